"""First-order states under their own names, and derived parameters."""

import math
import pickle

import numpy as np
import pytest

import lagrangian as lg

#: A current that decays through a resistance, i = i₀ e^{−Rt/L}, with a block at rest, and a family of states.
WINDING = """
machine Winding in plane {
    parameters { R: ohm = 2, L: H = 0.5, first: A = 3, tau: s = 1 }
    coordinates { x: m }
    inputs { U: V }
    states {
        /// The current.
        i: A = first,
        der(i) = (U - R*i)/L,
        T[k in 1..2]: K = 10*k, der(T[k in 1..2]) = -T[k]/tau,
    }
    bodies { block { mass: 1, at: (x, 0) } }
    gravity none;
}
"""


@pytest.fixture
def winding() -> lg.Machine:
    return lg.loads(WINDING)


def test_a_state_goes_by_its_name(winding):
    assert winding.states == ("i", "T[1]", "T[2]")
    assert winding.coordinates == ("x", "integral(i)", "integral(T)[1]", "integral(T)[2]")
    start = winding.start
    assert start.v["i"] == start.v["integral(i)"] == 3.0
    assert start.v["T[2]"] == 20.0 and start.v.names == ("x", "i", "T[1]", "T[2]")
    with pytest.raises(lg.UnknownName):
        start.q["i"]
    assert winding.units["i"] == "A" and winding.units["der(i)"] == "A/s" and winding.docs_of["i"] == "The current."
    assert "state" in winding._repr_html_()
    # The accelerations include the rates of states: di/dt = −R i/L.
    a = winding.accelerations(v={"i": [1.0, 2.0], "T": 1.0}, u={"U": 1.0})
    np.testing.assert_allclose(a[:, 1], [(1 - 2 * 1.0) / 0.5, (1 - 2 * 2.0) / 0.5], rtol=1e-15)
    np.testing.assert_allclose(a[:, 2:], -1.0, rtol=1e-15)
    np.testing.assert_array_equal(a, winding.accelerations(v={"integral(i)": [1.0, 2.0], "integral(T)": 1.0}, u={"U": 1.0}))


def test_runs_start_with_states_and_have_them(winding):
    run = winding.simulate(0.5, start={"i": 4.0, "T": 8.0, "T[2]": 9.0}, tolerance=1e-12)
    known = 4 * np.exp(-4 * run.t)
    # A tolerance of 1e-12 in each of about ten steps.
    np.testing.assert_allclose(run["i"], known, atol=1e-10)
    np.testing.assert_array_equal(run.v["i"], run["i"])
    np.testing.assert_allclose([run.end.v["T[1]"], run.end.v["T[2]"]], [8 * math.exp(-0.5), 9 * math.exp(-0.5)], atol=1e-10)
    further = winding.simulate(1.0, start=run.end, tolerance=1e-12)
    assert abs(further.end.v["i"] - 4 * math.exp(-4)) < 1e-10
    # A law of an input and an event that read the state by name.
    held = winding.simulate(0.5, inputs={"U": lambda t, q, v: 2 * v["i"]}, events={"seen": lambda t, q, v: v["i"] - 2.9})
    assert abs(held.end.v["i"] - 3.0) < 1e-12 and not held.events
    with pytest.raises(lg.UnknownName):
        winding.simulate(0.5, start={"j": 1.0})


def test_models_and_derivatives_know_states(winding):
    model = winding.linearize(outputs=["i", "der(i)"])
    assert "i" in model.states and model.outputs == ("i", "der(i)")
    k = model.states.index("i")
    np.testing.assert_allclose(model.C[:, k], [1.0, -4.0], rtol=1e-12)
    np.testing.assert_allclose(model.D[:, 0], [0.0, 2.0], rtol=1e-12)
    found = winding.sensitivities(0.5, ["start(i)", "R"], tolerance=1e-12, every=0.1)
    np.testing.assert_allclose(found.sensitivity("i", "start(i)"), np.exp(-4 * found.t), atol=1e-10)
    np.testing.assert_allclose(found.sensitivity("i", "R"), -found.t / 0.5 * 3 * np.exp(-4 * found.t), atol=1e-10)
    assert found.v["i"][0] == 3.0
    sweep = winding.sweep({"start(i)": [1.0, 2.0]}, until=0.5, start={"T": 1.0}, reduce={"last": "last(i)"}, tolerance=1e-12)
    np.testing.assert_allclose(sweep.grid("last"), np.array([1.0, 2.0]) * math.exp(-2), atol=1e-10)


def test_orbits_have_states():
    # τ u′ = U sin Ωt − u, with a block that comes to rest.
    circuit = lg.loads(
        """machine Filter in plane {
            parameters { tau: s = 0.5, Omega: rad/s = 4 }
            coordinates { x: m }
            states { u: V = 0, der(u) = (2*V*sin(Omega*t) - u)/tau }
            bodies { block { mass: 1, at: (x, 0) } }
            springs { back { stiffness: 1, stretch: x } }
            dampers { oil { damping: 3, stretch: x } }
            gravity none;
        }"""
    )
    orbit = circuit.orbit(period="2*pi/Omega", start={"u": 0.3})
    assert orbit.states == ("x", "der(x)", "u")
    # About ten steps err by 1e-11 each.
    assert abs(orbit.start.v["u"] + 2 * 2 / (1 + 4)) < 1e-9
    assert np.abs(orbit.multipliers - math.exp(-orbit.period / 0.5)).min() < 1e-9
    run = orbit.simulate(tolerance=1e-11)
    assert abs(run.end.v["u"] - orbit.start.v["u"]) < 1e-9


#: A disc on a torsion spring: φ = φ₀ cos ωt, ω² = c/J, J = m r²/2.
DISC = """
machine Disc in plane {
    parameters { m: kg = 2, r: m = 0.5, c: N*m = 4, J: kg*m^2 = m*r^2/2, K: kg*m^2 = 2*J, w[k in 1..2]: m = k*r }
    coordinates { phi: rad = 0.3 }
    bodies { disc { mass: m, inertia: J, at: (0, 0), angle: phi } }
    torsion_springs { wire { stiffness: c, twist: phi } }
    outputs { twice: kg*m^2 = K, first: m = w[1], second: m = w[2] }
}
"""


def _omega(machine: lg.Machine) -> float:
    return math.sqrt(-float(machine.accelerations({"phi": 1.0}, {"phi": 0.0})[0]))


def test_a_derived_parameter_is_given_a_value(tmp_path):
    disc = lg.loads(DISC)
    assert disc.derived_parameters == ("J", "K", "w[1]", "w[2]") and "J" not in disc.parameters
    assert disc.units["J"] == "kg*m^2"
    assert abs(_omega(disc) - 4.0) < 1e-14
    # J follows from another mass by its formula, and no longer once it has a value of its own; K still follows.
    assert abs(_omega(disc.with_parameters(m=8)) - 2.0) < 1e-14
    given = disc.with_parameters(m=8, J=1.0)
    assert given.parameters["J"] == 1.0 and given.derived_parameters == ("K", "w[1]", "w[2]")
    assert abs(_omega(given) - 2.0) < 1e-14
    assert abs(_omega(given.with_parameters(m=3)) - 2.0) < 1e-14
    assert float(given.evaluate().outputs["twice"]) == 2.0
    assert abs(_omega(given.with_parameters(J=4)) - 1.0) < 1e-14
    member = disc.with_parameters({"w[2]": 7.0}, r=0.25).evaluate().outputs
    assert (float(member["first"]), float(member["second"])) == (0.25, 7.0)
    path = tmp_path / "disc.machine"
    path.write_text(DISC)
    loaded = lg.load(path, J=1.0, m=8)
    assert abs(_omega(loaded) - 2.0) < 1e-14
    again = pickle.loads(pickle.dumps(given))
    assert again == given and again.parameters["J"] == 1.0 and again != disc
    # Commands, sweeps and derivatives use the value as well.
    assert abs(given.modes(start={"phi": 0.0}).frequencies[0] - 2.0 / (2 * math.pi)) < 1e-12
    assert abs(given.orbit(start={"phi": 0.1}).period - math.pi) < 1e-9
    found = given.sensitivities(1.0, "J", tolerance=1e-12)
    # ∂φ/∂J = φ₀ sin(ωt) ω t/(2J).
    np.testing.assert_allclose(found.sensitivity("phi", "J")[-1], 0.3 * math.sin(2.0) * 2.0 / 2, atol=1e-10)
    sweep = given.sweep({"m": [1.0, 2.0]}, until=1.0, reduce={"last": "last(phi)"}, tolerance=1e-12)
    np.testing.assert_allclose(sweep.grid("last"), 0.3 * math.cos(2.0), atol=1e-10)
    sweep = disc.sweep({"J": [1.0, 4.0]}, until=1.0, reduce={"last": "last(phi)"}, tolerance=1e-12)
    np.testing.assert_allclose(sweep.grid("last"), 0.3 * np.cos([2.0, 1.0]), atol=1e-10)
    with pytest.raises(lg.UnknownName, match="did you mean"):
        disc.with_parameters(JJ=1.0)

"""Periodic motions against closed forms."""

import math

import numpy as np
import pytest

import lagrangian as lg

CIRCLE = """
machine Circle in plane {
    parameters { d: N*s/m = 1, size: m = 1, speed: m/s = 1 }
    coordinates { x: m = 1.5 }
    bodies { ball { mass: 1, at: (x, 0) } }
    springs { back { stiffness: 1, stretch: x } }
    forces { feed { on: x, value: d*(1 - (x/size)^2 - (der(x)/speed)^2)*der(x) } }
}
"""


def test_a_limit_cycle_in_closed_form():
    found = lg.loads(CIRCLE).orbit(near=6)
    # Each step errs by 1e-11, and a period has about a hundred.
    assert found.period == pytest.approx(2 * math.pi, rel=1e-8)
    assert found.stability == "stable" and found.autonomous and found.family == 0
    assert np.allclose(found.multipliers, [1, math.exp(-2 * math.pi)], rtol=0, atol=1e-8)
    assert list(found.trivial) == [True, False]
    assert math.hypot(found.start.q["x"], found.start.v["x"]) == pytest.approx(1, abs=1e-8)
    run = found.simulate(tolerance=1e-11)
    assert run.end.q["x"] == pytest.approx(found.start.q["x"], abs=1e-8)


def test_upright_is_an_orbit(machines):
    pendulum = lg.load(machines / "kapitza_pendulum.machine")
    found = pendulum.orbit(period="2*pi/omega", start={"theta": 0})
    # Mathieu's equation, by mpmath to 30 digits: cli/tests/command/orbit/by_mpmath.py.
    assert abs(found.multipliers[0] - complex(0.926172254050953, 0.377100723714735)) < 1e-8
    assert np.linalg.det(found.monodromy) == pytest.approx(1, abs=1e-8)
    weak = pendulum.with_parameters(omega=30).orbit(period="2*pi/omega", start={"theta": 0})
    assert weak.stability == "unstable"
    with pytest.raises(lg.LagrangianError, match="change with time"):
        pendulum.orbit()

"""Linear models and modes against closed forms, and against SciPy."""

import json

import numpy as np
import pytest
from conftest import ROOT

import lagrangian as lg

OSCILLATOR = """machine Oscillator in plane {
    parameters { m: kg = 2, k: N/m = 4, c: N*s/m = 1 }
    coordinates { x: m = 0.3 }
    inputs { push: N = 0 }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    dampers { damper { damping: c, stretch: x } }
    forces { push { on: x, value: push } }
}"""


def test_an_oscillator_has_the_matrices_of_the_textbook():
    m = lg.loads(OSCILLATOR)
    model = m.linearize(rate={"x": 2.0}, u={"push": 3.0}, outputs=["x", "der(x,2)"])
    assert model.A.tolist() == [[0.0, 1.0], [-2.0, -0.5]]
    assert model.B.tolist() == [[0.0], [0.5]]
    assert model.C.tolist() == [[1.0, 0.0], [-2.0, -0.5]]
    assert model.D.tolist() == [[0.0], [0.5]]
    assert model.drift == pytest.approx([2.0, (3 - 1.2 - 2) / 2], rel=1e-14)
    assert model.states == ("x", "der(x)") and model.outputs == ("x", "der(x,2)")
    rest = m.linearize(steady={}, u={"push": 3.0})
    assert rest.at.q["x"] == pytest.approx(0.75, rel=1e-15) and not rest.drift.any()
    s = 1j * np.array([0.1, 1.0, 10.0])
    exact = 1 / (2 * s**2 + s + 4)
    assert rest.response(s.imag)[:, 0, 0] == pytest.approx(exact, rel=1e-13)
    assert rest.eigenvalues() == pytest.approx([-0.25 + 1j * np.sqrt(1.9375), -0.25 - 1j * np.sqrt(1.9375)])
    modes = m.modes()
    assert len(modes) == 1 and modes[0].damping == pytest.approx(0.25 / np.sqrt(2))
    assert m.equilibrium(u={"push": 3.0}).q["x"] == pytest.approx(0.75)


def test_frequencies_are_those_of_the_textbook():
    m = lg.load(ROOT / "machines" / "double_pendulum.machine")
    modes = m.modes(start={"theta1": 0.3})
    exact = np.sqrt(9.81 * (2 + np.array([-1, 1]) * np.sqrt(2)))
    assert modes.eigenvalues == pytest.approx(1j * exact, rel=1e-12)
    assert [mode.kind for mode in modes] == ["oscillation"] * 2
    assert modes.shapes.shape == (2, 2)


def test_files_hold_the_model(tmp_path):
    m = lg.loads(OSCILLATOR)
    model = m.linearize(steady={})
    for ending in ("json", "npz", "csv"):
        model.save(tmp_path / f"model.{ending}")
    assert np.load(tmp_path / "model.npz")["A"].tolist() == model.A.tolist()
    assert np.load(tmp_path / "model.npz")["states"].tolist() == ["x", "der(x)"]
    document = json.loads((tmp_path / "model.json").read_text())
    assert document["A"] == model.A.tolist() and document["basis"] is None
    assert (tmp_path / "model.A.csv").read_text() == ",x,der(x)\nx,0.0,1.0\nder(x),-2.0,-0.5\n"
    io = pytest.importorskip("scipy.io")
    model.save(tmp_path / "model.mat")
    assert io.loadmat(tmp_path / "model.mat")["B"].tolist() == model.B.tolist()
    with pytest.raises(ValueError, match="ending"):
        model.save(tmp_path / "model.txt")


def test_poles_and_zeros_are_those_of_scipy():
    linalg = pytest.importorskip("scipy.linalg")
    m = lg.load(ROOT / "machines" / "cart_pole.machine")
    model = m.linearize(steady={}, outputs=["x"])
    found = np.sort_complex(model.eigenvalues())
    assert found == pytest.approx(np.sort_complex(np.linalg.eigvals(model.A)), abs=1e-12)
    pencil = np.block([[model.A, model.B], [model.C, model.D]])
    masses = np.diag([1.0] * 4 + [0.0])
    zeros = linalg.eigvals(pencil, masses)
    zeros = np.sort_complex(zeros[np.isfinite(zeros) & (np.abs(zeros) < 1e6)])
    assert np.sort_complex(model.zeros()) == pytest.approx(zeros, rel=1e-9)
    assert model.scipy().A.tolist() == model.A.tolist()


def test_mistakes_are_told():
    m = lg.load(ROOT / "machines" / "cart_pole.machine")
    with pytest.raises(lg.UnknownName, match="did you mean"):
        m.linearize(outputs=["tipp"])
    with pytest.raises(lg.UnknownName):
        m.modes(steady={"xx": 1.0})
    with pytest.raises(ValueError, match="more than once"):
        m.linearize(inputs=["push", "push"])
    with pytest.raises(ValueError, match="sliding"):
        lg.load(ROOT / "machines" / "block_on_incline.machine").modes()
    block = lg.loads(OSCILLATOR.replace("value: push", "value: push - 1*N*sign(der(x))"))
    with pytest.raises(ValueError, match="corner or a jump"):
        block.linearize(steady={})
    with pytest.raises(ValueError, match="corner or a jump"):
        block.modes()


def test_plots_show_the_response():
    plt = pytest.importorskip("matplotlib.pyplot")
    model = lg.loads(OSCILLATOR).linearize(steady={}, outputs=["x"])
    omega = np.array([0.1, np.sqrt(2.0), 10.0])
    gain, phase = (axes.lines[0].get_ydata() for axes in model.bode(omega).axes)
    # At resonance of 2 x'' + x' + 4 x only the damper acts: the gain is 1/ω, with a lag of a quarter turn.
    assert gain[1] == pytest.approx(-20 * np.log10(np.sqrt(2.0)), abs=1e-12)
    assert phase[1] == pytest.approx(-90.0, abs=1e-12)
    upper, lower, mark = model.nyquist(omega).axes[0].lines
    exact = 1 / (4 - 2 * omega**2 + 1j * omega)
    np.testing.assert_allclose(upper.get_xdata() + 1j * upper.get_ydata(), exact, rtol=1e-13)
    np.testing.assert_allclose(lower.get_ydata(), -exact.imag, rtol=1e-13)
    assert (mark.get_xdata()[0], mark.get_ydata()[0]) == (-1.0, 0.0)
    # By default the plot covers the poles.
    (line, *_) = model.bode().axes[0].lines
    assert line.get_xdata()[0] < np.sqrt(2.0) < line.get_xdata()[-1]
    plt.close("all")
    with pytest.raises(ValueError, match="from an input"):
        lg.load(ROOT / "machines" / "double_pendulum.machine").linearize(steady={}).bode()


BALL = """machine Ball in plane {
    parameters { m: kg = 2, g: m/s^2 = 10, r: m = 0.1, k: N/m = 800, b: N*s/m = 4 }
    coordinates { y: m = 1 }
    bodies { ball { mass: m, at: (0, y) } }
    gravity (0, -g);
    contacts { floor { gap: y - r, LAW } }
}"""


def test_a_ball_on_a_floor_that_yields_has_modes():
    m = lg.loads(BALL.replace("LAW", "compliance: linear(k, b)"))
    modes = m.modes()
    assert m.equilibrium().q["y"] == pytest.approx(0.1 - 20 / 800, rel=1e-14)
    assert modes.eigenvalues == pytest.approx([-1 + 1j * np.sqrt(399)], rel=1e-12)
    # In the air it falls.
    falling = m.linearize()
    assert falling.A.tolist() == [[0.0, 1.0], [0.0, 0.0]]
    assert falling.drift.tolist() == [0.0, -10.0]
    rigid = lg.loads(BALL.replace("LAW", "restitution: 0.5"))
    with pytest.raises(ValueError, match="rigid contacts, as `floor`, count as open"):
        rigid.modes()
    with pytest.raises(ValueError, match="the rigid contact `floor` is closed there"):
        rigid.linearize(start={"y": 0.1})


def test_modes_about_the_centre_are_in_cartesian_coordinates():
    m = lg.loads(
        """machine Particle in plane {
    parameters { m: kg = 2, kx: N/m = 8, ky: N/m = 18 }
    coordinates { s: m = 1, phi: rad }
    bodies { particle { mass: m, at: polar(s, phi) } }
    gravity none;
    springs { along { stiffness: kx, stretch: s*cos(phi) }, across { stiffness: ky, stretch: s*sin(phi) } }
    charts { particle: polar(s, phi) | cartesian(x, y) }
}"""
    )
    modes = m.modes()
    assert modes.eigenvalues == pytest.approx([2j, 3j], rel=1e-12)
    assert set(modes[0].shape) == {"x", "y"} and modes.equilibrium.q.names == ("x", "y")
    model = m.linearize(start={"s": 0.0})
    assert model.states == ("x", "y", "der(x)", "der(y)") and model.at.q.names == ("x", "y")
    np.testing.assert_allclose(model.A[2:, :2], [[-4, 0], [0, -9]], atol=1e-12)
    # Away from the centre they are those of the spec, and an output that names one is of the spec alone.
    assert m.linearize().states == ("s", "phi", "der(s)", "der(phi)")
    with pytest.raises(ValueError, match="singular"):
        m.linearize(start={"s": 0.0}, outputs=["s"])

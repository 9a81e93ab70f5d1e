"""Derivatives of motions, against closed forms."""

import math

import numpy as np
import pytest

import lagrangian as lg


def test_derivatives_of_an_oscillation_are_those_of_its_closed_form(oscillator):
    found = oscillator.sensitivities(5, ["k", "m", "start(x)", "rate(x)", "force"], tolerance=1e-12, every=0.1)
    t, k, m = found.t, 8.0, 2.0
    w = math.sqrt(k / m)
    # x = x0 cos wt + v0/w sin wt + F/k (1 - cos wt), with x0 = 1, v0 = 0, F = 0.
    by_w = -t * np.sin(w * t)
    expected = {
        "k": by_w / (2 * m * w),
        "m": -by_w * w / (2 * m),
        "start(x)": np.cos(w * t),
        "rate(x)": np.sin(w * t) / w,
        "force": (1 - np.cos(w * t)) / k,
    }
    # A hundred steps with errors of 1e-12 in numbers of up to 5, and as much again because the derivatives grow with t.
    for name, values in expected.items():
        np.testing.assert_allclose(found.sensitivity("x", name), values, atol=1e-9)
    assert found.sensitivities.shape == (51, 2, 5)
    np.testing.assert_allclose(found.sensitivity("der(x)", "start(x)"), -w * np.sin(w * t), atol=1e-9)
    np.testing.assert_allclose(found.q["x"], np.cos(w * t), atol=1e-9)


def test_derivatives_are_those_of_neighbours(double):
    found = double.sensitivities(2, ["l2", "start(theta1)"], start={"theta1": 1.0}, tolerance=1e-12, at=[1.0, 2.0])
    h = 1e-5
    for name, changed in {
        "l2": lambda x: double.with_parameters(l2=1 + x).simulate(2, start={"theta1": 1.0}, tolerance=1e-13),
        "start(theta1)": lambda x: double.simulate(2, start={"theta1": 1 + x}, tolerance=1e-13),
    }.items():
        difference = (changed(h).end.y - changed(-h).end.y) / (2 * h)
        # The truncation error is a third derivative of about 1e3 times h²/6; runs have errors of 1e-12, divided by h.
        np.testing.assert_allclose(found.sensitivities[-1, :, found.by.index(name)], difference, atol=1e-5)


def test_what_has_no_derivatives_is_refused(double, machines):
    with pytest.raises(lg.UnknownName, match="did you mean `l1`"):
        double.sensitivities(1, "l11")
    with pytest.raises(lg.UnknownName):
        double.sensitivities(1, "start(l1)")
    with pytest.raises(ValueError, match="each once"):
        double.sensitivities(1, ["l1", "l1"])
    with pytest.raises(ValueError, match="outside of the run"):
        double.sensitivities(1, "l1", at=[2.0])
    with pytest.raises(ValueError, match="follows from others"):
        lg.load(machines / "bricard.machine").sensitivities(0.1, "g")


#: A pendulum described by its angle, and by the position of its ball on a rod.
SWING = """
machine Swing in plane {
    parameters { l: m = 0.5, g: m/s^2 = 9.81 }
    coordinates { theta: rad = 1 }
    bodies { ball { mass: 1, at: l*(sin(theta), -cos(theta)) } }
    gravity (0, -g);
}
"""

TIED = """
machine Swing in plane {
    parameters { l: m = 0.5, g: m/s^2 = 9.81 }
    coordinates { theta: rad = 1, x: m = l*sin(1), y: m = -l*cos(1) }
    bodies { ball { mass: 1, at: (x, y) } }
    constraints { across: x = l*sin(theta), along: y = -l*cos(theta) }
    gravity (0, -g);
}
"""


def test_derivatives_on_constraints_are_those_of_the_free_coordinate():
    by = ["l", "g", "start(theta)", "rate(theta)"]
    free = lg.loads(SWING).sensitivities(1.5, by, tolerance=1e-12, every=0.1)
    held = lg.loads(TIED).sensitivities(1.5, by, tolerance=1e-12, every=0.1, keep=["theta", "der(theta)"])
    theta, omega = free.q["theta"], free.v["theta"]
    for name in by:
        # About a hundred steps err by 1e-12 each; without projection the distance from the constraints grows with time.
        np.testing.assert_allclose(held.sensitivity("theta", name), free.sensitivity("theta", name), atol=1e-8)
        np.testing.assert_allclose(held.sensitivity("der(theta)", name), free.sensitivity("der(theta)", name), atol=1e-8)
        # y = −l cos θ.
        by_y = 0.5 * np.sin(theta) * free.sensitivity("theta", name) - (np.cos(theta) if name == "l" else 0.0)
        np.testing.assert_allclose(held.sensitivity("y", name), by_y, atol=1e-8)
    assert np.abs(omega).max() > 1


BALL = """machine Ball in plane {
    parameters { m: kg = 0.3, g: m/s^2 = 10, e: 1 = 0.5 }
    coordinates { y: m = 5 }
    bodies { ball { mass: m, at: (0, y) } }
    gravity (0, -g);
    contacts { floor { gap: y, restitution: e } }
}"""


def test_derivatives_are_continued_across_an_impact():
    # It falls for 1 s, and leaves the floor with e times 10 m/s: y = 10 e (t - T) - 5 (t - T)², T² = 2 y0/g.
    found = lg.loads(BALL).sensitivities(1.5, ["e", "start(y)"], tolerance=1e-12, every=0.5)
    np.testing.assert_allclose(found.t, [0, 0.5, 1.0, 1.5])
    np.testing.assert_allclose(found.q["y"][-1], 5 * 0.5 - 5 * 0.25, atol=1e-9)
    np.testing.assert_allclose(found.sensitivity("y", "e")[[1, 3]], [0, 10 * 0.5], atol=1e-8)
    # y = e g T s - g s²/2 with s = t - T and dT/dy0 = 1/(g T) = 0.1.
    expected = 0.1 * (0.5 * 10 * 0.5) + (0.5 * 10 - 10 * 0.5) * -0.1
    np.testing.assert_allclose(found.sensitivity("y", "start(y)")[[1, 3]], [1, expected], atol=1e-8)
    with pytest.raises(ValueError, match="leave `t0` and `at` out"):
        lg.loads(BALL).sensitivities(1.5, "e", at=[1.0])


def test_derivatives_pass_the_centre_of_polar_coordinates():
    particle = lg.loads(
        """machine Particle in plane {
    parameters { m: kg = 2, k: N/m = 8 }
    coordinates { s: m = 1, phi: rad }
    bodies { particle { mass: m, at: polar(s, phi) } }
    gravity none;
    springs { to_centre { stiffness: k, stretch: s } }
    charts { particle: polar(s, phi) | cartesian(x, y) }
}"""
    )
    # s = |cos wt| through the centre at π/4, w = 2.
    found = particle.sensitivities(1.5, ["k", "start(s)"], tolerance=1e-12, every=0.5)
    side = np.sign(np.cos(2 * found.t))
    np.testing.assert_allclose(found.q["s"], np.abs(np.cos(2 * found.t)), atol=1e-9)
    np.testing.assert_allclose(found.sensitivity("s", "start(s)"), side * np.cos(2 * found.t), atol=1e-8)
    np.testing.assert_allclose(found.sensitivity("s", "k"), -side * found.t * np.sin(2 * found.t) / 8, atol=1e-8)

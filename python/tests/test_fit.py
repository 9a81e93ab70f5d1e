"""Fits against SciPy's least squares on a closed form."""

import math

import numpy as np
import pytest

import lagrangian as lg

TEXT = """machine Oscillator in plane {
    parameters { m: kg = 2, k: N/m = 25, c: N*s/m = 0.5 }
    coordinates { x: m = 0.1 }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    dampers { damper { damping: c, stretch: x } }
    gravity none;
}"""


def swung(t, m, k, c, x):
    """x of m x'' + c x' + k x = 0, released from rest."""
    decay = c / (2 * m)
    omega = np.sqrt(k / m - decay**2)
    return np.exp(-decay * t) * x * (np.cos(omega * t) + decay / omega * np.sin(omega * t))


def measured(seed, m=2.0, x=0.1):
    t = np.arange(61) * 0.05
    return t, swung(t, m, 30.0, 0.6, x) + np.random.default_rng(seed).normal(0, 1e-3, t.size)


def test_a_fit_is_that_of_scipy():
    optimize = pytest.importorskip("scipy.optimize")
    t, x = measured(1)
    x[3] = math.nan
    fit = lg.loads(TEXT).fit({"t": t, "x": x}, ["k", "c", "start(x)"])
    kept = ~np.isnan(x)
    known, covariance = optimize.curve_fit(
        lambda t, k, c, x: swung(t, 2.0, k, c, x), t[kept], x[kept], [28.0, 0.5, 0.1], xtol=1e-14, ftol=1e-14
    )
    errors = np.sqrt(np.diag(covariance))
    found = np.array([fit[name] for name in fit.names])
    # The search ends within 1e-6 of a standard error; SciPy uses finite differences with an error
    # of about 1e-7.
    assert np.all(np.abs(found - known) < 1e-5 * errors)
    assert np.allclose(fit.covariance, covariance, rtol=1e-4, atol=1e-4 * np.min(np.diag(covariance)))
    assert fit.converged and fit.derivatives == "integrated" and fit.measurements == kept.sum()
    assert fit.machine.parameters["k"] == fit["k"]
    # The residuals agree with the closed form at the estimates to the tolerance of runs.
    k, c, x0 = found
    assert np.allclose(fit.residuals["x"], (x - swung(t, 2.0, k, c, x0))[kept], rtol=0, atol=1e-7)


def test_several_experiments_have_settings_and_starts_of_their_own():
    runs = [dict(zip(("t", "x"), measured(2))), dict(zip(("t", "x"), measured(3, m=4.0, x=0.2)))]
    fit = lg.loads(TEXT).fit(runs, ["k", "c", "start(x)"], settings=[{}, {"m": 4}], sigma={"x": 1e-3})
    assert fit.names == ("k", "c", "start(x) in 1", "start(x) in 2")
    truth = [30.0, 0.6, 0.1, 0.2]
    for name, value in zip(fit.names, truth):
        # Five standard errors are exceeded by one seed in a million, and these seeds are fixed.
        assert abs(fit[name] - value) < 5 * fit.standard_errors[name]
    assert set(fit.experiment) == {1, 2}


def test_what_cannot_be_told_apart_is_named():
    fit = lg.loads(TEXT).fit(dict(zip(("t", "x"), measured(4))), ["m", "k", "c"])
    assert [one.formula for one in fit.combinations] == ["m/c", "k/c"]
    assert set(fit.standing.values()) == {"entangled"}
    assert math.isnan(fit.standard_errors["k"]) and "cannot be told apart" in fit.warnings[0]


def test_what_is_wrong_is_raised():
    machine = lg.loads(TEXT)
    t, x = measured(5)
    with pytest.raises(ValueError, match="did you mean"):
        machine.fit({"t": t, "x": x}, "kk")
    with pytest.raises(ValueError, match="column `t`"):
        machine.fit({"x": x}, "k")
    with pytest.raises(ValueError, match="shape"):
        machine.fit({"t": t, "x": x[:-1]}, "k")
    with pytest.raises(ValueError, match="number of experiments is 1"):
        machine.fit({"t": t, "x": x}, "k", settings=[{}, {}])

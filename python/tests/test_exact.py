"""Errors of runs, runs in double-double and enclosures, against the closed form of a mass on a spring, x = cos 2t."""

import math
from decimal import Context, Decimal, localcontext

import pytest

import lagrangian as lg

#: cos 2 and −2 sin 2 (mpmath, 40 digits).
COS2 = Decimal("-0.4161468365471423869975682295007621897660")
RATE = Decimal("-1.8185948536513633907920397318234896854046")


def test_a_global_error_is_near_the_true_one(oscillator):
    run = oscillator.simulate(1, tolerance=1e-6)
    found = oscillator.global_error(1, tolerance=1e-6)
    assert set(found.errors) == {"x", "der(x)"} and found.kind == "estimate" and not found.is_rounding
    true = abs(run.end.q["x"] - float(COS2))
    # The reference is exact, so the estimate equals the true error up to the rounding of both ends.
    assert abs(found.errors["x"] - true) <= 4 * 2**-53
    assert true <= 1e-6


def test_an_end_in_double_double(oscillator):
    found = oscillator.precise(1)
    for name, values, exact in (("q", found.q, COS2), ("v", found.v, RATE)):
        # One step, whose error is at most the tolerance, plus the rounding of the thirtieth digit.
        with localcontext(Context(prec=50)):
            assert abs(values["x"] - exact) <= Decimal(found.tolerance) + Decimal("5e-30"), name
    assert found.steps == 1
    assert found.t == 1.0 and 0 <= found.difference < 1e-27


def test_an_enclosure_contains_the_motion(oscillator):
    found = oscillator.validated(0.5)
    for (low, high), exact in ((found.q["x"], math.cos(1.0)), (found.v["x"], -2 * math.sin(1.0))):
        assert low <= exact <= high and high - low < 1e-11
    assert found.steps > 0


def test_what_has_none_says_so(machines):
    four_bar = lg.load(machines / "four_bar.machine")
    with pytest.raises((ValueError, lg.LagrangianError), match="constraint"):
        four_bar.precise(0.1)
    with pytest.raises((ValueError, lg.LagrangianError), match="constraint"):
        four_bar.validated(0.1)


def test_a_program_is_exact(double):
    assert not double.check().accuracy
    found = double.check(accuracy=True).accuracy
    assert {"mass_matrix", "bias", "applied", "accelerations"} <= set(found)
    for one in found.values():
        assert one.states > 100 and 0 <= one.median <= one.worst and set(one.state["q"]) == {"theta1", "theta2"}

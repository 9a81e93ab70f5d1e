"""Exceptions, and the information in them."""

import pickle

import numpy as np
import pytest

import lagrangian as lg
from conftest import OSCILLATOR


def test_mistakes_of_a_spec_have_their_place():
    with pytest.raises(lg.SpecError) as error:
        lg.loads(OSCILLATOR.replace("value: force", "value: farce"), name="spring.machine")
    (one,) = error.value.diagnostics
    line = OSCILLATOR.splitlines().index("    forces { push { on: x, value: force } }") + 1
    assert (one.code, one.file, one.line) == ("unknown-name", "spring.machine", line)
    assert f"{'^' * len('farce')}" in str(error.value)
    assert "force" in one.help
    assert isinstance(error.value, ValueError)


def test_mistakes_of_a_formula_are_told_where_it_is(oscillator):
    with pytest.raises(lg.SpecError) as error:
        oscillator.simulate(1, inputs={"force": "-2*der(y)"})
    assert error.value.diagnostics[0].file == "input force"
    assert error.value.diagnostics[0].column == 8
    with pytest.raises(lg.SpecError) as error:
        oscillator.simulate(1, inputs={"force": "x + 1*s"})
    assert error.value.diagnostics[0].file == "input force"


def test_unknown_names_are_told_with_the_near_one(oscillator):
    for call in (
        lambda: oscillator.with_parameters(mm=1),
        lambda: oscillator.simulate(1, start={"xx": 1}),
        lambda: oscillator.simulate(1, inputs={"forse": 1}),
        lambda: oscillator.simulate(1)["pul"],
        lambda: oscillator.evaluate({"y": 1}),
        lambda: oscillator.sweep({"m": [1, 2]}, until=1)["stats"],
    ):
        with pytest.raises(lg.UnknownName) as error:
            call()
        assert error.value.name in str(error.value)
        assert error.value.known
    with pytest.raises(LookupError, match="did you mean `force`"):
        oscillator.simulate(1, inputs={"forse": 1})


def test_values_that_no_machine_has_are_refused(oscillator):
    with pytest.raises(ValueError, match="mass must be positive"):
        oscillator.with_parameters(m=-1)
    with pytest.raises(ValueError, match="mass must be positive"):
        oscillator.accelerations(parameters={"m": [1.0, -1.0]})
    with pytest.raises(TypeError):
        oscillator.with_parameters(m="1")


def test_shapes_and_kinds_are_told(double):
    with pytest.raises(ValueError, match=r"q has shape \(3, 8\), expected \(…, 2\)"):
        double.accelerations(np.zeros((3, 8)))
    with pytest.raises(ValueError, match=r"q has shape \(3,\), expected \(2,\)"):
        double.accelerations(np.zeros(3), np.zeros(2))
    with pytest.raises(ValueError, match="cannot be broadcast together"):
        double.accelerations(np.zeros((3, 2)), np.zeros((4, 2)))
    for wrong in (np.zeros(2, complex), np.array(["a", "b"]), np.array([None, None])):
        with pytest.raises(TypeError, match="q is an array of"):
            double.accelerations(wrong)
    for wrong in (np.nan, np.inf):
        with pytest.raises(ValueError, match="not finite"):
            double.simulate(1, start={"theta1": wrong})
        assert np.isnan(double.accelerations({"theta1": wrong})).all()
        assert np.isnan(double.accelerations(np.array([wrong, 0.0]), np.zeros(2))).all()


SINGULAR = """
machine Spherical in space {
    parameters { m: kg = 1, l: m = 1 }
    coordinates { theta: rad = 1, phi: rad }
    bodies { bob { mass: m, at: l*(sin(theta)*cos(phi), sin(theta)*sin(phi), -cos(theta)) } }
    gravity (0, 0, -9.81);
}
"""


def test_singular_states_are_raised_or_are_nan():
    machine = lg.loads(SINGULAR)
    q = np.array([[1.0, 0.0], [0.0, 0.3], [0.5, 0.0], [0.0, 0.0]]).reshape(2, 2, 2)
    with pytest.raises(lg.SingularError) as error:
        machine.accelerations(q)
    assert error.value.coordinate == "phi"
    assert error.value.index == (0, 1)
    a = machine.accelerations(q, singular="nan")
    assert np.isnan(a[:, 1]).all() and np.isfinite(a[:, 0]).all()
    found = machine.evaluate(q, singular="nan")
    assert found.ok.tolist() == [[True, False], [True, False]]
    with pytest.raises(lg.SingularError) as error:
        machine.accelerations(np.zeros(2), np.zeros(2))
    assert error.value.index == ()


def test_an_exception_of_a_function_is_raised_as_it_is(oscillator):
    class Mine(Exception):
        pass

    def broken(t, q, v):
        if t > 0.5:
            raise Mine("no more")
        return 0.0

    for settings in ({"inputs": {"force": broken}}, {"events": {"e": broken}}, {"stop": broken}):
        with pytest.raises(Mine, match="no more") as error:
            oscillator.simulate(10, **settings)
        assert any(frame.name == "broken" for frame in error.traceback)
    with pytest.raises(ValueError, match="input force: the function must return a number"):
        oscillator.simulate(1, inputs={"force": lambda t, q, v: "much"})
    with pytest.raises(ValueError, match="returned 2 numbers"):
        oscillator.simulate(1, inputs=lambda t, q, v: [1.0, 2.0])


def test_a_run_that_fails_keeps_what_there_is(double):
    with pytest.raises(lg.RunError) as error:
        double.simulate(100, max_steps=20)
    assert 0 < error.value.t < 100
    assert error.value.run.end.t == error.value.t
    run = double.simulate(100, max_steps=20, on_error="return")
    assert run.ending == "error" and "20 steps" in run.error


def test_exceptions_pickle():
    errors = []
    for call in (
        lambda: lg.loads("machine"),
        lambda: lg.loads(OSCILLATOR).with_parameters(mm=1),
        lambda: lg.loads(SINGULAR).accelerations({"theta": 0.0}),
        lambda: lg.loads(OSCILLATOR.replace("m: kg = 2", "m: kg")).accelerations(),
        lambda: lg.loads(OSCILLATOR).simulate(100, max_steps=2),
    ):
        with pytest.raises(lg.LagrangianError) as error:
            call()
        errors.append(error.value)
    for error in errors:
        again = pickle.loads(pickle.dumps(error))
        assert type(again) is type(error) and str(again) == str(error)
    # The last error belongs to a run, and holds its part up to the error.
    np.testing.assert_array_equal(again.run["x"], errors[-1].run["x"])
    assert again.t == errors[-1].t == again.run.end.t and again.run.error == errors[-1].run.error

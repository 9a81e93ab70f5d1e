"""Machines: names, values, equality, pickling."""

import copy
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest

import lagrangian as lg
from conftest import OSCILLATOR


def test_names_values_and_units(oscillator):
    assert oscillator.name == "Oscillator"
    assert oscillator.docs == "A mass on a spring."
    assert oscillator.coordinates == ("x",)
    assert dict(oscillator.parameters) == {"m": 2.0, "k": 8.0}
    assert dict(oscillator.inputs) == {"force": 0.0}
    assert oscillator.units["der(x)"] == "m/s"
    assert oscillator.outputs == ("pull",)
    assert oscillator.start.q["x"] == 1.0
    with pytest.raises(TypeError):
        oscillator.parameters["m"] = 3.0
    with pytest.raises(ValueError):
        oscillator.start.q[0] = 3.0


def test_what_the_spec_says_is_known_by_name():
    machine = lg.loads(
        """machine Rod in plane {
            parameters { /// Its length.
                l: m = 2 }
            coordinates { /// Across.
                x: m = 2, y: m }
            bodies { bead { mass: 1, at: (x, y) } }
            constraints { /// Keeps its length.
                rod: x^2 + y^2 = l^2 }
            outputs { r: m = x }
            gravity (0, -9.81);
        }"""
    )
    said = machine.docs_of
    assert (said["l"], said["x"], said["der(x)"], said["y"]) == ("Its length.", "Across.", "Across.", "")
    assert said["rod"] == said["multiplier(rod)"] == "Keeps its length." and said["r"] == ""
    assert set(machine.units) <= set(said)
    assert set(machine.constraints) | set(machine.contacts) <= set(said)


def test_other_values_make_another_machine_of_the_same_program(oscillator):
    heavier = oscillator.with_parameters(m=4, force=1)
    assert (heavier.parameters["m"], heavier.inputs["force"]) == (4.0, 1.0)
    assert oscillator.parameters["m"] == 2.0
    assert heavier != oscillator
    assert heavier.with_parameters(m=2, force=0) == oscillator
    # a = (F − k x)/m
    assert heavier.accelerations() == pytest.approx([(1 - 8) / 4], rel=1e-15)


def test_equal_texts_are_equal_machines(oscillator):
    again = lg.loads(OSCILLATOR)
    assert again == oscillator and hash(again) == hash(oscillator)
    assert copy.copy(oscillator) is oscillator and copy.deepcopy(oscillator) is oscillator
    assert lg.loads(OSCILLATOR + "\n// another") != oscillator


def test_machines_pickle_with_their_bases(machines):
    crusher = lg.load(machines / "crushing_crusher.machine")
    assert crusher.files, "it extends another spec"
    bytes_ = pickle.dumps(crusher)
    again = pickle.loads(bytes_)
    assert again == crusher
    assert np.array_equal(again.accelerations(), crusher.accelerations())


def test_families_and_constants(machines):
    chain = lg.load(machines / "chain.machine", constants={"N": 3})
    assert len(chain.coordinates) == 3
    assert chain.constants == {"N": Fraction(3)}
    longer = chain.with_constants(N=4)
    assert len(longer.coordinates) == 4
    family = next(name for name in chain.coordinates if "[" in name)
    base = family.split("[")[0]
    run = chain.simulate(0.01, start={base: 0.1, f"{base}[2]": 0.2})
    assert list(run.q[0]) == [0.1, 0.2, 0.1]
    with pytest.raises(ValueError, match="finite"):
        chain.with_constants(N=math.nan)


def test_bases_are_given_or_read_from_a_folder(tmp_path):
    variant = 'machine Heavier extends "base.machine" { parameters { m: kg = 5 } }'
    given = lg.loads(variant, files={"base.machine": OSCILLATOR})
    assert given.parameters["m"] == 5.0
    (tmp_path / "base.machine").write_text(OSCILLATOR)
    read = lg.loads(variant, folder=tmp_path)
    assert read.parameters["m"] == 5.0
    with pytest.raises(lg.SpecError, match="not among `files`"):
        lg.loads(variant, files={})


def test_parameters_without_a_value_are_missed_when_numbers_are_needed():
    text = OSCILLATOR.replace("m: kg = 2", "m: kg")
    machine = lg.loads(text)
    assert math.isnan(machine.parameters["m"])
    for needs in (machine.accelerations, machine.evaluate, lambda: machine.simulate(1)):
        with pytest.raises(lg.MissingParameters) as missing:
            needs()
        assert missing.value.names == ["m"]
    assert lg.loads(text, m=2.0).accelerations() == pytest.approx([-4.0])
    # A sweep that leaves it without a value raises the same error; one that sets it in every run does not.
    sweep = machine.sweep({"m": [1.0, 2.0]}, until=0.1)
    assert len(sweep) == 2 and not len(sweep.failed)


def test_what_is_shown_in_a_notebook(oscillator):
    html = oscillator._repr_html_()
    assert "<code>k</code>" in html and "N/m" in html
    assert "Oscillator" in oscillator.equations._repr_markdown_()
    assert "documentclass" in oscillator.equations.latex()
    assert "accelerations" in oscillator.program.text
    for form in ("rust", "c", "html"):
        assert oscillator.derive(form)
    with pytest.raises(ValueError, match="no form named"):
        oscillator.derive("fortran")

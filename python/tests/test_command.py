"""Results of the command's functions in Python, and the command itself."""

import ctypes
import json
import math
import os
import re
import shutil
import subprocess
import sys
import zipfile

import numpy as np
import pytest

import lagrangian as lg
from conftest import OSCILLATOR, ROOT


def lagrangian(*arguments, **settings):
    """The command of the package."""
    call = [sys.executable, "-m", "lagrangian", *map(str, arguments)]
    return subprocess.run(call, capture_output=True, text=True, cwd=ROOT, **settings)


# Where the package implements what each command does.
IN_PYTHON = {
    "check": (lg.Machine, "check"),
    "derive": (lg.Machine, "derive"),
    "library": (lg.Machine, "library"),
    "fmu": (lg.Machine, "fmu"),
    "evaluate": (lg.Machine, "evaluate"),
    "simulate": (lg.Machine, "simulate"),
    "sweep": (lg.Machine, "sweep"),
    "map": (lg.Sweep, "map"),
    "modes": (lg.Machine, "modes"),
    "linearize": (lg.Machine, "linearize"),
    "orbit": (lg.Machine, "orbit"),
    "sensitivities": (lg.Machine, "sensitivities"),
    "compare": (lg.Machine, "compare"),
    "spectrum": (lg.Machine, "spectrum"),
    "peaks": (lg.Machine, "peaks"),
    "section": (lg.Machine, "section"),
    "fit": (lg.Machine, "fit"),
    "brachistochrone": (lg.Machine, "brachistochrone"),
    "import": (lg, "from_mjcf"),
}


def commands(help_text):
    """The names of commands that ``--help`` lists."""
    listed = help_text.split("Commands:\n")[1].split("\n\n")[0]
    return [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and line[2] != " "]


def test_every_command_has_a_place_in_the_package():
    told = lagrangian("--help", env={**os.environ, "COLUMNS": "200"})
    assert told.returncode == 0, told.stderr
    assert set(commands(told.stdout)) - {"help"} == set(IN_PYTHON)
    for command, place in IN_PYTHON.items():
        owner, name = place
        assert callable(getattr(owner, name, None)), command
        assert getattr(owner, name).__doc__, command


def test_the_package_is_the_command():
    said = lagrangian("simulate", "machines/simple_pendulum.machine", "--until", "1", "--json")
    assert said.returncode == 0, said.stderr
    document = json.loads(said.stdout)
    run = lg.load(ROOT / "machines" / "simple_pendulum.machine").simulate(1)
    assert document["q"] == {"theta": run.end.q["theta"]}
    said = lagrangian("simulate", "machines/simple_pendulum.machin", "--until", "1")
    assert said.returncode == 2 and "cannot read" in said.stderr


def test_degrees_of_freedom_and_printed_formulas(machines):
    found = lg.load(machines / "four_bar.machine").check()
    # Three bars with three numbers each, or angles with two equations: either has one degree of freedom.
    assert found.degrees_of_freedom == 1 and found.coordinates - found.independent == 1
    plain = lg.loads(OSCILLATOR).check()
    assert plain.ok and plain.degrees_of_freedom == plain.coordinates == 1
    text = OSCILLATOR.replace("gravity none;", 'gravity none; published "a print" { kinetic_energy = m*der(x)^2 }')
    printed = lg.loads(text).check()
    (formula,) = printed.published
    # The published energy is twice the correct one.
    assert (formula.block, formula.agrees) == ("a print", False) and not printed.ok
    assert formula.drop and formula.add


BEAD = """
machine Bead in plane {
    parameters { g: m/s^2 = 9.81 }
    coordinates { x: m, y: m }
    bodies { bead { mass: 1, at: (x, -y) } }
    gravity (0, -g);
}
"""


def test_the_fastest_way_is_a_cycloid():
    bead = lg.loads(BEAD)
    # From the cusp of a cycloid with radius r to its lowest point: pi r along, 2 r down, in pi sqrt(r/g).
    r = 0.5
    found = bead.brachistochrone({"x": math.pi * r, "y": 2 * r})
    assert found.is_motion
    assert found.time == pytest.approx(math.pi * math.sqrt(r / 9.81), rel=1e-9)
    # The cycloid is x = r (phi - sin phi), y = r (1 - cos phi), with phi = t sqrt(g/r).
    phi = found.t * math.sqrt(9.81 / r)
    np.testing.assert_allclose(found.q["x"], r * (phi - np.sin(phi)), atol=1e-9)
    np.testing.assert_allclose(found.q["y"], r * (1 - np.cos(phi)), atol=1e-9)
    with pytest.raises(lg.UnknownName):
        bead.brachistochrone({"z": 1.0})
    with pytest.raises(ValueError):
        bead.brachistochrone()


def test_a_fastest_way_is_saved(tmp_path):
    found = lg.loads(BEAD).brachistochrone({"x": 1.0, "y": 1.0})
    for ending in ("csv", "svg", "html"):
        found.save(tmp_path / f"way.{ending}")
        assert (tmp_path / f"way.{ending}").stat().st_size > 1000
    with pytest.raises(ValueError, match="ending"):
        found.save(tmp_path / "way.txt")


ROTOR = """
/// A whirling mass on a spring in a frame that turns: frequencies split.
machine Whirl in plane {
    parameters { m: kg = 1, k: N/m = 100, omega: rad/s = 1 }
    coordinates { x: m, y: m }
    frames { disc = ground.turn(omega*t) }
    bodies { mass { mass: m, at: disc.point(x, y) } }
    springs { a { stiffness: k, stretch: x }, b { stiffness: k, stretch: y } }
    gravity none;
}
"""


def test_a_campbell_diagram_follows_modes():
    rotor = lg.loads(ROTOR)
    found = rotor.campbell("omega", (1.0, 5.0, 9))
    # In the rotating frame: w = 10 ± omega.
    expected = np.stack([10 - found.values, 10 + found.values], axis=1) / (2 * np.pi)
    np.testing.assert_allclose(np.sort(found.frequencies, axis=1), expected, rtol=1e-9)
    # Each mode is followed continuously, so each is a straight line.
    assert np.abs(np.diff(found.frequencies, 2, axis=0)).max() < 1e-9
    with pytest.raises(ValueError, match="equally spaced"):
        rotor.campbell("omega", [1.0, 2.0, 4.0])
    with pytest.raises(ValueError, match="omga"):
        rotor.campbell("omga", (1.0, 5.0, 9))


def test_the_page_of_a_run(double, tmp_path):
    run = double.simulate(1)
    page = run.report()
    assert page.html.startswith("<!doctype html>") and "DoublePendulum" in page.html
    shown = page._repr_html_()
    # The frame has no access to its page.
    assert 'sandbox="allow-scripts allow-downloads"' in shown and "allow-same-origin" not in shown
    page.save(tmp_path / "run.html")
    assert (tmp_path / "run.html").read_text() == page.html
    run.save(tmp_path / "saved.html")
    assert (tmp_path / "saved.html").read_text() == page.html
    with pytest.raises(ValueError, match="dense"):
        double.simulate(1, dense=False).report()


def test_the_page_says_what_drives_the_machine(oscillator):
    run = oscillator.simulate(1, inputs={"force": "1*N*sin(2*rad/s*t)"})
    assert "1*N*sin(2*rad/s*t)" in run.report().html

    def push(t, q, v):
        return math.sin(t)

    assert "push(t, q, v)" in oscillator.simulate(1, inputs={"force": push}).report().html


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_the_package_needs_no_file_of_the_spec(tmp_path):
    base = tmp_path / "base.machine"
    base.write_text(OSCILLATOR)
    text = 'machine Heavier extends "base.machine" { parameters { m: kg = 5 } }'
    machine = lg.loads(text, name="heavier.machine", folder=tmp_path)
    base.unlink()
    assert machine.check().coordinates == 1
    assert machine.simulate(0.5).report().html


CLOSE = 1e-11


@pytest.mark.parametrize("name", ["arm", "leg", "hand"])
def test_robots_move_as_pinocchio_moves_them(name):
    # The references and the tolerance are those of the command's own test.
    folder = ROOT / "cli" / "tests" / "command" / "import"
    robot = lg.from_urdf(folder / f"{name}.urdf")
    for point in json.loads((folder / "pinocchio.json").read_text())[name]:
        seen = robot.evaluate(point["q"], point["v"])
        for quantity in ("mass_matrix", "bias", "applied", "accelerations"):
            truth = np.array(point[quantity])
            np.testing.assert_allclose(getattr(seen, quantity), truth, rtol=0, atol=CLOSE * np.abs(truth).max())


CLOSE_TO_MUJOCO = 1e-12
MODELS = ROOT / "cli" / "tests" / "command" / "import" / "mujoco"


@pytest.mark.parametrize("name", ["ant", "crane", "gripper", "half_cheetah", "hopper", "walker2d"])
def test_models_move_as_mujoco_moves_them(name):
    # The references and the tolerance are those of the command's own test.
    model = lg.from_mjcf(MODELS / f"{name}.xml")
    for point in json.loads((MODELS / "mujoco.json").read_text())[name]:
        truth = np.array(point["accelerations"])
        seen = model.accelerations(point["q"], point["v"], u=point["inputs"])
        np.testing.assert_allclose(seen, truth, rtol=0, atol=CLOSE_TO_MUJOCO * np.abs(truth).max())


def test_a_model_at_fault_is_told(tmp_path):
    with pytest.raises(ValueError, match="from_urdf"):
        lg.from_mjcf(ROOT / "cli" / "tests" / "command" / "import" / "arm.urdf")
    with pytest.raises(ValueError, match="cannot read"):
        lg.from_mjcf(tmp_path / "nowhere.xml")


def test_a_robot_at_fault_is_told_with_its_line(tmp_path):
    file = tmp_path / "robot.urdf"
    file.write_text('<robot name="r">\n  <link name="a"/>\n  <joint name="j" type="hinge"/>\n</robot>\n')
    with pytest.raises(ValueError, match="robot.urdf:3"):
        lg.from_urdf(file)
    with pytest.raises(ValueError, match="base"):
        lg.from_urdf(file, base="flying")
    with pytest.raises(ValueError, match="cannot read"):
        lg.from_urdf(tmp_path / "nowhere.urdf")


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_a_unit_has_the_values_of_the_machine(double, tmp_path):
    made = double.with_parameters(l2=0.25).fmu(
        tmp_path / "double.fmu", start={"theta1": 0.5}, outputs=["theta2"], events={"low": "theta1"}
    )
    # The number of events is an output too.
    assert (made.fmi, made.states, made.outputs, made.events) == ("3.0", 4, 2, 1) and len(made.platforms) == 1
    with zipfile.ZipFile(made.path) as unit:
        assert unit.testzip() is None
        description = unit.read("modelDescription.xml").decode()
    starts = dict(re.findall(r'name="([^"]*)"[^>]*?start="([^"]*)"', description))
    assert float(starts["l2"]) == 0.25 and float(starts["theta1"]) == 0.5
    sources = double.fmu(tmp_path / "sources.fmu", fmi=2, kind="cs", sources_only=True)
    assert sources.fmi == "2.0" and not sources.platforms and len(sources.kinds) == 1
    with pytest.raises(ValueError, match="thta1"):
        double.fmu(tmp_path / "wrong.fmu", outputs=["thta1"])
    with pytest.raises(lg.ExportError):
        double.fmu(tmp_path / "wrong.fmu", cc="no-such-compiler")
    assert not (tmp_path / "wrong.fmu").exists()


@pytest.mark.skipif(shutil.which("rustc") is None, reason="no Rust toolchain")
def test_a_library_computes_what_the_package_does(oscillator, tmp_path):
    header = oscillator.library(tmp_path / "oscillator.so", lanes=[2])
    assert "void eval2(" in (tmp_path / header).read_text()
    made = ctypes.CDLL(str(tmp_path / "oscillator.so"))
    made.eval.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p]
    made.parameter_name.restype = ctypes.c_char_p
    assert [made.parameter_name(i).decode() for i in range(made.parameters())] == list(oscillator.parameters)
    numbers = (ctypes.c_double * 3)(*oscillator.parameters.values(), 0.5)
    state, found = (ctypes.c_double * 2)(0.3, -0.2), (ctypes.c_double * 1)()
    made.eval_setup(numbers)
    made.eval(state, 0.0, numbers, found)
    assert list(found) == oscillator.accelerations([0.3], [-0.2], u=[0.5]).tolist()
    with pytest.raises(ValueError, match="lanes"):
        oscillator.library(tmp_path / "wrong.so", lanes=3)

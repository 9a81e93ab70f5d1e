"""Spectra, peaks, sections and differences against closed forms of a mass on a spring, x = cos 2t, and against the command."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest

import lagrangian as lg

SPEC = """machine Oscillator in plane {
    parameters { m: kg = 2, k: N/m = 8 }
    coordinates { x: m = 1 }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    gravity none;
}"""


@pytest.fixture
def block():
    return lg.loads(SPEC)


def test_the_line_of_an_oscillation(block):
    found = block.spectrum(100, every=0.05)
    line = found.lines["x"][0]
    # Isolated line: under Hann's window its error falls with the cube of the number of periods in the run, which is 32.
    assert line.frequency == pytest.approx(1 / math.pi, rel=1e-5)
    assert line.amplitude == pytest.approx(1, rel=1e-3)
    assert found["x"].shape == found.frequencies.shape
    assert abs(found.frequencies[np.argmax(found["x"])] - 1 / math.pi) <= found.resolution
    with pytest.raises(ValueError, match="window"):
        block.spectrum(1, window="square")


def test_peaks_are_half_a_period_apart(block):
    found = block.peaks(10, "x", tolerance=1e-11)["x"]
    # Hermite cubics through rows 0.01 s apart.
    assert np.allclose(found.t, np.arange(1, 7) * math.pi / 2, atol=1e-6)
    assert np.allclose(found.values, [-1, 1, -1, 1, -1, 1], atol=1e-8)
    assert list(found.maximum) == [False, True] * 3
    assert found.period == pytest.approx(math.pi, abs=1e-6)


def test_sections(block):
    found = block.section(10, crossing="x", direction="down", tolerance=1e-11)
    assert np.allclose(found.t, math.pi / 4 + math.pi * np.arange(len(found)), atol=1e-8)
    assert len(found) == 3
    assert np.allclose(found["der(x)"], -2, atol=1e-8)
    for period in (math.pi, "2*pi*sqrt(m/k)"):
        once = block.section(10, every_period=period, of="x", tolerance=1e-11)
        assert once.names == ("x",) and np.allclose(once["x"], 1, atol=1e-8)
    with pytest.raises(ValueError, match="crossing"):
        block.section(10)


def test_the_difference_of_two_stiffnesses(block):
    found = block.compare(block.with_parameters(k=8.8), 2 * math.pi, tolerance=1e-11)
    t = np.linspace(0, 2 * math.pi, found.instants)
    off = np.abs(np.cos(2 * t) - np.cos(math.sqrt(4.4) * t))
    assert found["x"].largest == pytest.approx(off.max(), abs=1e-8)
    assert found["x"].at == pytest.approx(t[np.argmax(off)], abs=1e-9)
    assert found["x"].range == pytest.approx(2, abs=1e-4)
    with pytest.raises(lg.UnknownName):
        found["y"]
    with pytest.raises(ValueError, match="same machine"):
        block.compare(lg.loads(SPEC.replace("Oscillator", "Other")), 1)


def test_numbers_are_the_commands(block, tmp_path):
    path = tmp_path / "oscillator.machine"
    path.write_text(SPEC)
    table = tmp_path / "run.csv"

    def command(*arguments):
        call = [sys.executable, "-m", "lagrangian", *map(str, arguments)]
        return subprocess.run(call, check=True, capture_output=True, text=True).stdout

    said = json.loads(command("peaks", path, "--until", 5, "--json"))["quantities"][0]
    found = block.peaks(5)["x"]
    assert list(found.values) == [one["value"] for one in said["extremes"]]
    command("simulate", path, "--until", 5, "--out", table)
    said = json.loads(command("compare", path, table, "--of", "x", "--json"))["quantities"][0]
    assert block.compare(table, of="x")["x"].largest == said["largest"]

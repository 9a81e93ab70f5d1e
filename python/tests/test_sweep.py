"""Sweeps: rows equal those of single runs, whatever computes them."""

import math
import os
import random
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import lagrangian as lg
from conftest import ROOT


def test_rows_are_those_of_single_runs(oscillator):
    sweep = oscillator.sweep(
        {"k": (2.0, 8.0, 4), "start(x)": [0.5, 1.0]},
        until=3,
        reduce={"peak": "max(abs(x))", "energy": "mean(k*x^2/2)"},
        events={"zero": "x"},
        record=["end", "at=1.5"],
        tolerance=1e-10,
    )
    assert len(sweep) == 8 and not len(sweep.failed)
    assert sweep.grid("x").shape == (4, 2)
    for i in range(8):
        k, x0 = sweep["k"][i], sweep["start(x)"][i]
        w = math.sqrt(k / 2)
        assert sweep["x"][i] == pytest.approx(x0 * math.cos(3 * w), abs=1e-8)
        assert sweep["x@1.5"][i] == pytest.approx(x0 * math.cos(1.5 * w), abs=1e-8)
        turned = 3 * w >= math.pi
        assert sweep["peak"][i] == pytest.approx(x0, abs=1e-8)
        # ∫ k x²/2 dt/T = k x0²/4 (1 + sin(2 w T)/(2 w T))
        mean = k * x0**2 / 4 * (1 + math.sin(6 * w) / (6 * w))
        assert sweep["energy"][i] == pytest.approx(mean, abs=1e-7), turned
        run = sweep.run(i)
        assert run.end.q["x"] == sweep["x"][i]


def test_rows_do_not_depend_on_threads(double):
    vary = {"start(theta1)": lg.Uniform(-3, 3), "l2": lg.Normal(1, 0.01)}
    plain, threaded = (
        double.sweep(vary, samples=64, until=1, threads=threads, progress=False) for threads in (1, 3)
    )
    for name in plain.columns:
        if plain[name].dtype == object:
            assert plain[name].tolist() == threaded[name].tolist()
        else:
            np.testing.assert_array_equal(plain[name], threaded[name])
    rows = [lg.run_chunk(plain.plan, k)["theta1"] for k in range(3)]
    np.testing.assert_array_equal(np.concatenate(rows), plain["theta1"][: sum(map(len, rows))])


def test_designs(oscillator):
    side_by_side = oscillator.sweep({"k": [1, 2, 3], "m": [3, 2, 1]}, until=0.1, together=["k", "m"])
    assert len(side_by_side) == 3 and side_by_side["m"].tolist() == [3, 2, 1]
    pandas = pytest.importorskip("pandas")
    table = oscillator.sweep(pandas.DataFrame({"k": [1.0, 2.0], "m": [3.0, 4.0]}), until=0.1)
    assert table["k"].tolist() == [1, 2] and table["m"].tolist() == [3, 4]
    latin = oscillator.sweep({"k": lg.LogUniform(1, 100)}, samples=10, design="latin", until=0.1)
    strata = np.floor(np.log10(latin["k"]) * 5).astype(int)
    assert sorted(strata) == list(range(10))
    frame = latin.to_pandas()
    assert frame.index.name == "run" and len(frame) == 10


def test_what_a_sweep_refuses(oscillator):
    for settings, error, why in (
        ({"vary": {"kk": [1, 2]}}, ValueError, "did you mean `k`"),
        ({"vary": {"k": lg.Uniform(1, 2)}}, ValueError, "samples"),
        ({"vary": {"k": [1, 2], "m": [1]}, "together": ["k", "m"]}, ValueError, "must have the same number"),
        ({"vary": {"k": [1, 2]}, "inputs": {"force": lambda t, q, v: 0.0}}, TypeError, "function in Python"),
        ({"vary": {"k": [1, 2]}, "reduce": {"p": "most(x)"}}, lg.UnknownName, "reduction"),
        ({"vary": {"k": [1, 2]}, "reduce": {"p": "max(y)"}}, lg.SpecError, "`y`"),
        ({"vary": {"k": [1, 2]}, "record": "sometimes"}, ValueError, "record"),
        ({"vary": {"k": [1, 2]}, "record": "at=0.5,0.5"}, ValueError, "0.5 s is given more than once"),
        ({"vary": {"k": [1, 2]}, "tolerance": 0}, ValueError, "tolerance"),
        ({"vary": {"k": [1, 2]}, "engine": "steam"}, ValueError, "engine"),
        ({"vary": {"k": [1, 2]}, "record": ["every=1", "event=e"], "events": {"e": "x"}}, ValueError, "drawn in one way"),
    ):
        with pytest.raises(error, match=why):
            oscillator.sweep(until=1, **settings)
    with pytest.raises(ValueError):
        lg.Uniform(2, 1)


def test_events_and_contacts_are_reduced():
    ball = lg.loads(
        """machine Ball in plane {
            parameters { e: 1 = 0.5, g: m/s^2 = 9.81 }
            coordinates { y: m = 1 }
            bodies { ball { mass: 2, at: (0, y) } }
            gravity (0, -g);
            contacts { floor { gap: y, restitution: e } }
        }"""
    )
    first = math.sqrt(2 / 9.81)
    # The first impact takes 1 - e^2 of m g h; the second one comes after 0.9 s.
    sweep = ball.sweep(
        {"e": [0.5, 0.8]},
        until=0.8,
        reduce={
            "first": "first(floor impact)",
            "last": "last(floor impact)",
            "rate": "frequency(floor impact)",
            "power": "power(floor)",
        },
    )
    np.testing.assert_allclose(sweep["first"], [first, first], rtol=1e-12)
    np.testing.assert_array_equal(sweep["first"], sweep["last"])
    np.testing.assert_allclose(sweep["rate"], [1 / 0.8, 1 / 0.8], rtol=1e-12)
    np.testing.assert_allclose(sweep["power"], [0.75 * 19.62 / 0.8, 0.36 * 19.62 / 0.8], rtol=1e-9)


def test_a_folder_with_other_files_is_not_used(oscillator, tmp_path):
    (tmp_path / "notes.tmp").write_text("mine")
    with pytest.raises(ValueError, match="holds no sweep"):
        oscillator.sweep({"k": [1.0, 2.0]}, until=0.1, out=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.tmp"]


def test_runs_that_fail_are_rows(oscillator):
    sweep = oscillator.sweep({"m": [1.0, -1.0, 2.0]}, until=0.1)
    assert sweep.failed.tolist() == [1]
    assert "mass must be positive" in sweep["error"][1] and sweep["error"][0] is None


def test_inputs_and_samples(oscillator):
    sweep = oscillator.sweep(
        {"k": [8.0]}, until=5, inputs={"force": "1*N*sin(1*rad/s*t)"}, record="every=0.5", tolerance=1e-11
    )
    t = sweep.samples["t"]
    closed = np.cos(2 * t) + 0.5 / 3 * (np.sin(t) - 0.5 * np.sin(2 * t))
    np.testing.assert_allclose(sweep.samples["x"], closed, atol=1e-9)


def test_samples_at_events(oscillator):
    sweep = oscillator.sweep(
        {"start(x)": [0.5, 1.0]}, until=5, events={"zero": "x"}, record="event=zero", after=1.0, tolerance=1e-12
    )
    # cos 2t = 0 at (k + 1/2) pi/2: 2.36 and 3.93 s for the second and third; the first is before 1 s and does not count.
    t = (np.arange(1, 3) + 0.5) * math.pi / 2
    np.testing.assert_allclose(sweep.samples["t"], np.tile(t, 2), atol=1e-9)
    assert sweep.samples["run"].tolist() == [0, 0, 1, 1] and set(sweep.samples["event"]) == {"zero"}
    np.testing.assert_allclose(np.abs(sweep.samples["der(x)"]), [1.0, 1.0, 2.0, 2.0], atol=1e-9)
    with pytest.raises(ValueError, match="did you mean `zero`"):
        oscillator.sweep({"k": [1.0]}, until=1, events={"zero": "x"}, record="event=zeros")


def test_files(oscillator, tmp_path):
    sweep = oscillator.sweep({"k": [1.0, 2.0]}, until=0.1)
    sweep.save(tmp_path / "rows.csv")
    lines = (tmp_path / "rows.csv").read_text().splitlines()
    assert lines[0].startswith("run,k,status,error,t,x,der(x)") and len(lines) == 3
    # A sweep that stores its rows on the way writes the same file.
    oscillator.sweep({"k": [1.0, 2.0]}, until=0.1, out=tmp_path / "kept.csv")
    assert (tmp_path / "kept.csv").read_bytes() == (tmp_path / "rows.csv").read_bytes()
    parquet = pytest.importorskip("pyarrow.parquet")
    sweep.save(tmp_path / "rows.parquet")
    assert parquet.read_table(tmp_path / "rows.parquet")["x"].to_pylist() == sweep["x"].tolist()


@pytest.mark.parametrize("engine", ["ray", "dask"])
def test_clusters_make_the_same_rows(double, engine):
    pytest.importorskip({"ray": "ray", "dask": "distributed"}[engine])
    vary = {"start(theta1)": (-3.0, 3.0, 40)}
    here = double.sweep(vary, until=2, threads=1)
    there = double.sweep(vary, until=2, engine=engine, threads=2)
    np.testing.assert_array_equal(here["theta2"], there["theta2"])


#: The runs of a sweep that is killed, and the number of kills; `LAGRANGIAN_KILLED_RUNS=100000 LAGRANGIAN_KILLS=20` is the long test.
KILLED_RUNS = int(os.environ.get("LAGRANGIAN_KILLED_RUNS", "4000"))
KILLS = int(os.environ.get("LAGRANGIAN_KILLS", "4"))

#: A program that runs a stored sweep; its arguments are the path and the number of runs.
KEPT = """
import sys
import lagrangian as lg
m = lg.load("machines/double_pendulum.machine")
side = int(sys.argv[2])
lg.set_threads(2)
m.sweep(
    {"start(theta1)": (-1.0, 1.0, side), "start(theta2)": (-1.0, 1.0, 50)},
    until=1, reduce={"peak": "max(abs(theta2))"}, tolerance=1e-8, out=sys.argv[1], progress=False, threads=2,
)
"""


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_kept_rows_are_those_in_memory(oscillator, tmp_path, ending):
    settings = {"until": 1.5, "reduce": {"peak": "max(abs(x))"}, "record": "every=0.5"}
    vary = {"k": (1.0, 4.0, 5), "m": [1.0, -1.0]}
    here = oscillator.sweep(vary, **settings)
    path = tmp_path / f"rows.{ending}"
    kept = oscillator.sweep(vary, out=path, **settings)
    assert kept.path == str(path) and sorted(os.listdir(tmp_path)) == [f"rows.{ending}", f"rows.samples.{ending}"]
    for name in here.columns:
        np.testing.assert_array_equal(kept[name], here[name])
    np.testing.assert_array_equal(kept.samples["x"], here.samples["x"])
    # A folder keeps its chunks, and no chunk is made twice.
    folder = str(tmp_path / "chunks") + "/"
    first = oscillator.sweep(vary, out=folder, **settings)
    stamps = {name: os.stat(folder + name).st_mtime_ns for name in os.listdir(folder) if name != "lock"}
    again = oscillator.sweep(vary, out=folder, **settings)
    assert stamps == {name: os.stat(folder + name).st_mtime_ns for name in os.listdir(folder) if name != "lock"}
    np.testing.assert_array_equal(first["peak"], again["peak"])


def test_another_sweep_is_not_mixed_with_what_is_kept(oscillator, tmp_path):
    folder = tmp_path / "chunks"
    oscillator.sweep({"k": [1.0, 2.0]}, until=1, out=folder)
    with pytest.raises(ValueError, match="until: 2.0, was 1.0; fresh=True begins again"):
        oscillator.sweep({"k": [1.0, 2.0]}, until=2, out=folder)
    assert len(oscillator.sweep({"k": [1.0, 2.0]}, until=2, out=folder, fresh=True)) == 2
    for wrong in ("rows.txt", "rows.v1"):
        with pytest.raises(ValueError, match="rows go to"):
            oscillator.sweep({"k": [1.0, 2.0]}, until=1, out=tmp_path / wrong)


def test_a_sweep_that_is_killed_goes_on_and_has_the_same_bytes(tmp_path):
    side = KILLED_RUNS // 50

    def begun(name):
        call = [sys.executable, "-c", KEPT, str(tmp_path / name), str(side)]
        return subprocess.Popen(call, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    began = time.monotonic()
    whole = begun("whole.parquet")
    _, said = whole.communicate(timeout=3600)
    assert whole.returncode == 0, said
    took = time.monotonic() - began
    seed = int(os.environ.get("LAGRANGIAN_KILL_SEED", random.SystemRandom().getrandbits(32)))
    print(f"LAGRANGIAN_KILL_SEED={seed}")
    instants, killed, ended = random.Random(seed), 0, 0
    while killed < KILLS:
        process = begun("killed.parquet")
        # Stored chunks shorten the next attempt, so later kills come sooner.
        time.sleep(instants.uniform(0.1, 1.0) * took / (1 + killed) ** 0.5)
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
            killed += 1
            process.communicate()
            continue
        _, said = process.communicate()
        assert process.returncode == 0, said
        # It finished before it was killed: start again from the beginning.
        ended += 1
        assert ended < 10 * KILLS, "it is too fast to be killed"
        assert (tmp_path / "killed.parquet").read_bytes() == (tmp_path / "whole.parquet").read_bytes()
        (tmp_path / "killed.parquet").unlink()
    last = begun("killed.parquet")
    _, said = last.communicate(timeout=3600)
    assert last.returncode == 0, said
    assert (tmp_path / "killed.parquet").read_bytes() == (tmp_path / "whole.parquet").read_bytes()
    assert not (tmp_path / "killed.parquet.part").exists()


def test_a_full_disk_is_told_and_the_sweep_goes_on(tmp_path):
    # A process that may only write files of up to 2 kB.
    limited = "import resource, signal\nsignal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
    limited += "resource.setrlimit(resource.RLIMIT_FSIZE, (2000, resource.RLIM_INFINITY))\n"
    path = tmp_path / "rows.csv"
    call = [sys.executable, "-c", limited + KEPT, str(path), "2"]
    said = subprocess.run(call, cwd=ROOT, capture_output=True, text=True)
    assert said.returncode != 0 and "OSError: cannot write" in said.stderr and "the same call continues" in said.stderr
    assert not path.exists()
    subprocess.run([sys.executable, "-c", KEPT, str(path), "2"], cwd=ROOT, check=True)
    assert len(path.read_text().splitlines()) == 101


def test_ctrl_c_ends_a_kept_sweep_at_once(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", KEPT.replace("until=1,", "until=500,").replace("import sys", "import sys; print('ready', flush=True)", 1), str(tmp_path / "rows.csv"), "100"],
        cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )
    assert process.stdout.readline() == "ready\n"
    time.sleep(3.0)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode != 0 and "KeyboardInterrupt" in said
    assert (tmp_path / "rows.csv.part" / "plan.json").exists()


@pytest.mark.parametrize("engine", ["ray", "dask"])
def test_clusters_keep_the_same_bytes(double, engine, tmp_path):
    pytest.importorskip({"ray": "ray", "dask": "distributed"}[engine])
    vary = {"start(theta1)": (-3.0, 3.0, 40)}
    double.sweep(vary, until=2, threads=1, out=tmp_path / "here.csv")
    double.sweep(vary, until=2, engine=engine, threads=2, out=tmp_path / "there.csv")
    assert (tmp_path / "here.csv").read_bytes() == (tmp_path / "there.csv").read_bytes()


def test_a_sweep_is_drawn(oscillator, tmp_path):
    sweep = oscillator.sweep({"k": (1.0, 4.0, 5), "m": [1.0, 2.0]}, until=1, reduce={"peak": "max(abs(x))"})
    sweep.map(tmp_path / "peak.svg", "peak")
    sweep.map(tmp_path / "peak.html", ["peak", "x"], over="k", only={"m": 2.0})
    assert (tmp_path / "peak.svg").read_text().startswith("<svg")
    assert (tmp_path / "peak.html").read_text().startswith("<!doctype html>")
    # The command draws the same from the table that the sweep saves.
    sweep.save(tmp_path / "rows.csv")
    call = [sys.executable, "-m", "lagrangian", "map", "rows.csv", "--of", "peak", "--plot", "told.svg"]
    assert subprocess.run(call, cwd=tmp_path, capture_output=True).returncode == 0
    assert (tmp_path / "told.svg").read_bytes() == (tmp_path / "peak.svg").read_bytes()
    for wrong in ({"of": "peek"}, {"of": "peak", "over": "kk"}):
        with pytest.raises(lg.UnknownName):
            sweep.map(tmp_path / "wrong.svg", **wrong)
    with pytest.raises(ValueError, match="ending"):
        sweep.map(tmp_path / "wrong.png", "peak")
    at_events = oscillator.sweep({"k": (1.0, 4.0, 3)}, until=9, events={"zero": "x"}, record="event=zero")
    at_events.map(tmp_path / "zeros.svg", "der(x)", samples=True)
    assert (tmp_path / "zeros.svg").read_text().startswith("<svg")

"""Sweeps: rows are those of single runs, whatever makes them."""

import math

import numpy as np
import pytest

import lagrangian as lg


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
        ({"vary": {"k": [1, 2], "m": [1]}, "together": ["k", "m"]}, ValueError, "as many"),
        ({"vary": {"k": [1, 2]}, "inputs": {"force": lambda t, q, v: 0.0}}, TypeError, "function in Python"),
        ({"vary": {"k": [1, 2]}, "reduce": {"p": "most(x)"}}, lg.UnknownName, "reduction"),
        ({"vary": {"k": [1, 2]}, "reduce": {"p": "max(y)"}}, lg.SpecError, "`y`"),
        ({"vary": {"k": [1, 2]}, "record": "sometimes"}, ValueError, "record"),
        ({"vary": {"k": [1, 2]}, "engine": "steam"}, ValueError, "engine"),
    ):
        with pytest.raises(error, match=why):
            oscillator.sweep(until=1, **settings)
    with pytest.raises(ValueError):
        lg.Uniform(2, 1)


def test_runs_that_fail_are_rows(oscillator):
    sweep = oscillator.sweep({"m": [1.0, -1.0, 2.0]}, until=0.1)
    assert sweep.failed.tolist() == [1]
    assert "mass is positive" in sweep["error"][1] and sweep["error"][0] is None


def test_inputs_and_samples(oscillator):
    sweep = oscillator.sweep(
        {"k": [8.0]}, until=5, inputs={"force": "1*N*sin(1*rad/s*t)"}, record="every=0.5", tolerance=1e-11
    )
    t = sweep.samples["t"]
    closed = np.cos(2 * t) + 0.5 / 3 * (np.sin(t) - 0.5 * np.sin(2 * t))
    np.testing.assert_allclose(sweep.samples["x"], closed, atol=1e-9)


def test_files(oscillator, tmp_path):
    sweep = oscillator.sweep({"k": [1.0, 2.0]}, until=0.1)
    sweep.save(tmp_path / "rows.csv")
    lines = (tmp_path / "rows.csv").read_text().splitlines()
    assert lines[0].startswith("run,k [N/m],status,error,t [s],x [m]") and len(lines) == 3
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

"""Runs, against closed forms, SciPy and the command."""

import json
import math
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import lagrangian as lg
from test_evaluate import command


def test_an_oscillator_moves_as_its_closed_form(oscillator):
    run = oscillator.simulate(10, tolerance=1e-12)
    # x = cos(ω t), ω = √(8/2). About 200 steps with a tolerance of 1e-12 each.
    np.testing.assert_allclose(run["x"], np.cos(2 * run.t), atol=1e-9)
    np.testing.assert_allclose(run["der(x)"], -2 * np.sin(2 * run.t), atol=1e-9)
    np.testing.assert_allclose(run["pull"], 8 * np.cos(2 * run.t), atol=1e-8)
    assert len(run) == 1001 and run.t[-1] == 10.0
    assert run.ending == "time"
    assert abs(run.energy.residual) < 1e-9
    np.testing.assert_allclose(run.energy.kinetic + run.energy.potential, 4.0, atol=1e-9)


def test_states_between_samples(oscillator):
    run = oscillator.simulate(10, tolerance=1e-12)
    times = np.array([[7.77, 0.0], [1.234, 10.0]])
    state = run.at(times)
    assert state.q.shape == (2, 2, 1)
    np.testing.assert_allclose(state.q["x"], np.cos(2 * times), atol=1e-9)
    assert isinstance(run.at(1.0).q["x"], float)
    seen = run.observe(times)
    np.testing.assert_allclose(seen["pull"], 8 * np.cos(2 * times), atol=1e-8)
    np.testing.assert_allclose(seen.accelerations[..., 0], -4 * np.cos(2 * times), atol=1e-8)
    np.testing.assert_allclose(seen.kinetic_energy + seen.potential_energy, np.full((2, 2), 4.0), atol=1e-8)
    assert seen.ok.all() and seen.mass_matrix.shape == (2, 2, 1, 1)
    with pytest.raises(lg.UnknownName, match="pull"):
        seen["pul"]
    for outside in (-0.1, 10.1, math.nan):
        with pytest.raises(ValueError, match="outside"):
            run.at(outside)
    with pytest.raises(ValueError, match="forgotten"):
        oscillator.simulate(1, dense=False).at(0.5)


def test_what_is_kept(oscillator):
    assert oscillator.simulate(1, every=0.3).t.tolist() == pytest.approx([0, 0.3, 0.6, 0.9, 1.0])
    assert oscillator.simulate(1, every=0.25).t.tolist() == [0, 0.25, 0.5, 0.75, 1.0]
    assert oscillator.simulate(1, at=[0.1, 0.5]).t.tolist() == [0.1, 0.5]
    assert oscillator.simulate(1, at=[0, 0.5, 1]).t.tolist() == [0, 0.5, 1]
    backward = oscillator.simulate(-1, every=0.5)
    assert backward.t.tolist() == [0, -0.5, -1.0]
    np.testing.assert_allclose(backward["x"], np.cos(2 * backward.t), atol=1e-7)
    np.testing.assert_allclose(backward.at([-0.7, -0.1]).q["x"], np.cos([1.4, 0.2]), atol=1e-7)
    for wrong, why in (
        ({"at": [0.5, 0.1]}, "sorted"),
        ({"at": [2.0]}, "outside"),
        ({"every": 0.0}, "greater than 0"),
        ({"every": 1e-9}, "instants"),
        ({"at": [0.1], "every": 0.1}, "not by both"),
        ({"method": "euler"}, "no method named"),
        ({"tolerance": -1.0}, "tolerance"),
    ):
        with pytest.raises(ValueError, match=why):
            oscillator.simulate(1, **wrong)


def test_starts(oscillator):
    run = oscillator.simulate(1, start={"x": 0}, rate={"x": 2}, tolerance=1e-12)
    np.testing.assert_allclose(run["x"], np.sin(2 * run.t), atol=1e-10)
    further = oscillator.simulate(2, start=run.end, tolerance=1e-12)
    assert further.t[0] == 1.0
    np.testing.assert_allclose(further["x"], np.sin(2 * further.t), atol=1e-10)
    with pytest.raises(ValueError, match="of its own"):
        oscillator.simulate(2, start=run.end, rate={"x": 1})


def driven(t):
    """m x'' + k x = sin t from x = 1, at rest: ω = 2, F/m = 1/2."""
    amplitude = 0.5 / (4 - 1)
    return np.cos(2 * t) + amplitude * (np.sin(t) - 0.5 * np.sin(2 * t))


@pytest.mark.parametrize(
    "force",
    [
        "1*N*sin(1*rad/s*t)",
        lambda t, q, v: math.sin(t),
    ],
)
def test_inputs_are_formulas_or_functions(oscillator, force):
    run = oscillator.simulate(5, inputs={"force": force}, tolerance=1e-11)
    np.testing.assert_allclose(run["x"], driven(run.t), atol=1e-9)
    np.testing.assert_allclose(run["force"], np.sin(run.t), atol=1e-14)
    assert "force" in run.columns and run.units["force"] == "N"
    assert not any("formula" in name for name in run.columns)


def test_tables_drive_inputs_to_the_bits_of_the_command(oscillator, tmp_path):
    # From rest at x = 1, held there by 8 N for a second, whose equilibrium is x = 1, then released.
    times, values = [0.0, 1.0], [8.0, 0.0]
    path = tmp_path / "push.csv"
    path.write_text("t [ms];force [kN]\n0;0.008\n1000;0\n")
    runs = [
        oscillator.simulate(3, inputs={"force": force}, tolerance=1e-11)
        for force in (lg.Table(times, values, "hold"), f"{path}:force,hold")
    ]
    run = runs[0]
    np.testing.assert_allclose(run.at([0.5, 1.0, 2.5]).q["x"], [1, 1, math.cos(3)], atol=1e-10)
    assert run["force"][999 // 3] == 8.0 and run["force"][-1] == 0.0
    assert np.array_equal(run.q, runs[1].q) and np.array_equal(run.v, runs[1].v)
    lines = [(np.array([0.0, 1.0, 2.0]), np.array([0.0, 3.0, 0.0])), lg.Table([0, 1, 2], [0, 3, 0])]
    one, two = (oscillator.simulate(3, inputs={"force": line}) for line in lines)
    assert np.array_equal(one.q, two.q) and one["force"].max() == pytest.approx(3, abs=1e-2)
    for wrong, why in (
        (lg.Table([0, 1], [1, 2], beyond="error"), "no value next to t = 1 s"),
        (lg.Table([1, 0], [1, 2]), "not later"),
        (f"{path}:speed", "no column"),
        (path.with_suffix(".txt"), "is not a table"),
    ):
        with pytest.raises((ValueError, lg.LagrangianError), match=why):
            oscillator.simulate(3, inputs={"force": wrong})
    with pytest.raises(ValueError, match="no series"):
        oscillator.simulate(3, inputs={"force": "1*N*sin(1*rad/s*t)"}, method="taylor")
    with pytest.raises(ValueError, match="kind=.steps.: must be .hold., .linear. or .cubic."):
        lg.Table([0, 1], [1, 2], "steps")


def test_sampled_controllers_hold_what_they_set(oscillator):
    text = "-4*kg/s*der(x)"
    law = lg.Sampled(text, every=0.05, delay=0.01)
    of_command = oscillator.simulate(2, inputs={"force": f"{text},every=50*ms,delay=10*ms"}, tolerance=1e-11)
    looks = []

    def remembers(t, q, v):
        looks.append(t)
        return -4 * v["x"]

    runs = [
        oscillator.simulate(2, inputs={"force": what}, tolerance=1e-11, events={"strong": "force - 2*N"}, stop="force - 3*N")
        for what in (law, lg.Sampled(remembers, every=0.05, delay=0.01))
    ]
    assert np.allclose(looks, 0.05 * np.arange(len(looks))) and len(looks) > 3
    assert runs[0].end.t == runs[1].end.t
    np.testing.assert_allclose(runs[0].end.y, runs[1].end.y, atol=1e-13)
    # The force jumps across 2 N, which is an event, and the run stops where a step ends with more than 3 N.
    for run in runs:
        assert run.ending == "stop" and run["force"][-1] > 3 and run.end.t < 0.5
        assert [event.name for event in run.events] == ["strong"]
        jump = run.events[0].t
        assert (jump - 0.01) / 0.05 == pytest.approx(round((jump - 0.01) / 0.05), abs=1e-9)
    # Computed by hand: between two changes the mass oscillates about force/k.
    x, v, force = 1.0, 0.0, 0.0
    for _ in range(40):
        look = -4 * v
        for h, next_force in ((0.01, look), (0.04, look)):
            middle, c, s = force / 8, math.cos(2 * h), math.sin(2 * h)
            x, v = middle + (x - middle) * c + v / 2 * s, v * c - 2 * (x - middle) * s
            force = next_force
    np.testing.assert_allclose([of_command.end.q["x"], of_command.end.v["x"]], [x, v], atol=1e-9)


def test_all_inputs_by_one_function(oscillator):
    for function in (lambda t, q, v: [math.sin(t)], lambda t, q, v: {"force": math.sin(t)}):
        run = oscillator.simulate(5, inputs=function, tolerance=1e-11)
        np.testing.assert_allclose(run["x"], driven(run.t), atol=1e-9)
    # A damper by feedback: x'' + 2 x' + 4 x = 0.
    run = oscillator.simulate(5, inputs={"force": lambda t, q, v: -4 * v["x"]}, tolerance=1e-11)
    w = math.sqrt(3)
    closed = np.exp(-run.t) * (np.cos(w * run.t) + np.sin(w * run.t) / w)
    np.testing.assert_allclose(run["x"], closed, atol=1e-9)


def test_events_are_found_to_rounding(oscillator):
    def falling(t, q, v):
        return q["x"]

    falling.direction, falling.terminal = -1, False
    events = {"zero": "x", "falls": falling, "second": lg.Event("x", "rising", terminal=2)}
    run = oscillator.simulate(20, events=events, tolerance=1e-12)
    # cos(2 t) = 0 at (k + 1/2) π/2; it rises for the second time at k = 3.
    zeros = (np.arange(4) + 0.5) * math.pi / 2
    np.testing.assert_allclose(run.event("zero").t, zeros, atol=1e-10)
    np.testing.assert_allclose(run.event("falls").t, zeros[::2], atol=1e-10)
    assert run.ending == "event second" and run.end.t == pytest.approx(zeros[3], abs=1e-10)
    assert run.poincare("zero").shape == (4, 2)
    assert [event.name for event in run.events][:2] == ["zero", "falls"]
    with pytest.raises(lg.UnknownName):
        run.event("never")
    assert oscillator.simulate(0.1, events={"never": "x"}).event("never").t.shape == (0,)
    with pytest.raises(ValueError, match="crossing"):
        lg.Event("x", "sideways")


def test_a_condition_ends_a_run_at_a_step(oscillator):
    for stop in ("-x", lambda t, q, v: q["x"] < 0):
        run = oscillator.simulate(20, stop=stop)
        assert run.ending == "stop"
        assert math.pi / 4 < run.end.t < 2


def test_the_period_of_a_pendulum(pendulum):
    # 4 K(k)/ω with k = sin(A/2): the arithmetic-geometric mean of 1 and cos(A/2).
    a, b = 1.0, math.cos(math.pi / 4)
    for _ in range(6):
        a, b = (a + b) / 2, math.sqrt(a * b)
    period = 2 * math.pi / a * math.sqrt(1 / 9.81)
    run = pendulum.simulate(10, events={"top": lg.Event("der(theta)", "falling")}, tolerance=1e-12)
    np.testing.assert_allclose(run.event("top").t[:3], period * np.arange(1, 4), atol=1e-9)


def test_taylor_and_stiff_methods(oscillator):
    for method in ("taylor", "dopri5", "radau5"):
        run = oscillator.simulate(5, method=method, tolerance=1e-9)
        np.testing.assert_allclose(run["x"], np.cos(2 * run.t), atol=1e-5)


def test_a_long_run_goes_on_by_series():
    # x = cos t over 300 periods; the errors of two thousand steps add up.
    oscillator = lg.loads(
        """machine Oscillating in plane {
            parameters { k: N/m = 1 }
            coordinates { x: m = 1 }
            bodies { a { mass: 1, at: (x, 0) } }
            springs { back { stiffness: k, stretch: x } }
        }"""
    )
    run = oscillator.simulate(1885, method="auto", tolerance=1e-12)
    assert [of[1] for of in run.choices] == ["dop853", "taylor"]
    assert run.choices[1][2].startswith("a step by series costs")
    assert abs(run.end.q["x"] - math.cos(1885)) < 2e3 * 1e-12
    # The series is known now, which makes no difference, and a short run needs none.
    again = oscillator.simulate(1885, method="auto", tolerance=1e-12)
    assert again.choices == run.choices and again.end.q["x"] == run.end.q["x"]
    assert [of[1] for of in oscillator.simulate(1, method="auto").choices] == ["dop853"]
    # One of a million that share the derivation goes by it from the start, as a row of a sweep of so many.
    shared = oscillator.simulate(1, method="auto", one_of=1_000_000)
    assert [of[1] for of in shared.choices] == ["taylor"]
    with pytest.raises(ValueError, match="one_of"):
        oscillator.simulate(1, one_of=2)
    with pytest.raises(ValueError, match="one_of"):
        oscillator.simulate(1, method="auto", one_of=0)
    sweep = oscillator.sweep({"start(x)": (0.5, 1.0, 40)}, until=40, tolerance=1e-12, method="auto")
    again = sweep.run(17)
    assert sweep["methods"][17].startswith("dop853, taylor from")
    assert again.end.q["x"] == sweep["x"][17] and sweep.run(17, method="dop853").choices == []
    taylor = oscillator.simulate(1885, method="taylor", tolerance=1e-12)
    assert abs(taylor.end.q["x"] - math.cos(1885)) < 2e3 * 1e-12


def test_a_run_chooses_its_methods():
    # x = cos t beside a mass that returns slowly in thick oil, y'' + 2e4 y' + 1e4 y = 0: the fast component decays at once.
    stiff = lg.loads(
        """machine Damped in plane {
            parameters { k: N/m = 1, c: N*s/m = 2e4 }
            coordinates { x: m = 1, y: m = 1 }
            bodies { a { mass: 1, at: (x, 0) }, b { mass: 1, at: (0, y) } }
            springs { slow { stiffness: k, stretch: x }, fast { stiffness: 1e4*k, stretch: y } }
            dissipations { oil: 1/2*c*der(y)^2 }
        }"""
    )
    run = stiff.simulate(30, method="auto", tolerance=1e-8)
    assert [of[1] for of in run.choices] == ["dop853", "radau9"]
    assert run.choices[0][0] == 0 and "stability" in run.choices[1][2]
    slow, fast = np.roots([1, 2e4, 1e4])[::-1]
    y = (fast * math.exp(30 * slow)) / (fast - slow)
    np.testing.assert_allclose([run.end.q["x"], run.end.q["y"]], [math.cos(30), y], atol=1e-6)
    assert stiff.simulate(0.01).choices == []
    with pytest.raises(ValueError, match="there are: auto, dop853"):
        stiff.simulate(1, method="dop835")


def test_scipy_integrates_the_same_machine(double):
    scipy = pytest.importorskip("scipy.integrate")
    solved = scipy.solve_ivp(double.rhs(), (0, 2), double.start.y, method="DOP853", rtol=1e-12, atol=1e-12, vectorized=True)
    run = double.simulate(2, tolerance=1e-13)
    # Both runs are within their tolerance, which the motion amplifies by about 1e2.
    np.testing.assert_allclose(solved.y[:, -1], run.end.y, atol=1e-9)
    ivp = double.simulate(2, events={"down": "theta1"}, tolerance=1e-12).as_ivp()
    assert ivp.success and ivp.status == 0 and ivp.y.shape == (4, 1001)
    np.testing.assert_allclose(ivp.sol(2.0), ivp.y[:, -1])
    assert len(ivp.t_events) == 1 and ivp.y_events[0].shape == (len(ivp.t_events[0]), 4)


@pytest.mark.skipif(command() is None, reason="the command `lagrangian` is not built")
@pytest.mark.parametrize("name", ["double_pendulum", "four_bar", "block_on_incline", "contacts/woodpecker"])
def test_runs_are_those_of_the_command(machines, name, tmp_path):
    path = machines / f"{name}.machine"
    table = tmp_path / "run.csv"
    until = 0.5
    said = subprocess.run(
        [command(), "simulate", str(path), "--until", str(until), "--every", "0.01", "--out", str(table), "--json"],
        capture_output=True,
        text=True,
        check=True,
    )
    document = json.loads(said.stdout)
    run = lg.load(path).simulate(until, every=0.01)
    assert dict(zip(run.q.names, run.end.q.tolist())) == document["q"]
    assert run.statistics["steps"] == document["steps"]
    run.save(tmp_path / "mine.csv")
    theirs, mine = table.read_text().splitlines(), (tmp_path / "mine.csv").read_text().splitlines()
    assert mine[0] == theirs[0]
    numbers = [np.array([line.split(",") for line in lines[1:]], dtype=float) for lines in (theirs, mine)]
    np.testing.assert_array_equal(*numbers)


def test_tables(oscillator, tmp_path):
    run = oscillator.simulate(1, every=0.1)
    pandas = pytest.importorskip("pandas")
    frame = run.to_pandas()
    assert frame.index.name == "t" and frame["x"].iloc[-1] == run["x"][-1]
    pyarrow = pytest.importorskip("pyarrow")
    table = run.to_arrow()
    assert table.schema.field("pull").metadata == {b"unit": b"N"}
    run.save(tmp_path / "run.parquet")
    assert pyarrow.parquet.read_table(tmp_path / "run.parquet") == table
    run.save(tmp_path / "run.npz")
    assert np.load(tmp_path / "run.npz")["x"].tolist() == run["x"].tolist()
    io = pytest.importorskip("scipy.io")
    run.save(tmp_path / "run.mat")
    assert io.loadmat(tmp_path / "run.mat")["x"].ravel().tolist() == run["x"].tolist()
    run.save(tmp_path / "run.csv")
    read = pandas.read_csv(tmp_path / "run.csv")
    assert read["pull [N]"].tolist() == run["pull"].tolist()
    assert run.to_numpy(["x", "pull"]).shape == (11, 2)
    before = sorted(os.listdir(tmp_path))
    with pytest.raises(ValueError, match="ending"):
        run.save(tmp_path / "run.xlsx")
    assert sorted(os.listdir(tmp_path)) == before


def test_the_spectrum_of_a_sine(oscillator):
    run = oscillator.simulate(10 * math.pi, every=math.pi / 100, tolerance=1e-11)
    frequencies, amplitudes = run.spectrum("x")
    peak = int(np.argmax(amplitudes))
    # ten periods of 1/π Hz, plus the one sample that ends the run
    assert frequencies[peak] == pytest.approx(1 / math.pi, rel=2e-3)
    assert amplitudes[peak] == pytest.approx(1.0, abs=1e-2)
    with pytest.raises(ValueError, match="equally spaced"):
        oscillator.simulate(1, at=[0, 0.1, 0.5]).spectrum("x")


def test_runs_pickle(oscillator):
    run = oscillator.simulate(5, inputs={"force": "1*N*sin(1*rad/s*t)"}, events={"zero": "x"})
    again = pickle.loads(pickle.dumps(run))
    np.testing.assert_array_equal(again.q, run.q)
    assert again.events[0].t == run.events[0].t


def test_threads_share_a_machine(double):
    results = {}

    def work(k):
        results[k] = double.simulate(3, start={"theta1": 0.1 * k}).end.y.tolist()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k in range(6):
        assert results[k] == double.simulate(3, start={"theta1": 0.1 * k}).end.y.tolist()


def test_progress_is_told_and_may_end_the_run(double):
    told = []

    def enough(*now):
        told.append(now)
        raise RuntimeError("enough")

    # Longer than any machine would need; the callback stops it.
    with pytest.raises(RuntimeError, match="enough"):
        double.simulate(1e6, progress=enough, dense=False, energy=False)
    ((fraction, t, steps),) = told
    assert 0 < fraction < 1 and t == pytest.approx(1e6 * fraction) and steps > 0


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_a_run(machines):
    program = (
        "import lagrangian as lg\n"
        f"m = lg.load({str(machines / 'double_pendulum.machine')!r})\n"
        "print('ready', flush=True)\n"
        "m.simulate(1e6, dense=False, energy=False)\n"
    )
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    _, said = child.communicate(timeout=10)
    assert child.returncode != 0 and "KeyboardInterrupt" in said


PARTICLE = """machine Particle in plane {
    parameters { m: kg = 2, kx: N/m = 8, ky: N/m = 18, _F: N = 3, _w: rad/s = 2 }
    coordinates { s: m = 1, phi: rad }
    inputs { pull: N = 0 }
    bodies { particle { mass: m, at: polar(s, phi) } }
    gravity none;
    springs { along { stiffness: kx, stretch: s*cos(phi) }, across { stiffness: ky, stretch: s*sin(phi) } }
    forces { pull { at: particle.at, force: (0, pull) } }
    charts { particle: polar(s, phi) | cartesian(x, y) }
    outputs { height: m = s*sin(phi) }
}"""


def test_a_run_passes_the_centre_of_polar_coordinates():
    m = lg.loads(PARTICLE)
    # x = cos 2t, y = 0: through the centre at π/4.
    run = m.simulate(3, tolerance=1e-11)
    x = np.cos(2 * run.t)
    np.testing.assert_allclose(run["s"], np.abs(x), atol=1e-8)
    away = np.abs(x) > 1e-3
    np.testing.assert_allclose(np.cos(run["phi"])[away], np.sign(x)[away], atol=1e-6)
    assert run.start.q["s"] == 1.0 and run.end.q["s"] == pytest.approx(abs(np.cos(6)), abs=1e-8)
    between = run.at([0.123, 2.9])
    np.testing.assert_allclose(between.q["s"], np.abs(np.cos(2 * np.array([0.123, 2.9]))), atol=1e-8)
    assert {"s", "phi", "der(s)", "der(phi)"} <= set(run.columns)
    assert "x" not in run.columns and "height" in run.columns
    assert "<html" in run.report().html
    # An input by a formula, and an event.
    run = m.simulate(3, inputs={"pull": "_F*sin(_w*t)"}, events={"low": "height"}, tolerance=1e-11)
    assert "pull" in run.columns
    # A Python function sees the coordinates of the spec, in which the distance becomes negative.
    for given in [{"stop": lambda t, q, v: False}, {"keep": ["s"]}]:
        assert m.simulate(3, **given)["s"].min() == pytest.approx(-1, abs=1e-4)


def test_an_assumption_that_ends_a_run_has_its_place():
    m = lg.loads(
        """machine Fall in plane {
    coordinates { x: m = 0.5 }
    bodies { ball { mass: 1, at: (x, 0) } }
    gravity (-9.81, 0);
    assume { x > 0 }
}"""
    )
    with pytest.raises(lg.RunError, match=r"the machine assumes `x > 0`, which does not hold at t = .* \(.*:5:14\)"):
        m.simulate(1)

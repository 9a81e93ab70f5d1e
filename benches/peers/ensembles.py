"""The number of trajectories per second: our ensembles compared with heyoka's batches, MuJoCo's rollout and SciPy, at equal true error.

    python benches/peers/ensembles.py [--ours PROGRAM]

256 double pendulums (two bobs of 1 kg on rods of 1 m, 9.81 m/s²) start at rest from a grid of angles between 0.1 and 1 rad and run for
5 s, and 256 crushers (`machines/crusher9.machine`) from a grid of distances of mortar and pestle for 0.5 s, on one core. The error of an
ensemble is the largest difference of a coordinate or a rate at the end from a reference: heyoka's Taylor method in 80-bit numbers
at 1e-19. Each tool runs with several tolerances or step lengths, and its time at a given error is
interpolated between them on logarithmic scales. Times are processor times, the best of several.

Ours is `cargo bench --bench ensemble -- --ends FOLDER`, or a program built from it.
"""

import argparse
import json
import math
import subprocess
import tempfile
import time
from pathlib import Path

import heyoka as hy
import motions
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SIDE, END, GRAVITY = 16, 5.0, 9.81
ERRORS = (1e-6, 1e-7, 1e-8, 1e-9)


def starts():
    angles = 0.1 + 0.9 * np.arange(SIDE) / (SIDE - 1)
    one, two = np.meshgrid(angles, angles, indexing="ij")
    return np.stack([one.ravel(), two.ravel(), np.zeros(SIDE**2), np.zeros(SIDE**2)], axis=1)


def clock(work, times):
    """The smallest processor time of several runs, and the result of the last."""
    best = math.inf
    for _ in range(times):
        began = time.process_time()
        result = work()
        best = min(best, time.process_time() - began)
    return best, result


def crushers():
    system, _, _, _, _ = motions.crusher()
    start = np.zeros(18)
    start[[2, 4, 7]] = 0.01, 0.4, 1.3
    first = np.tile(start, (SIDE**2, 1))
    part = np.arange(SIDE) / (SIDE - 1)
    one, two = np.meshgrid(part, part, indexing="ij")
    first[:, 3], first[:, 6] = 0.14 + 0.02 * one.ravel(), 0.09 + 0.02 * two.ravel()
    return system, first, 0.5


def pendulums():
    """Simplified by hand, for absolute angles and equal bobs and rods."""
    system, _, _, _, _ = motions.pendulum()
    return system, starts(), END


def reference(system, first, until):
    number = np.longdouble
    size = first.shape[1]
    runner = hy.taylor_adaptive(system, np.zeros(size, number), tol=number(1e-19), fp_type=number)
    ends = np.empty(first.shape)
    for i, start in enumerate(first):
        runner.time = number(0)
        runner.state[:] = start.astype(number)
        runner.propagate_until(number(until))
        ends[i] = runner.state.astype(float)
    return ends


def of_heyoka(batch, system, first, until):
    size = first.shape[1]
    for tolerance in (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12):
        zeros = np.zeros((size, batch) if batch > 1 else size)
        make = hy.taylor_adaptive_batch if batch > 1 else hy.taylor_adaptive
        runner = make(system, zeros, tol=tolerance)
        begin = np.ascontiguousarray(first.reshape(-1, batch, size).swapaxes(1, 2))

        def run():
            ends = np.empty_like(begin)
            for i, start in enumerate(begin):
                if batch > 1:
                    runner.set_time(np.zeros(batch))
                    runner.state[:] = start
                else:
                    runner.time = 0.0
                    runner.state[:] = start[:, 0]
                runner.propagate_until(until)
                ends[i] = runner.state.reshape(size, batch)
            return ends.swapaxes(1, 2).reshape(-1, size)

        yield clock(run, 5)


def of_mujoco():
    import mujoco
    from mujoco import rollout

    spec = """<mujoco><option integrator="RK4" gravity="0 0 -9.81"><flag contact="disable"/></option><worldbody>
      <body><joint type="hinge" axis="0 -1 0"/><inertial pos="0 0 -1" mass="1" diaginertia="1e-12 1e-12 1e-12"/>
        <body pos="0 0 -1"><joint type="hinge" axis="0 -1 0"/><inertial pos="0 0 -1" mass="1" diaginertia="1e-12 1e-12 1e-12"/></body>
      </body></worldbody></mujoco>"""
    # The second angle of this model is relative to the first rod.
    first = starts()
    first = np.stack([first[:, 0], first[:, 1] - first[:, 0], first[:, 2], first[:, 3]], axis=1)
    for steps in (100, 200, 400, 800, 1600):
        model = mujoco.MjModel.from_xml_string(spec.replace("<option", f'<option timestep="{END / steps!r}"'))
        state = np.concatenate([np.zeros((SIDE**2, 1)), first], axis=1)
        data = mujoco.MjData(model)
        seconds, (found, _) = clock(lambda: rollout.rollout(model, data, state, nstep=steps), 3)
        q = found[:, -1, 1:5]
        yield seconds, np.stack([q[:, 0], q[:, 0] + q[:, 1], q[:, 2], q[:, 2] + q[:, 3]], axis=1)


def of_scipy():
    from scipy.integrate import solve_ivp

    def motion(_, y):
        a, b, v, w = y
        c, s = math.cos(a - b), math.sin(a - b)
        f = -s * w * w - 2.0 * GRAVITY * math.sin(a)
        g = s * v * v - GRAVITY * math.sin(b)
        d = 2.0 - c * c
        return [v, w, (f - c * g) / d, (2.0 * g - c * f) / d]

    for tolerance in (1e-5, 1e-7, 1e-9, 1e-11):
        run = lambda: np.array([solve_ivp(motion, (0, END), y, method="DOP853", rtol=tolerance, atol=tolerance).y[:, -1] for y in starts()])
        yield clock(run, 1)


def of_ours(program):
    """Seconds and end states of every run, by machine and method."""
    with tempfile.TemporaryDirectory() as folder:
        call = [program] if program else ["cargo", "bench", "--bench", "ensemble", "--"]
        said = subprocess.run([*call, "--ends", folder], cwd=ROOT, capture_output=True, text=True, check=True)
        runs = {}
        for line in said.stdout.splitlines():
            one = json.loads(line)
            ends = np.fromfile(one["file"]).reshape(SIDE**2, -1)
            runs.setdefault((one["machine"], one["method"]), []).append((one["seconds"], ends))
        return runs


def table(title, tools, exact):
    print(f"| {title} | " + " | ".join(f"at {error:.0e}" for error in ERRORS) + " |")
    print("| --- |" + " --: |" * len(ERRORS))
    for name, runs in tools.items():
        found = sorted((np.abs(ends - exact).max(), seconds) for seconds, ends in runs)
        errors, seconds = np.array(found).T
        cells = []
        for error in ERRORS:
            inside = errors[0] <= error <= errors[-1]
            at = math.exp(np.interp(math.log(error), np.log(errors), np.log(seconds)))
            cells.append(f"{SIDE**2 / at:.0f}" if inside else "–")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    print()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--ours", help="a program that `cargo bench --bench ensemble` has built")
    parser.add_argument("--ours-and-heyoka", action="store_true", help="leave the others out")
    given = parser.parse_args()
    ours = of_ours(given.ours)
    for title, of in {"pendulum": pendulums, "crusher": crushers}.items():
        task = of()
        tools = {
            **{f"lagrangian, {of}": runs for (name, of), runs in ours.items() if name == title},
            "heyoka, batches of 4": of_heyoka(4, *task),
            "heyoka, one by one": of_heyoka(1, *task),
        }
        if title == "pendulum" and not given.ours_and_heyoka:
            tools |= {"MuJoCo, rollout, RK4": of_mujoco(), "SciPy, DOP853": of_scipy()}
        table(title, tools, reference(*task))


if __name__ == "__main__":
    main()

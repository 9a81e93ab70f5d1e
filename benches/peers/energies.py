#!/usr/bin/env python3
"""The error of the energy over very long runs of the elastic pendulum: our methods, heyoka, and a leapfrog in C.

    target/peers/python/bin/python benches/peers/energies.py [--periods 1e6] [--svg FILE] [--ours lagrangian]

The machine is machines/elastic_pendulum.machine, from rest at its start. heyoka and the leapfrog integrate it in Cartesian coordinates, where its
energy is a sum of functions of the rates and of the positions, as the leapfrog needs it. A period is that of the stretching, 2π √(m/k). Every program
runs for 1, 10^½, 10, … periods; the energy of each end is computed from its binary64 numbers in 40 digits, so that its own rounding is no error.
The times of the runs play no part, so other load on the computer does not matter.
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from mpmath import cos, mp, mpf, sin, sqrt

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent))
from diagram import Panel, drawing  # noqa: E402, from benches/
# The parameters and the start of the machine.
M, K, L0, G, R, THETA = 1.0, 39.24, 0.75, 9.81, 1.2, 0.1
PERIOD = 2.0 * math.pi * math.sqrt(M / K)
# Our methods with their settings: the least tolerance, and steps of a fixed length.
OURS = {
    "taylor, 2.3e-15": ["--method", "taylor", "--tolerance", "2.3e-15"],
    "dop853, 1e-12": ["--method", "dop853", "--tolerance", "1e-12"],
    "gauss8, steps of 0.1 s": ["--method", "gauss8", "--longest-step", "0.1"],
    "rattle, steps of 0.01 s": ["--method", "rattle", "--longest-step", "0.01"],
}
LEAPFROG_STEP = 0.01
STEPS = "1000000000000"


def energy(x, y, u, v):
    """In J, of a position and its rates."""
    stretch = sqrt(x * x + y * y) - mpf(L0)
    return mpf(M) * (u * u + v * v) / 2 + mpf(K) * stretch * stretch / 2 + mpf(M) * mpf(G) * y


def cartesian(r, theta, dr, dtheta):
    """Position and rates of the mass."""
    s, c = sin(theta), cos(theta)
    return r * s, -r * c, dr * s + r * dtheta * c, -dr * c + r * dtheta * s


def relative(start, end):
    """The relative error of the energy at `end`."""
    known = energy(*start)
    return float(abs((energy(*end) - known) / known))


def ours(program, words, times):
    """Errors of one of our methods: a run for each time."""
    for t in times:
        call = [*program, "simulate", str(ROOT / "machines/elastic_pendulum.machine"), "--json", "--max-steps", STEPS]
        told = subprocess.run([*call, "--until", repr(t), *words], capture_output=True, text=True, check=True)
        run = json.loads(told.stdout)
        polar = [mpf(value) for value in (*run["q"].values(), *run["v"].values())]
        yield relative(cartesian(mpf(R), mpf(THETA), mpf(0), mpf(0)), cartesian(*polar))


def heyokas(times):
    """Errors of heyoka at its least tolerance."""
    import heyoka as hy
    import numpy as np

    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    pull = (K / M) * (L0 / hy.sqrt(x * x + y * y) - 1.0)
    start = [float(value) for value in cartesian(mpf(R), mpf(THETA), mpf(0), mpf(0))]
    system = [(x, u), (y, v), (u, pull * x), (v, pull * y - G)]
    run = hy.taylor_adaptive(system, np.array(start), tol=np.finfo(float).eps / 2)
    exact = [mpf(value) for value in start]
    for t in times:
        run.propagate_until(t)
        yield relative(exact, [mpf(float(value)) for value in run.state])


def leapfrogs(times):
    """Errors of the leapfrog."""
    start = [float(value) for value in cartesian(mpf(R), mpf(THETA), mpf(0), mpf(0))]
    counts = [str(round(t / LEAPFROG_STEP)) for t in times]
    with tempfile.TemporaryDirectory() as folder:
        program = str(Path(folder) / "leapfrog")
        subprocess.run(["gcc", "-O2", "-o", program, str(HERE / "expert/leapfrog.c"), "-lm"], check=True)
        numbers = [LEAPFROG_STEP, M, K, L0, G, start[0], start[1]]
        told = subprocess.run([program, *map(repr, numbers), *counts], capture_output=True, text=True, check=True)
    for line in told.stdout.splitlines():
        yield relative([mpf(value) for value in start], [mpf(value) for value in line.split()])


def diagram(periods, errors):
    """The errors over the periods, beside the growth of a random walk of one rounding error a period, and of a rounding error that is always the same."""
    last = periods[-1]
    panel = Panel("relative error of the energy", "periods", (1.0, last), (1e-17, 1.0))
    panel.guide("√t", (1.0, 1e-16), (last, 1e-16 * last**0.5))
    panel.guide("t", (1.0, 1e-16), (last, 1e-16 * last))
    for name, values in errors.items():
        panel.line(name, list(zip(periods, values)), dashed=not name.startswith("lagrangian"))
    return drawing([panel])


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--periods", type=float, default=1e6)
    words.add_argument("--svg", help="a file for the diagram")
    words.add_argument("--ours", help="the command lagrangian; by default it is built")
    call = words.parse_args()
    mp.dps = 40
    program = [call.ours] if call.ours else ["cargo", "run", "--release", "--quiet", "--"]
    periods = [10.0 ** (k / 2) for k in range(round(2 * math.log10(call.periods)) + 1)]
    times = [count * PERIOD for count in periods]
    runs = {f"lagrangian, {name}": ours(program, settings, times) for name, settings in OURS.items()}
    runs |= {"heyoka": heyokas(times), f"leapfrog, steps of {LEAPFROG_STEP} s": leapfrogs(times)}
    shown = periods[::2]
    print("| relative error of the energy after | " + " | ".join(f"{count:g} periods" for count in shown) + " |")
    print("| --- |" + " --: |" * len(shown))
    errors = {}
    for name, values in runs.items():
        errors[name] = list(values)
        print(f"| {name} | " + " | ".join(f"{value:.1e}" for value in errors[name][::2]) + " |", flush=True)
    if call.svg:
        Path(call.svg).write_text(diagram(periods, errors))


if __name__ == "__main__":
    main()

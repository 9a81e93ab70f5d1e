#!/usr/bin/env python3
"""Orders of convergence across impacts: a pendulum before a wall, whose motion is known in elliptic functions.

    target/peers/python/bin/python benches/contact_orders.py [--svg FILE] [--ours lagrangian]

It swings from rest at 1.2 rad to a wall at the bottom of its circle, from which it comes back with 0.8 of its rate. The error is that of the angle
and the rate, in the steps of methods of a fixed length and in the tolerance of the others; time stepping is shown before the first impact and after
five, the others after five. Needs mpmath.
"""

import argparse
import json
import math
import subprocess
import tempfile
from pathlib import Path

from diagram import Panel, drawing
from mpmath import asin, ellipfun, ellipk, mp, mpf, sin, sqrt

ROOT = Path(__file__).resolve().parent.parent
SPEC = """machine Pendulum in plane {
    parameters { m: kg = 1, l: m = 1, e: 1 = 0.8, g: m/s^2 = 9.81 }
    coordinates { theta: rad = 1.2 }
    bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
    gravity (0, -g);
    contacts { wall { gap: l*theta, restitution: e } }
}
"""
EARLY, LATE = 0.3, 5.0
STEPS = [0.02 / 2**k for k in range(9)]
TOLERANCES = [10.0**-k for k in range(3, 14)]
# Methods, the time of the end, and whether they take steps of a fixed length.
RUNS = {
    "moreau, before impacts": ("moreau", EARLY, True),
    "moreau, after 5 impacts": ("moreau", LATE, True),
    "semi-implicit-euler, after 5": ("semi-implicit-euler", LATE, True),
    "rk4, after 5": ("rk4", LATE, True),
    "dopri5": ("dopri5", LATE, False),
    "dop853": ("dop853", LATE, False),
    "radau9": ("radau9", LATE, False),
    "taylor": ("taylor", LATE, False),
}


def exact(t):
    """Angle and rate at time `t`.

    With the modulus k = sin(amplitude/2), sin(θ/2) = k sn(ω τ, k) a time τ after the bottom (L. D. Landau, E. M. Lifshitz, Mechanics, §11). An impact
    multiplies the rate at the bottom, 2 ω k, and with it k, by the restitution.
    """
    omega, k = sqrt(mpf("9.81")), sin(mpf("0.6"))
    # From the amplitude to the bottom: a quarter of a period before the first impact.
    since = mpf(t) - ellipk(k * k) / omega
    if since >= 0:
        k *= mpf("0.8")
        while since > 2 * ellipk(k * k) / omega:
            since -= 2 * ellipk(k * k) / omega
            k *= mpf("0.8")
        sign = 1
    else:
        # It comes down, as if it had left the bottom upward in a run of time reversed.
        since, sign = -since, -1
    angle = 2 * asin(k * ellipfun("sn", omega * since, m=k * k))
    return angle, sign * 2 * omega * k * ellipfun("cn", omega * since, m=k * k)


def error(program, spec, method, until, words):
    """The error of the end of a run; none if the run is refused or ends early."""
    call = [*program, "simulate", spec, "--json", "--method", method, "--until", repr(until), *words]
    told = subprocess.run(call, capture_output=True, text=True)
    if told.returncode:
        return None
    run = json.loads(told.stdout)
    ends = zip((run["q"]["theta"], run["v"]["theta"]), exact(until))
    return max(float(abs(mpf(is_) - truth)) for is_, truth in ends)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--svg", help="a file for the diagram")
    words.add_argument("--ours", help="the command lagrangian; by default it is built")
    call = words.parse_args()
    mp.dps = 30
    program = [call.ours] if call.ours else ["cargo", "run", "--release", "--quiet", "--"]
    by_step = Panel("error in rad and rad/s", "step [s]", (1e-5, 1e-1), (1e-16, 1.0))
    by_tolerance = Panel("error in rad and rad/s", "tolerance", (1e-14, 1e-2), (1e-16, 1e-2))
    by_tolerance.guide("the tolerance", (1e-14, 1e-14), (1e-2, 1e-2))
    with tempfile.TemporaryDirectory() as folder:
        spec = str(Path(folder) / "pendulum.machine")
        Path(spec).write_text(SPEC)
        for name, (method, until, fixed) in RUNS.items():
            settings = STEPS if fixed else TOLERANCES
            option = "--longest-step" if fixed else "--tolerance"
            errors = [error(program, spec, method, until, [option, repr(setting)]) for setting in settings]
            (by_step if fixed else by_tolerance).line(name, list(zip(settings, errors)))
            pairs = [(a, b) for a, b in zip(errors, errors[1:]) if a and b]
            if fixed:
                orders = " ".join(f"{math.log2(a / b):.2f}" for a, b in pairs)
                print(f"{name}: error {errors[-1]:.1e} at steps of {settings[-1]:.1e} s; orders between halved steps {orders}", flush=True)
            else:
                told = " ".join("–" if value is None else f"{value:.1e}" for value in errors)
                print(f"{name}: errors at tolerances from 1e-3 to 1e-13 {told}", flush=True)
    if call.svg:
        Path(call.svg).write_text(drawing([by_step, by_tolerance]))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Machines with contacts by our command and its peers: error, and time, in one run.

    benches/peers/contacts.py COMMAND [--only ball,block,slider,pile] [--peers mujoco,siconos] [--rounds 5]

COMMAND is the command `lagrangian`. Each peer is a module of collisions/ with its tasks as functions; one that is not installed is
left out with a word. Each round runs all settings in turn, and the least time counts; it is that of the run, without reading and deriving.

* ball: it falls from 1 m and keeps 0.8 of its speed; the error of its height after 2.3 s, in its fourth flight.
* block: it rocks from rest about a corner; the error of the time of the first fall.
* slider: a slider-crank whose slider has play in its guide; the error of the angles of crank and rod after 9 ms, in which both upper
  corners hit the guide five times, at once.
* pile: 12 discs fall into a bowl; the greatest depth of a disc in another or in the bowl, and the greatest speed, after 2.5 s, when
  the heap is at rest. Both are 0 in an exact solution.

The first three have exact solutions (collisions/truths.py).
"""

import argparse
import importlib
import math
import os
import sys

from collisions import truths

UNTIL = 2.3
DISCS, REST = 12, 2.5
# A setting that takes longer, in s, is run once; one that takes at most SHORT, several times a round.
LONG, SHORT, REPEATS = 0.5, 0.02, 4
PEERS = ("mujoco", "exudyn", "drake", "siconos", "ours")


def tasks():
    """For each task what the functions get besides a setting, its title and the errors of what they return, with units."""
    height, fall = truths.ball(UNTIL), truths.first_fall()
    far = lambda values: max(abs(value - exact) for value, exact in zip(values, truths.SLIDER))
    return {
        "ball": ((UNTIL,), f"ball, height after {UNTIL} s", lambda v: f"{abs(v[0] - height):.1e} m"),
        "block": ((), "block, first fall", lambda v: f"{abs(v[0] - fall):.1e} s"),
        "slider": ((), f"slider with play, angles after {truths.SLIDER_END} s", lambda v: f"{far(v):.1e} rad"),
        "pile": ((DISCS, REST), f"heap of {DISCS} discs after {REST} s", lambda v: f"{v[0]:.1e} m deep, {v[1]:.1e} m/s"),
    }


def peer(name):
    try:
        return importlib.import_module(f"collisions.{name}")
    except ImportError as why:
        print(f"{name} does not take part: {why}", file=sys.stderr)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("command", help="the command lagrangian")
    words.add_argument("--only", default="ball,block,slider,pile")
    words.add_argument("--peers", default=",".join(PEERS))
    words.add_argument("--rounds", type=int, default=5)
    call = words.parse_args()
    os.environ["LAGRANGIAN"] = call.command
    peers = [module for module in map(peer, call.peers.split(",")) if module]
    print("| task | | error | time [ms] |")
    print("| --- | --- | --: | --: |")
    for name, (given, title, error) in tasks().items():
        if name not in call.only.split(","):
            continue
        rows = {}
        for count in range(call.rounds):
            for module in peers:
                for setting in module.SETTINGS.get(name, ()):
                    key = f"{module.NAME}, {module.said(setting)}"
                    before, text = rows.get(key, (math.inf, None))
                    if (count == 0 or key in rows) and (count == 0 or before < LONG):
                        try:
                            run = getattr(module, name)
                            seconds, value = run(setting, *given)
                            for _ in range(REPEATS if seconds < SHORT else 0):
                                seconds = min(seconds, run(setting, *given)[0])
                        except Exception as why:  # noqa: BLE001, an error of a peer is reported and its row is omitted
                            print(f"{name}: {key}: {why}", file=sys.stderr)
                            continue
                        rows[key] = min(before, seconds), error(value)
        for i, (key, (seconds, text)) in enumerate(rows.items()):
            print(f"| {'' if i else title} | {key} | {text} | {1e3 * seconds:.3g} |", flush=True)


if __name__ == "__main__":
    main()

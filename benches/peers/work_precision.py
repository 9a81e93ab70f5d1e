#!/usr/bin/env python3
"""Work against precision: the time of whole runs against their error, for our program and its peers, in one run on one core.

    target/peers/python/bin/python benches/peers/work_precision.py [--only NAME,NAME] [--rounds 3] [--svg FILE] [--ours PROGRAM]

Every run is one of tests/data/references: its end is known to 30 digits, and the error of a setting is the greatest |y − reference| /
(s + |reference|) over coordinates and rates, with s = 1 except for the crusher. Every tool runs with many tolerances (or step
lengths). Each round runs all settings in turn, so that other load on the computer affects all of them alike, and the fastest run
of each setting counts.

Peers that integrate equations get those of tests/data/references/equations.py, solved by LDLᵀ without square roots; those of the double
pendulum, the crusher and the chains are simplified by hand (motions.py). heyoka, diffsol and gcc (around a DOP853 in C) compile them and
CasADi interprets them, and SciPy calls the function that heyoka has compiled. IDAS solves for accelerations and multipliers itself.
MuJoCo, Drake and Exudyn get bodies and hinges (runs/bodies.py) of the machines that they can describe, and derive the equations themselves.

Each peer is one module of runs/. One that is not installed is left out with a word.

Ours is `cargo bench --bench time_against_error`, or a program built from it.
"""

import argparse
import importlib
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
from runs.problem import PROBLEMS, ROOT, Run

# If a setting takes longer, finer settings of the same tool are skipped.
LONG = 0.4
# Runs of a setting per round, for us and for peers alike, if they take at most SHORT; others are run in the first round alone.
REPEATS, SHORT = 5, 0.2
ERRORS = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)
# Modules of runs/, each with the class `Peer` of one program.
PEERS = ("heyoka", "dop853", "sundials", "scipy", "diffsol", "mujoco", "drake", "exudyn")


def peer_of(name):
    """The class of a peer, or None if it isn't installed."""
    try:
        return importlib.import_module(f"runs.{name}").Peer
    except ImportError as why:
        print(f"{name} does not take part: {why}", file=sys.stderr)


def of_ours(program, name):
    """Our settings: tool, tolerance or step, seconds, error."""
    call = [*program, "--only", name, "--repeats", str(REPEATS)]
    said = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for line in said.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0] == name:
            yield f"lagrangian, {cells[1]}", float(cells[2]), float(cells[4]) * 1e-6, float(cells[5])


def race(name, program, rounds, wanted, once):
    """For each tool and setting the least seconds and the error. Peers whose names are in `once` take part in the first round alone."""
    run, best = Run(name), {}

    def note(tool, setting, seconds, error):
        if math.isfinite(error):
            before = best.setdefault(tool, {}).get(setting, (math.inf, 0.0))
            best[tool][setting] = (min(before[0], seconds), error)

    peers = []
    for kind in wanted:
        try:
            peers.append(kind(run))
        except Exception as why:  # noqa: BLE001, an error of a peer is reported and its run is omitted
            print(f"{name}: {kind.__module__}: {why}", file=sys.stderr)
    slow = set()
    for count in range(rounds):
        for tool, setting, seconds, error in of_ours(program, name):
            note(tool, setting, seconds, error)
        for peer in peers:
            if count and type(peer).__module__.removeprefix("runs.") in once:
                continue
            for tool in peer.tools:
                for setting in peer.settings(tool):
                    if (tool, setting) in slow:
                        break
                    if count and best.get(tool, {}).get(setting, (0.0, 0.0))[0] > SHORT:
                        continue
                    try:
                        seconds, end = peer.call(tool, setting)
                        for _ in range(REPEATS - 1 if seconds < SHORT else 0):
                            seconds = min(seconds, peer.call(tool, setting)[0])
                    except Exception as why:  # noqa: BLE001
                        print(f"{name}: {tool}, {setting:.0e}: {str(why).splitlines()[0]}", file=sys.stderr)
                        slow.add((tool, setting))
                        break
                    if end is not None:
                        note(tool, setting, seconds, run.error(end))
                    if seconds > LONG:
                        slow.add((tool, setting))
                        break
        print(f"{name}: round {count + 1} of {rounds}", file=sys.stderr, flush=True)
    return {tool: sorted((error, seconds) for seconds, error in settings.values()) for tool, settings in best.items()}


def front(points):
    """The settings that no other beats in both error and time, by increasing error."""
    kept = []
    for error, seconds in sorted(points):
        error = max(error, 1e-18)
        while kept and kept[-1][1] >= seconds and kept[-1][0] == error:
            kept.pop()
        if not kept or seconds < kept[-1][1]:
            kept.append((error, seconds))
    return kept


def seconds_at(points, error):
    """The time at a given error, interpolated between the neighbouring settings on logarithmic scales."""
    kept = front(points)
    if not kept or kept[0][0] > error:
        return None
    if kept[-1][0] < error:
        return kept[-1][1]
    errors, seconds = np.array(kept).T
    return math.exp(np.interp(math.log(error), np.log(errors), np.log(seconds)))


def tables(results):
    for name, tools in results.items():
        print(f"| {name} | " + " | ".join(f"{error:.0e}" for error in ERRORS) + " | least error |")
        print("| --- |" + " --: |" * (len(ERRORS) + 1))
        for tool, points in tools.items():
            at = [seconds_at(points, error) for error in ERRORS]
            cells = ["–" if seconds is None else f"{seconds * 1e3:.3g}" for seconds in at]
            print(f"| {tool} | " + " | ".join(cells) + f" | {min(points)[0]:.1e} |")
        print()


def is_of_many(tool):
    """Whether its time is a share of that of several trajectories at once."""
    return "lanes" in tool or "batch" in tool


def ratios(theirs, ours):
    """The cells of a row: times over ours at each error."""
    for seconds, least in zip(theirs, ours):
        if seconds is None:
            yield "" if least is None else "–"
        elif least is None:
            yield "alone"
        else:
            ratio = seconds / least
            yield f"{ratio:.2f}" if ratio < 9.995 else f"{float(f'{ratio:.3g}'):g}"


def milliseconds(times):
    return ["–" if seconds is None else f"{seconds * 1e3:.3g}" for seconds in times]


def summary(results):
    """For each run and error the milliseconds of our fastest single method and the time of every program's fastest one over that; then the same
    of several trajectories at once."""
    print("| run | time, at error | " + " | ".join(f"{error:.0e}" for error in ERRORS) + " |")
    print("| --- | --- |" + " --: |" * len(ERRORS))
    for name, tools in results.items():
        for of_many in (False, True):
            best = {}
            for tool, points in tools.items():
                if is_of_many(tool) == of_many:
                    best.setdefault(tool.split(",")[0], []).extend(points)
            ours, words = best.pop("lagrangian", []), ("ours, four lanes, ms", "batch of four")
            if of_many and not (ours and best):
                continue
            times = [seconds_at(ours, error) for error in ERRORS]
            rows = [(words[0] if of_many else "ours, ms", milliseconds(times))]
            for program, points in best.items():
                cells = list(ratios([seconds_at(points, error) for error in ERRORS], times))
                if any(cell not in ("", "–") for cell in cells):
                    rows.append((f"{program}, {words[1]}" if of_many else program, cells))
            for k, (label, cells) in enumerate(rows):
                print(" ".join(f"| {cell}".rstrip() for cell in ("" if k or of_many else name, label, *cells)) + " |")
    print()


PANEL, MARGIN, IN_A_ROW = (330.0, 270.0), (56.0, 44.0), 3
# Error to the right, from 1 to 10⁻¹⁶; time upward, from 10 µs to 10 s; both logarithmic. Lower right is better.
OURS = ("#0b5394", "#c8553d", "#588157", "#8a5a9e", "#b8860b", "#008b8b", "#a0522d")
THEIRS = ("#111111", "#777777", "#e69f00", "#cc79a7", "#d55e00", "#56b4e9", "#009e73", "#999933", "#882255")


def text(x, y, anchor, words):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{words}</text>'


def panel(name, tools, style, corner):
    """The diagram of one run."""
    left, top = corner
    bottom, right = top + PANEL[1], left + PANEL[0]
    part = lambda value, low, high: min(1.0, max(0.0, (value - low) / (high - low)))
    x = lambda error: left + PANEL[0] * part(-math.log10(max(error, 1e-18)), 0.0, 16.0)
    y = lambda seconds: bottom - PANEL[1] * part(math.log10(seconds), -5.0, 1.0)
    out = [text((left + right) / 2, top - 10, "middle", name.replace("_", " "))]
    for power in range(0, 17, 4):
        at = x(10.0**-power)
        out += [f'<line x1="{at:.1f}" y1="{top}" x2="{at:.1f}" y2="{bottom}" stroke="#ddd"/>']
        out += [text(at, bottom + 14, "middle", f"1e-{power}")]
    for power in range(-5, 2):
        at = y(10.0**power)
        out += [f'<line x1="{left}" y1="{at:.1f}" x2="{right}" y2="{at:.1f}" stroke="#ddd"/>']
        out += [text(left - 4, at + 4, "end", f"{10.0 ** (power + 3):g} ms")]
    for tool, points in tools.items():
        color, dashes, thick = style[tool]
        shown = [(x(error), y(seconds)) for error, seconds in front(points) if error < 1.0]
        line = " ".join(f"{a:.1f},{b:.1f}" for a, b in shown)
        out += [f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="{thick}"{dashes}/>']
        out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2" fill="{color}"/>' for a, b in shown]
    return out


def drawing(results):
    names = list(results)
    rows = -(-len(names) // IN_A_ROW)
    tools = list(dict.fromkeys(tool for points in results.values() for tool in points))
    ours = [tool for tool in tools if tool.startswith("lagrangian")]
    theirs = [tool for tool in tools if tool not in ours]
    style = {tool: (OURS[i % len(OURS)], "", 1.8) for i, tool in enumerate(ours)}
    style |= {tool: (THEIRS[i % len(THEIRS)], ' stroke-dasharray="4 3"', 1.2) for i, tool in enumerate(theirs)}
    width = IN_A_ROW * (PANEL[0] + MARGIN[0]) + 16.0
    height = rows * (PANEL[1] + 2 * MARGIN[1]) + 18.0 * (-(-len(tools) // IN_A_ROW) + 1)
    frame = f'viewBox="0 0 {width:.0f} {height:.0f}" font-family="sans-serif" font-size="11"'
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" {frame}>', '<rect width="100%" height="100%" fill="white"/>']
    for i, name in enumerate(names):
        corner = MARGIN[0] + (i % IN_A_ROW) * (PANEL[0] + MARGIN[0]), MARGIN[1] + (i // IN_A_ROW) * (PANEL[1] + 2 * MARGIN[1])
        out += panel(name, results[name], style, corner)
    for i, tool in enumerate(tools):
        color, dashes, thick = style[tool]
        left = MARGIN[0] + (i % IN_A_ROW) * (PANEL[0] + MARGIN[0])
        y = rows * (PANEL[1] + 2 * MARGIN[1]) + 18.0 * (i // IN_A_ROW) + 8
        out.append(f'<line x1="{left}" y1="{y}" x2="{left + 28}" y2="{y}" stroke="{color}" stroke-width="{thick}"{dashes}/>')
        out.append(text(left + 34, y + 4, "start", tool))
    return "\n".join([*out, "</svg>"]) + "\n"


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--only", help="names of runs")
    words.add_argument("--rounds", type=int, default=3)
    words.add_argument("--svg", help="a file for the diagrams")
    words.add_argument("--json", help="a file for all settings; if it exists, its runs are drawn and shown too")
    words.add_argument("--ours", help="a program that `cargo bench --bench time_against_error` has built")
    words.add_argument("--peers", default=",".join(PEERS))
    words.add_argument("--once", default="", help="peers that take part in the first round alone, such as slow ones")
    words.add_argument("--methods", help="our methods, separated by semicolons: 'taylor;taylor, 4 lanes;dop853'")
    call = words.parse_args()
    program = [call.ours] if call.ours else ["cargo", "bench", "--bench", "time_against_error", "--"]
    if call.methods:
        program += ["--methods", call.methods]
    wanted = [kind for kind in map(peer_of, filter(None, call.peers.split(","))) if kind]
    results = {}
    if call.json and Path(call.json).exists():
        results = json.loads(Path(call.json).read_text())
    for name in call.only.split(",") if call.only else PROBLEMS:
        results[name] = race(name, program, call.rounds, wanted, call.once.split(","))
        if call.json:
            Path(call.json).write_text(json.dumps(results))
    tables(results)
    summary(results)
    if call.svg:
        Path(call.svg).write_text(drawing(results))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Work against precision: the time of whole runs against their error, for our program and its peers, in one run on one core.

    target/peers/python/bin/python benches/peers/work_precision.py [--only NAME,NAME] [--rounds 3] [--svg FILE] [--ours PROGRAM]

Every run is one of tests/data/references: its end is known to 30 digits, and the error of a setting is the greatest |y − reference| /
(s + |reference|) over coordinates and rates, with s = 1 except for the crusher. Every tool runs with many tolerances (or step
lengths). Each round runs all settings in turn, so that other load on the computer affects all of them alike, and the fastest run
of each setting counts.

Peers integrate the equations of tests/data/references/equations.py, solved by LDLᵀ without square roots; those of the double pendulum, the
crusher and the chains are simplified by hand (motions.py). They get compiled right-hand sides: heyoka and CasADi compile or interpret
their own, and SciPy calls the function that heyoka has compiled. IDAS solves for accelerations and multipliers itself. MuJoCo runs the
machines that it can describe, with steps of fixed length.

Ours is `cargo bench --bench time_against_error`, or a program built from it.
"""

import argparse
import json
import math
import subprocess
import sys
import time
from pathlib import Path

import casadi
import heyoka as hy
import motions
import mujoco
import numpy as np
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parents[2]
REFERENCES = ROOT / "tests" / "data" / "references"
sys.path.insert(0, str(REFERENCES))
from equations import PROBLEMS

# A setting that takes longer is run once, and finer settings of the same tool are skipped.
LONG = 1.0
# Runs of a setting per round, for us and for peers alike, if they take at most SHORT.
REPEATS, SHORT = 5, 0.2
ERRORS = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)
MOST = 1_000_000


class Run:
    """A file of references."""

    def __init__(self, name):
        self.name, self.scales, end = name, None, []
        for line in (REFERENCES / f"{name}.txt").read_text().splitlines():
            word, *rest = line.split()
            if word in ("start", "scales"):
                setattr(self, word, [float(x) for x in rest])
            elif word == "until":
                self.until = float(rest[0])
            elif word not in ("#", "machine", "end"):
                end.append(np.longdouble(word))
        self.end = np.array(end)
        self.scales = np.array(self.scales or [1.0] * len(end))

    def error(self, y):
        return float(np.max(np.abs(np.asarray(y, np.longdouble) - self.end) / (self.scales + np.abs(self.end))))


class Symbols:
    """The arithmetic of the equations on another program's expressions."""

    number = float

    def __init__(self, of):
        self.of = of

    def sin_cos(self, angle):
        return self.of.sin(angle), self.of.cos(angle)

    def root(self, x):
        return self.of.sqrt(x)


def solved(matrix, right):
    """The solution of M x = f by LDLᵀ; zeros are the int 0 and cost nothing. Rows of constraints come last, so no pivot is 0."""
    n = len(right)
    is_zero = lambda x: isinstance(x, int) and x == 0
    D, L, f = [], [[0] * n for _ in range(n)], list(right)
    for i in range(n):
        left, held = matrix[i][i], [0] * i
        for j in range(i):
            entry = matrix[i][j]
            for k in range(j):
                if not is_zero(held[k]) and not is_zero(L[j][k]):
                    entry = entry - held[k] * L[j][k]
            held[j] = entry
        for j in range(i):
            if not is_zero(held[j]):
                L[i][j] = held[j] / D[j]
                left = left - held[j] * L[i][j]
        D.append(left)
    for i in range(n):
        for j in range(i):
            if not is_zero(L[i][j]):
                f[i] = f[i] - L[i][j] * f[j]
    f = [f[i] / D[i] for i in range(n)]
    for i in reversed(range(n)):
        for j in range(i + 1, n):
            if not is_zero(L[j][i]):
                f[i] = f[i] - L[j][i] * f[j]
    return f


BY_HAND = {
    "double_pendulum_regular": motions.pendulum,
    "double_pendulum_chaotic": motions.pendulum,
    "crusher": motions.crusher,
    "stiff_crusher": lambda: motions.crusher(10_000),
    "chain_8": lambda: motions.chain(8, False),
    "chain_16": lambda: motions.chain(16, False),
}
# Unrolled code for these takes minutes to compile.
COMPACT = ("andrews_squeezer", "closed_pendulum")


class Heyoka:
    """Taylor's method for one trajectory and for four in lanes, each with its own steps."""

    tolerances = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16)

    def __init__(self, run):
        self.run, self.made = run, {}
        self.system = self.equations(run)
        self.tools = {"heyoka, Taylor": 1, "heyoka, Taylor, batch of 4": 4}

    @staticmethod
    def equations(run):
        if run.name in BY_HAND:
            return BY_HAND[run.name]()[0]
        n = len(run.start) // 2
        q, v = ([hy.expression(f"{kind}{i:02}") for i in range(n)] for kind in "qv")
        matrix, right = PROBLEMS[run.name][2](Symbols(hy), hy.time, q, v)
        return [*zip(q, v), *zip(v, solved(matrix, right)[:n])]

    def settings(self, _tool):
        return self.tolerances

    def call(self, tool, tolerance):
        width = self.tools[tool]
        key = width, tolerance
        compact = self.run.name in COMPACT
        start = np.array(self.run.start)
        if key not in self.made:
            words = {"tol": tolerance, "compact_mode": compact}
            self.made[key] = (
                hy.taylor_adaptive(self.system, start, **words)
                if width == 1
                else hy.taylor_adaptive_batch(self.system, np.array([start] * width).T.copy(), **words)
            )
        one = self.made[key]
        if width == 1:
            one.time, one.state[:] = 0.0, start
        else:
            one.set_time(0.0)
            one.state[:] = np.array([start] * width).T
        clock = time.process_time()
        one.propagate_until(self.run.until)
        seconds = (time.process_time() - clock) / width
        return seconds, one.state if width == 1 else one.state[:, 0]


class SciPy:
    tools = ("SciPy, DOP853", "SciPy, Radau", "SciPy, LSODA")

    def __init__(self, run):
        self.run = run
        system = Heyoka.equations(run)
        variables = [variable for variable, _ in system]
        compiled = hy.cfunc([right for _, right in system], vars=variables, compact_mode=run.name in COMPACT)
        self.rate = lambda t, y: compiled(np.ascontiguousarray(y), time=t)

    def settings(self, tool):
        return (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)[: 5 if tool.endswith("Radau") else 6]

    def call(self, tool, tolerance):
        method = tool.split()[-1]
        clock = time.process_time()
        found = solve_ivp(self.rate, (0.0, self.run.until), self.run.start, method=method, rtol=tolerance, atol=tolerance)
        return time.process_time() - clock, found.y[:, -1] if found.success else None


class Sundials:
    """CVODES with its Adams and BDF formulas, and IDAS for the implicit equations, both through CasADi."""

    tools = ("SUNDIALS, CVODES Adams", "SUNDIALS, CVODES BDF", "SUNDIALS, IDAS")

    def __init__(self, run):
        self.run, self.made = run, {}

    def settings(self, _tool):
        return (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)

    def problem(self, tool):
        n = len(self.run.start) // 2
        x, t = casadi.SX.sym("x", 2 * n), casadi.SX.sym("t")
        q, v = casadi.vertsplit(x[:n]), casadi.vertsplit(x[n:])
        matrix, right = PROBLEMS[self.run.name][2](Symbols(casadi), t, q, v)
        if tool.endswith("IDAS"):
            z = casadi.SX.sym("z", len(right))
            left = [sum((entry * z[j] for j, entry in enumerate(row)), start=casadi.SX(0)) for row in matrix]
            rest = casadi.vertcat(*[a - f for a, f in zip(left, right)])
            return {"x": x, "t": t, "z": z, "ode": casadi.vertcat(*v, z[:n]), "alg": rest}
        return {"x": x, "t": t, "ode": casadi.vertcat(*v, *solved(matrix, right)[:n])}

    def call(self, tool, tolerance):
        key = tool, tolerance
        if key not in self.made:
            words = {"reltol": tolerance, "abstol": tolerance, "max_num_steps": MOST, "show_eval_warnings": False}
            if "Adams" in tool:
                words |= {"linear_multistep_method": "adams"}
            kind = "idas" if tool.endswith("IDAS") else "cvodes"
            self.made[key] = casadi.integrator("run", kind, self.problem(tool), 0.0, self.run.until, words)
        clock = time.process_time()
        try:
            end = self.made[key](x0=self.run.start)["xf"]
        except RuntimeError:
            return time.process_time() - clock, None
        return time.process_time() - clock, np.array(end).ravel()


class MuJoCo:
    tools = ("MuJoCo, RK4",)

    def __init__(self, run):
        import peers.mujoco_peer as models

        bars = {"double_pendulum_regular": 2, "double_pendulum_chaotic": 2, "chain_8": 8, "chain_16": 16}
        self.run, self.bars = run, bars.get(run.name)
        if self.bars:
            bob = [(1.0, 1.0, 1.0, 1e-12)] * self.bars
            rod = [(0.2, 0.5, 0.1, 0.5 * 0.04 / 12)] * self.bars
            self.body = models.chain_of(bob if self.bars == 2 else rod)
        else:
            self.tools = ()

    def settings(self, _tool):
        return [self.run.until / 2**k for k in range(8, 18)]

    def call(self, _tool, step):
        text = (
            f'<mujoco><compiler angle="radian"/><option gravity="0 0 -9.81" integrator="RK4" timestep="{step!r}">'
            f'<flag contact="disable" constraint="disable"/></option><worldbody>{self.body}</worldbody></mujoco>'
        )
        model = mujoco.MjModel.from_xml_string(text)
        data = mujoco.MjData(model)
        n = model.nv
        for place, x in ((data.qpos, self.run.start[:n]), (data.qvel, self.run.start[n:])):
            # Joint angles of chains are relative to the previous bar.
            place[:] = np.diff(x, prepend=0.0)
        clock = time.process_time()
        mujoco.mj_step(model, data, nstep=round(self.run.until / step))
        seconds = time.process_time() - clock
        ends = (data.qpos, data.qvel)
        return seconds, np.concatenate([np.cumsum(x) for x in ends])


def of_ours(program, name):
    """Our settings: tool, tolerance or step, seconds, error."""
    call = [*program, "--only", name, "--repeats", str(REPEATS)]
    said = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for line in said.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if cells[0] == name:
            yield f"lagrangian, {cells[1]}", float(cells[2]), float(cells[4]) * 1e-6, float(cells[5])


def race(name, program, rounds, wanted):
    """For each tool and setting the least seconds and the error."""
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
            print(f"{name}: {kind.__name__}: {why}", file=sys.stderr)
    slow = set()
    for count in range(rounds):
        for tool, setting, seconds, error in of_ours(program, name):
            note(tool, setting, seconds, error)
        for peer in peers:
            for tool in peer.tools:
                for setting in peer.settings(tool):
                    if (tool, setting) in slow:
                        break
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
    words.add_argument("--peers", default="heyoka,sundials,scipy,mujoco")
    words.add_argument("--methods", help="our methods, separated by semicolons: 'taylor;taylor, 4 lanes;dop853'")
    call = words.parse_args()
    program = [call.ours] if call.ours else ["cargo", "bench", "--bench", "time_against_error", "--"]
    if call.methods:
        program += ["--methods", call.methods]
    kinds = {"heyoka": Heyoka, "sundials": Sundials, "scipy": SciPy, "mujoco": MuJoCo}
    wanted = [kinds[name] for name in call.peers.split(",") if name]
    results = {}
    if call.json and Path(call.json).exists():
        results = json.loads(Path(call.json).read_text())
    for name in call.only.split(",") if call.only else PROBLEMS:
        results[name] = race(name, program, call.rounds, wanted)
        if call.json:
            Path(call.json).write_text(json.dumps(results))
    tables(results)
    if call.svg:
        Path(call.svg).write_text(drawing(results))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Closed loops over time: joint drift, error and time of peers and of our command, on one core.

    benches/peers/closed_loops.py COMMAND [SECONDS]   COMMAND is the command `lagrangian`; needs requirements.txt

The machines are the four-bar linkage and the five-link pendulum of machines/, typed in here by hand as loops of uniform bars.
For each run of SECONDS (100 if not given) it prints the largest distance between the parts of an opened joint, the largest
change of the energy, and the error of the angles at a time up to which the motion is not chaotic, against the same equations
with 64-bit mantissas.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import casadi
import heyoka
import mujoco
import numpy
import pinocchio
import sympy
import sympy.physics.mechanics
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parent.parent.parent
GRAVITY = 9.81
TOLERANCE = 1e-9


class Loop:
    """Bars with absolute angles, from pin to pin; `signs` are their directions around the loop to the pin at (span, 0).

    The last bar has the sign −1 if it hangs from that pin itself.
    """

    def __init__(self, name, lengths, masses, signs, span, start, compared):
        self.name, self.lengths, self.masses, self.signs, self.span = name, lengths, masses, signs, span
        self.start = numpy.array(start)
        # Up to this time errors are at most the tolerance times a moderate number.
        self.compared = compared
        self.n = len(lengths)

    def centres(self):
        """For each bar, the contributions of itself and of the bars before it to the position of its centre: (bar, length)."""
        for i, sign in enumerate(self.signs):
            before = [(j, self.lengths[j]) for j in range(i)] if sign > 0 else []
            yield before + [(i, self.lengths[i] / 2)]

    def equations(self, q, v, sin, cos, zero):
        """M, f, G, γ of M a + Gᵀ λ = f, G a = γ, in any number type of q and v."""
        n = self.n
        s, c = [sin(x) for x in q], [cos(x) for x in q]
        across = lambda i, j: c[i] * c[j] + s[i] * s[j]
        turned = lambda i, j: s[i] * c[j] - c[i] * s[j]
        mass = [[zero] * n for _ in range(n)]
        force = [zero] * n
        for m, length, i, arms in zip(self.masses, self.lengths, range(n), self.centres()):
            mass[i][i] = mass[i][i] + m * length**2 / 12
            for a, at in arms:
                force[a] = force[a] - m * GRAVITY * at * c[a]
                for b, bt in arms:
                    mass[a][b] = mass[a][b] + m * at * bt * (1 if a == b else across(a, b))
                    if a != b:
                        force[a] = force[a] - m * at * bt * turned(a, b) * v[b] * v[b]
        arms = [sign * length for sign, length in zip(self.signs, self.lengths)]
        rows = [[-arm * x for arm, x in zip(arms, s)], [arm * x for arm, x in zip(arms, c)]]
        gamma = [sum((arm * x * w * w for arm, x, w in zip(arms, xs, v)), zero) for xs in (c, s)]
        return mass, force, rows, gamma

    def solution(self, q, v, sin, cos, zero):
        """a and λ by Gaussian elimination of the whole system: first M, which is positive definite, then −G M⁻¹ Gᵀ."""
        mass, force, rows, gamma = self.equations(q, v, sin, cos, zero)
        n, m = self.n, len(rows)
        table = [mass[i] + [row[i] for row in rows] + [force[i]] for i in range(n)]
        table += [rows[k] + [zero] * m + [gamma[k]] for k in range(m)]
        for i in range(n + m):
            for j in range(i + 1, n + m):
                factor = table[j][i] / table[i][i]
                for k in range(i + 1, n + m + 1):
                    table[j][k] = table[j][k] - factor * table[i][k]
        solution = [zero] * (n + m)
        for i in reversed(range(n + m)):
            rest = sum((table[i][k] * solution[k] for k in range(i + 1, n + m)), zero)
            solution[i] = (table[i][-1] - rest) / table[i][i]
        return solution

    def gap(self, q):
        """The gap in the loop, in m."""
        x = sum(sign * length * math.cos(a) for sign, length, a in zip(self.signs, self.lengths, q))
        y = sum(sign * length * math.sin(a) for sign, length, a in zip(self.signs, self.lengths, q))
        return math.hypot(x - self.span, y)

    def energy(self, q, v):
        mass, _, _, _ = self.equations(q, v, math.sin, math.cos, 0.0)
        heights = (m * at * math.sin(q[a]) for m, arms in zip(self.masses, self.centres()) for a, at in arms)
        return 0.5 * numpy.dot(v, numpy.array(mass) @ v) + GRAVITY * sum(heights)

    def read(self, run):
        """The largest gap, the largest change of energy, and the state at the time of comparison, from rows (t, q, v)."""
        gap = change = 0.0
        energy = self.energy(*numpy.split(self.start, 2))
        compared = None
        for t, *y in run:
            q, v = numpy.split(numpy.array(y), 2)
            gap, change = max(gap, self.gap(q)), max(change, abs(self.energy(q, v) - energy))
            if abs(t - self.compared) < 1e-6:
                compared = q
        return gap, change, compared


def four_bar():
    a, b, c, d, omega = 0.3, 0.8, 0.6, 1.0, 12.0
    base = d - a
    coupler = math.acos((base**2 + b**2 - c**2) / (2 * b * base))
    rocker = math.pi - math.acos((base**2 + c**2 - b**2) / (2 * c * base))
    turn = -a / base * omega
    start = [0.0, coupler, rocker, omega, turn, turn]
    return Loop("four_bar", [a, b, c], [1.0, 2.0, 1.5], [1, 1, -1], d, start, 10.0)


def five_links():
    start = [-math.pi / 2, 0.0, -math.pi / 3, math.pi / 3, math.pi / 2] + [0.0] * 5
    return Loop("closed_pendulum", [1.0] * 5, [1.0] * 5, [1] * 5, 2.0, start, 2.0)


def heyoka_run(loop, until, samples, number=float, tolerance=None):
    """Taylor's method for the accelerations."""
    names = [f"q{i}" for i in range(loop.n)] + [f"v{i}" for i in range(loop.n)]
    y = heyoka.make_vars(*names)
    q, v = y[: loop.n], y[loop.n :]
    a = loop.solution(q, v, heyoka.sin, heyoka.cos, heyoka.expression(number(0.0)))[: loop.n]
    options = {"fp_type": number} if number is not float else {}
    if tolerance is not None:
        options["tol"] = number(tolerance)
    start = numpy.array(loop.start, dtype=number)
    motion = heyoka.taylor_adaptive(list(zip(y, v + a)), state=start, compact_mode=True, **options)
    clock = time.process_time()
    grid = numpy.array(samples, dtype=number)
    rows = motion.propagate_grid(grid)[-1]
    return time.process_time() - clock, [[t, *map(float, row)] for t, row in zip(samples, rows)]


def casadi_run(form, loop, until, samples):
    """IDAS for the equations of motion; `form` is the formulation of the joints."""
    q, v, a = (casadi.SX.sym(name, loop.n) for name in "qva")
    split = lambda x: [x[i] for i in range(loop.n)]
    mass, force, rows, gamma = loop.equations(split(q), split(v), casadi.sin, casadi.cos, casadi.SX(0))
    matrix = lambda rows: casadi.vertcat(*[casadi.horzcat(*row) for row in rows])
    mass, rows, force, gamma = matrix(mass), matrix(rows), casadi.vertcat(*force), casadi.vertcat(*gamma)
    multipliers = casadi.SX.sym("λ", 2)
    arms = [sign * length for sign, length in zip(loop.signs, loop.lengths)]
    places = casadi.vertcat(
        sum(arm * casadi.cos(x) for arm, x in zip(arms, split(q))) - loop.span,
        sum(arm * casadi.sin(x) for arm, x in zip(arms, split(q))),
    )
    balance = casadi.mtimes(mass, a) + casadi.mtimes(rows.T, multipliers) - force
    unknown, along = [a, multipliers], v
    if form == "index 3":
        joints = [places]
    elif form == "index 2, GGL":
        extra = casadi.SX.sym("μ", 2)
        unknown, along = unknown + [extra], v + casadi.mtimes(rows.T, extra)
        joints = [casadi.mtimes(rows, v), places]
    else:
        joints = [casadi.mtimes(rows, a) - gamma]
    dae = {
        "x": casadi.vertcat(q, v), "z": casadi.vertcat(*unknown),
        "ode": casadi.vertcat(along, a), "alg": casadi.vertcat(balance, *joints),
    }
    options = {"abstol": TOLERANCE, "reltol": TOLERANCE, "max_num_steps": 10_000_000}
    if form != "index 1":
        # The start is exact; algebraic variables are excluded from the error test, as the manual of IDAS advises.
        options |= {"calc_ic": False, "suppress_algebraic": True}
    step = casadi.integrator("step", "idas", dae, 0.0, list(samples), options)
    exact = loop.solution(*numpy.split(loop.start, 2), math.sin, math.cos, 0.0)
    guess = numpy.concatenate([exact, numpy.zeros(dae["z"].numel() - len(exact))])
    clock = time.process_time()
    result = step(x0=loop.start, z0=guess)
    seconds = time.process_time() - clock
    return seconds, [[t, *row] for t, row in zip(samples, numpy.array(result["xf"]).T)]


def sympy_run(loop, until, samples):
    """Lagrange's equations with multipliers, compiled by `lambdify` with `cse`, and SciPy's DOP853, as PyDy does it."""
    clock = sympy.Symbol("t")
    q = [sympy.Function(f"q{i}")(clock) for i in range(loop.n)]
    kinetic = potential = 0
    for m, length, angle, arms in zip(loop.masses, loop.lengths, q, loop.centres()):
        x = sum(at * sympy.cos(q[a]) for a, at in arms)
        y = sum(at * sympy.sin(q[a]) for a, at in arms)
        kinetic += m * (x.diff(clock) ** 2 + y.diff(clock) ** 2) / 2 + m * length**2 / 12 * angle.diff(clock) ** 2 / 2
        potential += m * GRAVITY * y
    arms = list(zip(loop.signs, loop.lengths, q))
    joints = [
        sum(sign * length * sympy.cos(a) for sign, length, a in arms) - loop.span,
        sum(sign * length * sympy.sin(a) for sign, length, a in arms),
    ]
    method = sympy.physics.mechanics.LagrangesMethod(kinetic - potential, q, hol_coneqs=joints)
    method.form_lagranges_equations()
    state = q + [x.diff(clock) for x in q]
    plain = sympy.symbols(f"y0:{len(state)}")
    known = dict(reversed(list(zip(state, plain))))
    matrices = [method.mass_matrix_full.subs(known), method.forcing_full.subs(known)]
    function = sympy.lambdify([plain], matrices, cse=True)

    def rates(_, y):
        matrix, right = function(y)
        return numpy.linalg.solve(matrix, right)[: len(y), 0]

    clock = time.process_time()
    run = solve_ivp(rates, (0.0, until), loop.start, "DOP853", samples, rtol=TOLERANCE, atol=TOLERANCE)
    return time.process_time() - clock, [[t, *y] for t, y in zip(run.t, run.y.T)]


def mujoco_run(step, integrator, loop, until, samples):
    """Hinges, with an equality that closes the loop, as stiff as the solver permits."""
    number = lambda x: repr(float(x))
    pin = lambda i: "0 0 0" if loop.signs[i] < 0 or i == 0 else f"{number(loop.lengths[i - 1])} 0 0"
    body = lambda i, inside: f"""<body name="bar{i}" pos="{f'{number(loop.span)} 0 0' if loop.signs[i] < 0 else pin(i)}">
      <joint name="q{i}" type="hinge" axis="0 -1 0"/>
      <inertial pos="{number(loop.lengths[i] / 2)} 0 0" mass="{number(loop.masses[i])}"
        diaginertia="{' '.join([number(loop.masses[i] * loop.lengths[i] ** 2 / 12)] * 3)}"/>{inside}</body>"""
    bars = [i for i in range(loop.n) if loop.signs[i] > 0]
    chain = ""
    for i in reversed(bars):
        chain = body(i, chain)
    hung = [i for i in range(loop.n) if loop.signs[i] < 0]
    chain += "".join(body(i, "") for i in hung)
    end = f'anchor="{number(loop.lengths[bars[-1]])} 0 0"'
    other = f'body2="bar{hung[0]}"' if hung else ""
    xml = f"""<mujoco><compiler angle="radian"/>
      <option timestep="{step}" gravity="0 0 {-GRAVITY}" integrator="{integrator}" solver="Newton" tolerance="1e-15"/>
      <worldbody>{chain}</worldbody>
      <equality><connect body1="bar{bars[-1]}" {other} {end} solref="{2 * step} 1" solimp="0.9999 0.9999 0.001"/></equality>
    </mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)

    def absolute(x):
        result = numpy.array(x)
        for i in bars[1:]:
            result[i] += result[i - 1]
        return result

    def relative(x):
        return [x[i] - x[i - 1] if i in bars[1:] else x[i] for i in range(loop.n)]

    # MuJoCo derives the anchor on the other body from the model's reference pose, in which all bars have angle 0.
    if hung:
        model.eq_data[0, 3:6] = [loop.lengths[hung[0]], 0.0, 0.0]
    else:
        model.eq_data[0, 3:6] = [loop.span, 0.0, 0.0]
    q, v = numpy.split(loop.start, 2)
    data.qpos[:], data.qvel[:] = relative(q), relative(v)
    rows, clock = [], time.process_time()
    every = round((samples[1] - samples[0]) / step)
    rows.append([0.0, *loop.start])
    for t in samples[1:]:
        mujoco.mj_step(model, data, every)
        rows.append([t, *absolute(data.qpos), *absolute(data.qvel)])
    return time.process_time() - clock, rows


def pinocchio_run(step, loop, until, samples):
    """Pinocchio's constrained dynamics with Baumgarte stabilization, and the classic Runge–Kutta method of order 4."""
    model = pinocchio.Model()
    model.gravity.linear = numpy.array([0.0, -GRAVITY, 0.0])
    joints = []
    for i in range(loop.n):
        first = loop.signs[i] < 0 or i == 0
        x = loop.span if loop.signs[i] < 0 else 0.0 if first else loop.lengths[i - 1]
        place = pinocchio.SE3(numpy.eye(3), numpy.array([x, 0.0, 0.0]))
        joints.append(model.addJoint(0 if first else joints[i - 1], pinocchio.JointModelRZ(), place, f"q{i}"))
        length, mass = loop.lengths[i], loop.masses[i]
        inertia = pinocchio.Inertia(mass, numpy.array([length / 2, 0.0, 0.0]), numpy.eye(3) * mass * length**2 / 12)
        model.appendBodyToJoint(joints[i], inertia, pinocchio.SE3.Identity())
    bars = [i for i in range(loop.n) if loop.signs[i] > 0]
    hung = [i for i in range(loop.n) if loop.signs[i] < 0]
    at = lambda x: pinocchio.SE3(numpy.eye(3), numpy.array([x, 0.0, 0.0]))
    other = (joints[hung[0]], at(loop.lengths[hung[0]])) if hung else (0, at(loop.span))
    joint = pinocchio.RigidConstraintModel(
        pinocchio.ContactType.CONTACT_3D, model, joints[bars[-1]], at(loop.lengths[bars[-1]]), *other,
        pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED,
    )
    joint.setBaumgarteCorrectorParameters(pinocchio.BaumgarteCorrectorParameters(1e4, 2e2))
    data = model.createData()
    held, known = pinocchio.StdVec_RigidConstraintModel(), pinocchio.StdVec_RigidConstraintData()
    held.append(joint)
    known.append(joint.createData())
    pinocchio.initConstraintDynamics(model, data, held, known)
    # The third row of the joint, out of the plane, is already satisfied by the hinges.
    settings = pinocchio.ProximalSettings(1e-14, 1e-12, 20)
    to = numpy.eye(loop.n)
    for i in bars[1:]:
        to[i, i - 1] = -1.0
    back = numpy.linalg.inv(to)
    nothing = numpy.zeros(loop.n)

    def rates(y):
        q, v = numpy.split(y, 2)
        return numpy.concatenate([v, pinocchio.constraintDynamics(model, data, q, v, nothing, held, known, settings)])

    y = numpy.concatenate([to @ x for x in numpy.split(loop.start, 2)])
    rows, clock = [[0.0, *loop.start]], time.process_time()
    every = round((samples[1] - samples[0]) / step)
    for t in samples[1:]:
        for _ in range(every):
            k1 = rates(y)
            k2 = rates(y + step / 2 * k1)
            k3 = rates(y + step / 2 * k2)
            k4 = rates(y + step * k3)
            y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        rows.append([t, *numpy.concatenate([back @ x for x in numpy.split(y, 2)])])
    return time.process_time() - clock, rows


def own_run(command, tolerance, loop, until, samples):
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "motion.csv"
        every = samples[1] - samples[0]
        words = [command, "simulate", ROOT / f"machines/{loop.name}.machine", "--until", until, "--every", every]
        words += ["--tolerance", tolerance, "--out", table, "--json"]
        run = json.loads(subprocess.run(list(map(str, words)), check=True, capture_output=True).stdout)
        with open(table) as file:
            lines = list(csv.reader(line for line in file if not line.startswith("#")))
    return run["seconds"], [list(map(float, line[: 1 + 2 * loop.n])) for line in lines[1:]]


def main():
    command, until = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 100.0
    samples = numpy.linspace(0.0, until, round(until * 10) + 1)
    runs = {
        "SymPy, SciPy's DOP853 1e-9": sympy_run,
        "CasADi, IDAS 1e-9, index 3": lambda *a: casadi_run("index 3", *a),
        "CasADi, IDAS 1e-9, index 2, GGL": lambda *a: casadi_run("index 2, GGL", *a),
        "CasADi, IDAS 1e-9, index 1": lambda *a: casadi_run("index 1", *a),
        "heyoka, Taylor 2e-16": heyoka_run,
        "Pinocchio, RK4 1 ms, Baumgarte": lambda *a: pinocchio_run(1e-3, *a),
        "MuJoCo, Euler 1 ms": lambda *a: mujoco_run(1e-3, "Euler", *a),
        "MuJoCo, RK4 0.1 ms": lambda *a: mujoco_run(1e-4, "RK4", *a),
        "**lagrangian**, dop853 1e-9, interpreted": lambda *a: own_run(command, TOLERANCE, *a),
        "**lagrangian**, dop853 1e-14, interpreted": lambda *a: own_run(command, 1e-14, *a),
    }
    print("| machine | program | open joint [m] | energy [J] | error [rad] | time [s] |")
    print("| --- | --- | --: | --: | --: | --: |")
    for loop in (four_bar(), five_links()):
        few = numpy.linspace(0.0, loop.compared, 11)
        truth = [
            loop.read(heyoka_run(loop, loop.compared, few, numpy.longdouble, tolerance)[1])[2] for tolerance in (1e-19, 1e-18)
        ]
        assert numpy.abs(truth[0] - truth[1]).max() < 1e-13, truth
        for name, run in runs.items():
            try:
                seconds, rows = run(loop, until, samples)
            except Exception as error:
                print(f"{loop.name}, {name}: {error}", file=sys.stderr)
                print(f"| {loop.name} | {name} | – | – | – | gave up |", flush=True)
                continue
            gap, change, end = loop.read(rows)
            error = numpy.abs(end - truth[0]).max()
            print(f"| {loop.name} | {name} | {gap:.1e} | {change:.1e} | {error:.1e} | {seconds:.2f} |", flush=True)


if __name__ == "__main__":
    main()

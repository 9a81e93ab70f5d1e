"""The tasks of contacts.py in Siconos; run by a Python that has it: TASK SETTING … prints a line of JSON for each setting.

Settings are steps in s of Moreau and Jean's scheme with θ = 1/2.
"""

import ctypes
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
# This folder has a module with the name of the program.
sys.path[:] = [place for place in sys.path if Path(place or ".").resolve() != HERE]
sys.path.append(str(HERE.parent))
import numpy as np  # noqa: E402
import siconos  # noqa: E402
import siconos.kernel as kernel  # noqa: E402
import siconos.numerics as numerics  # noqa: E402
from collisions.heap import RADIUS, measured  # noqa: E402

GRAVITY = 9.81


def simulation(parts, links, until, step, problem):
    """It, for dynamical systems and for pairs of interactions and the systems that they join."""
    model = kernel.NonSmoothDynamicalSystem(0.0, until)
    for part in parts:
        model.insertDynamicalSystem(part)
    for interaction, *joined in links:
        model.link(interaction, *joined)
    scheme = kernel.MoreauJeanOSI(0.5)
    run = kernel.TimeStepping(model, kernel.TimeDiscretisation(0.0, step), scheme, problem)
    run.setNewtonTolerance(1e-10)
    run.setNewtonMaxIteration(20)
    return run


def stepped(run, count, look=None):
    """Makes steps; returns the seconds."""
    clock = time.process_time()
    for _ in range(count):
        run.computeOneStep()
        if look and look(run.nextTime()):
            break
        run.nextStep()
    return time.process_time() - clock


def ball(step):
    body = kernel.LagrangianLinearTIDS([1.0], [0.0], [[1.0]])
    body.setFExtPtr([-GRAVITY])
    floor = kernel.Interaction(kernel.NewtonImpactNSL(0.8), kernel.LagrangianLinearTIR([[1.0]]))
    until = 2.3
    run = simulation([body], [(floor, body)], until + 1.0, step, kernel.LCP())
    return stepped(run, round(until / step)), [float(body.q()[0])]


def frictional(tolerance=1e-12):
    problem = kernel.FrictionContact(2, numerics.SICONOS_FRICTION_2D_NSGS)
    options = problem.numericsSolverOptions()
    options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 10_000
    return problem


def block(step):
    tilt, half = 0.12248933156343208, (0.25, 1.0)
    height = half[0] * math.sin(tilt) + half[1] * math.cos(tilt)
    mass = 100.0
    inertia = mass * (half[0] ** 2 + half[1] ** 2) / 3
    body = kernel.LagrangianLinearTIDS([0.0, height, tilt], [0.0] * 3, np.diag([mass, mass, inertia]))
    body.setFExtPtr([0.0, -mass * GRAVITY, 0.0])
    law = kernel.NewtonImpactFrictionNSL(0.0, 0.0, 2.0, 2)
    links = [(kernel.Interaction(law, relation(side)), body) for side in ("left", "right")]
    run = simulation([body], links, 2.0, step, frictional())
    found = [tilt, math.nan]

    def look(t):
        before, found[0] = found[0], float(body.q()[2])
        if before > 0 >= found[0]:
            found[1] = t - step * found[0] / (found[0] - before)
            return True

    seconds = stepped(run, round(1.0 / step), look)
    return seconds, [found[1]]


def relation(name):
    return kernel.LagrangianScleronomousR(f"siconos_plugin:{name}_y", f"siconos_plugin:{name}_G")


def slider(step):
    body = kernel.LagrangianDS([0.0] * 3, [150.0, -75.0, 0.0], "siconos_plugin:slider_mass")
    body.setComputeFGyrFunction("siconos_plugin", "slider_gyr")
    body.setComputeJacobianFGyrqFunction("siconos_plugin", "slider_gyr_q")
    body.setComputeJacobianFGyrqDotFunction("siconos_plugin", "slider_gyr_v")
    law = kernel.NewtonImpactFrictionNSL(0.4, 0.0, 0.01, 2)
    links = [(kernel.Interaction(law, relation(f"touch{i}")), body) for i in range(4)]
    until = 0.009
    run = simulation([body], links, until + 0.01, step, frictional())
    return stepped(run, round(until / step)), [float(x) for x in body.q()[:2]]


def pile(step, count=12, until=2.5):
    mass, radius, apart = 0.05, RADIUS, 0.07
    discs = []
    for i in range(1, count + 1):
        at = [apart * math.sqrt(i) * of(2.4 * i) for of in (math.cos, math.sin)]
        disc = kernel.LagrangianLinearTIDS([*at, 0.0], [0.0] * 3, np.diag([mass, mass, mass * radius**2 / 2]))
        disc.setFExtPtr([0.0, -mass * GRAVITY, 0.0])
        discs.append(disc)
    law = kernel.NewtonImpactFrictionNSL(0.0, 0.0, 0.3, 2)
    links = [(kernel.Interaction(law, relation("wall")), disc) for disc in discs]
    for i, disc in enumerate(discs):
        links += [(kernel.Interaction(law, relation("pair")), disc, other) for other in discs[i + 1 :]]
    run = simulation(discs, links, until + 1.0, step, frictional(1e-10))
    seconds = stepped(run, round(until / step))
    x, y, u, v = (
        [float(of(disc)[i]) for disc in discs] for of in (kernel.LagrangianDS.q, kernel.LagrangianDS.velocity) for i in (0, 1)
    )
    return seconds, measured(x, y, u, v)


def main():
    task, *steps = sys.argv[1:]
    if task == "version":
        print(siconos.version)
        return
    with tempfile.TemporaryDirectory() as folder:
        # Siconos asks the system for this name, and gets the library that is already loaded under it.
        library = f"{folder}/siconos_plugin.so"
        words = ["gcc", "-O3", "-shared", "-fPIC", "-Wl,-soname,siconos_plugin.so", "-o", library, HERE / "siconos_plugin.c", "-lm"]
        subprocess.run(words, check=True)
        ctypes.CDLL(library)
        for step in map(float, steps):
            seconds, value = globals()[task](step)
            print(json.dumps({"step": step, "seconds": seconds, "value": value}), flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""A bouncing ball in MuJoCo, Exudyn and our command, and a rocking block in MuJoCo and our command: error against closed forms,
and time.

    benches/peers/contacts.py COMMAND      COMMAND is the command `lagrangian`; needs mujoco and exudyn (requirements.txt)
"""

import json
import math
import subprocess
import sys
import time
from pathlib import Path

import exudyn
import exudyn.utilities as items
import mujoco

ROOT = Path(__file__).resolve().parent.parent.parent
GRAVITY = 9.81


def ball(t, height=1.0, restitution=0.8):
    """The height of a ball at time t after a release from rest: its flights are parabolas."""
    begins, speed = math.sqrt(2 * height / GRAVITY), math.sqrt(2 * GRAVITY * height)
    if t < begins:
        return height - GRAVITY * t * t / 2
    while True:
        speed *= restitution
        if t < begins + 2 * speed / GRAVITY:
            return speed * (t - begins) - GRAVITY * (t - begins) ** 2 / 2
        begins += 2 * speed / GRAVITY


def mujoco_ball(step, stiffness, until):
    """MuJoCo's ball on a soft floor that only pushes: with the damping ratio sin φ its restitution is exp(−(π − 2 φ) tan φ)
    (T. Schwager, T. Pöschel, Granular Matter 9 (2007) 465–469), which must be 0.8."""
    low, high = 0.0, 1.5
    for _ in range(60):
        phi = (low + high) / 2
        low, high = (phi, high) if (math.pi - 2 * phi) * math.tan(phi) < -math.log(0.8) else (low, phi)
    damping = 2 * math.sin(phi) * math.sqrt(stiffness)
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco>
          <option timestep="{step}" gravity="0 0 {-GRAVITY}" integrator="RK4" tolerance="1e-12"/>
          <default><geom solref="{-stiffness} {-damping}" solimp="0.999 0.999 0.001"/></default>
          <worldbody>
            <geom type="plane" size="0 0 1"/>
            <body pos="0 0 1.02"><joint type="slide" axis="0 0 1"/><geom type="sphere" size="0.02" mass="0.1"/></body>
          </worldbody>
        </mujoco>"""
    )
    data = mujoco.MjData(model)
    while data.time < until - step / 2:
        mujoco.mj_step(model, data)
    return 1.0 + data.qpos[0]


def exudyn_ball(step, stiffness, until):
    """Exudyn's ball of 1 kg on a soft floor with a prescribed restitution of 0.8, by its model of Gonthier and others (2); its other
    model (1) is less accurate. Steps of generalized-α at which contact begins and ends are repeated."""
    machine = exudyn.SystemContainer().AddSystem()
    ball, fixed = machine.AddNode(items.Node1D()), machine.AddNode(items.NodePointGround())
    machine.AddObject(items.Mass1D(mass=1.0, nodeNumber=ball))
    of_ball, of_floor = (machine.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)) for node in (ball, fixed))
    machine.AddLoad(items.LoadCoordinate(markerNumber=of_ball, load=-GRAVITY))
    machine.AddObject(
        items.ObjectContactCoordinate(
            markerNumbers=[of_floor, of_ball],
            nodeNumber=machine.AddNode(items.NodeGenericData(initialCoordinates=[1.0, 0.0], numberOfDataCoordinates=2)),
            contactStiffness=stiffness,
            restitutionCoefficient=0.8,
            minimumImpactVelocity=1e-3,
            impactModel=2,
            offset=-1.0,
        )
    )
    machine.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = until
    settings.timeIntegration.numberOfSteps = round(until / step)
    settings.solution.file.write = False
    machine.SolveDynamic(settings)
    return 1.0 + float(machine.GetNodeOutput(ball, exudyn.OutputVariableType.Coordinates))


HALF_WIDTH, HALF_HEIGHT, TILT = 0.25, 1.0, 0.12248933156343208


def first_fall():
    """The exact time at which a rigid block with R = √(b² + h²) that rocks from rest first stands upright.

    θ̈ = −p² sin(α − θ) with p² = 3 g/(4 R) and tan α = b/h (G. W. Housner, 1963), from rest at TILT; by Simpson's rule over u, in
    which the time is smooth: θ = TILT (1 − u²).
    """
    radius = math.hypot(HALF_WIDTH, HALF_HEIGHT)
    alpha = math.atan2(HALF_WIDTH, HALF_HEIGHT)
    square = 3 * GRAVITY / (4 * radius)

    def integrand(u):
        # θ̇² = 2 p² (cos(α − TILT) − cos(α − θ)), without cancellation, over u².
        mean = alpha - TILT + TILT * u * u / 2
        half = TILT * u * u / 2
        share = math.sin(half) / half if half > 0 else 1.0
        return 2 * TILT / math.sqrt(4 * square * math.sin(mean) * share * TILT / 2)

    count = 1000
    inner = sum((4 if k % 2 else 2) * integrand(k / count) for k in range(1, count))
    return (integrand(0.0) + inner + integrand(1.0)) / (3 * count)


def mujoco_block(step, stiffness):
    damping = 2 * math.sqrt(stiffness)
    height = HALF_WIDTH * math.sin(TILT) + HALF_HEIGHT * math.cos(TILT)
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco>
          <option timestep="{step}" gravity="0 0 {-GRAVITY}" integrator="implicitfast" tolerance="1e-12" cone="elliptic" impratio="100"/>
          <default><geom solref="{-stiffness} {-damping}" solimp="0.999 0.999 0.001" friction="2 0.005 0.0001"/></default>
          <worldbody>
            <geom type="plane" size="0 0 1"/>
            <body pos="0 0 {height!r}" euler="0 {-math.degrees(TILT)!r} 0">
              <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>
              <geom type="box" size="{HALF_WIDTH} 0.1 {HALF_HEIGHT}" mass="100"/></body>
          </worldbody>
        </mujoco>"""
    )
    data = mujoco.MjData(model)
    # A slab in space has the same inertia about this axis as one in the plane.
    angle = -TILT
    while data.time < 5:
        before, angle = angle, -TILT + data.qpos[2]
        if before < 0 <= angle:
            return data.time - step * angle / (angle - before)
        mujoco.mj_step(model, data)
    return math.nan


def here(command, *words):
    clock = time.perf_counter()
    output = subprocess.run([command, "simulate", *words, "--json"], capture_output=True, check=True, text=True)
    return json.loads(output.stdout), time.perf_counter() - clock


def main():
    command = sys.argv[1]
    print("| task | | error | time [ms] |")
    print("| --- | --- | --: | --: |")
    until = 2.3
    truth = ball(until)
    for name, of_peer, settings in [
        (f"MuJoCo {mujoco.__version__}", mujoco_ball, [(1e-3, 1e5), (1e-4, 1e6)]),
        (f"Exudyn {exudyn.__version__}", exudyn_ball, [(1e-3, 1e5), (1e-4, 1e7)]),
    ]:
        for step, stiffness in settings:
            clock = time.perf_counter()
            error = abs(of_peer(step, stiffness, until) - truth)
            spent = 1e3 * (time.perf_counter() - clock)
            print(f"| ball, height after {until} s | {name}, {step:g} s, {stiffness:g} /s² | {error:.1e} m | {spent:.1f} |")
    for tolerance in ["1e-6", "1e-12"]:
        words = ["machines/contacts/bouncing_ball.machine", "--until", str(until), "--tolerance", tolerance]
        run, spent = here(command, *[str(ROOT / words[0]), *words[1:]])
        error = abs(run["q"]["y"] - truth)
        print(f"| | here, tolerance {tolerance}, with reading and deriving | {error:.1e} m | {1e3 * spent:.1f}; run {1e3 * run['seconds']:.2f} |")
    truth = first_fall()
    for step, stiffness in [(1e-3, 1e5), (1e-4, 1e7)]:
        clock = time.perf_counter()
        error = abs(mujoco_block(step, stiffness) - truth)
        spent = 1e3 * (time.perf_counter() - clock)
        print(f"| block, first fall | MuJoCo, {step:g} s, {stiffness:g} /s² | {error:.1e} s | {spent:.1f} |")
    for tolerance in ["1e-6", "1e-12"]:
        spec = str(ROOT / "machines/contacts/rocking_block.machine")
        run, spent = here(command, spec, "--until", "1.5", "--tolerance", tolerance)
        first = next(event["t"] for event in run["contact_events"] if event["kind"] == "impact")
        print(f"| | here, tolerance {tolerance}, with reading and deriving | {abs(first - truth):.1e} s | {1e3 * spent:.1f}; run {1e3 * run['seconds']:.2f} |")


if __name__ == "__main__":
    main()

"""MuJoCo: soft contacts. Settings are a step in s and a stiffness in 1/s²."""

import math
import time

import mujoco
import numpy as np

from collisions import truths
from collisions.heap import BOWL, RADIUS, SIDES
from collisions.truths import GRAVITY, HALF_HEIGHT, HALF_WIDTH, TILT

NAME = f"MuJoCo {mujoco.__version__}"
SETTINGS = {
    "ball": [(1e-3, 1e5), (2.5e-4, 1e6), (1e-4, 1e6), (2.5e-5, 1e8)],
    "block": [(1e-3, 1e5), (1e-4, 1e7), (1e-5, 1e9)],
    "slider": [(1e-5, 1e8), (1e-6, 1e10), (1e-7, 1e12)],
    "pile": [(2e-3, 1e5), (5e-4, 1e6), (1e-4, 1e7)],
}


def said(setting):
    return f"{setting[0]:g} s, {setting[1]:g} /s²"


def damping_for(restitution, stiffness):
    """With the damping ratio sin φ a spring that only pushes returns exp(−(π − 2 φ) tan φ) of the speed (T. Schwager, T. Pöschel,
    Granular Matter 9 (2007) 465–469)."""
    low, high = 0.0, 1.5
    for _ in range(60):
        phi = (low + high) / 2
        low, high = (phi, high) if (math.pi - 2 * phi) * math.tan(phi) < -math.log(restitution) else (low, phi)
    return 2 * math.sin(phi) * math.sqrt(stiffness)


def model_of(step, solref, integrator, options, world, friction=1.0):
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><compiler angle="radian" autolimits="true"/>
          <option timestep="{step!r}" {options} integrator="{integrator}" tolerance="1e-12"/>
          <default><geom solref="{-solref[0]!r} {-solref[1]!r}" solimp="0.9999 0.9999 0.001" friction="{friction} 0 0"/></default>
          <worldbody>{world}</worldbody></mujoco>"""
    )


def stepped(model, data, until):
    clock = time.process_time()
    mujoco.mj_step(model, data, nstep=round(until / model.opt.timestep))
    return time.process_time() - clock


def ball(setting, until):
    step, stiffness = setting
    world = """<geom type="plane" size="0 0 1"/>
      <body pos="0 0 1.02"><joint type="slide" axis="0 0 1"/><geom type="sphere" size="0.02" mass="0.1"/></body>"""
    solref = stiffness, damping_for(0.8, stiffness)
    model = model_of(step, solref, "RK4", f'gravity="0 0 {-GRAVITY}"', world)
    data = mujoco.MjData(model)
    seconds = stepped(model, data, until)
    return seconds, [1.0 + data.qpos[0]]


def block(setting):
    step, stiffness = setting
    height = HALF_WIDTH * math.sin(TILT) + HALF_HEIGHT * math.cos(TILT)
    # A slab in space has the same inertia about this axis as one in the plane.
    world = f"""<geom type="plane" size="0 0 1"/>
      <body pos="0 0 {height!r}" euler="0 {-TILT!r} 0">
        <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 1 0"/>
        <geom type="box" size="{HALF_WIDTH} 0.1 {HALF_HEIGHT}" mass="100"/></body>"""
    options = f'gravity="0 0 {-GRAVITY}" cone="elliptic" impratio="100"'
    model = model_of(step, (stiffness, 2 * math.sqrt(stiffness)), "implicitfast", options, world, friction=2)
    data, angle = mujoco.MjData(model), -TILT
    clock = time.process_time()
    while data.time < 2:
        before, angle = angle, -TILT + data.qpos[2]
        if before < 0 <= angle:
            return time.process_time() - clock, [data.time - step * angle / (angle - before)]
        mujoco.mj_step(model, data)
    return time.process_time() - clock, [math.nan]


def slider(setting):
    step, stiffness = setting
    l1, l2, a, b = truths.CRANK, truths.ROD, truths.HALF_LENGTH, truths.HALF_SIDE
    (m1, m2, m3), (J1, J2, J3) = truths.MASSES, truths.INERTIAS
    body = lambda at, centre, m, J, inner: (
        f'<body pos="{at!r} 0 0"><joint type="hinge" axis="0 0 1"/>'
        f'<inertial pos="{centre!r} 0 0" mass="{m!r}" diaginertia="{J!r} {J!r} {J!r}"/>{inner}</body>'
    )
    # The bar is thin, so that its corners lie in the plane of motion.
    bar = f'<geom type="box" size="{a!r} {b!r} 1e-3" mass="0"/>'
    gap = b + truths.PLAY
    planes = (
        f'<geom type="plane" size="0 0 1" pos="0 {-gap!r} 0" xyaxes="0 0 1 1 0 0"/>'
        f'<geom type="plane" size="0 0 1" pos="0 {gap!r} 0" xyaxes="1 0 0 0 0 1"/>'
    )
    world = planes + body(0.0, l1 / 2, m1, J1, body(l1, l2 / 2, m2, J2, body(l2, 0.0, m3, J3, bar)))
    solref = stiffness, damping_for(truths.RESTITUTION, stiffness)
    options = f'gravity="0 {-GRAVITY} 0" cone="elliptic" impratio="10"'
    model = model_of(step, solref, "RK4", options, world, friction=truths.FRICTION)
    data = mujoco.MjData(model)
    u, v = truths.RATES
    data.qvel[:] = u, v - u, -v
    seconds = stepped(model, data, truths.SLIDER_END)
    return seconds, [data.qpos[0], data.qpos[0] + data.qpos[1]]


def pile(setting, count, until):
    """Spheres in a plane; the bowl is a polygon about its circle."""
    step, stiffness = setting
    mass, radius, apart, bowl = 0.05, RADIUS, 0.07, BOWL
    world = []
    for k in range(SIDES):
        angle = math.pi * (1 + (k + 0.5) / SIDES)
        x, z = math.cos(angle), math.sin(angle)
        # Boxes are sorted by place, planes are not; the face of each is a side of the polygon.
        world.append(
            f'<geom type="box" size="0.01 0.2 0.05" pos="{(bowl + 0.05) * x!r} 0 {(bowl + 0.05) * z!r}" zaxis="{x!r} 0 {z!r}"/>'
        )
    inertia = mass * radius**2 / 2
    for i in range(1, count + 1):
        x, z = (apart * math.sqrt(i) * of(2.4 * i) for of in (math.cos, math.sin))
        world.append(
            f'<body pos="{x!r} 0 {z!r}"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
            f'<joint type="hinge" axis="0 -1 0"/><inertial pos="0 0 0" mass="{mass!r}" diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>'
            f'<geom type="sphere" size="{radius!r}"/></body>'
        )
    options = f'gravity="0 0 {-GRAVITY}" cone="elliptic" impratio="10"'
    model = model_of(step, (stiffness, 2 * math.sqrt(stiffness)), "implicitfast", options, "".join(world), friction=0.3)
    data = mujoco.MjData(model)
    seconds = stepped(model, data, until)
    depth = max([0.0, *(-contact.dist for contact in data.contact)])
    return seconds, [depth, float(np.abs(data.qvel.reshape(-1, 3)[:, :2]).max())]

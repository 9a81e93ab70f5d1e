"""MuJoCo: its engine with steps of fixed length, RK4; loops are closed by its constraints, which are soft."""

import time

import mujoco
import numpy as np

from runs.bodies import machine

# MuJoCo demands inertia of every body; this part of an inertia of 1 changes an angle by less than the errors that RK4 reaches.
LEAST = 1e-12
AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}


def words(numbers):
    return " ".join(repr(float(x)) for x in numbers)


def nested(of, parent):
    """The text of the bodies that hang on a body."""
    out = []
    for i, body in enumerate(of.bodies):
        if body.parent == parent:
            inertia = [max(x, LEAST) for x in body.inertia[:3]] + list(body.inertia[3:])
            out.append(
                f'<body name="b{i}" pos="{words(body.at)}"><joint name="j{body.coordinate}" type="hinge" axis="{AXES[body.axis]}" '
                f'damping="{body.damping}"/><inertial pos="{words(body.centre)}" mass="{body.mass!r}" fullinertia="{words(inertia)}"/>'
                + "".join(f'<site name="{name}" pos="{words(at)}"/>' for name, at in sites(of, i))
                + nested(of, i)
                + "</body>"
            )
    return "".join(out)


def sites(of, body):
    """The points of a body where loops are closed and the spring is fastened."""
    for i, (one, at, other, point) in enumerate(of.loops):
        if body == one:
            yield f"one{i}", at
        if body == other:
            yield f"other{i}", point
    if of.spring and body == of.spring.body:
        yield "pulled", of.spring.at
    if of.spring and body == -1:
        yield "fast", of.spring.ground


def text_of(of, step):
    constraints = "" if of.loops else 'constraint="disable"'
    ties = "".join(
        f'<connect site1="one{i}" site2="other{i}" solref="{2 * step!r} 1" solimp="0.9999 0.9999 0.001 0.5 2"/>'
        for i in range(len(of.loops))
    )
    # The spring pulls along the line of a tendon.
    spring = of.spring and (
        f'<tendon><spatial springlength="{of.spring.length}" stiffness="{of.spring.stiffness}"><site site="pulled"/><site site="fast"/></spatial></tendon>'
    )
    ground = "".join(f'<site name="{name}" pos="{words(at)}"/>' for name, at in sites(of, -1))
    return (
        f'<mujoco><compiler angle="radian" autolimits="true"/><option gravity="{words(of.gravity)}" integrator="RK4" timestep="{step!r}" '
        f'tolerance="1e-12"><flag contact="disable" {constraints}/></option>'
        f"<worldbody>{ground}{nested(of, -1)}</worldbody><equality>{ties}</equality>{spring or ''}</mujoco>"
    )


class Peer:
    def __init__(self, run):
        self.run, self.machine, self.made = run, machine(run.name), {}
        self.tools = ("MuJoCo, RK4",) if self.machine else ()

    def settings(self, _tool):
        return [self.run.until / 2**k for k in range(8, 18)]

    def call(self, _tool, step):
        of = self.machine
        if step not in self.made:
            model = mujoco.MjModel.from_xml_string(text_of(of, step))
            places = [model.joint(f"j{i}").qposadr[0] for i in range(model.nv)]
            self.made[step] = model, places
        model, places = self.made[step]
        data = mujoco.MjData(model)
        n = model.nv
        data.qpos[places], data.qvel[places] = of.joints(self.run.start[:n]), of.joints(self.run.start[n:])
        if of.torque:
            data.qfrc_applied[places[of.torque[0]]] = of.torque[1]
        clock = time.process_time()
        mujoco.mj_step(model, data, nstep=round(self.run.until / step))
        seconds = time.process_time() - clock
        return seconds, np.concatenate([of.coordinates(data.qpos[places]), of.coordinates(data.qvel[places])])

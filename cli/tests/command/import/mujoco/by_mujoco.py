"""Accelerations of the models of this folder, by MuJoCo.

    pip install mujoco
    python by_mujoco.py > mujoco.json

ant, half_cheetah, hopper, humanoid and walker2d are those of Gymnasium 1.2.0 (`gymnasium/envs/mujoco/assets`, the MIT licence, which
stands beside them); the others are our own. MuJoCo's qacc is taken with contacts, limits and equations switched off, as
`mj_forward` finds it. Free and ball joints have quaternions there and three angles here: qvel = J v, so that qacc = J a + (dJ/dt) v,
which is solved for a. Equations between joints are put in by multipliers, M a + h = f + G^T l with G a = g, with M, h and f of MuJoCo.
"""

import json
import pathlib
import random

import mujoco
import numpy
from numpy import cross

AXES = {"x": numpy.array([1.0, 0, 0]), "y": numpy.array([0, 1.0, 0]), "z": numpy.array([0, 0, 1.0])}


def turn(axis, angle):
    k = numpy.cross(numpy.eye(3), AXES[axis])
    k = -k if not numpy.allclose(cross(AXES[axis], [0.3, 0.5, 0.7]), k @ [0.3, 0.5, 0.7]) else k
    return numpy.eye(3) + numpy.sin(angle) * k + (1 - numpy.cos(angle)) * k @ k


def quaternion(sequence, angles):
    product = numpy.array([1.0, 0, 0, 0])
    for axis, angle in zip(sequence, angles):
        one = numpy.concatenate([[numpy.cos(angle / 2)], numpy.sin(angle / 2) * AXES[axis]])
        result = numpy.zeros(4)
        mujoco.mju_mulQuat(result, product, one)
        product = result
    return product


def spin(sequence, angles, rates):
    """The matrix from the rates of three angles to the angular velocity in the body's axes, and its rate."""
    second, third = turn(sequence[1], angles[1]), turn(sequence[2], angles[2])
    u = [third.T @ second.T @ AXES[sequence[0]], third.T @ AXES[sequence[1]], AXES[sequence[2]]]
    # What is fixed to an outer frame turns back against the body.
    du = [-cross(rates[1] * u[1] + rates[2] * u[2], u[0]), -cross(rates[2] * u[2], u[1]), numpy.zeros(3)]
    return numpy.array(u).T, numpy.array(du).T


def states(path, count):
    model = mujoco.MjModel.from_xml_path(str(path))
    flags = mujoco.mjtDisableBit
    model.opt.disableflags |= flags.mjDSBL_CONSTRAINT | flags.mjDSBL_CONTACT | flags.mjDSBL_CLAMPCTRL
    data = mujoco.MjData(model)
    draw = random.Random(f"{path.stem} 2026")
    number = lambda size: round(draw.uniform(-size, size), 3)
    for _ in range(count):
        q, v, parts = [], [], []
        for joint in range(model.njnt):
            kind = model.jnt_type[joint]
            several = {int(mujoco.mjtJoint.mjJNT_FREE): 6, int(mujoco.mjtJoint.mjJNT_BALL): 3}.get(int(kind), 1)
            parts.append((kind, len(q), int(several)))
            q += [number(1.2) for _ in range(several)]
            v += [number(1.5) for _ in range(several)]
        for equation in range(model.neq):
            assert model.eq_type[equation] == mujoco.mjtEq.mjEQ_JOINT
            first, second = model.eq_obj1id[equation], model.eq_obj2id[equation]
            polynomial = numpy.polynomial.Polynomial(model.eq_data[equation][:5])
            led = q[parts[second][1]] - model.qpos0[model.jnt_qposadr[second]] if second >= 0 else 0.0
            q[parts[first][1]] = float(model.qpos0[model.jnt_qposadr[first]] + polynomial(led))
            v[parts[first][1]] = float(polynomial.deriv()(led) * v[parts[second][1]]) if second >= 0 else 0.0
        jacobian, rest = numpy.zeros((model.nv, len(q))), numpy.zeros(model.nv)
        for joint, (kind, at, several) in enumerate(parts):
            place, row = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
            if several == 1:
                data.qpos[place] = q[at]
                jacobian[row, at] = 1.0  # a hinge or a slide
                continue
            if several == 6:
                data.qpos[place:place + 3] = q[at:at + 3]
                jacobian[row:row + 3, at:at + 3] = numpy.eye(3)
                place, row, at = place + 3, row + 3, at + 3
            sequence = "zyx" if several == 6 else "xyz"
            data.qpos[place:place + 4] = quaternion(sequence, q[at:at + 3])
            matrix, rate = spin(sequence, q[at:at + 3], v[at:at + 3])
            jacobian[row:row + 3, at:at + 3] = matrix
            rest[row:row + 3] = rate @ v[at:at + 3]
        data.qvel[:] = jacobian @ v
        inputs = [number(0.8) for _ in range(model.nu)]
        data.ctrl[:] = inputs
        mujoco.mj_forward(model, data)
        if model.neq == 0:
            a = numpy.linalg.solve(jacobian, data.qacc - rest)
        else:
            mass = numpy.zeros((model.nv, model.nv))
            mujoco.mj_fullM(model, data, mass) if mujoco.__version__ >= "4" else mujoco.mj_fullM(model, mass, data.qM)
            force = data.qfrc_passive + data.qfrc_actuator - data.qfrc_bias - mass @ rest
            mass, force = jacobian.T @ mass @ jacobian, jacobian.T @ force
            rows, drift = numpy.zeros((model.neq, len(q))), numpy.zeros(model.neq)
            for equation in range(model.neq):
                first, second = model.eq_obj1id[equation], model.eq_obj2id[equation]
                polynomial = numpy.polynomial.Polynomial(model.eq_data[equation][:5])
                rows[equation, parts[first][1]] = 1.0
                if second >= 0:
                    led = q[parts[second][1]] - model.qpos0[model.jnt_qposadr[second]]
                    rows[equation, parts[second][1]] = -polynomial.deriv()(led)
                    drift[equation] = polynomial.deriv(2)(led) * v[parts[second][1]] ** 2
            whole = numpy.block([[mass, rows.T], [rows, numpy.zeros((model.neq, model.neq))]])
            a = numpy.linalg.solve(whole, numpy.concatenate([force, drift]))[:len(q)]
        yield {"q": q, "v": v, "inputs": inputs, "accelerations": a.tolist()}


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    parts = []
    for path in sorted(here.glob("*.xml")):
        lines = ",\n".join(json.dumps(state) for state in states(path, 3))
        parts.append(f'"{path.stem}": [\n{lines}\n]')
    print("{" + ",\n".join(parts) + "}")

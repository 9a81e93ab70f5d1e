"""Accelerations of the models of this folder, whose bodies are held together by `connect` and `weld`, by MuJoCo.

    pip install mujoco
    python by_mujoco.py > loops.json

MuJoCo's equalities are soft. So its mass matrix M, forces f and the gradients J of its residuals are taken, and the equations with
multipliers are solved, M a = f + J^T l with J a = -dJ/dt v, at states that Newton's method brings onto the equalities. dJ/dt v is a
difference over milliseconds of motion with the rates v, extrapolated: its error is some 4 h^4 = 4e-12 of fifth derivatives.
"""

import json
import pathlib
import random

import mujoco
import numpy


def rows(model, data, q):
    """Residuals of the equalities, and their gradients."""
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    count = int((data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY).sum())
    jacobian = numpy.array(data.efc_J).reshape(-1, model.nv)[:count]
    return numpy.array(data.efc_pos[:count]), jacobian


def states(path, count):
    model = mujoco.MjModel.from_xml_path(str(path))
    flags = mujoco.mjtDisableBit
    model.opt.disableflags |= flags.mjDSBL_CONTACT | flags.mjDSBL_CLAMPCTRL
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    data = mujoco.MjData(model)
    draw = random.Random(f"{path.stem} 2026")
    found = 0
    while found < count:
        q = model.qpos0 + [draw.uniform(-0.4, 0.4) for _ in range(model.nq)]
        for _ in range(200):
            residual, jacobian = rows(model, data, q)
            q = q - numpy.linalg.lstsq(jacobian, residual, rcond=None)[0]
        residual, jacobian = rows(model, data, q)
        if abs(residual).max() > 1e-14:
            continue
        found += 1
        v = numpy.array([draw.uniform(-1.0, 1.0) for _ in range(model.nv)])
        v = v - numpy.linalg.lstsq(jacobian, jacobian @ v, rcond=None)[0]
        slope = lambda h: (rows(model, data, q + h * v)[1] - rows(model, data, q - h * v)[1]) / (2 * h)
        drift = ((4 * slope(1e-3) - slope(2e-3)) / 3) @ v
        inputs = [draw.uniform(-1.0, 1.0) for _ in range(model.nu)]
        data.qpos[:], data.qvel[:], data.ctrl[:] = q, v, inputs
        mujoco.mj_forward(model, data)
        mass = numpy.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass) if mujoco.__version__ >= "4" else mujoco.mj_fullM(model, mass, data.qM)
        force = data.qfrc_passive + data.qfrc_actuator - data.qfrc_bias
        size = len(jacobian)
        whole = numpy.block([[mass, jacobian.T], [jacobian, numpy.zeros((size, size))]])
        a = numpy.linalg.solve(whole, numpy.concatenate([force, -drift]))[:model.nv]
        yield {"q": q.tolist(), "v": v.tolist(), "inputs": inputs, "accelerations": a.tolist()}


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    parts = []
    for path in sorted(here.glob("*.xml")):
        lines = ",\n".join(json.dumps(state) for state in states(path, 3))
        parts.append(f'"{path.stem}": [\n{lines}\n]')
    print("{" + ",\n".join(parts) + "}")

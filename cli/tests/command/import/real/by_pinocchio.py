"""Accelerations of the robots of this folder at random states, by Pinocchio.

    pip install pin==4.1.0
    python by_pinocchio.py > pinocchio.json

Pinocchio reads the files as they stand. Its joint for a floating base is put together of three prismatic and three revolute ones
(along x, y, z; about z, y, x), so that it has the coordinates that a spec has; what mimics is projected, q = J r + c, and
Jᵀ M J r" = Jᵀ (forces - M c" - bias). The mass matrix is that of the composite rigid body algorithm, the forces are those of recursive
Newton-Euler. A robot in which nothing mimics is solved again by the articulated body algorithm, which forms no mass matrix: the two
differ by roundings only, and the largest difference and the largest condition number go to the standard error stream. The condition is
that of the mass matrix with its rows and columns scaled to a diagonal of ones, since a change of units costs no digits.
"""

import json
import pathlib
import random
import sys
import xml.etree.ElementTree as xml

import numpy
import pinocchio

# The link that floats, if any.
ROBOTS = {
    "panda": None,
    "baxter": None,
    "two_dofs": None,
    "borinot": "borinot__base_link",
    "hextilt": "hextilt__base_link",
    "alexander": "PELVIS_LINK",
    "simple_humanoid": "base_link",
}
BASE = ["x", "y", "z", "yaw", "pitch", "roll"]
STATES = 20


def floating_base():
    base = pinocchio.JointModelComposite()
    for joint in "PX PY PZ RZ RY RX".split():
        base.addJoint(getattr(pinocchio, f"JointModel{joint}")())
    return base


def mimicry(path):
    """Which joint each joint that mimics follows, by which factor and offset."""
    found = {}
    for joint in xml.parse(path).getroot().findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            found[joint.get("name")] = (mimic.get("joint"), float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))
    return found


def states(name, base):
    """The coordinates in their order, and what belongs to each state."""
    path = str(pathlib.Path(__file__).with_name(f"{name}.urdf"))
    model = pinocchio.buildModelFromUrdf(path, floating_base()) if base else pinocchio.buildModelFromUrdf(path)
    assert model.nq == model.nv, "a continuous joint has two numbers"
    data = model.createData()
    followed = mimicry(path)
    joints = [joint for joint in model.names[1:] if joint != "root_joint"]
    coordinates = [f"{base}_{part}" for part in BASE] if base else []
    coordinates += [joint for joint in joints if joint not in followed]
    projection, constant = numpy.zeros((model.nv, len(coordinates))), numpy.zeros(model.nv)
    if base:
        assert model.joints[1].idx_v == 0 and model.joints[1].nv == 6
        projection[:6, :6] = numpy.eye(6)
    for joint in joints:
        at, factor, offset = joint, 1.0, 0.0
        while at in followed:
            at, by, further = followed[at]
            offset += factor * further
            factor *= by
        row = model.joints[model.getJointId(joint)].idx_v
        projection[row, coordinates.index(at)] = factor
        constant[row] = offset
    draw = random.Random(f"{name} 2026")
    condition = difference = 0.0
    found = []
    for _ in range(STATES):
        r, rate = [numpy.array([round(draw.uniform(-1.3, 1.3), 3) for _ in coordinates]) for _ in range(2)]
        q, v = projection @ r + constant, projection @ rate
        upper = numpy.triu(pinocchio.crba(model, data, q))
        mass = projection.T @ (upper + numpy.triu(upper, 1).T) @ projection
        damping = -numpy.array(model.damping) * v
        forces = damping - pinocchio.nonLinearEffects(model, data, q, v)
        accelerations = numpy.linalg.solve(mass, projection.T @ forces)
        scale = 1 / numpy.sqrt(numpy.diag(mass))
        condition = max(condition, numpy.linalg.cond(scale[:, None] * mass * scale))
        if not followed:
            again = pinocchio.aba(model, data, q, v, damping)
            difference = max(difference, numpy.abs(again - accelerations).max() / numpy.abs(again).max())
        found.append({"q": r.tolist(), "v": rate.tolist(), "accelerations": accelerations.tolist()})
    print(f"{name}: condition {condition:.1e}, difference {difference:.1e}", file=sys.stderr)
    return coordinates, found


if __name__ == "__main__":
    parts = []
    for name, base in ROBOTS.items():
        coordinates, found = states(name, base)
        lines = ",\n".join(json.dumps(state) for state in found)
        parts.append(f'"{name}": {{"coordinates": {json.dumps(coordinates)}, "states": [\n{lines}\n]}}')
    print("{" + ",\n".join(parts) + "}")

"""Mass matrices, bias forces, applied forces and accelerations of the robots of this folder, by Pinocchio.

    pip install pin
    python by_pinocchio.py > pinocchio.json

Floating and planar joints are written out as chains of prismatic and revolute ones between links without mass, so that Pinocchio
has the coordinates that a spec has; what mimics is projected, M = Jᵀ M J with q = J r + c. Pinocchio reads everything else as it
stands in the files. Its mass matrix is that of the composite rigid body algorithm, its forces those of recursive Newton-Euler.
"""

import json
import pathlib
import random
import xml.etree.ElementTree as xml

import numpy
import pinocchio

# The coordinates in their order, under the names that they have in specs.
COORDINATES = {
    "arm": ["shoulder", "elbow", "wrist-turn", "hand-turn"],
    "leg": ["hip pitch", "knee", "ankle pitch", "ankle roll"],
    "hand": ["curl", "thumb turn"],
    "slider": ["x", "t", "g"],
    "floating": ["free_x", "free_y", "free_z", "free_yaw", "free_pitch", "free_roll", "hip"],
    "planar": ["glide_x", "glide_y", "glide_angle", "tilt", "flutter_x", "flutter_z", "flutter_angle"],
    "quadruped": ["free_x", "free_y", "free_z", "free_yaw", "free_pitch", "free_roll"]
    + [f"{leg} {joint}" for leg in ["front left", "front right", "hind left", "hind right"] for joint in ["roll", "pitch", "knee"]],
}

# The chains: prismatic (p) and revolute (r) joints along axes.
CHAINS = {
    "free": [("x", "p", "1 0 0"), ("y", "p", "0 1 0"), ("z", "p", "0 0 1"), ("yaw", "r", "0 0 1"), ("pitch", "r", "0 1 0"),
             ("roll", "r", "1 0 0")],
    "glide": [("x", "p", "1 0 0"), ("y", "p", "0 1 0"), ("angle", "r", "0 0 -1")],
    "flutter": [("x", "p", "1 0 0"), ("z", "p", "0 0 1"), ("angle", "r", "0 1 0")],
}


def read(path):
    """The model; what each joint that mimics follows, by factor and offset; and the damping of each joint."""
    robot = xml.parse(path).getroot()
    followed, damping = {}, {}
    for joint in list(robot.findall("joint")):
        name = joint.get("name")
        if joint.get("type") == "continuous":
            joint.set("type", "revolute")
        if joint.get("type") == "revolute" and joint.find("limit") is None:
            xml.SubElement(joint, "limit", lower="-9", upper="9", effort="1", velocity="1")
        mimic = joint.find("mimic")
        if mimic is not None:
            followed[name] = (mimic.get("joint"), float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))
            joint.remove(mimic)
        dynamics = joint.find("dynamics")
        damping[name] = 0.0 if dynamics is None else float(dynamics.get("damping", 0))
        if name in CHAINS:
            robot.remove(joint)
            above = joint.find("parent").get("link")
            for number, (suffix, kind, axis) in enumerate(CHAINS[name]):
                is_last = number + 1 == len(CHAINS[name])
                below = joint.find("child").get("link") if is_last else f"{name} {number}"
                if not is_last:
                    xml.SubElement(robot, "link", name=below)
                part = xml.SubElement(robot, "joint", name=f"{name}_{suffix}",
                                      type="prismatic" if kind == "p" else "revolute")
                xml.SubElement(part, "parent", link=above)
                xml.SubElement(part, "child", link=below)
                xml.SubElement(part, "axis", xyz=axis)
                xml.SubElement(part, "limit", lower="-9", upper="9", effort="1", velocity="1")
                if number == 0 and joint.find("origin") is not None:
                    part.append(joint.find("origin"))
                above = below
    return pinocchio.buildModelFromXML(xml.tostring(robot, encoding="unicode")), followed, damping


def states(name, count):
    path = pathlib.Path(__file__).with_name(f"{name}.urdf")
    model, followed, damping = read(path)
    assert model.nq == model.nv, model
    data = model.createData()
    coordinates = COORDINATES[name]
    # q = projection r + constant
    projection, constant = numpy.zeros((model.nv, len(coordinates))), numpy.zeros(model.nv)
    dampers = numpy.zeros((model.nv, model.nv))
    for joint in model.names[1:]:
        row = model.joints[model.getJointId(joint)].idx_v
        at, factor, offset = joint, 1.0, 0.0
        while at in followed:
            at, by, further = followed[at]
            offset += factor * further
            factor *= by
        projection[row, coordinates.index(at)] = factor
        constant[row] = offset
        dampers[row, row] = damping.get(joint, 0.0)
    draw = random.Random(f"{name} 2026")
    for _ in range(count):
        r, rate = [numpy.array([round(draw.uniform(-1.3, 1.3), 3) for _ in coordinates]) for _ in range(2)]
        q, v = projection @ r + constant, projection @ rate
        mass = pinocchio.crba(model, data, q)
        mass = numpy.triu(mass) + numpy.triu(mass, 1).T
        weight = pinocchio.computeGeneralizedGravity(model, data, q)
        gravity, model.gravity = model.gravity.copy(), pinocchio.Motion.Zero()
        bias = pinocchio.rnea(model, data, q, v, numpy.zeros(model.nv))
        model.gravity = gravity
        mass = projection.T @ mass @ projection
        bias = projection.T @ bias
        applied = projection.T @ (-weight - dampers @ v)
        yield {
            "q": r.tolist(),
            "v": rate.tolist(),
            "mass_matrix": mass.tolist(),
            "bias": bias.tolist(),
            "applied": applied.tolist(),
            "accelerations": numpy.linalg.solve(mass, applied - bias).tolist(),
        }


if __name__ == "__main__":
    robots = {name: list(states(name, 4)) for name in COORDINATES}
    parts = []
    for name, list_of_states in robots.items():
        lines = ",\n".join(json.dumps(state) for state in list_of_states)
        parts.append(f'"{name}": [\n{lines}\n]')
    print("{" + ",\n".join(parts) + "}")

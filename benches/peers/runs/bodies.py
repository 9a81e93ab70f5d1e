"""Machines as bodies on hinges, for engines that are given bodies: bodies in the order of a walk outwards, loops, and what acts on them."""

from typing import NamedTuple

import numpy as np

import tasks
from runs.problem import ROOT  # noqa: F401, it makes the references importable
from equations import ANDREWS

GRAVITY = 9.81


class Body(NamedTuple):
    """A body on a hinge; lengths in m, in the axes of the body before (`at`) or its own."""

    coordinate: int
    parent: int  # its place in the list, or -1 for the ground
    axis: str
    at: tuple
    mass: float
    centre: tuple
    inertia: tuple  # xx, yy, zz, xy, xz, yz about the centre, kg m²
    damping: float = 0.0


class Spring(NamedTuple):
    body: int
    at: tuple
    ground: tuple
    stiffness: float
    length: float


class Machine(NamedTuple):
    bodies: list
    gravity: tuple
    absolute: bool = False  # whether coordinates are angles against the ground
    loops: tuple = ()  # body, point, body or -1, point: these coincide
    spring: Spring | None = None
    torque: tuple | None = None  # coordinate, N m

    def joints(self, y):
        """The angles between bodies, or their rates, from coordinates; in the order of coordinates."""
        y, found = np.asarray(y, float), np.empty(len(y))
        for body in self.bodies:
            before = self.bodies[body.parent].coordinate if body.parent >= 0 else None
            found[body.coordinate] = y[body.coordinate] - (y[before] if self.absolute and before is not None else 0.0)
        return found

    def coordinates(self, joints):
        """The reverse of `joints`."""
        found = np.empty(len(joints))
        for body in self.bodies:
            before = found[self.bodies[body.parent].coordinate] if self.absolute and body.parent >= 0 else 0.0
            found[body.coordinate] = joints[body.coordinate] + before
        return found


def flat(coordinate, parent, at, mass, inertia, centre):
    return Body(coordinate, parent, "z", (*at, 0.0), mass, (*centre, 0.0), (inertia, inertia, inertia, 0, 0, 0))


def hanging(count, length, mass, centre, inertia):
    at = lambda i: (0.0, -length if i else 0.0)
    bodies = [flat(i, i - 1, at(i), mass, inertia, (0.0, -centre)) for i in range(count)]
    return Machine(bodies, (0.0, -GRAVITY, 0.0), absolute=True)


def four_bar():
    bar = lambda i, parent, at, mass, length: flat(i, parent, at, mass, mass * length**2 / 12, (length / 2, 0.0))
    bodies = [bar(0, -1, (0, 0), 1.0, 0.3), bar(1, 0, (0.3, 0), 2.0, 0.8), bar(2, -1, (1.0, 0), 1.5, 0.6)]
    return Machine(bodies, (0.0, -GRAVITY, 0.0), absolute=True, loops=((1, (0.8, 0, 0), 2, (0.6, 0, 0)),))


def closed_pendulum():
    bodies = [flat(i, i - 1, (1.0 if i else 0.0, 0), 1.0, 1 / 12, (0.5, 0.0)) for i in range(5)]
    return Machine(bodies, (0.0, -GRAVITY, 0.0), absolute=True, loops=((4, (1.0, 0, 0), -1, (2.0, 0, 0)),))


def andrews():
    p = ANDREWS
    a, b, origin = (p["xa"], p["ya"]), (p["xb"], p["yb"]), (0.0, 0.0)
    bodies = [
        flat(0, -1, origin, 0.04325, 2.194e-6, (p["ra"], 0)),
        flat(1, 0, (p["rr"], 0), 0.00365, 4.410e-7, (-p["da"], 0)),
        flat(2, -1, b, 0.02373, 5.255e-6, (p["sb"], -p["sa"])),
        flat(4, -1, a, 0.07050, 1.169e-5, (p["ta"], p["tb"])),
        flat(3, 3, (p["zt"], 0), 0.00706, 5.667e-7, (0, p["ea"] - p["e"])),
        flat(6, -1, a, 0.05498, 1.912e-5, (-p["ub"], -p["ua"])),
        flat(5, 5, (0, -p["u"]), 0.00706, 5.667e-7, (p["zf"] - p["fa"], 0)),
    ]
    pin = (1, (-p["d"], 0, 0))
    loops = ((2, (0, -p["ss"], 0), *pin), (4, (0, -p["e"], 0), *pin), (6, (p["zf"], 0, 0), *pin))
    spring = Spring(2, (p["sd"], -p["sc"], 0), (p["xc"], p["yc"], 0), p["c0"], p["l0"])
    return Machine(bodies, (0.0, 0.0, 0.0), loops=loops, spring=spring, torque=(0, p["mom"]))


def arm():
    links = enumerate(tasks.ARM_LINKS)
    number = tasks.ARM
    bodies = [Body(i, i - 1, axis, at, number[mass], centre, of, number["friction"]) for i, (axis, at, mass, centre, of) in links]
    return Machine(bodies, (0.0, 0.0, -GRAVITY))


def machine(name):
    """The machine of a run of work_precision.py, or None if this file doesn't describe it."""
    of = {
        "double_pendulum_regular": lambda: hanging(2, 1.0, 1.0, 1.0, 0.0),
        "double_pendulum_chaotic": lambda: hanging(2, 1.0, 1.0, 1.0, 0.0),
        "chain_8": lambda: hanging(8, 0.2, 0.5, 0.1, 0.5 * 0.04 / 12),
        "chain_16": lambda: hanging(16, 0.2, 0.5, 0.1, 0.5 * 0.04 / 12),
        "six_joint_arm": arm,
        "four_bar": four_bar,
        "closed_pendulum": closed_pendulum,
        "andrews_squeezer": andrews,
    }.get(name)
    return of() if of else None

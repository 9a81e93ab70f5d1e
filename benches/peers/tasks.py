"""The tasks: parameters, random states, and the results that every peer must compute. See README.md."""

import math
import struct

# T1, in the order of the run-time parameter vector.
CRUSHER = {
    "m": 450.0, "J": 60.0, "m0": 25.0, "e": 0.04, "x0": 0.10, "y0": -0.25, "w": 100.0,
    "m1": 120.0, "J1": 2.4, "m2": 60.0, "J2": 0.5,
    "cx": 2e5, "cy": 1.6e5, "xc": 0.35, "yc": -0.05, "bx": 400.0, "by": 350.0, "xb": 0.35, "yb": 0.04,
    "k1": 5e4, "d1": 60.0, "r1": 0.15, "k2": 2e4, "d2": 30.0, "r2": 0.10,
}

# The arm of machines/six_joint_arm.machine.
ARM = {
    "h": 0.35, "a": 0.40, "b": 0.42, "c": 0.10,
    "m1": 12.0, "m2": 9.0, "m3": 6.0, "m4": 1.5, "m5": 1.0, "m6": 5.2, "friction": 0.4, "g": 9.81,
}
# For each link: axis of its joint, shift of its frame in the previous frame, mass, mass centre in its own frame,
# inertia about the mass centre (Ixx, Iyy, Izz, Ixy, Ixz, Iyz).
ARM_LINKS = [
    ("z", (0, 0, 0), "m1", (0, -0.01, ARM["h"] / 2), (0.25, 0.25, 0.06, 0, 0, 0)),
    ("y", (0, 0, ARM["h"]), "m2", (0, 0.03, ARM["a"] / 2), (0.13, 0.13, 0.02, 0, 0, 0)),
    ("y", (0, 0, ARM["a"]), "m3", (0.01, 0, ARM["b"] / 2), (0.09, 0.09, 0.01, 0, 0, 0.002)),
    ("z", (0, 0, ARM["b"]), "m4", (0, 0, 0), (0.003, 0.003, 0.002, 0, 0, 0)),
    ("y", (0, 0, 0), "m5", (0, 0, ARM["c"] / 2), (0.002, 0.002, 0.001, 0, 0, 0)),
    ("z", (0, 0, ARM["c"]), "m6", (0.03, 0, 0.08), (0.02, 0.02, 0.01, 0.001, 0, 0)),
]
CHAIN_SIZES = [2, 4, 8, 16, 32, 64]
GRAVITY = 9.81


def chain_links(n):
    """Length, mass, distance of the mass centre from the upper hinge, and inertia about the mass centre, for
    each link of T2."""
    links = []
    for i in range(n):
        length = 0.4 + 0.05 * (i % 5)
        rod = 0.8 + 0.1 * (i % 3)
        point = 0.5 + 0.1 * (i % 4)
        mass = rod + point
        centre = (rod * length / 2 + point * length) / mass
        inertia = rod * length**2 / 12 + rod * (centre - length / 2) ** 2 + point * (length - centre) ** 2
        links.append((length, mass, centre, inertia))
    return links


class Random:
    """The random number generator SplitMix64."""

    def __init__(self, seed):
        self.state = seed

    def uniform(self, low, high):
        mask = (1 << 64) - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & mask
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        z ^= z >> 31
        return low + (high - low) * ((z >> 11) * 2.0**-53)


class Task:
    """A machine: its size, its run-time parameters, its states, and the number of states whose error is known."""

    def __init__(self, name):
        self.name = name
        if name == "crusher":
            self.n, self.parameters, self.judged = 9, list(CRUSHER.values()), 256
            pi = math.pi
            centre = [0, 0, 0, 0.15, 0, 0, 0.10, 0, 0] + [0] * 9
            half = [0.02, 0.02, 0.1, 0.03, pi, pi, 0.02, pi, pi, 0.5, 0.5, 1, 0.3, 5, 10, 0.3, 5, 10]
            random, count = Random(20260001), 1024
            draw = lambda: [c + random.uniform(-h, h) for c, h in zip(centre, half)] + [random.uniform(0, 10)]
        elif name == "arm":
            # The run-time parameters, followed by the motors' torques.
            self.n, self.parameters, self.judged = 6, list(ARM.values()) + [0.0] * 6, 256
            random, count = Random(20260206), 1024
            draw = lambda: self.angles(random)
        else:
            self.n = int(name.removeprefix("chain"))
            links = chain_links(self.n)
            self.parameters, self.judged = [GRAVITY] + [x for link in links for x in link], 128
            random, count = Random(20260100 + self.n), max(128, min(1024, 8192 // self.n))
            draw = lambda: self.angles(random)
        self.states = [draw() for _ in range(count)]

    def angles(self, random):
        q = [random.uniform(-math.pi, math.pi) for _ in range(self.n)]
        return q + [random.uniform(-3, 3) for _ in range(self.n)] + [0.0]

    def by_family(self):
        """The parameters in the order of our specs: for a chain all lengths, then all masses, and so on."""
        if not self.name.startswith("chain"):
            return self.parameters
        gravity, *links = self.parameters
        return [gravity] + [x for k in range(4) for x in links[k::4]]

    def write(self, path, parameters, references):
        """The input of the timing loop: sizes, parameters, states, references; all in binary64."""
        rows = [parameters, *self.states, *references]
        sizes = [self.n, len(parameters), len(self.states), len(references)]
        with open(path, "wb") as file:
            file.write(struct.pack("<4d", *map(float, sizes)))
            for row in rows:
                file.write(struct.pack(f"<{len(row)}d", *row))

"""Equations of motion of known machines, typed in by hand: mass matrices and forces, with multipliers where loops are closed.

They share nothing with what this project derives. A function is given an arithmetic `over` (`sin_cos`, `root`, `number`), the time,
coordinates and rates, and returns the rows of a symmetric matrix and what stands on the right: its unknowns are accelerations, then
multipliers. So the same lines make references (make.py) and what other programs integrate (benches/peers/work_precision.py).
"""

import math


def is_nothing(column):
    return all(isinstance(x, int) and x == 0 for x in column)


class Plane:
    """Bodies in the plane whose points are sums of vectors that turn with sums of coordinates."""

    def __init__(self, over, q, v):
        self.over, self.q, self.v, self.n = over, q, v, len(q)
        self.known = {}
        self.matrix = [[0] * self.n for _ in range(self.n)]
        self.force = [0] * self.n

    def turned(self, angle, vector):
        """A vector of a frame that is turned by the sum of these coordinates, and the square of the rate of turning."""
        if angle not in self.known:
            total, rate = self.q[angle[0]], self.v[angle[0]]
            for i in angle[1:]:
                total, rate = total + self.q[i], rate + self.v[i]
            self.known[angle] = (*self.over.sin_cos(total), rate * rate)
        sin, cos, square = self.known[angle]
        x, y = vector
        return cos * x - sin * y, sin * x + cos * y, square

    def point(self, terms):
        """Its Jacobian by columns, and its acceleration where all coordinates' accelerations vanish."""
        jacobian, bias = [[0, 0] for _ in self.q], [0, 0]
        for angle, vector in terms:
            x, y, square = self.turned(angle, vector)
            for i in angle:
                jacobian[i] = [jacobian[i][0] - y, jacobian[i][1] + x]
            bias = [bias[0] - x * square, bias[1] - y * square]
        return jacobian, bias

    def body(self, mass, inertia, angle, terms, weight):
        """Newton's and Euler's laws; `weight` is the vector of gravity."""
        jacobian, bias = self.point(terms)
        for i in range(self.n):
            x, y = jacobian[i]
            self.force[i] = self.force[i] - mass * (x * (bias[0] - weight[0]) + y * (bias[1] - weight[1]))
            for j in range(self.n):
                if is_nothing(jacobian[i]) or is_nothing(jacobian[j]):
                    continue
                self.matrix[i][j] = self.matrix[i][j] + mass * (x * jacobian[j][0] + y * jacobian[j][1])
        for i in angle:
            for j in angle:
                self.matrix[i][j] = self.matrix[i][j] + inertia

    def closed(self, points):
        """The equations with the accelerations of these points 0."""
        rows, sides = [], []
        for terms in points:
            jacobian, bias = self.point(terms)
            for axis in (0, 1):
                rows.append([column[axis] for column in jacobian])
                sides.append(-1 * bias[axis])
        zeros = [0] * len(rows)
        matrix = [[*row, *[g[i] for g in rows]] for i, row in enumerate(self.matrix)]
        matrix += [[*row, *zeros] for row in rows]
        return matrix, [*self.force, *sides]


def double_pendulum(over, _t, q, v):
    """Textbook form with absolute angles, unit masses and lengths."""
    g = over.number(9.81)
    sin, cos = over.sin_cos(q[0] - q[1])
    (s1, _), (s2, _) = over.sin_cos(q[0]), over.sin_cos(q[1])
    return (
        [[2, cos], [cos, 1]],
        [-1 * (sin * (v[1] * v[1])) - 2 * g * s1, sin * (v[0] * v[0]) - g * s2],
    )


def crusher(over, t, q, v, stiffer=1):
    """Newton's law for each body: Jacobians and the accelerations that stay where those of coordinates vanish.

    The springs of the platform are `stiffer` by this factor.
    """
    m, J, m0, e, x0, y0, w = map(over.number, (450.0, 60.0, 25.0, 0.04, 0.10, -0.25, 100.0))
    m1, J1, m2, J2 = map(over.number, (120.0, 2.4, 60.0, 0.5))
    cx, cy, xc, yc = map(over.number, (2e5 * stiffer, 1.6e5 * stiffer, 0.35, -0.05))
    bx, by, xb, yb = map(over.number, (400.0, 350.0, 0.35, 0.04))
    k1, d1, r1, k2, d2, r2 = map(over.number, (5e4, 60.0, 0.15, 2e4, 30.0, 0.10))
    (st, ct), (n1, c1), (n2, c2), (sw, cw) = map(over.sin_cos, (q[2], q[4], q[7], w * t))
    px, py = x0 * ct - y0 * st, x0 * st + y0 * ct
    s1, s2 = q[3], q[6]
    spin = v[2] * v[2]
    zeros = lambda: [0] * 9
    row = lambda entries: [entries.get(i, 0) for i in range(9)]
    mortar = (
        row({0: 1, 3: c1, 4: -1 * (s1 * n1)}),
        row({1: 1, 3: n1, 4: s1 * c1}),
        -1 * ((s1 * (v[4] * v[4])) * c1) - 2 * ((v[3] * v[4]) * n1),
        -1 * ((s1 * (v[4] * v[4])) * n1) + 2 * ((v[3] * v[4]) * c1),
    )
    relative = (
        -1 * ((s2 * (v[7] * v[7])) * c2) - 2 * ((v[6] * v[7]) * n2),
        -1 * ((s2 * (v[7] * v[7])) * n2) + 2 * ((v[6] * v[7]) * c2),
    )
    pestle = (
        [*mortar[0][:6], c2, -1 * (s2 * n2), 0],
        [*mortar[1][:6], n2, s2 * c2, 0],
        mortar[2] + relative[0],
        mortar[3] + relative[1],
    )
    debalance = (
        row({0: 1, 2: -1 * py}),
        row({1: 1, 2: px}),
        -1 * (px * spin) - (e * w * w) * cw,
        -1 * (py * spin) - (e * w * w) * sw,
    )
    matrix, force = [zeros() for _ in range(9)], zeros()
    matrix[0][0] = matrix[1][1] = m
    for mass, (jx, jy, ax, ay) in ((m0, debalance), (m1, mortar), (m2, pestle)):
        for i in range(9):
            force[i] = force[i] - mass * (jx[i] * ax + jy[i] * ay)
            for j in range(9):
                matrix[i][j] = matrix[i][j] + mass * (jx[i] * jx[j] + jy[i] * jy[j])
    for i, inertia in ((2, J), (5, J1), (8, J2)):
        matrix[i][i] = matrix[i][i] + inertia
    along_x, along_y = cx * (q[0] - yc * q[2]), cy * (q[1] + xc * q[2])
    damp_x, damp_y = bx * (v[0] - yb * v[2]), by * (v[1] + xb * v[2])
    force[0] = force[0] - along_x - damp_x
    force[1] = force[1] - along_y - damp_y
    force[2] = force[2] + yc * along_x - xc * along_y + yb * damp_x - xb * damp_y
    force[3] = force[3] - k1 * (s1 - r1) - d1 * v[3]
    force[6] = force[6] - k2 * (s2 - r2) - d2 * v[6]
    return matrix, force


def stiff_crusher(over, t, q, v):
    return crusher(over, t, q, v, stiffer=10_000)


def heavy_top(over, _t, q, v):
    """Euler's angles in the order z, x, z; A of the fixed point."""
    m, l, across, along, g = map(over.number, (15.0, 1.0, 0.234375, 0.46875, 9.81))
    A, C = across + m * l * l, along
    s, c = over.sin_cos(q[1])
    (psi, theta, phi), sc = v, s * c
    matrix = [[A * (s * s) + C * (c * c), 0, C * c], [0, A, 0], [C * c, 0, C]]
    right = [
        2 * (C - A) * (sc * (theta * psi)) + C * (s * (theta * phi)),
        (A - C) * (sc * (psi * psi)) - C * (s * (psi * phi)) + m * g * l * s,
        C * (s * (theta * psi)),
    ]
    return matrix, right


def spherical_pendulum(over, _t, q, v):
    """l = 1, per unit of mass."""
    s, c = over.sin_cos(q[1])
    sc = s * c
    return [[s * s, 0], [0, 1]], [-2 * (sc * (v[0] * v[1])), sc * (v[0] * v[0]) - over.number(9.81) * s]


def elastic_pendulum(k):
    def equations(over, _t, q, v):
        """Per unit of mass, r and θ."""
        g, l0 = over.number(9.81), over.number(0.75)
        s, c = over.sin_cos(q[1])
        r = q[0]
        outward = r * (v[1] * v[1]) + g * c - over.number(k) * (r - l0)
        return [[1, 0], [0, r * r]], [outward, -2 * (r * (v[0] * v[1])) - g * (r * s)]

    return equations


def chain(n):
    """Rods of one kind, in the closed form for absolute angles."""

    def equations(over, _t, q, v):
        l, m, g = over.number(0.2), over.number(0.5), over.number(9.81)
        J = m * over.number(0.04) / 12
        rows = [over.sin_cos(angle) for angle in q]
        squares = [rate * rate for rate in v]
        matrix, force = [[0] * n for _ in range(n)], []
        for i in range(n):
            force.append(-(g * m * l * (n - i - over.number(0.5))) * rows[i][0])
            matrix[i][i] = J + m * l * l / 4 + (n - 1 - i) * m * l * l
        for i in range(n):
            for j in range(i + 1, n):
                A = m * l * l * (n - j - over.number(0.5))
                cos = rows[i][1] * rows[j][1] + rows[i][0] * rows[j][0]
                sin = rows[i][0] * rows[j][1] - rows[i][1] * rows[j][0]
                matrix[i][j] = matrix[j][i] = A * cos
                skew = A * sin
                force[i] = force[i] - skew * squares[j]
                force[j] = force[j] + skew * squares[i]
        return matrix, force

    return equations


def four_bar(over, _t, q, v):
    a, b, c, g = map(over.number, (0.3, 0.8, 0.6, 9.81))
    m1, m2, m3 = map(over.number, (1.0, 2.0, 1.5))
    weight = (0, -g)
    plane = Plane(over, q, v)
    plane.body(m1, m1 * a * a / 12, (0,), [((0,), (a / 2, 0))], weight)
    plane.body(m2, m2 * b * b / 12, (1,), [((0,), (a, 0)), ((1,), (b / 2, 0))], weight)
    plane.body(m3, m3 * c * c / 12, (2,), [((2,), (c / 2, 0))], weight)
    return plane.closed([[((0,), (a, 0)), ((1,), (b, 0)), ((2,), (-c, 0))]])


ANDREWS = {
    "xa": -0.06934, "ya": -0.00227, "xb": -0.03635, "yb": 0.03273, "xc": 0.014, "yc": 0.072, "d": 0.028, "da": 0.0115,
    "e": 0.02, "ea": 0.01421, "zf": 0.02, "fa": 0.01421, "rr": 0.007, "ra": 0.00092, "ss": 0.035, "sa": 0.01874,
    "sb": 0.01043, "sc": 0.018, "sd": 0.02, "zt": 0.04, "ta": 0.02308, "tb": 0.00916, "u": 0.04, "ua": 0.01228,
    "ub": 0.00449, "c0": 4530.0, "l0": 0.07785, "mom": 0.033,
}  # fmt: skip


def andrews_loops(p):
    """Where the loops meet: along K1 and K2, against each of the three other ways; angles are sums of coordinates."""
    pin = [((0,), (p["rr"], 0)), ((0, 1), (-p["d"], 0))]
    minus = lambda terms: [(angle, (-x, -y)) for angle, (x, y) in terms]
    ways = [
        ([((2,), (0, -p["ss"]))], (p["xb"], p["yb"])),
        ([((4,), (p["zt"], 0)), ((4, 3), (0, -p["e"]))], (p["xa"], p["ya"])),
        ([((6,), (0, -p["u"])), ((6, 5), (p["zf"], 0))], (p["xa"], p["ya"])),
    ]
    return [([*terms, *minus(pin)], at) for terms, at in ways]


def andrews(over, _t, q, v):
    """Coordinates beta, Theta, gamma, Phi, delta, Omega, epsilon."""
    p = {name: over.number(value) for name, value in ANDREWS.items()}
    m = [over.number(x) for x in (0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498)]
    I = [over.number(x) for x in (2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5)]
    plane = Plane(over, q, v)
    none = (0, 0)
    plane.body(m[0], I[0], (0,), [((0,), (p["ra"], 0))], none)
    plane.body(m[1], I[1], (0, 1), [((0,), (p["rr"], 0)), ((0, 1), (-p["da"], 0))], none)
    plane.body(m[2], I[2], (2,), [((2,), (p["sb"], -p["sa"]))], none)
    plane.body(m[3], I[3], (4, 3), [((4,), (p["zt"], 0)), ((4, 3), (0, p["ea"] - p["e"]))], none)
    plane.body(m[4], I[4], (4,), [((4,), (p["ta"], p["tb"]))], none)
    plane.body(m[5], I[5], (6, 5), [((6,), (0, -p["u"])), ((6, 5), (p["zf"] - p["fa"], 0))], none)
    plane.body(m[6], I[6], (6,), [((6,), (-p["ub"], -p["ua"]))], none)
    plane.force[0] = plane.force[0] + p["mom"]
    # The spring pulls the point of K3 towards the ground.
    x, y, _ = plane.turned((2,), (p["sd"], -p["sc"]))
    dx, dy = x + (p["xb"] - p["xc"]), y + (p["yb"] - p["yc"])
    length = over.root(dx * dx + dy * dy)
    pull = p["c0"] * (length - p["l0"]) / length
    plane.force[2] = plane.force[2] - pull * (x * dy - y * dx)
    return plane.closed([terms for terms, _ in andrews_loops(p)])


def flyball_governor(over, _t, q, v):
    l, b, m, M, J, g = map(over.number, (0.2, 0.2, 0.5, 2.0, 0.02, 9.81))
    s, c = over.sin_cos(q[1])
    sleeve, (phi, alpha, rate) = q[2], v
    sc = s * c
    G = [0, (l / b) * (sleeve * s), (sleeve - l * c) / b]
    moved = 2 * l * (s * (rate * alpha)) + l * ((sleeve * c) * (alpha * alpha)) + rate * rate
    matrix = [
        [J + 2 * m * l * l * (s * s), 0, 0, 0],
        [0, 2 * m * l * l, 0, G[1]],
        [0, 0, M, G[2]],
        [0, G[1], G[2], 0],
    ]
    right = [
        -4 * m * l * l * (sc * (alpha * phi)),
        2 * m * l * l * (sc * (phi * phi)) - 2 * m * g * l * s,
        M * g,
        -1 * moved / b,
    ]
    return matrix, right


def two_body_orbit(over, _t, q, v):
    """About a mass of 4 with G = 1."""
    r = q[0]
    return [[1, 0], [0, r * r]], [r * (v[1] * v[1]) - 4 / (r * r), -2 * (r * (v[0] * v[1]))]


def closed_pendulum(over, _t, q, v):
    """Five bars between two pins."""
    l, m, g = map(over.number, (1.0, 1.0, 9.81))
    plane = Plane(over, q, v)
    for i in range(5):
        above = [((k,), (l, 0)) for k in range(i)]
        plane.body(m, m * l * l / 12, (i,), [*above, ((i,), (l / 2, 0))], (0, -g))
    return plane.closed([[((k,), (l, 0)) for k in range(5)]])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def six_joint_arm(over, _t, q, v):
    """Newton's and Euler's laws of each body in its own axes, with the velocities that each joint alone gives it."""
    number = over.number
    h, a, b, c = map(number, (0.35, 0.40, 0.42, 0.10))
    # Of each joint: the axis, and where it is in the axes of the body before.
    joints = (("z", (0, 0, 0)), ("y", (0, 0, h)), ("y", (0, 0, a)), ("z", (0, 0, b)), ("y", (0, 0, 0)), ("z", (0, 0, c)))
    # Of each body: mass, mass centre, and the rows of its inertia about that.
    bodies = (
        (12, (0, number(-0.01), h / 2), ((0.25, 0, 0), (0, 0.25, 0), (0, 0, 0.06))),
        (9, (0, number(0.03), a / 2), ((0.13, 0, 0), (0, 0.13, 0), (0, 0, 0.02))),
        (6, (number(0.01), 0, b / 2), ((0.09, 0, 0), (0, 0.09, 0.002), (0, 0.002, 0.01))),
        (1.5, (0, 0, 0), ((0.003, 0, 0), (0, 0.003, 0), (0, 0, 0.002))),
        (1, (0, 0, c / 2), ((0.002, 0, 0), (0, 0.002, 0), (0, 0, 0.001))),
        (5.2, (number(0.03), 0, number(0.08)), ((0.02, 0.001, 0), (0.001, 0.02, 0), (0, 0, 0.01))),
    )
    n = len(joints)
    matrix, force = [[0] * n for _ in range(n)], [-number(0.4) * rate for rate in v]
    # In the axes of the body: what each joint's unit rate gives it of angular velocity and of velocity of its joint; its angular
    # velocity; and its accelerations where those of coordinates vanish, gravity as an acceleration upwards.
    turns, moves = [], []
    spin, angular, linear = [0, 0, 0], [0, 0, 0], [0, 0, number(9.81)]
    for i, ((axis, at), (mass, centre, inertia)) in enumerate(zip(joints, bodies)):
        sin, cos = over.sin_cos(q[i])

        def into(x):
            if axis == "z":
                return [cos * x[0] + sin * x[1], cos * x[1] - sin * x[0], x[2]]
            return [cos * x[0] - sin * x[2], x[1], cos * x[2] + sin * x[0]]

        linear = into(plus(linear, plus(cross(angular, at), cross(spin, cross(spin, at)))))
        moves = [into(plus(move, cross(turn, at))) for turn, move in zip(turns, moves)] + [[0, 0, 0]]
        unit = [0, 0, 1] if axis == "z" else [0, 1, 0]
        turns = [into(turn) for turn in turns] + [unit]
        before = into(spin)
        rate = [x * v[i] for x in unit]
        angular = plus(into(angular), cross(before, rate))
        spin = plus(before, rate)

        mass, rows = number(mass), [[number(x) if x else 0 for x in row] for row in inertia]
        of = lambda x: [dot(row, x) for row in rows]
        velocities = [plus(move, cross(turn, centre)) for turn, move in zip(turns, moves)]
        acceleration = plus(linear, plus(cross(angular, centre), cross(spin, cross(spin, centre))))
        torque = plus(of(angular), cross(spin, of(spin)))
        for j, (turn, velocity) in enumerate(zip(turns, velocities)):
            force[j] = force[j] - mass * dot(velocity, acceleration) - dot(turn, torque)
            for k in range(j + 1):
                entry = mass * dot(velocity, velocities[k]) + dot(turn, of(turns[k]))
                matrix[j][k] = matrix[j][k] + entry
                if k < j:
                    matrix[k][j] = matrix[j][k]
    return matrix, force


CRUSHER_START = [0.0, 0.0, 0.01, 0.16, 0.4, 0.0, 0.11, 1.3, 0.0, 0.05, -0.03, 0.02, 0.0, 2.0, 1.0, 0.0, -3.0, -2.0]
CRUSHER_SCALES = [0.02, 0.02, 0.1, 0.03, math.pi, math.pi, 0.02, math.pi, math.pi, 0.5, 0.5, 1, 0.3, 5, 10, 0.3, 5, 10]

ARM_START = [0.2] * 6 + [1.0, -0.5, 0.8, 2.0, -1.5, 3.0]

# Name: spec, what is set in it, equations, start where it is a state of doubles, end of the run, scales of errors where they are not 1.
PROBLEMS = {
    "double_pendulum_regular": ("double_pendulum", "", double_pendulum, [0.3, 0.5, 0.0, 0.0], 100.0, None),
    "double_pendulum_chaotic": ("double_pendulum", "", double_pendulum, [2.0, 2.5, 0.0, 0.0], 10.0, None),
    "crusher": ("crusher9", "", crusher, CRUSHER_START, 5.0, CRUSHER_SCALES),
    "stiff_crusher": ("crusher9", "cx=2e9 cy=1.6e9", stiff_crusher, CRUSHER_START, 1.0, CRUSHER_SCALES),
    "heavy_top": ("heavy_top", "", heavy_top, [math.pi, 1.2, 0.0, 0.5, 0.3, 150.0], 2.0, None),
    "spherical_pendulum": ("spherical_pendulum", "", spherical_pendulum, [0.0, math.pi / 3, 3.0, 0.0], 50.0, None),
    "elastic_pendulum": ("elastic_pendulum", "", elastic_pendulum(39.24), [1.2, 0.1, 0.0, 0.0], 50.0, None),
    "stiff_spring_pendulum": ("elastic_pendulum", "k=4e6", elastic_pendulum(4e6), [0.751, 1.0, 0.0, 0.0], 1.0, None),
    "chain_8": ("chain", "", chain(8), [0.3] * 8 + [0.0] * 8, 1.0, None),
    "chain_16": ("chain", "N=16", chain(16), [0.3] * 16 + [0.0] * 16, 1.0, None),
    "six_joint_arm": ("six_joint_arm", "", six_joint_arm, ARM_START, 2.0, None),
    "four_bar": ("four_bar", "", four_bar, None, 10.0, None),
    "andrews_squeezer": ("andrews_squeezer", "", andrews, None, 0.03, None),
    "closed_pendulum": ("closed_pendulum", "", closed_pendulum, None, 2.0, None),
    "kepler": ("two_body_orbit", "", two_body_orbit, [1.9, 0.0, 0.0, 0.2414902461795387], 3141.592653589793, None),
    "flyball_governor": ("flyball_governor", "", flyball_governor, None, 5.0, None),
}

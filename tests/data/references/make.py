#!/usr/bin/env python3
"""Makes the files beside it: where runs of known machines end, to 30 digits.

    pip install gmpy2 mpmath
    python3 tests/data/references/make.py [NAME ...]

The equations of motion (equations.py) are integrated by Taylor series of the accelerations in floating-point numbers of GNU MPFR (by
gmpy2), once with 46 coefficients and 180 bits and once with 60 coefficients and 240 bits, with steps of other lengths; what differs
between the two is written into the file, and a run whose two results do not agree to 30 digits is refused. The orbit is Kepler's
equation, solved in mpmath.

Numbers of a machine are the doubles next to what its spec says: what a run in doubles is given, too. Errors of rounding in them are
not errors of a run, and a chaotic motion multiplies them as much. Numbers that follow from others (angles of a closed loop, an inertia
J = m l²/12) follow from these to all digits.
"""

import math
import sys
import time
from operator import mul
from pathlib import Path

import gmpy2
import mpmath
from equations import ANDREWS, PROBLEMS, andrews_loops
from gmpy2 import mpfr

FOLDER = Path(__file__).resolve().parent
# Coefficients, bits, and the size of the last terms of a step.
RESOLUTIONS = ((46, 180, 1e-43), (60, 240, 1e-52))
DIGITS = 32


class Series:
    """A function of time by its Taylor coefficients `c` at the beginning of a step: the newest is added by `step`."""

    def __init__(self, graph, step):
        self.c, self.graph, self.step = [], graph, step
        graph.nodes.append(self)

    def __add__(self, other):
        a = self.c
        if isinstance(other, Series):
            b = other.c
            return Series(self.graph, lambda k: a[k] + b[k])
        if other == 0:
            return self
        return Series(self.graph, lambda k: a[k] + other if k == 0 else a[k])

    __radd__ = __add__

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        if isinstance(other, Series):
            a, b = self.c, other.c
            return Series(self.graph, lambda k: a[k] - b[k])
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        a = self.c
        if isinstance(other, Series):
            b = other.c
            return Series(self.graph, lambda k: sum(map(mul, a, reversed(b))))
        if other == 0:
            return 0
        if other == 1:
            return self
        return Series(self.graph, lambda k: a[k] * other)

    __rmul__ = __mul__

    def __truediv__(self, other):
        if not isinstance(other, Series):
            return self * (1 / mpfr(other))
        return quotient(self, other)

    def __rtruediv__(self, other):
        return quotient(other, self)


def quotient(a, b):
    """a/b: c_k = (a_k − Σ_{j≥1} b_j c_{k−j})/b_0."""
    a_is_series = isinstance(a, Series)

    def step(k):
        top = a.c[k] if a_is_series else (mpfr(a) if k == 0 else mpfr(0))
        return (top - sum(map(mul, b.c[1:], reversed(result.c)))) / b.c[0]

    result = Series(b.graph, step)
    return result


def root(a):
    """√a: c_k = (a_k − Σ_{0<j<k} c_j c_{k−j})/(2 c_0)."""

    def step(k):
        if k == 0:
            return gmpy2.sqrt(a.c[0])
        inner = result.c[1:]
        return (a.c[k] - sum(map(mul, inner, reversed(inner)))) / (2 * result.c[0])

    result = Series(a.graph, step)
    return result


def sin_cos(angle):
    """k s_k = Σ_{j≥1} j a_j c_{k−j}, k c_k = −Σ_{j≥1} j a_j s_{k−j}."""
    # The derivative of the angle, one coefficient behind: (j + 1) a_{j+1}.
    rate = Series(angle.graph, lambda k: k * angle.c[k])

    def sine(k):
        return gmpy2.sin(angle.c[0]) if k == 0 else sum(map(mul, rate.c[1:], reversed(cos.c))) / k

    def cosine(k):
        if k == 0:
            return gmpy2.cos(angle.c[0])
        return -sum(map(mul, rate.c[1:], reversed(sin.c[:k]))) / k

    sin = Series(angle.graph, sine)
    cos = Series(angle.graph, cosine)
    return sin, cos


def solution(matrix, right, graph):
    """x with M x = f: M_0 x_k = f_k − Σ_{j≥1} M_j x_{k−j}. Entries that are no series are constants."""
    n = len(right)
    inverse = []
    columns = []
    of = lambda entry, k: entry.c[k] if isinstance(entry, Series) else mpfr(entry if k == 0 else 0)

    def step(k):
        if k == 0:
            inverse[:] = inverted([[of(entry, 0) for entry in row] for row in matrix])
        sides = []
        for row, f in zip(matrix, right):
            side = of(f, k)
            for entry, x in zip(row, columns):
                if k > 0 and isinstance(entry, Series):
                    side -= sum(map(mul, entry.c[1:], reversed(x)))
            sides.append(side)
        for row, x in zip(inverse, columns):
            x.append(sum(map(mul, row, sides)))
        return mpfr(0)

    columns.extend([] for _ in range(n))
    Series(graph, step)
    results = []
    for x in columns:
        result = Series.__new__(Series)
        result.c, result.graph, result.step = x, graph, None
        graph.solved.append(x)
        results.append(result)
    return results


def inverted(matrix):
    """The inverse by Gauss and Jordan with pivots of rows."""
    n = len(matrix)
    rows = [list(row) + [mpfr(int(i == j)) for j in range(n)] for i, row in enumerate(matrix)]
    for j in range(n):
        pivot = max(range(j, n), key=lambda i: abs(rows[i][j]))
        rows[j], rows[pivot] = rows[pivot], rows[j]
        over = 1 / rows[j][j]
        rows[j] = [over * x for x in rows[j]]
        for i in range(n):
            if i != j and rows[i][j]:
                factor = rows[i][j]
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[j])]
    return [row[n:] for row in rows]


class Taylor:
    """The arithmetic of equations.py over series."""

    sin_cos, root, number = staticmethod(sin_cos), staticmethod(root), staticmethod(mpfr)


class Graph:
    """The equations of a machine: `equations(t, q, v)` gives the mass matrix with its constraints, and what stands on the right."""

    def __init__(self, n, equations):
        self.nodes, self.solved, self.n = [], [], n
        self.t = Series(self, None)
        self.q = [Series(self, None) for _ in range(n)]
        self.v = [Series(self, None) for _ in range(n)]
        self.given = [self.t, *self.q, *self.v]
        matrix, right = equations(Taylor, self.t, self.q, self.v)
        self.a = solution(matrix, right, self)[:n]
        self.computed = [node for node in self.nodes if node.step is not None]

    def expand(self, t, q, v, order):
        for node in self.nodes:
            node.c.clear()
        for x in self.solved:
            x.clear()
        self.t.c.append(t)
        for row, x in zip(self.q, q):
            row.c.append(x)
        for row, x in zip(self.v, v):
            row.c.append(x)
        for k in range(order):
            for node in self.computed:
                node.c.append(node.step(k))
            for x, rate, a in zip(self.q, self.v, self.a):
                x.c.append(rate.c[k] / (k + 1))
                rate.c.append(a.c[k] / (k + 1))
            self.t.c.append(mpfr(1 if k == 0 else 0))


def run(graph, start, until, order, tolerance):
    n = graph.n
    q, v = [mpfr(x) for x in start[:n]], [mpfr(x) for x in start[n:]]
    t, end, steps = mpfr(0), mpfr(until), 0
    while t < end:
        graph.expand(t, q, v, order)
        h = math.inf
        for j in (order - 1, order):
            worst = max(abs(row.c[j]) / (1 + abs(row.c[0])) for row in (*graph.q, *graph.v))
            if worst > 0:
                h = min(h, float(gmpy2.exp((math.log(tolerance) - gmpy2.log(worst)) / j)))
        h = min(mpfr(h), end - t)
        q, v = ([horner(row.c, h) for row in rows] for rows in (graph.q, graph.v))
        t = t + h
        steps += 1
    return [*q, *v], steps


def horner(c, h):
    total = mpfr(0)
    for x in reversed(c):
        total = total * h + x
    return total


def four_bar_start():
    """The crank on the ground bar: the rest is a triangle."""
    a, b, c, d, omega = map(mpfr, (0.3, 0.8, 0.6, 1.0, 12.0))
    r = d - a
    coupler = gmpy2.acos((r * r + b * b - c * c) / (2 * b * r))
    rocker = gmpy2.const_pi() - gmpy2.acos((r * r + c * c - b * b) / (2 * c * r))
    rate = -a / r * omega
    return [mpfr(0), coupler, rocker, omega, rate, rate]


def andrews_start():
    """The crank's angle to the digits of the publication is irrelevant to the loops: it is their unknown, at Theta = 0."""
    p = {name: mpfr(value) for name, value in ANDREWS.items()}
    guess = (-0.06171389001427644963589, 0.0, 0.4552798191630703802559, 0.2226683901658858846745, 0.4873649795438425502256,
             -0.2226683901658858846745, 1.230547444549821192497)  # fmt: skip
    q = [mpfr(x) for x in guess]
    free = (0, 2, 3, 4, 5, 6)
    for _ in range(9):
        sides, rows = [], []
        for terms, at in andrews_loops(p):
            x, y = at
            columns = [[mpfr(0), mpfr(0)] for _ in q]
            for angle, (px, py) in terms:
                total = sum(q[i] for i in angle)
                s, c = gmpy2.sin_cos(total)
                dx, dy = c * px - s * py, s * px + c * py
                x, y = x + dx, y + dy
                for i in angle:
                    columns[i][0] -= dy
                    columns[i][1] += dx
            sides += [x, y]
            rows += [[columns[i][axis] for i in free] for axis in (0, 1)]
        for row, i in zip(inverted(rows), free):
            q[i] -= sum(map(mul, row, sides))
    return [*q, *[mpfr(0)] * 7]


def flyball_start():
    """Arms at 0.6 rad, turned at 8 rad/s: slower than what holds them there; arms and links of one length."""
    return [mpfr(0), mpfr(0.6), 2 * mpfr(0.2) * gmpy2.cos(mpfr(0.6)), mpfr(8.0), mpfr(0), mpfr(0)]


def kepler(bits):
    """Around a mass of 4 with G = 1, from the distance 1.9 where it is greatest: the state at a time, by Kepler's equation."""
    mpmath.mp.prec = bits
    number = mpmath.mpf
    _, _, _, start, until, _ = PROBLEMS["kepler"]
    GM, r, rate = number(4), number(start[0]), number(start[3])
    a = 1 / (2 / r - (r * rate) ** 2 / GM)
    e = r / a - 1
    n = mpmath.sqrt(GM / a**3)
    # The mean anomaly from the apocentre; E is counted from the pericentre.
    mean = n * number(until) + mpmath.pi
    turns = mpmath.floor(mean / (2 * mpmath.pi))
    rest = mean - 2 * mpmath.pi * turns
    E = mpmath.findroot(lambda E: E - e * mpmath.sin(E) - rest, rest, tol=number(10) ** -100)
    distance = a * (1 - e * mpmath.cos(E))
    f = 2 * mpmath.atan2(mpmath.sqrt(1 + e) * mpmath.sin(E / 2), mpmath.sqrt(1 - e) * mpmath.cos(E / 2))
    outward = a * e * mpmath.sin(E) * n / (1 - e * mpmath.cos(E))
    return [distance, f + 2 * mpmath.pi * turns - mpmath.pi, outward, r * r * rate / distance**2]


def closed_pendulum_start():
    """Closed with two bars between the pins, and not symmetrical."""
    pi = gmpy2.const_pi()
    return [-pi / 2, mpfr(0), -pi / 3, pi / 3, pi / 2, *[mpfr(0)] * 5]


STARTS = {
    "four_bar": four_bar_start,
    "andrews_squeezer": andrews_start,
    "flyball_governor": flyball_start,
    "closed_pendulum": closed_pendulum_start,
}


def text_of(number):
    # As a double where it is one: shortest digits that read back as it.
    if mpfr(float(number)) == number:
        return repr(float(number))
    return f"{number:.{DIGITS - 1}e}"


def write(name, spec, settings, start, until, ends, scales, how):
    differences = [abs(a - b) / (1 + abs(b)) for a, b in zip(*ends)]
    worst = max(differences)
    if worst > 1e-30:
        raise SystemExit(f"{name}: the two results agree only to {float(worst):.1e}")
    lines = [
        f"# {how}",
        f"# two resolutions differ by {float(worst):.1e} of 1 + |y|",
        f"machine {spec} {settings}".rstrip(),
        f"until {until!r}",
    ]
    lines += [f"start {' '.join(map(text_of, start))}"]
    if scales:
        lines += [f"scales {' '.join(map(repr, map(float, scales)))}"]
    lines += ["end", *(f"{number:.{DIGITS - 1}e}" for number in ends[1])]
    (FOLDER / f"{name}.txt").write_text("\n".join(lines) + "\n")


def main():
    for name in sys.argv[1:] or PROBLEMS:
        clock = time.process_time()
        spec, settings, equations, given, until, scales = PROBLEMS[name]
        ends, counts = [], []
        for order, bits, tolerance in RESOLUTIONS:
            gmpy2.get_context().precision = bits
            start = STARTS[name]() if given is None else [mpfr(x) for x in given]
            if name == "kepler":
                ends.append([mpfr(mpmath.nstr(x, 60)) for x in kepler(2 * bits)])
                continue
            graph = Graph(len(start) // 2, equations)
            end, steps = run(graph, start, until, order, tolerance)
            ends.append(end)
            counts.append(f"{steps} steps of order {order} in {bits} bits")
        how = "Taylor series, " + ", ".join(counts) if counts else "Kepler's equation"
        write(name, spec, settings, start, until, ends, scales, how)
        print(f"{name}: {time.process_time() - clock:.1f} s; {how}", flush=True)


if __name__ == "__main__":
    main()

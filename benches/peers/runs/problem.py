"""The runs with known ends, and their equations in the expressions of any program."""

import math
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
REFERENCES = ROOT / "tests" / "data" / "references"
sys.path.insert(0, str(REFERENCES))
from equations import PROBLEMS  # noqa: E402

# Unrolled code for these takes minutes to compile.
COMPACT = ("andrews_squeezer", "closed_pendulum", "chain_16")
# Of these all forms but one are simplified by hand (motions.py).
BY_HAND = {
    "double_pendulum_regular": lambda motions, of: motions.pendulum(of),
    "double_pendulum_chaotic": lambda motions, of: motions.pendulum(of),
    "crusher": lambda motions, of: motions.crusher(1, of),
    "stiff_crusher": lambda motions, of: motions.crusher(10_000, of),
    "chain_8": lambda motions, of: motions.chain(8, False, of),
    "chain_16": lambda motions, of: motions.chain(16, False, of),
}


class Run:
    """A file of references."""

    def __init__(self, name):
        self.name, self.scales, end = name, None, []
        for line in (REFERENCES / f"{name}.txt").read_text().splitlines():
            word, *rest = line.split()
            if word in ("start", "scales"):
                setattr(self, word, [float(x) for x in rest])
            elif word == "until":
                self.until = float(rest[0])
            elif word not in ("#", "machine", "end"):
                end.append(np.longdouble(word))
        self.end = np.array(end)
        self.scales = np.array(self.scales or [1.0] * len(end))

    def error(self, y):
        """The greatest error of a coordinate or a rate, without unit; infinite if there is a value that is not a number."""
        error = float(np.max(np.abs(np.asarray(y, np.longdouble) - self.end) / (self.scales + np.abs(self.end))))
        return error if math.isfinite(error) else math.inf


class Symbols:
    """The arithmetic of the equations on another program's expressions."""

    number = float

    def __init__(self, of):
        self.of = of

    def sin_cos(self, angle):
        return self.of.sin(angle), self.of.cos(angle)

    def root(self, x):
        return self.of.sqrt(x)


def solved(matrix, right):
    """The solution of M x = f by LDLᵀ; zeros are the int 0 and cost nothing. Rows of constraints come last, so no pivot is 0."""
    n = len(right)
    is_zero = lambda x: isinstance(x, int) and x == 0
    D, L, f = [], [[0] * n for _ in range(n)], list(right)
    for i in range(n):
        left, held = matrix[i][i], [0] * i
        for j in range(i):
            entry = matrix[i][j]
            for k in range(j):
                if not is_zero(held[k]) and not is_zero(L[j][k]):
                    entry = entry - held[k] * L[j][k]
            held[j] = entry
        for j in range(i):
            if not is_zero(held[j]):
                L[i][j] = held[j] / D[j]
                left = left - held[j] * L[i][j]
        D.append(left)
    for i in range(n):
        for j in range(i):
            if not is_zero(L[i][j]):
                f[i] = f[i] - L[i][j] * f[j]
    f = [f[i] / D[i] for i in range(n)]
    for i in reversed(range(n)):
        for j in range(i + 1, n):
            if not is_zero(L[j][i]):
                f[i] = f[i] - L[j][i] * f[j]
    return f


def system(run, of):
    """Pairs of variables and rates, coordinates first, in the expressions of the module `of` (names as in heyoka)."""
    if run.name in BY_HAND:
        import motions

        return BY_HAND[run.name](motions, of)[0]
    n = len(run.start) // 2
    q, v = (of.make_vars(*[f"{kind}{i:02}" for i in range(n)]) for kind in "qv")
    matrix, right = PROBLEMS[run.name][2](Symbols(of), of.time, q, v)
    return [*zip(q, v), *zip(v, solved(matrix, right)[:n])]

"""SymPy: Lagrange's method, common subexpressions, C; the linear system is solved in C by a dense LDLᵀ."""

import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

import tasks
from peers.common import OPTIMIZED, Clock, command, ready

SOLVE = """
static void solve(double M[N][N], double f[N], double *x) {
    for (int j = 0; j < N; ++j) {
        const double inverse = 1 / M[j][j];
        for (int i = j + 1; i < N; ++i) {
            const double factor = M[i][j] * inverse;
            for (int k = j + 1; k <= i; ++k) M[i][k] -= factor * M[k][j];
            f[i] -= factor * f[j];
        }
    }
    for (int j = N - 1; j >= 0; --j) {
        double sum = f[j];
        for (int i = j + 1; i < N; ++i) sum -= M[i][j] * x[i];
        x[j] = sum / M[j][j];
    }
}
"""


def crusher(t, p):
    q = sp.Matrix(dynamicsymbols("x y th s1 f1 th1 s2 f2 th2"))
    v = q.diff(t)
    x, y, th, s1, f1, _, s2, f2, _ = q
    platform = sp.Matrix([x, y])
    debalance = platform + sp.Matrix([
        p["x0"] * sp.cos(th) - p["y0"] * sp.sin(th) + p["e"] * sp.cos(p["w"] * t),
        p["x0"] * sp.sin(th) + p["y0"] * sp.cos(th) + p["e"] * sp.sin(p["w"] * t),
    ])
    mortar = platform + s1 * sp.Matrix([sp.cos(f1), sp.sin(f1)])
    pestle = mortar + s2 * sp.Matrix([sp.cos(f2), sp.sin(f2)])
    bodies = [(p["m"], platform), (p["m0"], debalance), (p["m1"], mortar), (p["m2"], pestle)]
    T = (p["J"] * v[2] ** 2 + p["J1"] * v[5] ** 2 + p["J2"] * v[8] ** 2) / 2
    T += sum(mass * at.diff(t).dot(at.diff(t)) / 2 for mass, at in bodies)
    U = (p["cx"] * (x - p["yc"] * th) ** 2 + p["cy"] * (y + p["xc"] * th) ** 2) / 2
    U += (p["k1"] * (s1 - p["r1"]) ** 2 + p["k2"] * (s2 - p["r2"]) ** 2) / 2
    D = (p["bx"] * (v[0] - p["yb"] * v[2]) ** 2 + p["by"] * (v[1] + p["xb"] * v[2]) ** 2) / 2
    D += (p["d1"] * v[3] ** 2 + p["d2"] * v[6] ** 2) / 2
    return q, v, T - U, D


def chain(t, p, n):
    q = sp.Matrix(dynamicsymbols(f"q0:{n}"))
    v = q.diff(t)
    T = U = 0
    at = sp.zeros(2, 1)
    for i in range(n):
        length, mass, centre, inertia = p[1 + 4 * i : 5 + 4 * i]
        along = sp.Matrix([sp.sin(q[i]), -sp.cos(q[i])])
        body = at + centre * along
        at = at + length * along
        rate = body.diff(t)
        T += mass * rate.dot(rate) / 2 + inertia * v[i] ** 2 / 2
        U += mass * p[0] * body[1]
    return q, v, T - U, 0


def forms(task, variant, folder):
    """Lagrange's method written out (`LagrangesMethod` differentiates the same L in the same way, but does
    not support dissipation)."""
    clock = Clock()
    t = dynamicsymbols._t
    size = tasks.Task(task)
    n, numbers = size.n, size.parameters
    symbols = sp.symbols(f"p0:{len(numbers)}")
    read = symbols if variant == "par" else [sp.Float(x, 17) for x in numbers]
    if task == "crusher":
        q, v, L, D = crusher(t, dict(zip(tasks.CRUSHER, read)))
    else:
        q, v, L, D = chain(t, read, n)
    a = v.diff(t)
    momentum = sp.Matrix([L.diff(rate) for rate in v])
    residual = momentum.diff(t) - sp.Matrix([L.diff(x) - sp.diff(D, rate) for x, rate in zip(q, v)])
    matrix = residual.jacobian(a)
    force = -residual.subs(dict.fromkeys(a, 0))
    plain = dict(zip(v, sp.symbols(f"v0:{n}")))
    plain_q = dict(zip(q, sp.symbols(f"q0:{n}")))
    wanted = [matrix[i, j] for i in range(n) for j in range(i + 1)] + list(force)
    wanted = [expression.xreplace(plain).xreplace(plain_q) for expression in wanted]
    common, wanted = sp.cse(wanted)
    derive = clock.lap()
    lines = ["#include <math.h>", f"enum {{ N = {n} }};", SOLVE]
    lines.append("void eval(const double *y, double t, const double *p, double *qdd) {")
    lines += [f"    const double q{i} = y[{i}], v{i} = y[{n + i}];" for i in range(n)]
    if variant == "par":
        lines += [f"    const double p{i} = p[{i}];" for i in range(len(numbers))]
    lines += [f"    const double {name} = {sp.ccode(value)};" for name, value in common]
    lines.append("    double M[N][N], f[N];")
    index = 0
    for i in range(n):
        for j in range(i + 1):
            lines.append(f"    M[{i}][{j}] = {sp.ccode(wanted[index])};")
            index += 1
    for i in range(n):
        lines.append(f"    f[{i}] = {sp.ccode(wanted[index + i])};")
    lines += ["    solve(M, f, qdd);", "}"]
    source, library = folder / "lagrange.c", folder / "lagrange.so"
    source.write_text("\n".join(lines) + "\n")
    emit = clock.lap()
    yield ready("Lagrange, cse, dense LDL in C", library, derive, emit, command([*OPTIMIZED, "-o", library, source, "-lm"]))

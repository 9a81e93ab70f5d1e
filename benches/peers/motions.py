#!/usr/bin/env python3
"""Times whole runs with heyoka's Taylor method: the double pendulum for 100 s, the crusher and chains for 5 s.

    target/peers/python/bin/python benches/peers/motions.py [--references]

The right-hand sides are simplified by hand, because they dominate the time of such short steps. Errors are against references
with more digits than f64: those of benches/time_against_error.rs, and for chains a run with 64-bit mantissas, which
`--references` prints. Besides each run it prints a quarter of the time of four runs in lanes, each with its own steps.
"""

import argparse
import math
import time

import heyoka as hy
import numpy as np

REPEATS = 9
TOLERANCES = (1e-6, 1e-9, 1e-12, 1e-14, 1e-16)


def pendulum(of=hy):
    """Its rates in the expressions `of` heyoka, or of another module with the same names."""
    a, b, u, v = of.make_vars("a", "b", "u", "v")
    g = 9.81
    s, c = of.sin(a - b), of.cos(a - b)
    f, h = -s * v**2 - 2.0 * g * of.sin(a), s * u**2 - g * of.sin(b)
    over = 1.0 / (2.0 - c * c)
    system = [(a, u), (b, v), (u, (f - c * h) * over), (v, (2.0 * h - c * f) * over)]
    end = [0.1568362029256774608952189535, 0.1549800061482846913584054161,
           0.7581220395333524674810571735, 0.9338915929100755708546461654]
    return system, [0.3, 0.5, 0.0, 0.0], 100.0, end, [1.0] * 4


def crusher(stiffer=1, of=hy):
    """Newton's law for each body, as in expert/crusher.c; the springs of the platform are `stiffer` by this factor."""
    m, J, m0, e, x0, y0, w = 450.0, 60.0, 25.0, 0.04, 0.10, -0.25, 100.0
    m1, m2 = 120.0, 60.0
    cx, cy, xc, yc, bx_, by_, xb, yb = 2e5 * stiffer, 1.6e5 * stiffer, 0.35, -0.05, 400.0, 350.0, 0.35, 0.04
    k1, d1, r1, k2, d2, r2 = 5e4, 60.0, 0.15, 2e4, 30.0, 0.10
    names = ["x", "y", "t", "s1", "f1", "g1", "s2", "f2", "g2"]
    q = of.make_vars(*names)
    v = of.make_vars(*["v" + name for name in names])
    st, ct, n1, c1, n2, c2 = (wave(angle) for angle in (q[2], q[4], q[7]) for wave in (of.sin, of.cos))
    s1, s2, om, vs1, vf1, vs2, vf2 = q[3], q[6], v[2], v[3], v[4], v[6], v[7]
    share = m0 / (m + m0)
    by_inertia = 1.0 / (J + (x0 * x0 + y0 * y0) * m * share)
    bx, by = x0 * ct - y0 * st, x0 * st + y0 * ct
    along, across = cx * (q[0] - yc * q[2]), cy * (q[1] + xc * q[2])
    damp_x, damp_y = bx_ * (v[0] - yb * om), by_ * (v[1] + xb * om)
    F1, F2 = k1 * (r1 - s1) - d1 * vs1, k2 * (r2 - s2) - d2 * vs2
    f1x, f1y, f2x, f2y = F1 * c1, F1 * n1, F2 * c2, F2 * n2
    ux, uy = m0 * e * w * w * of.cos(w * of.time), m0 * e * w * w * of.sin(w * of.time)
    spin = m0 * (om * om)
    gx, gy = (ux + spin * bx) - (f1x + (along + damp_x)), (uy + spin * by) - (f1y + (across + damp_y))
    torque = (yc * along - xc * across) + (yb * damp_x - xb * damp_y)
    ex, ey = ux - share * gx, uy - share * gy
    alpha = by_inertia * (torque + (bx * ey - by * ex))
    turn = share * alpha
    ax, ay = gx / (m + m0) + turn * by, gy / (m + m0) - turn * bx
    mx, my = (f1x - f2x) / m1, (f1y - f2y) / m1
    Bx, By, Cx, Cy = mx - ax, my - ay, f2x / m2 - mx, f2y / m2 - my
    zero = of.expression(0.0)
    a = [ax, ay, alpha, (Bx * c1 + By * n1) + s1 * (vf1 * vf1), ((By * c1 - Bx * n1) - 2.0 * vs1 * vf1) / s1, zero,
         (Cx * c2 + Cy * n2) + s2 * (vf2 * vf2), ((Cy * c2 - Cx * n2) - 2.0 * vs2 * vf2) / s2, zero]
    system = [*zip(q, v), *zip(v, a)]
    start = [0.0, 0.0, 0.01, 0.16, 0.4, 0.0, 0.11, 1.3, 0.0, 0.05, -0.03, 0.02, 0.0, 2.0, 1.0, 0.0, -3.0, -2.0]
    end = [0.06145283273805227510136737529, 0.4241214737780232413153200169, -1.209985523340049481970345949,
           0.1455123597444114492826119317, 5.967265586494525128131223913, 5.0, 0.1036735412132180923702475683,
           -15.9766278485484829123169667, -10.0, -0.09462865728282268521632893372, 0.228207198914713414747289637,
           -0.5249274085360239320948923577, 0.1100939663714541980174367722, -0.2019782217149329347742263169, 1.0,
           0.0059859895538211664776422265, -2.701996137911471140233655696, -2.0]
    pi = math.pi
    scales = [0.02, 0.02, 0.1, 0.03, pi, pi, 0.02, pi, pi, 0.5, 0.5, 1.0, 0.3, 5.0, 10.0, 0.3, 5.0, 10.0]
    return system, start, 5.0, end, scales


def chain(n, with_end=True, of=hy):
    """The chain of machines/chain.machine, solved by L D Lᵀ, and, if requested, its end by a run with 64-bit mantissas."""
    l, m, g = 0.2, 0.5, 9.81
    J = 0.5 * 0.04 / 12
    q = of.make_vars(*[f"q{i}" for i in range(n)])
    v = of.make_vars(*[f"v{i}" for i in range(n)])
    reach = lambda k, i: l if i < k else l / 2 if i == k else 0.0
    A = [[sum(m * reach(k, i) * reach(k, j) for k in range(n)) for j in range(n)] for i in range(n)]
    M = [[A[i][j] * of.cos(q[i] - q[j]) if i != j else of.expression(A[i][i] + J) for j in range(i + 1)] for i in range(n)]
    f = []
    for i in range(n):
        turning = [A[i][j] * of.sin(q[j] - q[i]) * v[j] * v[j] for j in range(n) if j != i]
        weight = g * sum(m * reach(k, i) for k in range(n))
        f.append(of.sum([*turning, -weight * of.sin(q[i])]))
    D, L = [], [[None] * n for _ in range(n)]
    for i in range(n):
        left = M[i][i]
        for j in range(i):
            entry = M[i][j]
            for k in range(j):
                entry = entry - L[i][k] * L[j][k] * D[k]
            L[i][j] = entry / D[j]
            left = left - L[i][j] * L[i][j] * D[j]
        D.append(left)
    for i in range(n):
        for j in range(i):
            f[i] = f[i] - L[i][j] * f[j]
    f = [f[i] / D[i] for i in range(n)]
    for i in reversed(range(n)):
        for j in range(i + 1, n):
            f[i] = f[i] - L[j][i] * f[j]
    system = [*zip(q, v), *zip(v, f)]
    start = [0.3] * n + [0.0] * n
    if not with_end:
        return system, start, 5.0, None, [1.0] * (2 * n)
    exact = hy.taylor_adaptive(system, np.array(start, np.longdouble), fp_type=np.longdouble, compact_mode=n > 8)
    exact.propagate_until(np.longdouble(5.0))
    return system, start, 5.0, list(exact.state), [1.0] * (2 * n)


def race(name, system, start, until, end, scales, compact):
    end = np.array(end, np.longdouble)
    for tolerance in TOLERANCES:
        clock = time.perf_counter()
        one = hy.taylor_adaptive(system, start, tol=tolerance, compact_mode=compact)
        compiled = time.perf_counter() - clock
        best, state = math.inf, None
        for _ in range(REPEATS):
            one.time, one.state[:] = 0.0, start
            clock = time.perf_counter()
            one.propagate_until(until)
            best = min(best, time.perf_counter() - clock)
            state = one.state.copy()
        error = max(abs(y - x) / (s + abs(x)) for y, x, s in zip(state, end, scales))
        four = hy.taylor_adaptive_batch(system, np.array([start] * 4).T.copy(), tol=tolerance, compact_mode=compact)
        at_once = math.inf
        for _ in range(REPEATS):
            four.set_time(0.0)
            four.state[:] = np.array([start] * 4).T
            clock = time.perf_counter()
            four.propagate_until(until)
            at_once = min(at_once, (time.perf_counter() - clock) / 4)
        print(f"| {name} | {tolerance:.0e} | {float(error):.1e} | {best * 1e3:.3f} | {at_once * 1e3:.3f} | {compiled:.2f} |", flush=True)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--references", action="store_true", help="print where the chains end, without timing")
    words.add_argument("--only", default="pendulum,crusher,chain8", help="what to time")
    call = words.parse_args()
    if call.references:
        for n in (8, 16):
            print(n, *(f"{x:.20f}" for x in chain(n)[3]))
        return
    print("| heyoka, Taylor | tolerance | error | ms | ms, of four at once | compiled in s |")
    print("| --- | --: | --: | --: | --: | --: |")
    runs = {"pendulum": pendulum, "crusher": crusher, "chain8": lambda: chain(8), "chain16": lambda: chain(16)}
    for name in call.only.split(","):
        race(name, *runs[name](), compact=name == "chain16")


if __name__ == "__main__":
    main()

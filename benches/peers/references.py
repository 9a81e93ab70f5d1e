"""References with 40 digits: equations of motion typed in by hand, solved with dense matrices in mpmath.

No derivation is shared with any program: the crusher uses Newton's law for each body and hand-written Jacobians, the
chain the closed form of T2, the arm the principle of virtual power (Jourdain) in the ground frame.
"""

import mpmath
from mpmath import mpf

from tasks import ARM, ARM_LINKS, CRUSHER, GRAVITY, chain_links

mpmath.mp.dps = 40


def solve(matrix, right):
    """Solves M x = f for a symmetric positive definite M by LDLᵀ; both are overwritten."""
    n = len(right)
    for j in range(n):
        for i in range(j + 1, n):
            if matrix[i][j]:
                factor = matrix[i][j] / matrix[j][j]
                row, pivot = matrix[i], matrix[j]
                for k in range(j + 1, i + 1):
                    row[k] -= factor * matrix[k][j]
                right[i] -= factor * right[j]
    for j in reversed(range(n)):
        total = right[j]
        for i in range(j + 1, n):
            total -= matrix[i][j] * right[i]
        right[j] = total / matrix[j][j]
    return right


def crusher(y, t):
    p = {name: mpf(value) for name, value in CRUSHER.items()}
    x, yy, th, s1, f1, _, s2, f2, _ = map(mpf, y[:9])
    vx, vy, vth, vs1, vf1, _, vs2, vf2, _ = map(mpf, y[9:])
    zero, one = mpf(0), mpf(1)
    ct, st = mpmath.cos(th), mpmath.sin(th)
    c1, n1 = mpmath.cos(f1), mpmath.sin(f1)
    c2, n2 = mpmath.cos(f2), mpmath.sin(f2)
    phase = p["w"] * mpf(t)
    # The debalance's axis relative to the platform's origin.
    bx, by = p["x0"] * ct - p["y0"] * st, p["x0"] * st + p["y0"] * ct
    # Rows of the Jacobian of each point with respect to (x, y, th, s1, f1, th1, s2, f2, th2), and the acceleration
    # of the point for q'' = 0.
    radial1 = (-s1 * vf1**2 * c1 - 2 * vs1 * vf1 * n1, -s1 * vf1**2 * n1 + 2 * vs1 * vf1 * c1)
    radial2 = (-s2 * vf2**2 * c2 - 2 * vs2 * vf2 * n2, -s2 * vf2**2 * n2 + 2 * vs2 * vf2 * c2)
    spin = p["e"] * p["w"] ** 2
    platform = ([one] + [zero] * 8, [zero, one] + [zero] * 7, zero, zero)
    debalance = (
        [one, zero, -by] + [zero] * 6,
        [zero, one, bx] + [zero] * 6,
        -bx * vth**2 - spin * mpmath.cos(phase),
        -by * vth**2 - spin * mpmath.sin(phase),
    )
    mortar_x = [one, zero, zero, c1, -s1 * n1, zero, zero, zero, zero]
    mortar_y = [zero, one, zero, n1, s1 * c1, zero, zero, zero, zero]
    mortar = (mortar_x, mortar_y, radial1[0], radial1[1])
    pestle = (
        mortar_x[:6] + [c2, -s2 * n2, zero],
        mortar_y[:6] + [n2, s2 * c2, zero],
        radial1[0] + radial2[0],
        radial1[1] + radial2[1],
    )
    matrix = [[zero] * 9 for _ in range(9)]
    force = [zero] * 9
    for mass, (jx, jy, ax, ay) in zip(
        (p["m"], p["m0"], p["m1"], p["m2"]), (platform, debalance, mortar, pestle), strict=True
    ):
        for i in range(9):
            force[i] -= mass * (jx[i] * ax + jy[i] * ay)
            for j in range(9):
                matrix[i][j] += mass * (jx[i] * jx[j] + jy[i] * jy[j])
    for i, inertia in ((2, "J"), (5, "J1"), (8, "J2")):
        matrix[i][i] += p[inertia]
    along_x = p["cx"] * (x - p["yc"] * th)
    along_y = p["cy"] * (yy + p["xc"] * th)
    damp_x = p["bx"] * (vx - p["yb"] * vth)
    damp_y = p["by"] * (vy + p["xb"] * vth)
    force[0] -= along_x + damp_x
    force[1] -= along_y + damp_y
    force[2] -= -p["yc"] * along_x + p["xc"] * along_y - p["yb"] * damp_x + p["xb"] * damp_y
    force[3] -= p["k1"] * (s1 - p["r1"]) + p["d1"] * vs1
    force[6] -= p["k2"] * (s2 - p["r2"]) + p["d2"] * vs2
    return solve(matrix, force)


def chain(y, _t):
    n = len(y) // 2
    links = [tuple(map(mpf, link)) for link in chain_links(n)]
    cos = [mpmath.cos(mpf(q)) for q in y[:n]]
    sin = [mpmath.sin(mpf(q)) for q in y[:n]]
    square = [mpf(v) ** 2 for v in y[n:]]
    below, total = [mpf(0)] * n, mpf(0)
    for i in reversed(range(n)):
        below[i] = total
        total += links[i][1]
    moment = [m * c + l * k for (l, m, c, _), k in zip(links, below)]  # B
    matrix = [[mpf(0)] * n for _ in range(n)]
    force = [-b * mpf(GRAVITY) * s for b, s in zip(moment, sin)]
    for i, (l, m, c, inertia) in enumerate(links):
        matrix[i][i] = inertia + m * c**2 + l**2 * below[i]
        for j in range(i + 1, n):
            a = l * moment[j]
            matrix[j][i] = a * (cos[i] * cos[j] + sin[i] * sin[j])
            skew = a * (sin[i] * cos[j] - cos[i] * sin[j])  # A sin(th_i - th_j)
            force[i] -= skew * square[j]
            force[j] += skew * square[i]
    return solve(matrix, force)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def arm(y, _t):
    zero, one = mpf(0), mpf(1)
    q, v = [mpf(x) for x in y[:6]], [mpf(x) for x in y[6:]]
    rotation = [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
    apply = lambda vector: [dot(row, vector) for row in rotation]
    origin, omega, alpha, acceleration = ([zero] * 3 for _ in range(4))
    axes, origins = [], []
    matrix = [[zero] * 6 for _ in range(6)]
    force = [-mpf(ARM["friction"]) * rate for rate in v]
    for i, (axis, shift, mass, centre, inertia) in enumerate(ARM_LINKS):
        # The frame: shifted along the axes of the previous one, then rotated about its own axis.
        arm_of_shift = apply([mpf(x) for x in shift])
        acceleration = [
            a + b + c
            for a, b, c in zip(acceleration, cross(alpha, arm_of_shift), cross(omega, cross(omega, arm_of_shift)))
        ]
        origin = [a + b for a, b in zip(origin, arm_of_shift)]
        unit = apply([one, zero, zero] if axis == "x" else [zero, one, zero] if axis == "y" else [zero, zero, one])
        c, s = mpmath.cos(q[i]), mpmath.sin(q[i])
        turn = {
            "y": [[c, zero, s], [zero, one, zero], [-s, zero, c]],
            "z": [[c, -s, zero], [s, c, zero], [zero, zero, one]],
        }[axis]
        rotation = [[sum(row[k] * turn[k][j] for k in range(3)) for j in range(3)] for row in rotation]
        # With q'' = 0 the angular acceleration changes by omega x (axis q').
        alpha = [a + b for a, b in zip(alpha, cross(omega, [u * v[i] for u in unit]))]
        omega = [w + u * v[i] for w, u in zip(omega, unit)]
        axes.append(unit)
        origins.append(origin)
        # The body: mass centre, inertia in the ground frame, and its accelerations for q'' = 0.
        m = mpf(ARM[mass])
        to_centre = apply([mpf(x) for x in centre])
        at = [a + b for a, b in zip(origin, to_centre)]
        free = [
            a + b + c + (mpf(ARM["g"]) if k == 2 else zero)
            for k, (a, b, c) in enumerate(
                zip(acceleration, cross(alpha, to_centre), cross(omega, cross(omega, to_centre)))
            )
        ]
        xx, yy, zz, xy, xz, yz = map(mpf, inertia)
        local = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        half = [[dot(row, column) for column in local] for row in rotation]
        tensor = [[dot(row, other) for other in rotation] for row in half]
        times = lambda vector: [dot(row, vector) for row in tensor]
        moment = [a + b for a, b in zip(times(alpha), cross(omega, times(omega)))]
        rates = [cross(axes[j], [a - b for a, b in zip(at, origins[j])]) for j in range(i + 1)]
        for j in range(i + 1):
            force[j] -= m * dot(rates[j], free) + dot(axes[j], moment)
            weighted = times(axes[j])
            for k in range(i + 1):
                matrix[j][k] += m * dot(rates[j], rates[k]) + dot(axes[k], weighted)
    return solve(matrix, force)


def accelerations(task):
    """The accelerations at the first states of a task, as the nearest binary64 and the remainder: pairs of lists."""
    equations = {"crusher": crusher, "arm": arm}.get(task.name, chain)
    rows = []
    for state in task.states[: task.judged]:
        exact = equations(state[:-1], state[-1])
        high = [float(a) for a in exact]
        rows.append(high + [float(a - mpf(h)) for a, h in zip(exact, high)])
    return rows

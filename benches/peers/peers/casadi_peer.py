"""CasADi: SX graphs, differentiated and solved symbolically, generated as C."""

import casadi as ca

import tasks
from peers.common import OPTIMIZED, Clock, TooLong, command, ready


def crusher_lagrange(q, v, t, p):
    """M and f from the energies alone, by differentiation."""
    where, T, U, D = crusher_energies(q, v, t, p)
    momentum = ca.gradient(T, v)
    matrix = ca.jacobian(momentum, v)
    # d/dt of the momentum without M v'.
    bias = ca.jtimes(momentum, q, v) + ca.jacobian(momentum, t)
    force = ca.gradient(T, q) - ca.gradient(U, q) - ca.gradient(D, v) - bias
    return matrix, force


def crusher_energies(q, v, t, p):
    x, y, th, s1, f1, _, s2, f2, _ = ca.vertsplit(q)
    platform = ca.vertcat(x, y)
    turned = ca.vertcat(
        p["x0"] * ca.cos(th) - p["y0"] * ca.sin(th) + p["e"] * ca.cos(p["w"] * t),
        p["x0"] * ca.sin(th) + p["y0"] * ca.cos(th) + p["e"] * ca.sin(p["w"] * t),
    )
    mortar = platform + s1 * ca.vertcat(ca.cos(f1), ca.sin(f1))
    pestle = mortar + s2 * ca.vertcat(ca.cos(f2), ca.sin(f2))
    bodies = [(p["m"], platform), (p["m0"], platform + turned), (p["m1"], mortar), (p["m2"], pestle)]
    T = (p["J"] * v[2] ** 2 + p["J1"] * v[5] ** 2 + p["J2"] * v[8] ** 2) / 2
    for mass, at in bodies:
        T += mass / 2 * ca.sumsqr(ca.jtimes(at, q, v) + ca.jacobian(at, t))
    U = (p["cx"] * (x - p["yc"] * th) ** 2 + p["cy"] * (y + p["xc"] * th) ** 2) / 2
    U += (p["k1"] * (s1 - p["r1"]) ** 2 + p["k2"] * (s2 - p["r2"]) ** 2) / 2
    D = (p["bx"] * (v[0] - p["yb"] * v[2]) ** 2 + p["by"] * (v[1] + p["xb"] * v[2]) ** 2) / 2
    D += (p["d1"] * v[3] ** 2 + p["d2"] * v[6] ** 2) / 2
    return bodies, T, U, D


def crusher_projected(q, v, t, p):
    """M = sum m JᵀJ, and the bias accelerations projected with the same Jacobians, as in Kane's method."""
    bodies, _, U, D = crusher_energies(q, v, t, p)
    matrix = ca.diag(ca.vertcat(0, 0, p["J"], 0, 0, p["J1"], 0, 0, p["J2"]))
    force = -ca.gradient(U, q) - ca.gradient(D, v)
    for mass, at in bodies:
        jacobian = ca.jacobian(at, q)
        rate = ca.jtimes(at, q, v) + ca.jacobian(at, t)
        bias = ca.jtimes(rate, q, v) + ca.jacobian(rate, t)
        matrix += mass * (jacobian.T @ jacobian)
        force -= mass * (jacobian.T @ bias)
    return matrix, force


def crusher_by_hand(q, v, t, p):
    """M and f simplified by hand: with differences of angles, and common masses."""
    x, y, th, s1, f1, _, s2, f2, _ = ca.vertsplit(q)
    vx, vy, vth, vs1, vf1, _, vs2, vf2, _ = ca.vertsplit(v)
    ct, st, c1, n1, c2, n2 = ca.cos(th), ca.sin(th), ca.cos(f1), ca.sin(f1), ca.cos(f2), ca.sin(f2)
    c12, n12 = c1 * c2 + n1 * n2, c1 * n2 - n1 * c2
    m2, m12, m0 = p["m2"], p["m1"] + p["m2"], p["m0"]
    total = p["m"] + m0 + m12
    bx, by = p["x0"] * ct - p["y0"] * st, p["x0"] * st + p["y0"] * ct
    matrix = ca.SX(9, 9)
    entries = {
        (0, 0): total, (1, 1): total, (2, 0): -m0 * by, (2, 1): m0 * bx,
        (2, 2): p["J"] + m0 * (p["x0"] ** 2 + p["y0"] ** 2),
        (3, 0): m12 * c1, (3, 1): m12 * n1, (3, 3): m12,
        (4, 0): -m12 * s1 * n1, (4, 1): m12 * s1 * c1, (4, 4): m12 * s1**2,
        (5, 5): p["J1"], (8, 8): p["J2"],
        (6, 0): m2 * c2, (6, 1): m2 * n2, (6, 3): m2 * c12, (6, 4): m2 * s1 * n12, (6, 6): m2,
        (7, 0): -m2 * s2 * n2, (7, 1): m2 * s2 * c2, (7, 3): -m2 * s2 * n12, (7, 4): m2 * s1 * s2 * c12,
        (7, 7): m2 * s2**2,
    }
    for (i, j), value in entries.items():
        matrix[i, j] = value
        matrix[j, i] = value
    phase = p["w"] * t
    spin = p["e"] * p["w"] ** 2
    # Bias accelerations of the debalance, of the mortar along its radius and across it, and of the pestle
    # on the mortar.
    dx, dy = -bx * vth**2 - spin * ca.cos(phase), -by * vth**2 - spin * ca.sin(phase)
    r1, a1 = -s1 * vf1**2, 2 * vs1 * vf1
    r2, a2 = -s2 * vf2**2, 2 * vs2 * vf2
    along = p["cx"] * (x - p["yc"] * th)
    across = p["cy"] * (y + p["xc"] * th)
    damp_x, damp_y = p["bx"] * (vx - p["yb"] * vth), p["by"] * (vy + p["xb"] * vth)
    gx, gy = r1 * c1 - a1 * n1, r1 * n1 + a1 * c1
    hx, hy = r2 * c2 - a2 * n2, r2 * n2 + a2 * c2
    force = ca.vertcat(
        -along - damp_x - m0 * dx - m12 * gx - m2 * hx,
        -across - damp_y - m0 * dy - m12 * gy - m2 * hy,
        p["yc"] * along - p["xc"] * across + p["yb"] * damp_x - p["xb"] * damp_y - m0 * (bx * dy - by * dx),
        -p["k1"] * (s1 - p["r1"]) - p["d1"] * vs1 - m12 * r1 - m2 * (hx * c1 + hy * n1),
        -s1 * (m12 * a1 + m2 * (hy * c1 - hx * n1)),
        0,
        -p["k2"] * (s2 - p["r2"]) - p["d2"] * vs2 - m2 * (gx * c2 + gy * n2 + r2),
        -s2 * m2 * (gy * c2 - gx * n2 + a2),
        0,
    )
    return matrix, force


def chain_lagrange(q, v, t, p):
    n = q.shape[0]
    T = U = 0
    at = ca.SX.zeros(2)
    for i in range(n):
        length, mass, centre, inertia = (p[1 + 4 * i + k] for k in range(4))
        along = ca.vertcat(ca.sin(q[i]), -ca.cos(q[i]))
        body = at + centre * along
        at = at + length * along
        T += mass / 2 * ca.sumsqr(ca.jtimes(body, q, v)) + inertia / 2 * v[i] ** 2
        U += mass * p[0] * body[1]
    momentum = ca.gradient(T, v)
    return ca.jacobian(momentum, v), ca.gradient(T, q) - ca.gradient(U, q) - ca.jtimes(momentum, q, v)


def chain_by_hand(q, v, t, p):
    """The closed form of T2."""
    n = q.shape[0]
    link = lambda i, k: p[1 + 4 * i + k]
    below, total = [0] * n, 0
    for i in reversed(range(n)):
        below[i] = total
        total = total + link(i, 1)
    moment = [link(i, 1) * link(i, 2) + link(i, 0) * below[i] for i in range(n)]
    cos, sin = [ca.cos(q[i]) for i in range(n)], [ca.sin(q[i]) for i in range(n)]
    square = [v[i] ** 2 for i in range(n)]
    matrix = ca.SX(n, n)
    force = [-moment[i] * p[0] * sin[i] for i in range(n)]
    for i in range(n):
        matrix[i, i] = link(i, 3) + link(i, 1) * link(i, 2) ** 2 + link(i, 0) ** 2 * below[i]
        for j in range(i + 1, n):
            a = link(i, 0) * moment[j]
            matrix[i, j] = matrix[j, i] = a * (cos[i] * cos[j] + sin[i] * sin[j])
            skew = a * (sin[i] * cos[j] - cos[i] * sin[j])
            force[i] -= skew * square[j]
            force[j] += skew * square[i]
    return matrix, ca.vertcat(*force)


def by_ldl(matrix, force):
    d, lt, order = ca.ldl(matrix, True)
    return ca.ldl_solve(force, d, lt, order)


SOLVERS = {"LDL": by_ldl, "QR": lambda matrix, force: ca.solve(matrix, force)}


def equations(task):
    if task == "crusher":
        return {"Lagrange": crusher_lagrange, "projected": crusher_projected, "by hand": crusher_by_hand}
    return {"Lagrange": chain_lagrange, "by hand": chain_by_hand}


def function(task, variant, form, solver):
    """The function (y, t, p) -> qdd."""
    n = tasks.Task(task).n
    y, t = ca.SX.sym("y", 2 * n), ca.SX.sym("t")
    numbers = tasks.Task(task).parameters
    p = ca.SX.sym("p", len(numbers))
    read = p if variant == "par" else ca.SX(numbers)
    named = dict(zip(tasks.CRUSHER, ca.vertsplit(read))) if task == "crusher" else ca.vertsplit(read)
    # Differentiation needs q and v as symbols.
    q, v = ca.SX.sym("q", n), ca.SX.sym("v", n)
    matrix, force = equations(task)[form](q, v, t, named)
    qdd = ca.substitute(SOLVERS[solver](matrix, force), ca.vertcat(q, v), y)
    return ca.Function("f", [y, t, p], [ca.cse(ca.densify(qdd))])


SHIM = """
void eval(const double *y, double t, const double *p, double *qdd) {
    const double *arg[] = {y, &t, p};
    double *res[] = {qdd};
    f(arg, res, 0, 0, 0);
}
"""


def forms(task, variant, folder):
    """Every form that could be the fastest. Large chains are only solved by LDL, because QR takes several
    times the work."""
    n = tasks.Task(task).n
    wanted = [(form, solver) for form in equations(task) for solver in SOLVERS]
    if task != "crusher" and n > 4:
        wanted = [("by hand", "LDL")]
    for form, solver in wanted:
        clock = Clock()
        f = function(task, variant, form, solver)
        derive = clock.lap()
        name = f"{form}, {solver}"
        stem = folder / name.replace(", ", "_").replace(" ", "_")
        source = stem.with_suffix(".c")
        generator = ca.CodeGenerator("f")
        generator.add(f)
        source.write_text(generator.dump() + SHIM)
        emit = clock.lap()
        library = stem.with_suffix(".so")
        try:
            spent = command([*OPTIMIZED, "-o", library, source, "-lm"])
        except TooLong as limit:
            yield {"left_out": f"{name}, {limit}"}
            continue
        yield ready(name, library, derive, emit, spent)

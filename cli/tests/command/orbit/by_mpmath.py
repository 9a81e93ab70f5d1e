"""The numbers of `orbit.rs`: periods and Floquet's multipliers to 30 digits, by Taylor series of order 60 in mpmath.

It shares nothing with the program: no derivation, no method, no arithmetic. Run `python3 by_mpmath.py`; it takes mpmath alone.
"""

from mpmath import cos, ellipk, exp, findroot, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 45
ORDER = 50


def series(t, y, rates):
    """Coefficients of y about t: `rates` gives that of order k of the rate from those of y up to order k."""
    coefficients = [list(y)]
    for k in range(ORDER):
        coefficients.append([x / (k + 1) for x in rates(t, coefficients, k)])
    return coefficients


def at(coefficients, h):
    values = [mpf(0)] * len(coefficients[0])
    for row in reversed(coefficients):
        values = [v * h + c for v, c in zip(values, row)]
    return values


def integrate(y, period, rates, steps):
    h = period / steps
    for n in range(steps):
        y = at(series(n * h, y, rates), h)
    return y


def product(a, b, k):
    """The coefficient of order k of a product."""
    return sum((a[j] * b[k - j] for j in range(k + 1)), mpf(0))


def kapitza(g, l, a, omega):
    """Multipliers of upright: theta'' = (g - a omega^2 cos(omega t)) theta/l."""

    def rates(t, y, k):
        # cos(omega t) about t, by its derivatives.
        wave, factor = [], mpf(1)
        for j in range(k + 1):
            wave.append(factor * cos(omega * t + j * pi / 2))
            factor *= omega / (j + 1)
        lift = [-a * omega**2 * x / l for x in wave]
        lift[0] += g / l
        theta = [row[0] for row in y]
        return [y[k][1], product(lift, theta, k)]

    period = 2 * pi / omega
    columns = [integrate(start, period, rates, 16) for start in ([mpf(1), mpf(0)], [mpf(0), mpf(1)])]
    trace = columns[0][0] + columns[1][1]
    root = sqrt(trace**2 / 4 - 1)
    return trace / 2 + root, trace / 2 - root


def van_der_pol(mu):
    """Start, period and multiplier of x'' = mu (1 - x^2) x' - x, with the area of 1 - x^2 beside it."""

    rest = []

    def rates(t, y, k):
        # 1 - x^2 grows with the order.
        if k == 0:
            rest.clear()
        x, v = [row[0] for row in y], [row[1] for row in y]
        rest.append((1 if k == 0 else 0) - product(x, x, k))
        return [v[k], mu * product(rest, v, k) - x[k], mu * rest[k]]

    h = mpf(1) / 16
    # From the right on to where v is 0 again, falling.
    y, t = [mpf(2), mpf(0), mpf(0)], mpf(0)
    before = None
    for _ in range(12):
        y[2], t = mpf(0), mpf(0)
        while True:
            row = series(t, y, rates)
            after = at(row, h)
            if t > 1 and y[1] > 0 >= after[1]:
                part = findroot(lambda s: at(row, s)[1], (mpf(0), h), solver="anderson", tol=mpf(10) ** -45)
                y = at(row, part)
                y[1], t = mpf(0), t + part
                break
            y, t = after, t + h
        if before is not None and abs(y[0] - before) < mpf(10) ** -40:
            break
        before = y[0]
    return y[0], t, exp(y[2])


def show(name, *values):
    print(name, *(nstr(value, 30) for value in values))


g = mpf("9.81")
def trace(a):
    one, other = kapitza(g, mpf(1), a, mpf(88))
    return (one + other).real


show("pendulum from 2 rad, 1 m", 4 * ellipk(sin(mpf(1)) ** 2) / sqrt(g))
show("pendulum from 0.5 rad, 1 m", 4 * ellipk(sin(mpf("0.25")) ** 2) / sqrt(g))
for a, omega in [("0.1", 88), ("0.1", 30), ("0.5", 88)]:
    show(f"Kapitza a = {a}, omega = {omega}", *kapitza(g, mpf(1), mpf(a), mpf(omega)))
show("doubling at omega = 88", findroot(lambda a: trace(a) + 2, (mpf("0.44"), mpf("0.46")), solver="secant"))
show("van der Pol mu = 1", *van_der_pol(mpf(1)))
show("circle", exp(-2 * pi))

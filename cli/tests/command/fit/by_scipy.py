"""What the tests of `lagrangian fit` are held against: SciPy's least squares on closed forms.

Writes the measured tables beside it, and `by_scipy.json` with estimates, covariances and sums of squares.
Run by `python by_scipy.py`; made with NumPy 2 and SciPy 1.
"""

import json
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

HERE = Path(__file__).parent
MASS = 2.0


def oscillator(t, k, c, x0, v0):
    """x and dx/dt of m x'' + c x' + k x = 0, damped weakly."""
    decay = c / (2 * MASS)
    omega = np.sqrt(k / MASS - decay**2)
    b = (v0 + decay * x0) / omega
    e, cos, sin = np.exp(-decay * t), np.cos(omega * t), np.sin(omega * t)
    x = e * (x0 * cos + b * sin)
    v = e * ((omega * b - decay * x0) * cos - (omega * x0 + decay * b) * sin)
    return x, v


def solved(residuals, start):
    found = least_squares(residuals, start, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15, x_scale=np.abs(start))
    # The Jacobian once more, by differences of the sixth order.
    x, columns = found.x, []
    for j in range(len(x)):
        h = 1e-3 * max(abs(x[j]), 1e-2)
        def at(n):
            moved = x.copy()
            moved[j] += n * h
            return residuals(moved)
        columns.append((45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60 * h))
    jacobian = np.array(columns).T
    # One more step of Gauss and Newton.
    x = x - np.linalg.lstsq(jacobian, residuals(x), rcond=None)[0]
    return x, np.linalg.inv(jacobian.T @ jacobian), float(np.sum(residuals(x) ** 2))


def write(name, header, columns):
    rows = zip(*columns)
    cells = lambda row: ",".join("" if np.isnan(x) else repr(float(x)) for x in row)
    (HERE / name).write_text("\n".join([header, *map(cells, rows)]) + "\n")


def main():
    random = np.random.default_rng(20)
    result = {}

    # One coordinate, noise of an unknown size.
    t = np.arange(0, 4.0001, 0.04).round(6)
    x = oscillator(t, 30.0, 0.6, 0.2, -0.5)[0] + random.normal(0, 0.004, t.size)
    x[[7, 31, 32]] = np.nan
    write("oscillator.csv", "t [s],x [m]", [t, x])
    kept = ~np.isnan(x)
    estimate, inverse, total = solved(lambda p: oscillator(t[kept], *p)[0] - x[kept], np.array([25.0, 0.5, 0.15, -0.4]))
    variance = total / (kept.sum() - 4)
    result["oscillator"] = {
        "names": ["k", "c", "start(x)", "rate(x)"],
        "estimate": estimate.tolist(),
        "covariance": (variance * inverse).tolist(),
        "sum": total,
        "count": int(kept.sum()),
    }

    # Two experiments with starts of their own, coordinate and rate with known deviations, one of them at other times.
    sigma = [0.003, 0.02]
    runs = []
    for name, start, times in [("first.csv", (0.3, 0.0), np.arange(0, 3.0001, 0.05)), ("second.csv", (0.0, 2.0), np.arange(0.02, 2.5, 0.07))]:
        times = times.round(6)
        x, v = oscillator(times, 30.0, 0.6, *start)
        x, v = x + random.normal(0, sigma[0], times.size), v + random.normal(0, sigma[1], times.size)
        # In other units.
        write(name, "t [ms],x [mm],der(x) [cm/s]", [(1000 * times).round(3), 1000 * x, 100 * v])
        runs.append((times, x, v))

    def residuals(p):
        all = []
        for (times, x, v), start in zip(runs, (p[2:4], p[4:6])):
            there = oscillator(times, p[0], p[1], *start)
            all += [(there[0] - x) / sigma[0], (there[1] - v) / sigma[1]]
        return np.concatenate(all)

    estimate, inverse, total = solved(residuals, np.array([28.0, 0.5, 0.25, 0.01, 0.01, 1.9]))
    result["two"] = {
        "names": ["k", "c", "start(x) in first", "rate(x) in first", "start(x) in second", "rate(x) in second"],
        "estimate": estimate.tolist(),
        "covariance": inverse.tolist(),
        "sum": total,
        "sigma": sigma,
    }
    (HERE / "by_scipy.json").write_text(json.dumps(result, indent=1) + "\n")


main()

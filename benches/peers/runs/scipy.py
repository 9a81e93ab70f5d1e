"""SciPy: its methods over a right-hand side that heyoka has compiled."""

import time

import heyoka as hy
import numpy as np
from scipy.integrate import solve_ivp

from runs.problem import COMPACT, system


class Peer:
    tools = ("SciPy, DOP853", "SciPy, Radau", "SciPy, LSODA")

    def __init__(self, run):
        self.run = run
        rates = system(run, hy)
        variables = [variable for variable, _ in rates]
        compiled = hy.cfunc([right for _, right in rates], vars=variables, compact_mode=run.name in COMPACT)
        self.rate = lambda t, y: compiled(np.ascontiguousarray(y), time=t)

    def settings(self, tool):
        return (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)[: 5 if tool.endswith("Radau") else 6]

    def call(self, tool, tolerance):
        method = tool.split()[-1]
        clock = time.process_time()
        found = solve_ivp(self.rate, (0.0, self.run.until), self.run.start, method=method, rtol=tolerance, atol=tolerance)
        return time.process_time() - clock, found.y[:, -1] if found.success else None

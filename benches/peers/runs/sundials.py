"""SUNDIALS: CVODES with its Adams and BDF formulas, and IDAS for the implicit equations, all through CasADi."""

import time

import casadi
import numpy as np

from runs.problem import PROBLEMS, Symbols, system

MOST = 1_000_000


class Expressions:
    """CasADi's expressions by the names of heyoka."""

    sin, cos, sqrt = map(staticmethod, (casadi.sin, casadi.cos, casadi.sqrt))

    def __init__(self):
        self.time = casadi.SX.sym("t")

    @staticmethod
    def make_vars(*names):
        return [casadi.SX.sym(name) for name in names]

    expression = staticmethod(casadi.SX)
    sum = staticmethod(lambda terms: sum(terms, start=casadi.SX(0)))


class Peer:
    tools = ("SUNDIALS, CVODES Adams", "SUNDIALS, CVODES BDF", "SUNDIALS, IDAS")

    def __init__(self, run):
        self.run, self.made = run, {}

    def settings(self, _tool):
        return (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)

    def problem(self, tool):
        of = Expressions()
        n = len(self.run.start) // 2
        if tool.endswith("IDAS"):
            x = casadi.SX.sym("x", 2 * n)
            q, v = casadi.vertsplit(x[:n]), casadi.vertsplit(x[n:])
            matrix, right = PROBLEMS[self.run.name][2](Symbols(of), of.time, q, v)
            z = casadi.SX.sym("z", len(right))
            left = [sum((entry * z[j] for j, entry in enumerate(row)), start=casadi.SX(0)) for row in matrix]
            rest = casadi.vertcat(*[a - f for a, f in zip(left, right)])
            return {"x": x, "t": of.time, "z": z, "ode": casadi.vertcat(*v, z[:n]), "alg": rest}
        variables, rates = zip(*system(self.run, of))
        return {"x": casadi.vertcat(*variables), "t": of.time, "ode": casadi.vertcat(*rates)}

    def call(self, tool, tolerance):
        key = tool, tolerance
        if key not in self.made:
            words = {"reltol": tolerance, "abstol": tolerance, "max_num_steps": MOST, "show_eval_warnings": False}
            if "Adams" in tool:
                words |= {"linear_multistep_method": "adams"}
            kind = "idas" if tool.endswith("IDAS") else "cvodes"
            self.made[key] = casadi.integrator("run", kind, self.problem(tool), 0.0, self.run.until, words)
        clock = time.process_time()
        try:
            end = self.made[key](x0=self.run.start)["xf"]
        except RuntimeError:
            return time.process_time() - clock, None
        return time.process_time() - clock, np.array(end).ravel()

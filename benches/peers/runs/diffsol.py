"""diffsol: a right-hand side in its language, compiled by LLVM through its Python package; one explicit and three implicit methods.

The equations are those of the other integrators, simplified by hand where those are.
"""

import time

import numpy as np
import pydiffsol

from runs.problem import system
from runs.text import Graph


def program(run):
    """The text of a model: the state with its start, what is used more than once, and the rates."""
    graph = Graph()
    pairs = system(run, graph)
    lines, rates = graph.text(pairs, {})
    state = ", ".join(f"{variable.text} = {x!r}" for (variable, _), x in zip(pairs, run.start))
    named = [f"{name} {{ {value} }}" for name, value in lines]
    return "\n".join([f"u_i {{ {state} }}", *named, "F_i {", *[f"  {rate}," for rate in rates], "}"])


class Peer:
    tools = {
        "diffsol, TSIT45": pydiffsol.tsit45,
        "diffsol, BDF": pydiffsol.bdf,
        "diffsol, ESDIRK34": pydiffsol.esdirk34,
        "diffsol, TR-BDF2": pydiffsol.tr_bdf2,
    }

    def __init__(self, run):
        self.run = run
        self.ode = pydiffsol.Ode(program(run), matrix_type=pydiffsol.nalgebra_dense)

    def settings(self, tool):
        # The implicit methods have orders from 2 to 5: finer tolerances take them seconds.
        return (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)[: 6 if tool.endswith("TSIT45") else 5]

    def call(self, tool, tolerance):
        ode = self.ode
        ode.ode_solver, ode.rtol, ode.atol = self.tools[tool], tolerance, tolerance
        none = np.array([])
        clock = time.process_time()
        found = ode.solve(none, self.run.until)
        return time.process_time() - clock, found.ys[:, -1]

"""heyoka: Taylor's method for one trajectory and for four in lanes, each with its own steps."""

import time

import heyoka as hy
import numpy as np

from runs.problem import COMPACT, system


class Peer:
    tools = {"heyoka, Taylor": 1, "heyoka, Taylor, batch of 4": 4}
    tolerances = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16)

    def __init__(self, run):
        self.run, self.made = run, {}
        self.system = system(run, hy)

    def settings(self, _tool):
        return self.tolerances

    def call(self, tool, tolerance):
        width = self.tools[tool]
        key = width, tolerance
        start = np.array(self.run.start)
        if key not in self.made:
            words = {"tol": tolerance, "compact_mode": self.run.name in COMPACT}
            self.made[key] = (
                hy.taylor_adaptive(self.system, start, **words)
                if width == 1
                else hy.taylor_adaptive_batch(self.system, np.array([start] * width).T.copy(), **words)
            )
        one = self.made[key]
        if width == 1:
            one.time, one.state[:] = 0.0, start
        else:
            one.set_time(0.0)
            one.state[:] = np.array([start] * width).T
        clock = time.process_time()
        one.propagate_until(self.run.until)
        seconds = (time.process_time() - clock) / width
        return seconds, one.state if width == 1 else one.state[:, 0]

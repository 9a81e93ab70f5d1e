"""DOP853 in C over the same right-hand sides as C, in one file that gcc optimizes for this processor: what an expert writes by hand."""

import ctypes
import subprocess
import tempfile
import time
from pathlib import Path

from scipy.integrate._ivp import dop853_coefficients as tables

from runs.problem import system
from runs.text import Graph

SOURCE = Path(__file__).resolve().parent / "dop853.c"
STAGES = 12


def coefficients():
    row = lambda values: "{" + ", ".join(repr(float(x)) for x in values) + "}"
    matrix = ", ".join(row(tables.A[i][:STAGES]) for i in range(STAGES))
    lines = [f"static const double A[{STAGES}][{STAGES}] = {{{matrix}}};"]
    for name, values in (("B", tables.B), ("C", tables.C), ("E3", tables.E3), ("E5", tables.E5)):
        lines.append(f"static const double {name}[{STAGES}] = {row(values[:STAGES])};")
    return "\n".join(lines)


def rates(run):
    graph = Graph()
    pairs = system(run, graph)
    lines, found = graph.text(pairs, {variable.text: f"y[{i}]" for i, (variable, _) in enumerate(pairs)})
    values = [f"    const double {name} = {value};" for name, value in lines]
    ends = [f"    f[{i}] = {rate};" for i, rate in enumerate(found)]
    head = [f"enum {{ SIZE = {len(found)} }};", "static inline void rates(double t, const double *y, double *f) {", "    (void)t;"]
    return "\n".join([*head, *values, *ends, "}"])


class Peer:
    tools = ("C by hand, DOP853",)

    def __init__(self, run):
        self.run = run
        with tempfile.TemporaryDirectory() as folder:
            at = Path(folder)
            (at / "coefficients.h").write_text(coefficients())
            (at / "rates.h").write_text(rates(run))
            names = [f'-D{name}="{at / file}"' for name, file in (("COEFFICIENTS", "coefficients.h"), ("RATES", "rates.h"))]
            words = [
                "gcc",
                "-O3",
                "-march=native",
                "-fno-math-errno",
                "-shared",
                "-fPIC",
                *names,
                "-o",
                at / "run.so",
                SOURCE,
                "-lm",
            ]
            subprocess.run([str(word) for word in words], check=True)
            self.integrate = ctypes.CDLL(str(at / "run.so")).integrate
        self.integrate.restype = ctypes.c_long
        self.integrate.argtypes = [ctypes.POINTER(ctypes.c_double), ctypes.c_double, ctypes.c_double]

    def settings(self, _tool):
        return [10.0**-k for k in range(3, 16)]

    def call(self, _tool, tolerance):
        y = (ctypes.c_double * len(self.run.start))(*self.run.start)
        clock = time.process_time()
        attempts = self.integrate(y, self.run.until, tolerance)
        return time.process_time() - clock, list(y) if attempts > 0 else None

"""Pinocchio: the articulated-body algorithm over CasADi's symbols, generated as C; and its own compiled algorithm.

The wheel on PyPI does not contain `pinocchio.casadi`; the program pinocchio_codegen.cpp does the same with the same headers.
"""

import os
import subprocess

from peers.common import OPTIMIZED, command, ready

SHIM = """
void eval(const double *y, double t, const double *p, double *qdd) {
    const double *arg[] = {y, &t};
    double *res[] = {qdd};
    f(arg, res, 0, 0, 0);
}
"""


def generate(task, frame, folder):
    """Writes the C and the CasADi function; returns the CPU seconds of both, and the path without its extension."""
    stem = folder / f"aba_{frame}"
    words = [os.environ["PINOCCHIO_CODEGEN"], task, frame, str(stem)]
    printed = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return stem, *map(float, printed.split())


def forms(task, variant, folder):
    for frame in ("local", "world"):
        stem, derive, emit = generate(task, frame, folder)
        source, library = stem.with_suffix(".c"), stem.with_suffix(".so")
        with open(source, "a") as file:
            file.write(SHIM)
        spent = command([*OPTIMIZED, "-o", library, source, "-lm"])
        yield ready(f"ABA ({frame} frames) over CasADi, C", library, derive, emit, spent)

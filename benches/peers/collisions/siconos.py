"""Siconos, in a Python of its own: Debian's package python3-siconos belongs to the system's Python, and others by SICONOS_PYTHON."""

import json
import os
import subprocess
from pathlib import Path

PROGRAM = Path(__file__).resolve().parent / "siconos_program.py"
PYTHON = os.environ.get("SICONOS_PYTHON", "/usr/bin/python3")
SETTINGS = {
    "ball": [1e-2, 1e-3, 1e-4, 1e-5],
    "block": [1e-2, 1e-3, 1e-4, 1e-5],
    "slider": [1e-5, 1e-6, 1e-7],
    "pile": [5e-2, 1e-2, 2e-3],
}


def version():
    found = subprocess.run([PYTHON, str(PROGRAM), "version"], capture_output=True, text=True)
    if found.returncode != 0:
        raise ImportError(f"{PYTHON} has no module siconos (SICONOS_PYTHON names another Python)")
    return found.stdout.split()[-1]


NAME = f"Siconos {version()}, Moreau–Jean"


def said(setting):
    return f"{setting:g} s"


def task(name):
    def call(setting, *_):
        words = [PYTHON, str(PROGRAM), name, repr(setting)]
        lines = subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()
        run = json.loads(next(line for line in lines if line.startswith("{")))
        return run["seconds"], run["value"]

    return call


ball, block, slider, pile = map(task, ("ball", "block", "slider", "pile"))

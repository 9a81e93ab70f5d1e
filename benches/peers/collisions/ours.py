"""Our command. Settings are a tolerance, or words; the seconds are those of the run, without reading and deriving."""

import json
import math
import os
import subprocess
from pathlib import Path

from collisions.heap import measured

ROOT = Path(__file__).resolve().parents[3]
NAME = "here"
SETTINGS = {
    "ball": ["--tolerance 1e-6", "--tolerance 1e-12"],
    "block": ["--tolerance 1e-6", "--tolerance 1e-9", "--tolerance 1e-12"],
    "slider": ["--tolerance 1e-6", "--tolerance 1e-9", "--tolerance 1e-12"],
    "pile": [f"--method moreau --longest-step {step}" for step in ("5e-2", "1e-2", "2e-3")],
}


def said(setting):
    return setting.replace("--", "").replace("longest-step", "steps of")


def simulate(spec, *words):
    command = [os.environ["LAGRANGIAN"], "simulate", str(ROOT / "machines" / "contacts" / f"{spec}.machine"), *words, "--json"]
    return json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)


def ball(setting, until):
    run = simulate("bouncing_ball", "--until", str(until), *setting.split())
    return run["seconds"], [run["q"]["y"]]


def block(setting):
    # The run ends a little after the fall, as those of the others do.
    run = simulate("rocking_block", "--until", "0.5", *setting.split())
    impacts = (event["t"] for event in run["contact_events"] if event["kind"] == "impact")
    return run["seconds"], [next(impacts, math.nan)]


def slider(setting):
    run = simulate("slider_crank_clearance", "--until", "0.009", *setting.split())
    return run["seconds"], [run["q"]["theta1"], run["q"]["theta2"]]


def pile(setting, count, until):
    run = simulate("pile", "--const", f"N={count}", "--until", str(until), *setting.split())
    of = lambda part, name: [run[part][f"{name}[{i}]"] for i in range(1, count + 1)]
    return run["seconds"], measured(of("q", "x"), of("q", "y"), of("v", "x"), of("v", "y"))

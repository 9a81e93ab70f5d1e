#!/usr/bin/env python3
"""The creep of a block that should stick, in MuJoCo and in our command: an incline of 0.3 rad, friction 0.5, 1000 s.

    benches/peers/stick.py COMMAND      COMMAND is the command `lagrangian`; needs mujoco (requirements.txt)
"""

import json
import math
import subprocess
import sys
import time
from pathlib import Path

import mujoco

ROOT = Path(__file__).resolve().parent.parent.parent
ALPHA, GRAVITY, UNTIL = 0.3, 9.81, 1000.0

# The best settings against slip in MuJoCo's manual: elliptic cones, Newton's solver, a high ratio of
# frictional to normal impedance, and the pass that removes slip after each step.
SETTINGS = {
    "default": "",
    "elliptic, impratio 10": 'cone="elliptic" impratio="10"',
    "elliptic, impratio 1000": 'cone="elliptic" impratio="1000"',
    "elliptic, impratio 10, noslip 10": 'cone="elliptic" impratio="10" noslip_iterations="10"',
}


def creep(settings, step):
    """The distance that the block slides down, in m, and MuJoCo's own state after 1000 s."""
    x, z = GRAVITY * math.sin(ALPHA), -GRAVITY * math.cos(ALPHA)
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco>
          <option timestep="{step}" gravity="{x!r} 0 {z!r}" solver="Newton" tolerance="1e-12" {settings}/>
          <worldbody>
            <geom type="plane" size="0 0 1" friction="0.5 0.005 0.0001"/>
            <body pos="0 0 0.1"><freejoint/>
              <geom type="box" size="0.1 0.1 0.1" mass="2" friction="0.5 0.005 0.0001"/></body>
          </worldbody>
        </mujoco>"""
    )
    data = mujoco.MjData(model)
    # The initial settling into the floor is not counted.
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    start = data.qpos[0]
    while data.time < UNTIL:
        mujoco.mj_step(model, data)
    return data.qpos[0] - start


def main():
    print("| | creep in 1000 s [m] | time [s] |")
    print("| --- | --: | --: |")
    for name, settings in SETTINGS.items():
        clock = time.perf_counter()
        slid = creep(settings, 0.002)
        print(f"| MuJoCo {mujoco.__version__}, {name} | {slid:.3e} | {time.perf_counter() - clock:.2f} |")
    clock = time.perf_counter()
    words = [sys.argv[1], "simulate", str(ROOT / "machines/block_on_incline.machine"), "--until", str(UNTIL), "--json"]
    run = json.loads(subprocess.run(words, check=True, capture_output=True).stdout)
    print(f"| here | {run['q']['s']!r} | {time.perf_counter() - clock:.2f} |")


if __name__ == "__main__":
    main()

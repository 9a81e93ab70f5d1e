import os
from pathlib import Path

import pytest

import lagrangian as lg

# Under the load of other tests Ray needs more than its default of half a minute to start.
os.environ.setdefault("RAY_raylet_start_wait_time_s", "180")

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def machines() -> Path:
    return ROOT / "machines"


@pytest.fixture
def pendulum(machines: Path) -> lg.Machine:
    return lg.load(machines / "simple_pendulum.machine")


@pytest.fixture
def double(machines: Path) -> lg.Machine:
    return lg.load(machines / "double_pendulum.machine")


#: A mass on a spring, driven by a force.
OSCILLATOR = """
/// A mass on a spring.
machine Oscillator in plane {
    parameters { m: kg = 2, k: N/m = 8 }
    coordinates { x: m = 1 }
    inputs { force: N }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    forces { push { on: x, value: force } }
    outputs { pull: N = k*x }
    gravity none;
}
"""


@pytest.fixture
def oscillator() -> lg.Machine:
    return lg.loads(OSCILLATOR)

"""The time of calls from Python: `python python/benches/figures.py` in a clone, with the package installed."""

import pickle
import time
from pathlib import Path

import numpy as np

import lagrangian as lg

MACHINES = Path(__file__).resolve().parents[2] / "machines"
STATES = 100_000


def least(work, times=7):
    """The least time of several runs, in s."""
    found = []
    for _ in range(times):
        began = time.perf_counter()
        work()
        found.append(time.perf_counter() - began)
    return min(found)


def main():
    lg.set_threads(1)
    print("| machine | load | one state | a state of a batch | simulate(1), 100 samples | pickled |")
    print("| --- | --: | --: | --: | --: | --: |")
    for name in ("double_pendulum", "crusher9"):
        text = (MACHINES / f"{name}.machine").read_text()
        # The text must differ each time, because a process derives equal texts only once.
        texts = iter(f"{text}\n// {number}" for number in range(100))
        load = least(lambda: lg.loads(next(texts)))
        machine = lg.loads(text)
        q, v = np.array(machine.start.q) + 0.1, np.array(machine.start.v) + 0.1

        def calls():
            for _ in range(10_000):
                machine.accelerations(q, v)

        calls()
        states = [np.tile(of, (STATES, 1)) for of in (q, v)]
        out = np.empty_like(states[0])
        batch = least(lambda: machine.accelerations(*states, out=out))
        instants = np.linspace(0, 1, 100)
        run = least(lambda: machine.simulate(1, at=instants))
        print(
            f"| {name} | {load * 1e3:.1f} ms | {least(calls) / 1e4 * 1e6:.2f} µs | {batch / STATES * 1e9:.0f} ns "
            f"| {run * 1e3:.2f} ms | {len(pickle.dumps(machine))} B |"
        )


if __name__ == "__main__":
    main()

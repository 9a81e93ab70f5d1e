"""The overhead of a sweep on a cluster: `python python/benches/cluster.py [threads ray dask]` in a clone, with the package and these installed.

It measures the overhead of a chunk, with chunks of one short run, and the efficiency of two workers against one, with chunks of about a second.
"""

import json
import sys
import time
from pathlib import Path

import lagrangian as lg
from lagrangian._sweep import _engine, _whole_chunk, _Work

MACHINE = Path(__file__).resolve().parents[2] / "machines" / "double_pendulum.machine"
SHORT = 2000
LONG = 24


def plan_of(machine, until, count, length):
    """The plan of a sweep in chunks of this many runs, and how many chunks there are."""
    plan = json.loads(machine.sweep({"start(theta1)": (0.1, 3.0, 2)}, until=until, progress=False).plan)
    plan["design"] = [{"grid": {"name": "start(theta1)", "from": 0.1, "to": 3.0, "count": count, "log": False}}]
    plan["chunk"] = length
    return json.dumps(plan), -(-count // length)


def seconds(engine, plan, chunks, workers):
    """The time for all chunks of a plan."""
    began = time.perf_counter()
    made = sum(1 for _ in _engine(engine)(_Work(_whole_chunk), plan, range(chunks), workers))
    assert made == chunks
    return time.perf_counter() - began


def again(engine, workers):
    """Starts workers that derive the machine before the time is measured; None for an engine with its own workers."""
    if engine == "ray":
        import ray

        ray.shutdown()
        ray.init(num_cpus=workers, include_dashboard=False, log_to_driver=False)
        return engine
    if engine == "dask":
        import distributed

        return distributed.Client(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None)
    return None


def main(engines):
    machine = lg.load(MACHINE)
    short, short_chunks = plan_of(machine, 0.001, SHORT, 1)
    # The number of runs that takes about a second.
    tried, _ = plan_of(machine, 100.0, 16, 16)
    lg.run_chunk(tried, 0)
    began = time.perf_counter()
    lg.run_chunk(tried, 0)
    length = max(1, round(16 / (time.perf_counter() - began)))
    long, long_chunks = plan_of(machine, 100.0, length * LONG, length)
    began = time.perf_counter()
    for chunk in range(200):
        lg.run_chunk(short, chunk)
    alone = (time.perf_counter() - began) / 200
    print("| engine | overhead of a chunk | one worker | two workers | efficiency |")
    print("| --- | --: | --: | --: | --: |")
    for engine in engines:
        taken = []
        for workers in (1, 2):
            on = again(engine, workers)
            seconds(on, short, min(short_chunks, 50 * workers), workers)
            if workers == 1:
                overhead = seconds(on, short, short_chunks, workers) / short_chunks - alone
            taken.append(seconds(on, long, long_chunks, workers))
            if engine == "dask":
                on.close()
        one, two = taken
        print(f"| {engine} | {overhead * 1e3:.2f} ms | {one:.1f} s | {two:.1f} s | {one / two / 2:.2f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or ["threads", "ray", "dask"])

"""A worker that is killed during a run loses nothing."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest

#: Runs of a few milliseconds each, in at least eight chunks.
VARY = {"start(theta1)": (-3.0, 3.0, 400)}


def same(there, here):
    assert not len(there.failed)
    for name in there.columns:
        if there[name].dtype == object:
            assert there[name].tolist() == here[name].tolist()
        else:
            np.testing.assert_array_equal(there[name], here[name])


def ray_workers():
    """The processes that compute chunks."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            name = (process / "cmdline").read_bytes()
        except OSError:
            continue
        if name.startswith((b"ray::_whole_chunk", b"ray::_chunk_file")):
            found.append(int(process.name))
    return found


@pytest.mark.skipif(not Path("/proc/self/cmdline").exists(), reason="workers are looked up in /proc")
@pytest.mark.parametrize("is_kept", [False, True])
def test_a_worker_of_ray_that_is_killed_has_its_chunks_made_again(double, tmp_path, is_kept):
    ray = pytest.importorskip("ray")
    here = double.sweep(VARY, until=4, threads=1)
    killed = []

    def kill(fraction, done, parts):
        busy = ray_workers()
        if fraction >= 0.1 and not killed and busy:
            killed.append(busy[0])
            os.kill(busy[0], signal.SIGKILL)

    out = tmp_path / "rows.csv" if is_kept else None
    try:
        there = double.sweep(VARY, until=4, engine="ray", threads=2, progress=kill, out=out)
    finally:
        ray.shutdown()
    assert killed, "no worker was busy"
    same(there, here)


def test_a_worker_of_dask_that_is_killed_has_its_chunks_made_again(double):
    distributed = pytest.importorskip("distributed")
    here = double.sweep(VARY, until=4, threads=1)
    killed = []
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            workers = client.run(os.getpid)

            def kill(fraction, done, parts):
                if done >= 2 and not killed:
                    killed.append(next(iter(workers.values())))
                    os.kill(killed[0], signal.SIGKILL)

            there = double.sweep(VARY, until=4, engine=client, progress=kill)
    assert killed
    same(there, here)

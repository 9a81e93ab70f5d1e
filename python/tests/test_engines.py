"""A worker that is killed in mid-run loses nothing."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest

ray = pytest.importorskip("ray")
pytestmark = pytest.mark.skipif(not Path("/proc/self/cmdline").exists(), reason="workers are looked up in /proc")


def workers():
    """The processes that make chunks."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            name = (process / "cmdline").read_bytes()
        except OSError:
            continue
        if name.startswith(b"ray::_whole_chunk"):
            found.append(int(process.name))
    return found


def test_a_worker_that_is_killed_has_its_chunks_made_again(double):
    vary = {"start(theta1)": (-3.0, 3.0, 400)}
    here = double.sweep(vary, until=4, threads=1)
    killed = []

    def kill(fraction, done, chunks):
        busy = workers()
        if done >= 3 and not killed and busy:
            killed.append(busy[0])
            os.kill(busy[0], signal.SIGKILL)

    try:
        there = double.sweep(vary, until=4, engine="ray", threads=2, progress=kill)
    finally:
        ray.shutdown()
    assert killed, "no worker was busy"
    assert not len(there.failed)
    for name in there.columns:
        if there[name].dtype == object:
            assert there[name].tolist() == here[name].tolist()
        else:
            np.testing.assert_array_equal(there[name], here[name])

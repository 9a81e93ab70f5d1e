"""Functions that all builders of peers share."""

import resource
import subprocess
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
OPTIMIZED = ["gcc", "-O3", "-march=native", "-shared", "-fPIC"]
# CPU seconds that a C compiler may take for one file (T4).
COMPILE_LIMIT = 120


class TooLong(Exception):
    """A limit of T4 was reached."""


class Clock:
    """CPU seconds of this process since the last call."""

    def __init__(self):
        self.before = time.process_time()

    def lap(self):
        now = time.process_time()
        spent, self.before = now - self.before, now
        return spent


def command(words, limit=COMPILE_LIMIT, cwd=None, what="compiling"):
    """Runs a command; returns its CPU seconds, including child processes."""
    # The limit of the calling process (`run --limit`) cannot be raised.
    given = resource.getrlimit(resource.RLIMIT_CPU)[1]
    if given != resource.RLIM_INFINITY:
        limit = max(1, min(limit, given - 1))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)

    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))

    done = subprocess.run(
        [str(word) for word in words], cwd=cwd, preexec_fn=limited, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode != 0:
        if spent > 0.9 * limit:
            raise TooLong(f"{what}: more than {limit} s")
        raise RuntimeError(done.stdout.decode(errors="replace")[-3000:])
    return spent


def ready(name, library, derive, emit, compile_):
    """One form of a task, ready to be called."""
    return {
        "form": name,
        "library": str(library),
        "derive_s": derive,
        "emit_s": emit,
        "compile_s": compile_,
        "ready_s": derive + emit + compile_,
    }

#!/usr/bin/env python3
"""Loops against straight code: the chain of the peers' benchmark, compiled both ways.

    cargo build --release -p lagrangian-cli
    benches/loops.py target/release/lagrangian [12 16 24 32 64]

For each number of links: CPU seconds from the text to the library (rustc is nearly all of it), kilobytes of Rust, and
nanoseconds for a state, alone and in lanes of four; each straight, then with loops. Independent calls at 32 random states, the
median of 101 passes, the lower of two rounds. Needs gcc; says so if any bit differs.
"""

import ctypes
import pathlib
import resource
import subprocess
import sys
import tempfile

SPEC = pathlib.Path(__file__).parent / "peers" / "chain.machine"

LOOP = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
enum { STATES = 32, PASSES = 101, CALLS = 256 };
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * t.tv_sec + t.tv_nsec;
}
static int less(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
/* to: ns alone, ns in lanes, and behind them all results. */
int measure(const char *path, int n, double *to) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) return 1;
    void (*setup)(const double *) = (void (*)(const double *))dlsym(library, "eval_setup");
    void (*one)(const double *, double, const double *, double *) =
        (void (*)(const double *, double, const double *, double *))dlsym(library, "eval");
    void (*four)(const double *, const double *, const double *, double *) =
        (void (*)(const double *, const double *, const double *, double *))dlsym(library, "eval4");
    static double y[STATES * 2 * 64 * 4], t[4], sample[PASSES];
    srand(20260001);
    for (size_t i = 0; i < sizeof y / sizeof *y; ++i) y[i] = 6.0 * rand() / RAND_MAX - 3.0;
    setup(0);
    double *results = to + 2;
    for (int pass = 0; pass < PASSES; ++pass) {
        double start = now();
        for (int call = 0; call < CALLS; ++call)
            one(y + (call % STATES) * 2 * n, 0.0, 0, results + (call % STATES) * n);
        sample[pass] = (now() - start) / CALLS;
    }
    qsort(sample, PASSES, sizeof *sample, less);
    to[0] = sample[PASSES / 2];
    results += STATES * n;
    for (int pass = 0; pass < PASSES; ++pass) {
        double start = now();
        for (int call = 0; call < CALLS; ++call)
            four(y + (call % STATES) * 8 * n, t, 0, results + (call % STATES) * 4 * n);
        sample[pass] = (now() - start) / CALLS / 4;
    }
    qsort(sample, PASSES, sizeof *sample, less);
    to[1] = sample[PASSES / 2];
    return 0;
}
"""


def build(command, links, folder, straight):
    """A library: its path, CPU seconds, bytes of Rust."""
    library = folder / f"chain{links}{'s' if straight else 'l'}.so"
    source = library.with_suffix(".rs")
    call = [command, "library", SPEC, "--const", f"N={links}", "--out", library, "--source", source]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(call + ["--straight"] * straight, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    machine = source.read_text().split("mod machine {", 1)[1].split("// What the library exports.", 1)[0]
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return library, seconds, len(machine)


def main():
    command, *sizes = sys.argv[1:]
    sizes = [int(size) for size in sizes] or [8, 12, 16, 24, 32, 64]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "loop.c").write_text(LOOP)
        subprocess.run(["gcc", "-O2", "-shared", "-fPIC", "-o", folder / "loop.so", folder / "loop.c", "-ldl"], check=True)
        loop = ctypes.CDLL(str(folder / "loop.so"))
        print("| N | CPU s, straight | loops | kB, straight | loops | ns, straight | loops | ns in lanes, straight | loops |")
        print("| --: " * 9 + "|")
        for links in sizes:
            rows = [build(command, links, folder, straight) for straight in (True, False)]
            numbers = [(ctypes.c_double * (2 + 32 * 5 * links))() for _ in rows]
            times = [[float("inf")] * 2 for _ in rows]
            for _ in range(2):
                for (library, _, _), to, best in zip(rows, numbers, times):
                    if loop.measure(str(library).encode(), links, to):
                        sys.exit(f"{library} cannot be loaded")
                    best[:] = map(min, best, to[:2])
            cells = [f"{row[1]:.2f}" for row in rows] + [f"{row[2] / 1000:.0f}" for row in rows]
            cells += [f"{of[i]:.0f}" for i in range(2) for of in times]
            print(f"| {links} | " + " | ".join(cells) + " |", flush=True)
            if bytes(numbers[0])[16:] != bytes(numbers[1])[16:]:
                sys.exit(f"{links} links: the bits differ")


if __name__ == "__main__":
    main()

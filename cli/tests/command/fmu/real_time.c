/* The time that a unit takes for each of 20000 steps of a millisecond, in microseconds: the median, the 99.9th percentile,
   and the maximum. */
#include "fmi3Functions.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { STEPS = 20000 };

static double times[STEPS];

static double now(void) {
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    return 1e6 * at.tv_sec + 1e-3 * at.tv_nsec;
}

static int by_size(const void *a, const void *b) {
    const double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

int main(void) {
    bool event, terminate, early;
    double last;
    fmi3Instance unit = fmi3InstantiateCoSimulation("a", TOKEN, NULL, false, false, false, false, NULL, 0, NULL, NULL, NULL);
    if (!unit || fmi3EnterInitializationMode(unit, true, 1e-6, 0.0, false, 0.0) != fmi3OK) return 1;
    if (fmi3ExitInitializationMode(unit) != fmi3OK) return 2;
    for (int k = 0; k < STEPS; ++k) {
        const double before = now();
        if (fmi3DoStep(unit, 1e-3 * k, 1e-3, true, &event, &terminate, &early, &last) > fmi3Warning) return 3;
        times[k] = now() - before;
    }
    qsort(times, STEPS, sizeof *times, by_size);
    printf("%.1f us in the median, %.1f us but for one in a thousand, %.1f us at most\n", times[STEPS / 2],
           times[STEPS - STEPS / 1000], times[STEPS - 1]);
    fmi3FreeInstance(unit);
    return 0;
}

/* Many units in one process: each gives the same bits as alone, in whatever order they are stepped, and in several threads at once. The
   driver defines the units: `begin_unit(k)`, `step_unit(unit, k of STEPS)`, `state_of(unit, to)`, `end_unit(unit)`. */
#include <pthread.h>

enum { UNITS = 48, THREADS = 4 };

static double alone[UNITS][2 * MOST], among[UNITS][2 * MOST];

static void run_many(int from, int to) {
    Unit units[UNITS];
    for (int k = from; k < to; ++k) units[k] = begin_unit(k);
    /* In a different order at each step. */
    for (int step = 0; step < STEPS; ++step)
        for (int k = from; k < to; ++k) step_unit(units[from + (k * 5 + step) % (to - from)], step);
    for (int k = from; k < to; ++k) {
        state_of(units[k], among[k]);
        end_unit(units[k]);
    }
}

static void *run_share(void *share) {
    const int size = UNITS / THREADS, from = size * *(const int *)share;
    run_many(from, from + size);
    return NULL;
}

static void check_many(void) {
    pthread_t threads[THREADS];
    int shares[THREADS];
    for (int k = 0; k < UNITS; ++k) {
        Unit unit = begin_unit(k);
        for (int step = 0; step < STEPS; ++step) step_unit(unit, step);
        state_of(unit, alone[k]);
        end_unit(unit);
        must(k == 0 || memcmp(alone[k], alone[k - 1], 2 * n * sizeof(double)), 80);
    }
    run_many(0, UNITS);
    must(!memcmp(alone, among, sizeof alone), 81);
    memset(among, 0, sizeof among);
    for (int k = 0; k < THREADS; ++k) {
        shares[k] = k;
        must(!pthread_create(&threads[k], NULL, run_share, &shares[k]), 82);
    }
    for (int k = 0; k < THREADS; ++k) must(!pthread_join(threads[k], NULL), 82);
    must(!memcmp(alone, among, sizeof alone), 83);
}

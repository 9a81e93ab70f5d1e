/* Steps that are symmetric about turning points, near which a formula has two sign changes: oscillations whose maxima are in the middle of a
   communication step, in co-simulation by FMI 3.0. */
#include "steps3.h"
#include <math.h>
#include <string.h>

/* The references of x, y and their rates, and the distance of the events' thresholds below the maxima. */
enum { AT_STATES = 1, AT_DEPTH = 10 };

static struct {
    char what[8];
    double t;
} told[256];
static int told_count;

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)status, (void)category;
    must(sscanf(message, "at t = %lf s event %7[a-z]", &told[told_count % 256].t, told[told_count % 256].what) == 2, 90);
    ++told_count;
}

/* Two instants about each turning point, at a known distance from it, within a bound. */
static void compare(const char *what, double first, double apart, double before, double bound, double until) {
    int count = 0;
    for (int k = 0; k < told_count; ++k) {
        if (strcmp(told[k].what, what)) continue;
        const double turn = first + apart * (count / 2), known = count % 2 ? turn + before : turn - before;
        if (!(fabs(told[k].t - known) <= bound)) fprintf(stderr, "%s %d at %.17g, known %.17g\n", what, count, told[k].t, known);
        must(fabs(told[k].t - known) <= bound, 20);
        ++count;
    }
    const int known = 2 * (int)floor((until - first) / apart + 1.0);
    if (count != known) fprintf(stderr, "%d of %s, known %d\n", count, what, known);
    must(count == known, 21);
}

int main(void) {
    static const double tolerances[] = {1e-4, 1e-6, 1e-8};
    static const int all_parts[] = {5, 6, 12, 40};
    for (int way = 0; way < 24; ++way) {
        /* x = cos(t - t0) and y = 0.3 cos(2 (t - t0)) have their maxima in the middle of a communication step, once per period. */
        const int parts = all_parts[way / 6], steps = 3 * parts, stops = way % 2;
        const double tolerance = tolerances[way / 2 % 3], turn = 2.0 * acos(-1.0), h = turn / parts, depth = 1e3 * tolerance;
        const double first = (parts / 2 + 0.5) * h;
        const double start[] = {cos(first), 0.3 * cos(2.0 * first), sin(first), 0.6 * sin(2.0 * first)};
        double last = 0.0;
        fmi3Instance unit = fmi3InstantiateCoSimulation("a", TOKEN, NULL, false, true, stops, stops, NULL, 0, NULL, hear, NULL);
        must(unit != NULL, 3);
        told_count = 0;
        well(fmi3EnterInitializationMode(unit, true, tolerance, 0.0, false, 0.0), 4);
        for (unsigned i = 0; i < 4; ++i) well(fmi3SetFloat64(unit, &(unsigned){AT_STATES + i}, 1, &start[i], 1), 5);
        well(fmi3SetFloat64(unit, &(unsigned){AT_DEPTH}, 1, &depth, 1), 5);
        well(fmi3ExitInitializationMode(unit), 5);
        if (stops) well(fmi3EnterStepMode(unit), 6);
        for (int k = 0; k < steps;) {
            const double until = h * (k + 1);
            step(unit, until, &last);
            if (last >= until * (1.0 - 1e-15)) ++k;
        }
        /* About 250 steps have an error of at most 500 times the tolerance, which is half the depth, so an instant has an error of at most a
           quarter of its distance from the turning point. cos(s) + 0.3 cos(2 s) = 1.3 - depth is a quadratic equation for cos(s). */
        const double one = acos(1.0 - depth), both = acos((sqrt(1.0 + 2.4 * (1.6 - depth)) - 1.0) / 1.2);
        compare("one", first, turn, one, 0.25 * one, last);
        compare("both", first, turn, both, 0.25 * both, last);
        fmi3FreeInstance(unit);
    }
    return 0;
}

/* A wheel that rotates uniformly, and many times between two communication points, in co-simulation by FMI 3.0: it is upright at each half
   turn, and too low once per turn. */
#include "steps3.h"
#include <float.h>
#include <math.h>
#include <string.h>

#define MOST 4096

static double events[MOST], facts[MOST];
static int event_count, fact_count;

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    double t;
    char word[16];
    (void)environment, (void)status, (void)category;
    if (sscanf(message, "at t = %lf s event %15[a-z]", &t, word) == 2) events[event_count++ % MOST] = t;
    else if (sscanf(message, "at t = %lf s it no longer %15[a-z]", &t, word) == 2) facts[fact_count++ % MOST] = t;
}

/* Compares each instant, to the accuracy of 1e-13 s plus the rounding of an angle after so many turns and steps. */
static void compare(const char *what, const double *found, int count, double first, double apart, double until, int rule) {
    const int known = (int)floor((until - first) / apart) + 1;
    if (count != known) fprintf(stderr, "%d of %s, known %d\n", count, what, known);
    must(count == known, rule);
    for (int k = 0; k < count; ++k) {
        const double t = first + k * apart;
        if (!(fabs(found[k] - t) <= 1e-13 + 64.0 * DBL_EPSILON * (1.0 + until)))
            fprintf(stderr, "%s %d at %.17g, known %.17g\n", what, k, found[k], t);
        must(fabs(found[k] - t) <= 1e-13 + 64.0 * DBL_EPSILON * (1.0 + until), rule);
    }
}

int main(void) {
    static const struct {
        double length, until;
    } ways[] = {{1.0, 20.0}, {10.0, 100.0}, {100.0, 100.0}, {1000.0, 1000.0}};
    static const double tolerances[] = {1e-2, 1e-6, 1e-12};
    const double pi = acos(-1.0);
    for (int way = 0; way < 24; ++way) {
        const double length = ways[way / 6].length, until = ways[way / 6].until;
        const int stops = way % 2;
        /* Stopping at each of thousands of events, and searching the rest of the step each time, takes seconds. */
        if (stops && until > 100.0) continue;
        double last = 0.0;
        fmi3Instance unit = fmi3InstantiateCoSimulation("a", TOKEN, NULL, false, true, stops, stops, NULL, 0, NULL, hear, NULL);
        must(unit != NULL, 3);
        event_count = fact_count = 0;
        well(fmi3EnterInitializationMode(unit, true, tolerances[way / 2 % 3], 0.0, false, 0.0), 4);
        well(fmi3ExitInitializationMode(unit), 5);
        if (stops) well(fmi3EnterStepMode(unit), 6);
        while (last < until) {
            step(unit, length * (floor(last / length + 1e-9) + 1.0), &last);
        }
        /* phi = 0.3 + 10 t; cos(phi) = 0 at odd quarters of a turn, and sin(phi) falls to -1/2 at 7/12 of each turn. */
        compare("events", events, event_count, (0.5 * pi - 0.3) / 10.0, pi / 10.0, until, 20);
        compare("facts", facts, fact_count, (7.0 * pi / 6.0 - 0.3) / 10.0, pi / 5.0, until, 21);
        fmi3FreeInstance(unit);
    }
    return 0;
}

/* Two sign changes within one step: a ball that is above a height for some milliseconds, and a pendulum that is beyond an angle for a short
   time, both as events and as facts, in co-simulation by FMI 3.0 with communication steps of several lengths. */
#include "events.h"
#include "steps3.h"

/* Events: above 2.4585 m and beyond -0.9999 rad; facts: below 2.4587 m, before -0.99999 rad, and at least 1 m high. */
enum { TOP, EDGE, COUNTED };
enum { AT_GRAZES = 15 };

typedef struct {
    char what[16];
    double t;
} Told;

static Told told[64];
static int told_count;

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment;
    Told *one = &told[told_count++ % 64];
    if (sscanf(message, "at t = %lf s event %15[a-z]", &one->t, one->what) == 2) {
        must(status == fmi3OK && !strcmp(category, "logEvents"), 70);
    } else {
        char text[64];
        must(sscanf(message, "at t = %lf s it no longer holds that %60[^\n]", &one->t, text) == 2, 71);
        must(status == fmi3Warning && !strcmp(category, "logStatusWarning"), 72);
        strncpy(one->what, text, sizeof one->what - 1);
    }
}

/* The instants of one kind, in order. */
static int of(const char *what, double *to) {
    int count = 0;
    for (int k = 0; k < told_count; ++k)
        if (!strncmp(told[k].what, what, strlen(what))) to[count++] = told[k].t;
    return count;
}

static void near(double found, double known, double bound, int rule) {
    if (!(fabs(found - known) <= bound)) fprintf(stderr, "%.17g, known %.17g\n", found, known);
    must(fabs(found - known) <= bound, rule);
}

int main(void) {
    const double g = 9.81, v = 3.0;
    double one = 1.0, other = cos(0.5);
    for (int k = 0; k < 8; ++k) {
        const double mean = 0.5 * (one + other);
        other = sqrt(one * other), one = mean;
    }
    const double half = acos(-1.0) / sqrt(g / 0.5) / one;
    for (int way = 0; way < 6; ++way) {
        static const double lengths[] = {1.25, 0.625, 0.05};
        const double length = lengths[way / 2];
        const int stops = way % 2;
        double last = 0.0, at[8];
        fmi3Instance unit = fmi3InstantiateCoSimulation("a", TOKEN, NULL, false, true, stops, stops, NULL, 0, NULL, hear, NULL);
        must(unit != NULL, 3);
        told_count = 0;
        well(fmi3EnterInitializationMode(unit, true, 1e-12, 0.0, false, 0.0), 4);
        well(fmi3ExitInitializationMode(unit), 5);
        if (stops) well(fmi3EnterStepMode(unit), 6);
        while (last < 1.25) {
            step(unit, length * (floor(last / length + 1e-9) + 1.0), &last);
        }
        /* With a tolerance of 1e-12 the error of the motion is about 1e-11 by 1.25 s; near its greatest height the ball moves at
           about 0.05 m/s. */
        must(of("top", at) == 2, 20);
        const double above = sqrt(2.0 * (2.0 + v * v / (2.0 * g) - 2.4585) / g);
        near(at[0], v / g - above, 1e-9, 21);
        near(at[1], v / g + above, 1e-9, 22);
        must(of("y < 2.4587", at) == 1, 23);
        near(at[0], v / g - sqrt(2.0 * (2.0 + v * v / (2.0 * g) - 2.4587) / g), 1e-9, 24);
        /* The pendulum turns back at half its period, and is beyond an angle for the same time before and after that. With a = -(g/l)
           sin(theta) it moves by a t^2 / 2 there, reduced by the fraction (w t)^2 / 12, where w^2 = (g/l) cos(theta). */
        must(of("edge", at) == 2, 25);
        near(0.5 * (at[0] + at[1]), half, 1e-9, 26);
        const double beyond = sqrt(2e-4 / (g / 0.5 * sin(1.0)));
        near(0.5 * (at[1] - at[0]), beyond, 1e-4 * beyond, 27);
        must(of("theta", at) == 1, 28);
        near(half - at[0], beyond / sqrt(10.0), 1e-4 * beyond, 29);
        /* A fact that stays broken. */
        must(of("y >= 1", at) == 1, 30);
        near(at[0], (v + sqrt(v * v + 2.0 * g)) / g, 1e-10, 31);
        must(told_count == 7, 32);
        for (int k = 0; k < COUNTED; ++k) {
            int count = 0;
            well(fmi3GetInt32(unit, &(unsigned){AT_GRAZES + k}, 1, &count, 1), 33);
            must(count == 2, 33);
        }
        fmi3FreeInstance(unit);
    }
    return 0;
}

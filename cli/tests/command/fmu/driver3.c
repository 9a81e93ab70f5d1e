/* An importer of FMI 3.0 for one unit: prints what the unit computes, and checks the rules of the standard; the exit status
   is the number of a rule that is broken. Reads the numbers of variables, values, a state, the time and the end. */
#include "fmi3Functions.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 256

/* Counts every allocation of the process. */
static long allocations;
#ifdef __GLIBC__
void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *malloc(size_t size) { return ++allocations, __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return ++allocations, __libc_calloc(count, size); }
#endif

static int n, parameters, inputs, outputs;
static double p[MOST], u[MOST], y[MOST], t, until;
static long messages;

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)category;
    ++messages;
    if (status > fmi3Discard) fprintf(stderr, "%s\n", message);
}

static void must(int holds, int rule) {
    if (holds) return;
    fprintf(stderr, "rule %d is broken\n", rule);
    exit(rule);
}

static void well(fmi3Status status, int rule) { must(status == fmi3OK, rule); }

/* Writes consecutive values, from this reference on. */
static void write_all(fmi3Instance unit, unsigned first, int count, const double *values) {
    for (int i = 0; i < count; ++i) {
        const unsigned reference = first + i;
        well(fmi3SetFloat64(unit, &reference, 1, &values[i], 1), 10);
    }
}

static void read_all(fmi3Instance unit, unsigned first, int count, double *values) {
    unsigned references[2 * MOST];
    for (int i = 0; i < count; ++i) references[i] = first + i;
    well(fmi3GetFloat64(unit, references, count, values, count), 11);
}

static unsigned at_parameters(void) { return 1 + 3 * n; }
static unsigned at_inputs(void) { return at_parameters() + parameters; }
static unsigned at_outputs(void) { return at_inputs() + inputs; }

static void initialize(fmi3Instance unit, double tolerance, const double *start) {
    well(fmi3EnterInitializationMode(unit, true, tolerance, t, false, 0.0), 12);
    write_all(unit, at_parameters(), parameters, p);
    write_all(unit, at_inputs(), inputs, u);
    write_all(unit, 1, 2 * n, start);
    well(fmi3ExitInitializationMode(unit), 13);
}

static fmi3Instance slave(void) {
    fmi3Instance unit = fmi3InstantiateCoSimulation("two", TOKEN, NULL, false, false, false, false, NULL, 0, NULL, hear, NULL);
    must(unit != NULL, 14);
    return unit;
}

static void step(fmi3Instance unit, int k, int of) {
    bool event, terminate, early;
    double last;
    const double from = t + (until - t) * k / of, to = t + (until - t) * (k + 1) / of;
    well(fmi3DoStep(unit, from, to - from, true, &event, &terminate, &early, &last), 15);
    must(last == from + (to - from), 16);
}

static double largest_of(const double *one, const double *other, int count) {
    double largest = 0.0;
    for (int i = 0; i < count; ++i) largest = fmax(largest, fmax(fabs(one[i]), fabs(other[i])));
    return largest;
}

/* Compares directional derivatives of accelerations and outputs with finite differences. */
static void check_derivatives(fmi3Instance unit) {
    unsigned unknowns[2 * MOST];
    const int count = n + outputs;
    for (int i = 0; i < n; ++i) unknowns[i] = 1 + 2 * n + i;
    for (int i = 0; i < outputs; ++i) unknowns[n + i] = at_outputs() + i;
    for (unsigned known = 1; known < at_outputs(); ++known) {
        if (known > 2u * n && known < at_parameters()) continue;
        const double seed = 1.0;
        double exact[2 * MOST], up[2 * MOST], down[2 * MOST], value, states[2 * MOST];
        well(fmi3GetDirectionalDerivative(unit, unknowns, count, &known, 1, &seed, 1, exact, count), 20);
        well(fmi3GetFloat64(unit, &known, 1, &value, 1), 21);
        read_all(unit, 1, 2 * n, states);
        /* The relative error of a central difference is about (h/x)^2 = 1e-10, plus the rounding divided by h: 1e-13 is
           hundreds of roundings. */
        const double h = 1e-5 * (value != 0.0 ? fabs(value) : 1.0);
        for (int side = 0; side < 2; ++side) {
            const double moved = side ? value - h : value + h;
            if (known <= 2u * n) {
                const double before = states[known - 1];
                states[known - 1] = moved;
                well(fmi3SetContinuousStates(unit, states, 2 * n), 22);
                states[known - 1] = before;
            } else {
                well(fmi3SetFloat64(unit, &known, 1, &moved, 1), 22);
            }
            well(fmi3GetFloat64(unit, unknowns, count, side ? down : up, count), 23);
        }
        well(fmi3SetContinuousStates(unit, states, 2 * n), 24);
        if (known > 2u * n) well(fmi3SetFloat64(unit, &known, 1, &value, 1), 24);
        for (int i = 0; i < count; ++i) {
            const double difference = (up[i] - down[i]) / (2.0 * h);
            const double size = largest_of(up, down, count);
            if (!(fabs(exact[i] - difference) <= 1e-6 * fabs(difference) + 1e-13 * size / h)) {
                fprintf(stderr, "of %u by %u: %.17g, by differences %.17g\n", unknowns[i], known, exact[i], difference);
                exit(25);
            }
        }
    }
}

/* Adjoint derivatives must be consistent with directional ones: w (J s) = (w J) s, for weights and seeds without a pattern. */
static void check_adjoint(fmi3Instance unit) {
    unsigned unknowns[3 * MOST], knowns[3 * MOST];
    double w[3 * MOST], s[3 * MOST], along[3 * MOST], back[3 * MOST], one = 0.0, other = 0.0, size = 0.0;
    int count = 0, by = 0;
    for (int i = 0; i < 2 * n; ++i) unknowns[count++] = 1 + n + i;
    for (int i = 0; i < outputs; ++i) unknowns[count++] = at_outputs() + i;
    for (int i = 0; i < 2 * n; ++i) knowns[by++] = 1 + i;
    for (int i = 0; i < parameters + inputs; ++i) knowns[by++] = at_parameters() + i;
    for (int i = 0; i < count; ++i) w[i] = 0.5 + (i * 37 + 11) % 101 / 101.0;
    for (int i = 0; i < by; ++i) s[i] = 0.5 + (i * 53 + 29) % 103 / 103.0;
    well(fmi3GetDirectionalDerivative(unit, unknowns, count, knowns, by, s, by, along, count), 26);
    well(fmi3GetAdjointDerivative(unit, unknowns, count, knowns, by, w, count, back, by), 26);
    for (int i = 0; i < count; ++i) one += w[i] * along[i], size += fabs(w[i] * along[i]);
    for (int i = 0; i < by; ++i) other += back[i] * s[i], size += fabs(back[i] * s[i]);
    must(size > 0.0 && fabs(one - other) <= 1e-12 * size, 27);
}

enum { STEPS = 20 };

typedef fmi3Instance Unit;

/* Units with different starts. */
static Unit begin_unit(int k) {
    double start[MOST];
    memcpy(start, y, sizeof start);
    start[0] += 1e-3 * k;
    Unit unit = slave();
    initialize(unit, 1e-11, start);
    return unit;
}

static void step_unit(Unit unit, int k) { step(unit, k, STEPS); }

static void state_of(Unit unit, double *to) { read_all(unit, 1, 2 * n, to); }

static void end_unit(Unit unit) { fmi3FreeInstance(unit); }

#include "many.h"

int main(void) {
    if (scanf("%d %d %d %d", &n, &parameters, &inputs, &outputs) != 4) return 2;
    for (int i = 0; i < parameters; ++i)
        if (scanf("%lf", &p[i]) != 1) return 2;
    for (int i = 0; i < inputs; ++i)
        if (scanf("%lf", &u[i]) != 1) return 2;
    for (int i = 0; i < 2 * n; ++i)
        if (scanf("%lf", &y[i]) != 1) return 2;
    if (scanf("%lf %lf", &t, &until) != 2) return 2;
    must(!strcmp(fmi3GetVersion(), "3.0"), 3);

    /* Model exchange. */
    must(!fmi3InstantiateModelExchange("x", "another", NULL, false, false, NULL, hear), 4);
    fmi3Instance unit = fmi3InstantiateModelExchange("one", TOKEN, NULL, false, false, NULL, hear);
    must(unit != NULL, 5);
    initialize(unit, 1e-9, y);
    double a[MOST], derivatives[2 * MOST], numbers[MOST];
    read_all(unit, 1 + 2 * n, n, a);
    for (int i = 0; i < n; ++i) printf("%.17g\n", a[i]);
    read_all(unit, at_outputs(), outputs + 2, numbers);
    for (int i = 0; i < outputs + 2; ++i) printf("%.17g\n", numbers[i]);
    well(fmi3EnterContinuousTimeMode(unit), 6);
    well(fmi3SetTime(unit, t), 6);
    well(fmi3SetContinuousStates(unit, y, 2 * n), 6);
    well(fmi3GetContinuousStateDerivatives(unit, derivatives, 2 * n), 7);
    must(!memcmp(derivatives, y + n, n * sizeof *y) && !memcmp(derivatives + n, a, n * sizeof *a), 7);
    check_derivatives(unit);
    check_adjoint(unit);
    /* An unknown reference is an error, but the unit stays usable. */
    long heard = messages;
    const unsigned beyond = 100000;
    double none;
    must(fmi3GetFloat64(unit, &beyond, 1, &none, 1) == fmi3Error && messages == heard + 1, 8);
    must(fmi3SetFloat64(unit, &(unsigned){1 + 2 * n}, 1, &(double){0.0}, 1) == fmi3Error, 8);
    must(fmi3SetFloat64(unit, &(unsigned){at_parameters()}, 1, &(double){NAN}, 1) == fmi3Error, 8);
    fmi3FreeInstance(unit);

    /* Co-simulation: two units side by side, one of which is saved, continues, and is restored. */
    fmi3Instance one = slave(), two = slave();
    initialize(one, 1e-11, y);
    initialize(two, 1e-11, y);
    fmi3FMUState saved = NULL, copied = NULL;
    double first[2 * MOST], other[2 * MOST];
    static unsigned char bytes[1 << 16];
    size_t size = 0;
    const long before = allocations;
    long by_states = 0;
    for (int k = 0; k < STEPS; ++k) {
        if (k == STEPS / 2) {
            const long now = allocations;
            well(fmi3GetFMUState(one, &saved), 30);
            by_states = allocations - now;
        }
        step(one, k, STEPS);
        step(two, k, STEPS);
    }
    must(allocations == before + by_states && by_states <= 1, 31);
    read_all(one, 1, 2 * n, first);
    for (int i = 0; i < 2 * n; ++i) printf("%.17g\n", first[i]);
    read_all(two, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 32);
    well(fmi3SetFMUState(one, saved), 33);
    for (int k = STEPS / 2; k < STEPS; ++k) step(one, k, STEPS);
    read_all(one, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 34);
    well(fmi3SerializedFMUStateSize(one, saved, &size), 35);
    must(size <= sizeof bytes, 35);
    well(fmi3SerializeFMUState(one, saved, bytes, size), 35);
    fmi3Instance three = slave();
    well(fmi3DeserializeFMUState(three, bytes, size, &copied), 36);
    well(fmi3SetFMUState(three, copied), 36);
    for (int k = STEPS / 2; k < STEPS; ++k) step(three, k, STEPS);
    read_all(three, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 37);
    bytes[3] ^= 1;
    must(fmi3DeserializeFMUState(three, bytes, size, &copied) == fmi3Error, 38);
    /* Reset makes it like a new one. */
    well(fmi3Reset(two), 39);
    initialize(two, 1e-11, y);
    for (int k = 0; k < STEPS; ++k) step(two, k, STEPS);
    read_all(two, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 40);
    well(fmi3FreeFMUState(one, &saved), 41);
    well(fmi3FreeFMUState(one, &copied), 41);
    must(!saved && !copied, 41);
    fmi3FreeInstance(one);
    fmi3FreeInstance(two);
    fmi3FreeInstance(three);
    check_many();
    return 0;
}

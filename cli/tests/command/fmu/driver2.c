/* An importer of FMI 2.0 for one unit. Reads the numbers of variables, values, a state, the time and the end; prints accelerations,
   outputs, energies, and the state at the end of a co-simulation, with constant inputs and with inputs that grow by RATE per second. */
#include "fmi2Functions.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 256

static int n, parameters, inputs, outputs;
static double p[MOST], u[MOST], y[MOST], t, until;

static void hear(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                 fmi2String message, ...) {
    (void)environment, (void)name, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

static void must(int holds, int rule) {
    if (holds) return;
    fprintf(stderr, "rule %d is broken\n", rule);
    exit(rule);
}

static void read_all(fmi2Component unit, unsigned first, int count, double *values) {
    unsigned references[2 * MOST];
    for (int i = 0; i < count; ++i) references[i] = first + i;
    must(fmi2GetReal(unit, references, count, values) == fmi2OK, 11);
}

static void write_all(fmi2Component unit, unsigned first, int count, const double *values) {
    unsigned references[2 * MOST];
    for (int i = 0; i < count; ++i) references[i] = first + i;
    must(fmi2SetReal(unit, references, count, values) == fmi2OK, 10);
}

static fmi2Component instance_of(fmi2Type kind) {
    static const fmi2CallbackFunctions callbacks = {hear, calloc, free, NULL, NULL};
    fmi2Component unit = fmi2Instantiate("one", kind, TOKEN, "", &callbacks, fmi2False, fmi2False);
    must(unit != NULL, 5);
    return unit;
}

static void initialize(fmi2Component unit, const double *start) {
    must(fmi2SetupExperiment(unit, fmi2True, 1e-11, t, fmi2False, 0.0) == fmi2OK, 6);
    must(fmi2EnterInitializationMode(unit) == fmi2OK, 7);
    write_all(unit, 1 + 3 * n, parameters, p);
    write_all(unit, 1 + 3 * n + parameters, inputs, u);
    write_all(unit, 1, 2 * n, start);
    must(fmi2ExitInitializationMode(unit) == fmi2OK, 8);
}

static fmi2Component unit_of(fmi2Type kind) {
    fmi2Component unit = instance_of(kind);
    initialize(unit, y);
    return unit;
}

enum { STEPS = 20 };

static void step(fmi2Component unit, int k) {
    const double from = t + (until - t) * k / STEPS;
    must(fmi2DoStep(unit, from, (until - t) / STEPS, fmi2True) == fmi2OK, 15);
}

typedef fmi2Component Unit;

/* Units with different starts. */
static Unit begin_unit(int k) {
    double start[MOST];
    memcpy(start, y, sizeof start);
    start[0] += 1e-3 * k;
    Unit unit = instance_of(fmi2CoSimulation);
    initialize(unit, start);
    return unit;
}

static void step_unit(Unit unit, int k) { step(unit, k); }

static void state_of(Unit unit, double *to) { read_all(unit, 1, 2 * n, to); }

static void end_unit(Unit unit) { fmi2FreeInstance(unit); }

#include "many.h"

/* Two units side by side. One of them is saved, continues, and is restored, also into a third unit from bytes; and a unit that is reset
   is like a new one. */
static void check_states(void) {
    fmi2Component one = unit_of(fmi2CoSimulation), two = unit_of(fmi2CoSimulation);
    fmi2FMUstate saved = NULL, copied = NULL;
    double first[2 * MOST], half[2 * MOST], other[2 * MOST];
    static char bytes[1 << 16];
    size_t size = 0;
    for (int k = 0; k < STEPS; ++k) {
        if (k == STEPS / 2) {
            must(fmi2GetFMUstate(one, &saved) == fmi2OK, 30);
            read_all(one, 1, 2 * n, half);
        }
        step(one, k);
        step(two, k);
    }
    read_all(one, 1, 2 * n, first);
    read_all(two, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first) && memcmp(first, half, 2 * n * sizeof *first), 32);
    must(fmi2SetFMUstate(one, saved) == fmi2OK, 33);
    read_all(one, 1, 2 * n, other);
    must(!memcmp(half, other, 2 * n * sizeof *first), 33);
    for (int k = STEPS / 2; k < STEPS; ++k) step(one, k);
    read_all(one, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 34);
    must(fmi2SerializedFMUstateSize(one, saved, &size) == fmi2OK && size > 0 && size <= sizeof bytes, 35);
    must(fmi2SerializeFMUstate(one, saved, bytes, size) == fmi2OK, 35);
    must(fmi2SerializeFMUstate(one, saved, bytes, size - 1) == fmi2Error, 35);
    fmi2Component three = instance_of(fmi2CoSimulation);
    must(fmi2DeSerializeFMUstate(three, bytes, size, &copied) == fmi2OK, 36);
    must(fmi2SetFMUstate(three, copied) == fmi2OK, 36);
    for (int k = STEPS / 2; k < STEPS; ++k) step(three, k);
    read_all(three, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 37);
    bytes[3] ^= 1;
    must(fmi2DeSerializeFMUstate(three, bytes, size, &copied) == fmi2Error, 38);
    must(fmi2Reset(two) == fmi2OK, 39);
    initialize(two, y);
    for (int k = 0; k < STEPS; ++k) step(two, k);
    read_all(two, 1, 2 * n, other);
    must(!memcmp(first, other, 2 * n * sizeof *first), 40);
    must(fmi2FreeFMUstate(one, &saved) == fmi2OK && fmi2FreeFMUstate(one, &copied) == fmi2OK && !saved && !copied, 41);
    fmi2FreeInstance(one);
    fmi2FreeInstance(two);
    fmi2FreeInstance(three);
}

int main(void) {
    if (scanf("%d %d %d %d", &n, &parameters, &inputs, &outputs) != 4) return 2;
    for (int i = 0; i < parameters; ++i)
        if (scanf("%lf", &p[i]) != 1) return 2;
    for (int i = 0; i < inputs; ++i)
        if (scanf("%lf", &u[i]) != 1) return 2;
    for (int i = 0; i < 2 * n; ++i)
        if (scanf("%lf", &y[i]) != 1) return 2;
    if (scanf("%lf %lf", &t, &until) != 2) return 2;
    fmi2Component unit = unit_of(fmi2ModelExchange);
    double numbers[2 * MOST];
    must(fmi2EnterContinuousTimeMode(unit) == fmi2OK, 9);
    must(fmi2GetDerivatives(unit, numbers, 2 * n) == fmi2OK, 9);
    must(!memcmp(numbers, y + n, n * sizeof *y), 9);
    for (int i = 0; i < n; ++i) printf("%.17g\n", numbers[n + i]);
    read_all(unit, 1 + 3 * n + parameters + inputs, outputs + 2, numbers);
    for (int i = 0; i < outputs + 2; ++i) printf("%.17g\n", numbers[i]);
    fmi2FreeInstance(unit);
    for (int grows = 0; grows < 2; ++grows) {
        unit = unit_of(fmi2CoSimulation);
        for (int k = 0; k < 20; ++k) {
            const double from = t + (until - t) * k / 20;
            for (int i = 0; i < inputs && grows; ++i) {
                const unsigned reference = 1 + 3 * n + parameters + i;
                const double rate = RATE, value = u[i] + rate * (from - t);
                must(fmi2SetReal(unit, &reference, 1, &value) == fmi2OK, 12);
                must(fmi2SetRealInputDerivatives(unit, &reference, 1, &(int){1}, &rate) == fmi2OK, 13);
                must(fmi2SetRealInputDerivatives(unit, &reference, 1, &(int){2}, &rate) == fmi2Error, 14);
            }
            must(fmi2DoStep(unit, from, (until - t) / 20, fmi2True) == fmi2OK, 15);
        }
        read_all(unit, 1, 2 * n, numbers);
        for (int i = 0; i < 2 * n; ++i) printf("%.17g\n", numbers[i]);
        fmi2FreeInstance(unit);
    }
    check_states();
    check_many();
    return 0;
}

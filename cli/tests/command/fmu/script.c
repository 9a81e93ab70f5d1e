/* An importer of one unit in co-simulation, by FMI 2.0 or 3.0 (VERSION), that makes the calls which it reads, a line each:

     new I           makes unit I
     set I REF X     sets a variable                         begin I T TOL   enters and leaves initialization, at a time, with a tolerance
     try I REF X     sets a variable, which must fail        step I T        goes on to a time
     get I REF       prints a variable                       reset I, free I
     save I          saves the state, which must fail

   What a unit says is printed to stderr; a call that fails ends the importer. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if VERSION == 3
#include "fmi3Functions.h"
typedef fmi3Instance Unit;
static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)category;
    fprintf(stderr, "status %d: %s\n", status, message);
}
static Unit make(void) { return fmi3InstantiateCoSimulation("one", TOKEN, NULL, false, true, false, false, NULL, 0, NULL, hear, NULL); }
static Unit integrated(void) { return fmi3InstantiateModelExchange("one", TOKEN, NULL, false, true, NULL, hear); }
static int set(Unit unit, unsigned reference, double x) { return fmi3SetFloat64(unit, &reference, 1, &x, 1); }
static int get(Unit unit, unsigned reference, double *x) { return fmi3GetFloat64(unit, &reference, 1, x, 1); }
static int enter(Unit unit, double t, double tolerance) { return fmi3EnterInitializationMode(unit, true, tolerance, t, false, 0.0); }
static int leave(Unit unit) { return fmi3ExitInitializationMode(unit); }
static int step(Unit unit, double from, double to) {
    bool event, terminate, early;
    double last;
    int status = fmi3DoStep(unit, from, to - from, true, &event, &terminate, &early, &last);
    return status ? status : last != from + (to - from);
}
static int reset(Unit unit) { return fmi3Reset(unit); }
static int save(Unit unit) {
    fmi3FMUState state = NULL;
    return fmi3GetFMUState(unit, &state);
}
static void end(Unit unit) { fmi3FreeInstance(unit); }
#else
#include "fmi2Functions.h"
typedef fmi2Component Unit;
static void hear(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...) {
    (void)environment, (void)name, (void)category;
    va_list rest;
    va_start(rest, message);
    fprintf(stderr, "status %d: ", status);
    vfprintf(stderr, message, rest);
    fprintf(stderr, "\n");
    va_end(rest);
}
static const fmi2CallbackFunctions functions = {hear, calloc, free, NULL, NULL};
static Unit make(void) { return fmi2Instantiate("one", fmi2CoSimulation, TOKEN, NULL, &functions, 0, 1); }
static Unit integrated(void) { return fmi2Instantiate("one", fmi2ModelExchange, TOKEN, NULL, &functions, 0, 1); }
static int set(Unit unit, unsigned reference, double x) { return fmi2SetReal(unit, &reference, 1, &x); }
static int get(Unit unit, unsigned reference, double *x) { return fmi2GetReal(unit, &reference, 1, x); }
static int enter(Unit unit, double t, double tolerance) {
    const int status = fmi2SetupExperiment(unit, 1, tolerance, t, 0, 0.0);
    return status ? status : fmi2EnterInitializationMode(unit);
}
static int leave(Unit unit) { return fmi2ExitInitializationMode(unit); }
static int step(Unit unit, double from, double to) { return fmi2DoStep(unit, from, to - from, 1); }
static int reset(Unit unit) { return fmi2Reset(unit); }
static int save(Unit unit) {
    fmi2FMUstate state = NULL;
    return fmi2GetFMUstate(unit, &state);
}
static void end(Unit unit) { fmi2FreeInstance(unit); }
#endif

enum { MOST = 8 };

int main(void) {
    Unit units[MOST] = {0};
    double now[MOST] = {0};
    char word[16];
    int i;
    if (integrated()) return fprintf(stderr, "it has model exchange\n"), 1;
    for (int line = 1; scanf("%15s %d", word, &i) == 2; ++line) {
        unsigned reference = 0;
        double x = 0.0, tolerance = 0.0;
        int status = 0;
        if (!strcmp(word, "new")) {
            units[i] = make();
            status = !units[i];
        } else if (!strcmp(word, "set") || !strcmp(word, "try")) {
            if (scanf("%u %lf", &reference, &x) != 2) return 2;
            status = set(units[i], reference, x);
            if (word[0] == 't') status = !status;
        } else if (!strcmp(word, "begin")) {
            if (scanf("%lf %lf", &x, &tolerance) != 2) return 2;
            status = enter(units[i], x, tolerance);
            if (!status) status = leave(units[i]);
            now[i] = x;
        } else if (!strcmp(word, "step")) {
            if (scanf("%lf", &x) != 1) return 2;
            status = step(units[i], now[i], x);
            now[i] = x;
        } else if (!strcmp(word, "get")) {
            if (scanf("%u", &reference) != 1) return 2;
            status = get(units[i], reference, &x);
            printf("%.17g\n", x);
        } else if (!strcmp(word, "reset")) {
            status = reset(units[i]);
        } else if (!strcmp(word, "save")) {
            status = !save(units[i]);
        } else if (!strcmp(word, "free")) {
            end(units[i]);
        } else {
            return 2;
        }
        if (status) return fprintf(stderr, "line %d, %s, has the status %d\n", line, word, status), 3;
    }
    return 0;
}

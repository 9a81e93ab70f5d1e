/* Events of a unit of FMI 2.0, in both kinds of units: when and how often they happen. */
#include "fmi2Functions.h"
#include <stdarg.h>
#include "events.h"

static void hear(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category, fmi2String format, ...) {
    (void)environment, (void)name, (void)status;
    va_list arguments;
    va_start(arguments, format);
    listen(category, va_arg(arguments, const char *));
    va_end(arguments);
}

static void well(fmi2Status status, int rule) { must(status == fmi2OK, rule); }

static fmi2Component begin(fmi2Type kind, const fmi2CallbackFunctions *functions) {
    fmi2Component unit = fmi2Instantiate("a", kind, TOKEN, NULL, functions, fmi2False, fmi2True);
    must(unit != NULL, 3);
    well(fmi2SetupExperiment(unit, fmi2True, 1e-14, 0.0, fmi2False, 0.0), 4);
    well(fmi2EnterInitializationMode(unit), 4);
    well(fmi2ExitInitializationMode(unit), 5);
    return unit;
}

static void counted(fmi2Component unit, const int *known, int rule) {
    const unsigned references[EVENTS] = {AT_COUNTS, AT_COUNTS + 1, AT_COUNTS + 2, AT_COUNTS + 3};
    int counts[EVENTS];
    well(fmi2GetInteger(unit, references, EVENTS, counts), rule);
    must(!memcmp(counts, known, sizeof counts), rule);
}

int main(void) {
    const fmi2CallbackFunctions functions = {hear, calloc, free, NULL, NULL};
    fmi2Component unit = begin(fmi2CoSimulation, &functions);
    fmi2FMUstate saved = NULL;
    const int all[EVENTS] = {2, 1, 1, 3}, half[EVENTS] = {2, 1, 1, 1};
    for (int k = 0; k < 8; ++k) {
        if (k == 4) well(fmi2GetFMUstate(unit, &saved), 10);
        well(fmi2DoStep(unit, 0.25 * k, 0.25, fmi2True), 11);
    }
    counted(unit, all, 12);
    compare(heard, heard_count, 13);
    /* Two events remain in the second half of the run. */
    heard_count = 0;
    well(fmi2SetFMUstate(unit, saved), 14);
    counted(unit, half, 14);
    for (int k = 4; k < 8; ++k) well(fmi2DoStep(unit, 0.25 * k, 0.25, fmi2True), 15);
    counted(unit, all, 16);
    must(heard_count == 2, 17);
    must(fmi2SetInteger(unit, &(unsigned){AT_COUNTS}, 1, &(int){1}) == fmi2Error, 18);
    must(fmi2GetInteger(unit, &(unsigned){AT_FACT}, 1, &(int){1}) == fmi2Error, 18);
    well(fmi2FreeFMUstate(unit, &saved), 19);
    fmi2FreeInstance(unit);

    /* Model exchange, in which the importer integrates. */
    unit = begin(fmi2ModelExchange, &functions);
    fmi2EventInfo info;
    fmi2Boolean enter, terminate;
    double states[STATES], indicators[EVENTS + 1];
    well(fmi2NewDiscreteStates(unit, &info), 20);
    well(fmi2EnterContinuousTimeMode(unit), 20);
    for (int k = 0; k < 2; ++k) {
        /* Above 2.3 m; then below it again, and after the lowest point of the pendulum. */
        place(k ? 0.6 : 0.2, k ? -0.5 : 0.5, states);
        well(fmi2SetTime(unit, k ? 0.6 : 0.2), 21);
        well(fmi2SetContinuousStates(unit, states, STATES), 21);
        well(fmi2GetEventIndicators(unit, indicators, EVENTS + 1), 22);
        must(indicators[0] > 1000.0 && fabs(indicators[1] - (states[0] - 2.3)) <= 1e-15, 22);
        must(indicators[1 + BOTTOM] == states[1] && (indicators[1] > 0.0) == !k, 22);
        well(fmi2CompletedIntegratorStep(unit, fmi2True, &enter, &terminate), 23);
        must(enter && !terminate, 23);
        well(fmi2EnterEventMode(unit), 24);
        well(fmi2NewDiscreteStates(unit, &info), 24);
        must(!info.newDiscreteStatesNeeded && !info.valuesOfContinuousStatesChanged, 24);
        const int known[2][EVENTS] = {{1, 0, 0, 0}, {2, 0, 0, 1}};
        counted(unit, known[k], 25);
        well(fmi2EnterContinuousTimeMode(unit), 26);
    }
    fmi2FreeInstance(unit);
    return 0;
}

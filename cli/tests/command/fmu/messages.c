/* A particle in polar coordinates s, phi that moves through the pole: references 1, 2 are the coordinates, 3, 4 their rates, 7
   the parameter l, which determines the start s = 2 l. Prints the messages of the unit, and checks its results. */
#include "fmi3Functions.h"
#include <stdio.h>
#include <stdlib.h>

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment;
    printf("%d %s %s\n", status, category, message);
}

static void must(int holds, int rule) {
    if (holds) return;
    fprintf(stderr, "rule %d is broken\n", rule);
    exit(rule);
}

static double read_one(fmi3Instance unit, unsigned reference) {
    double value;
    must(fmi3GetFloat64(unit, &reference, 1, &value, 1) == fmi3OK, 3);
    return value;
}

static void write_one(fmi3Instance unit, unsigned reference, double value) {
    must(fmi3SetFloat64(unit, &reference, 1, &value, 1) == fmi3OK, 4);
}

int main(void) {
    bool event, terminate, early;
    double last, states[4] = {0.0, 0.0, 1.0, 0.0}, derivatives[4];
    fmi3Instance unit = fmi3InstantiateCoSimulation("a", TOKEN, NULL, false, true, false, false, NULL, 0, NULL, hear, NULL);
    must(unit != NULL, 5);
    must(read_one(unit, 1) == 2.0, 6);
    write_one(unit, 7, 0.5);
    must(read_one(unit, 1) == 1.0, 7);
    must(fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0) == fmi3OK, 8);
    write_one(unit, 7, 0.25);
    must(read_one(unit, 1) == 0.5, 9);
    write_one(unit, 1, 1.0);
    write_one(unit, 7, 4.0);
    must(read_one(unit, 1) == 1.0, 10);
    must(fmi3ExitInitializationMode(unit) == fmi3OK, 11);
    /* Parameters do not change a state once the run has begun. */
    write_one(unit, 7, 3.0);
    must(read_one(unit, 1) == 1.0, 12);
    must(fmi3SetFloat64(unit, &(unsigned){1}, 1, &(double){3.0}, 1) == fmi3Error, 13);
    for (int k = 0; k < 4; ++k)
        must(fmi3DoStep(unit, 0.4 * k, 0.4, true, &event, &terminate, &early, &last) == fmi3OK, 14);
    must(read_one(unit, 1) < -0.59 && read_one(unit, 1) > -0.61, 15);
    fmi3FreeInstance(unit);
    unit = fmi3InstantiateModelExchange("a", TOKEN, NULL, false, false, NULL, hear);
    must(fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0) == fmi3OK, 16);
    must(fmi3ExitInitializationMode(unit) == fmi3OK, 17);
    must(fmi3EnterContinuousTimeMode(unit) == fmi3OK, 18);
    must(fmi3SetContinuousStates(unit, states, 4) == fmi3OK, 19);
    must(fmi3GetContinuousStateDerivatives(unit, derivatives, 4) == fmi3Discard, 20);
    must(fmi3DoStep(unit, 0.0, 0.4, true, &event, &terminate, &early, &last) == fmi3Error, 21);
    fmi3FreeInstance(unit);
    return 0;
}

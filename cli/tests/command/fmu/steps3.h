/* Steps of communication by FMI 3.0, for drivers of co-simulation. */
#include "fmi3Functions.h"
#include "must.h"

static void well(fmi3Status status, int rule) { must(status == fmi3OK, rule); }

/* A step from where the unit is up to an instant or, where it may stop before, up to an event, which is told. */
static void step(fmi3Instance unit, double until, double *at) {
    bool event, terminate, early, again, end, nominals, values, next;
    double when;
    well(fmi3DoStep(unit, *at, until - *at, true, &event, &terminate, &early, at), 7);
    if (!event) return;
    well(fmi3EnterEventMode(unit), 8);
    well(fmi3UpdateDiscreteStates(unit, &again, &end, &nominals, &values, &next, &when), 8);
    well(fmi3EnterStepMode(unit), 8);
}

/* Communication steps of FMI 3.0, for drivers of co-simulation. */
#include "fmi3Functions.h"
#include "must.h"

static void well(fmi3Status status, int rule) { must(status == fmi3OK, rule); }

/* A step from the unit's time up to an instant or, if it may stop early, up to an event, whose
   time is returned. */
static void step(fmi3Instance unit, double until, double *at) {
    bool event, terminate, early, again, end, nominals, values, next;
    double when;
    well(fmi3DoStep(unit, *at, until - *at, true, &event, &terminate, &early, at), 7);
    if (!event) return;
    well(fmi3EnterEventMode(unit), 8);
    well(fmi3UpdateDiscreteStates(unit, &again, &end, &nominals, &values, &next, &when), 8);
    well(fmi3EnterStepMode(unit), 8);
}

/*
 * The part of a unit that does not depend on the version of the interface: its state, access to values by reference, derivatives, and the
 * integrator of co-simulation. This text follows the machine's own file, which defines the numbers and the names of the variables. There are no
 * mutable globals, no threads and no files; memory is allocated only for units and for saved states.
 */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The method of co-simulation: its stages and coefficients. */
#include "method.c"

enum {
    STATES = 2 * COORDINATES,
    /* The formulas of events are the last outputs of the program, after those of the spec. */
    SHOWN = OUTPUTS - EVENTS,
    INDICATORS = FACTS + EVENTS,
    /* What co-simulation watches within steps: the formulas of events, then the facts. */
    WATCHED = EVENTS + FACTS,
    /* Value references, numbered consecutively in this order. */
    AT_TIME = 0,
    AT_STATES = 1,
    AT_ACCELERATIONS = AT_STATES + STATES,
    AT_PARAMETERS = AT_ACCELERATIONS + COORDINATES,
    AT_INPUTS = AT_PARAMETERS + PARAMETERS,
    AT_OUTPUTS = AT_INPUTS + INPUTS,
    AT_MULTIPLIERS = AT_OUTPUTS + SHOWN,
    AT_KINETIC_ENERGY = AT_MULTIPLIERS + CONSTRAINTS,
    AT_POTENTIAL_ENERGY,
    AT_FACTS,
    AT_EVENTS = AT_FACTS + FACTS,
    /* How many times each event has happened, an integer. */
    AT_COUNTS = AT_EVENTS + EVENTS,
    /* Gap, normal force, friction and slip of each contact, which a unit with a run has. */
    AT_CONTACTS = AT_COUNTS + EVENTS,
    OF_CONTACTS = 4 * CONTACTS
};

#ifdef HAS_RUN
/*
 * The run of a machine whose motion depends on which contacts are closed and on what sticks: that of the runtime of lagrangian, compiled from Rust. Each
 * call answers WELL, WARNED or FAILED, and stores what there is to say. A run changes its inputs before it goes on, where they are others than before.
 */
typedef struct Run Run;
int unitRunBegin(Run **to, const double *parameters, const double *inputs, double *states, double t, double tolerance, char *message,
                 size_t size);
int unitRunAdvance(Run *run, const double *inputs, double until, double *t, double *states, char *message, size_t size);
int unitRunObserve(Run *run, const double *inputs, double *accelerations, double *multipliers, double *potential, double *contacts,
                   char *message, size_t size);
void unitRunEnd(Run *run);
#endif

/* A state violates its constraints if a residual exceeds this fraction of the size of its terms. */
#define LEFT 1e-10

/* The result of a call, numbered as in both versions of the interface. */
typedef enum { WELL, WARNED, DISCARDED, FAILED } Outcome;

typedef enum { INSTANTIATED, INITIALIZING, EVENT, CONTINUOUS, STEPPING, TERMINATED } Mode;

/* Everything that changes while a unit runs and that a saved state holds; all other values follow from it. */
typedef struct {
    double time;
    double states[STATES + 1];
    double parameters[PARAMETERS + 1];
    double inputs[INPUTS + 1];
    /* The rates at which inputs change until the next communication point, per s. */
    double input_rates[INPUTS + 1];
    /* Tolerance of each step, relative and absolute. */
    double tolerance;
    /* The length of the next step of co-simulation in s; 0 if it is not known. */
    double step;
    /* Which states the importer has set. The others start at the machine's values, which may depend on parameters. */
    unsigned char is_set[STATES + 1];
    /* Whether the states have been initialized with those of the start. */
    unsigned char is_started;
    /* Which facts were broken when they were last checked. */
    unsigned char is_broken[FACTS + 1];
    /* For each event: the last sign of its formula, 0 before it has one; the sign after a crossing that ended a step of co-simulation and is
       not counted yet, or 0; and how many times the event has happened. */
    signed char side[EVENTS + 1], passed[EVENTS + 1];
    int count[EVENTS + 1];
    /* A formula or a fact has a sign only once it exceeds this size, after a start at its zero or after the projection onto the constraints
       moved it back across a zero; otherwise 0. */
    double leave[WATCHED + 1];
    /* Whether signs must be checked before the next step, because a value was set or a step ended at an event. */
    unsigned char is_unsettled;
    Mode mode;
} State;

/* The maximum number of coefficients of a polynomial of the motion within a step, which is either the method's or of degree five; and the
   number of slopes that it is made of. */
enum { MOST_BENDS = 4 + BENDS > 6 ? 4 + BENDS : 6, SLOPES = STAGES + 1 + FURTHER };

typedef struct Unit Unit;

/* Delivers a message; each version of the interface has its own function. */
typedef void Report(const Unit *unit, Outcome outcome, const char *message);

struct Unit {
    State now;
    /* Values that follow from the parameters, and from the entire state. */
    UnitPrepared prepared;
    UnitTangentPrepared tangent;
    UnitAdjointPrepared adjoint;
    double accelerations[COORDINATES + 1];
    /* Workspace of a projection: the mass matrix or its Cholesky factor L, the constraint matrix G, L^-1 G^T, and the Cholesky factor of
       G W G^T. */
    double mass[COORDINATES * COORDINATES + 1], rows[CONSTRAINTS * COORDINATES + 1], carried[CONSTRAINTS * COORDINATES + 1];
    double normal[CONSTRAINTS * CONSTRAINTS + 1];
    /* The diagonal of the mass matrix; whether the mass matrix has no Cholesky factor; and which rows are left out. */
    double inertia[COORDINATES + 1];
    int is_plain;
    unsigned char is_left[CONSTRAINTS + 1];
    int singular;
    int is_prepared, is_evaluated;
    /* Workspace of a step of co-simulation. */
    double slopes[SLOPES][STATES + 1];
    double point[STATES + 1];
    /* The length of the last attempted step. */
    double tried;
    /* The polynomials of the motion within a step and its end, in which events are searched for. */
    double curve[MOST_BENDS][STATES + 1], end[STATES + 1];
    int bends;
    /* The kind of unit; whether the importer handles events, whether a step may end at an event, and whether the last one did. */
    int is_co_simulation, is_logging, has_event_mode, may_stop, has_stopped;
#ifdef HAS_RUN
    /* The run, once it has begun, and what it says of the present state. */
    Run *run;
    double multipliers[CONSTRAINTS + 1], contacts[OF_CONTACTS + 1], potential;
#endif
    Report *report;
    void *environment;
    void *callback;
    char name[64];
    char message[1024];
};

/* A saved state: the machine that it belongs to, and the bytes. */
typedef struct {
    char token[sizeof TOKEN];
    State state;
} Saved;

/* Ends the run of a unit, if it has begun. */
static void endRun(Unit *unit) {
#ifdef HAS_RUN
    unitRunEnd(unit->run);
    unit->run = NULL;
#endif
    unit->is_evaluated = 0;
}

static void restart(Unit *unit) {
    State *now = &unit->now;
    endRun(unit);
    memset(now, 0, sizeof *now);
    for (int i = 0; i < PARAMETERS; ++i) now->parameters[i] = PARAMETER_DEFAULTS[i];
    for (int i = 0; i < INPUTS; ++i) now->inputs[i] = INPUT_DEFAULTS[i];
    for (int i = 0; i < STATES; ++i) {
        now->is_set[i] = START_IS_SET[i];
        now->states[i] = START[i];
    }
    now->tolerance = TOLERANCE;
    now->mode = INSTANTIATED;
    unit->is_prepared = 0;
    unit->is_evaluated = 0;
}

static Outcome say(Unit *unit, Outcome outcome, const char *message) {
    if (unit->report && (unit->is_logging || outcome >= DISCARDED)) unit->report(unit, outcome, message);
    return outcome;
}

/* Whether x is finite: the difference is NaN for infinities and NaN, and comparisons with NaN are false. */
static int isFinite(double x) { return x - x == 0.0; }

/* Initializes the states that nobody has set, and the values that depend on parameters. */
static void prepare(Unit *unit) {
    if (unit->is_prepared && unit->now.is_started) return;
    unitPrepare(unit->now.parameters, &unit->prepared);
    unit->is_prepared = 1;
    unit->is_evaluated = 0;
    if (unit->now.is_started) return;
    double start[STATES + 1];
    unitStart(unit->now.parameters, start);
    for (int i = 0; i < STATES; ++i)
        if (!unit->now.is_set[i]) unit->now.states[i] = start[i];
    unit->now.is_started = 1;
}

/* The derivatives of the states. Returns 0 if the mass matrix can be inverted and all derivatives are finite. */
static int differentiate(Unit *unit, double t, const double *states, double *to) {
    const double *v = states + COORDINATES;
    double inputs[INPUTS + 1];
    for (int i = 0; i < INPUTS; ++i) inputs[i] = unit->now.inputs[i] + (t - unit->now.time) * unit->now.input_rates[i];
    const int singular = unitAccelerations(&unit->prepared, t, states, v, inputs, to + COORDINATES);
    for (int i = 0; i < COORDINATES; ++i) to[i] = v[i];
    if (singular) return singular;
    for (int i = COORDINATES; i < STATES; ++i)
        if (!isFinite(to[i])) return i - COORDINATES + 1;
    return 0;
}

#ifdef HAS_RUN
/* Begins the run at the present state, if it has not begun. The state of its beginning, which impacts and constraints may have changed, becomes that of
   the unit only once the start is settled. */
static Outcome beginRun(Unit *unit) {
    State *now = &unit->now;
    double states[STATES + 1];
    prepare(unit);
    if (unit->run) return WELL;
    memcpy(states, now->states, sizeof states);
    const int begun = unitRunBegin(&unit->run, now->parameters, now->inputs, states, now->time, now->tolerance, unit->message,
                                   sizeof unit->message);
    if (begun != FAILED && now->mode > INITIALIZING) memcpy(now->states, states, sizeof states);
    return (Outcome)begun;
}
#endif

/* The accelerations at the current state. Returns 0 on success. */
static int evaluate(Unit *unit) {
    prepare(unit);
    if (unit->is_evaluated) return unit->singular;
#ifdef HAS_RUN
    unit->singular = 1;
    if (beginRun(unit) == FAILED) return unit->singular;
    if (unitRunObserve(unit->run, unit->now.inputs, unit->accelerations, unit->multipliers, &unit->potential, unit->contacts,
                       unit->message, sizeof unit->message) == FAILED)
        return unit->singular;
    unit->singular = 0;
#else
    double to[STATES + 1];
    unit->singular = differentiate(unit, unit->now.time, unit->now.states, to);
    memcpy(unit->accelerations, to + COORDINATES, COORDINATES * sizeof *to);
#endif
    unit->is_evaluated = 1;
    return unit->singular;
}

static Outcome withoutAccelerations(Unit *unit, Outcome outcome) {
#ifdef HAS_RUN
    return say(unit, outcome, unit->message);
#endif
    const int i = unit->singular - 1;
    snprintf(unit->message, sizeof unit->message, "at t = %.17g s there is no acceleration of %s: its inertia vanishes, or a "
             "number is not finite", unit->now.time, i >= 0 && i < COORDINATES ? COORDINATE_NAMES[i] : "the machine");
    return say(unit, outcome, unit->message);
}

static Outcome unknown(Unit *unit, unsigned reference) {
    snprintf(unit->message, sizeof unit->message, "there is no variable with the reference %u for this call", reference);
    return say(unit, FAILED, unit->message);
}

/* The formulas of all events at a time and a state. They do not depend on accelerations. */
static void watch(const Unit *unit, double t, const double *states, double *to) {
    double inputs[INPUTS + 1], all[OUTPUTS + 1];
    if (EVENTS == 0) return;
    for (int i = 0; i < INPUTS; ++i) inputs[i] = unit->now.inputs[i] + (t - unit->now.time) * unit->now.input_rates[i];
    unitOutputs(&unit->prepared, t, states, states + COORDINATES, inputs, unit->accelerations, all);
    for (int k = 0; k < EVENTS; ++k) to[k] = all[SHOWN + k];
}

/* The formulas of all events, followed by the expressions that facts declare positive. Neither depends on accelerations. */
static void watchAll(const Unit *unit, double t, const double *states, double *to) {
    double inputs[INPUTS + 1];
    watch(unit, t, states, to);
    if (FACTS == 0) return;
    for (int i = 0; i < INPUTS; ++i) inputs[i] = unit->now.inputs[i] + (t - unit->now.time) * unit->now.input_rates[i];
    unitFacts(&unit->prepared, t, states, states + COORDINATES, inputs, unit->accelerations, to + EVENTS);
}

/* Gets real values by reference. */
static Outcome get(Unit *unit, const unsigned *references, size_t count, double *to) {
    State *now = &unit->now;
    const double *q = now->states, *v = q + COORDINATES, *u = now->inputs, *a = unit->accelerations;
    double several[OUTPUTS + FACTS + CONSTRAINTS + 1];
    prepare(unit);
    for (size_t k = 0; k < count; ++k) {
        const unsigned i = references[k];
        if (i == AT_TIME) {
            to[k] = now->time;
        } else if (i < AT_ACCELERATIONS) {
            to[k] = now->states[i - AT_STATES];
        } else if (i < AT_PARAMETERS) {
            if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
            to[k] = a[i - AT_ACCELERATIONS];
        } else if (i < AT_INPUTS) {
            to[k] = now->parameters[i - AT_PARAMETERS];
        } else if (i < AT_OUTPUTS) {
            to[k] = now->inputs[i - AT_INPUTS];
        } else if (i >= AT_MULTIPLIERS && i < AT_KINETIC_ENERGY) {
            if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
#ifdef HAS_RUN
            to[k] = unit->multipliers[i - AT_MULTIPLIERS];
#else
            if (unitMultipliers(&unit->prepared, now->time, q, v, u, several)) return withoutAccelerations(unit, DISCARDED);
            to[k] = several[i - AT_MULTIPLIERS];
#endif
        } else if (i < AT_MULTIPLIERS) {
            if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
            unitOutputs(&unit->prepared, now->time, q, v, u, a, several);
            to[k] = several[i - AT_OUTPUTS];
        } else if (i == AT_KINETIC_ENERGY) {
            to[k] = unitKineticEnergy(&unit->prepared, now->time, q, v, u);
        } else if (i == AT_POTENTIAL_ENERGY) {
#ifdef HAS_RUN
            if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
            to[k] = unit->potential;
#else
            to[k] = unitPotentialEnergy(&unit->prepared, now->time, q, v, u);
#endif
        } else if (i < AT_EVENTS) {
            unitFacts(&unit->prepared, now->time, q, v, u, a, several);
            to[k] = several[i - AT_FACTS];
        } else if (i < AT_COUNTS) {
            watch(unit, now->time, now->states, several);
            to[k] = several[i - AT_EVENTS];
#ifdef HAS_RUN
        } else if (i >= AT_CONTACTS && i < AT_CONTACTS + OF_CONTACTS) {
            if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
            to[k] = unit->contacts[i - AT_CONTACTS];
#endif
        } else {
            return unknown(unit, i);
        }
    }
    return WELL;
}

/* Gets integers by reference: how many times events happened. */
static Outcome getCounts(Unit *unit, const unsigned *references, size_t count, int *to) {
    for (size_t k = 0; k < count; ++k) {
        const unsigned i = references[k];
        if (i < AT_COUNTS || i >= AT_COUNTS + EVENTS) return unknown(unit, i);
        to[k] = unit->now.count[i - AT_COUNTS];
    }
    return WELL;
}

/* Sets real values by reference: states until the run begins, parameters and inputs at any time. */
static Outcome set(Unit *unit, const unsigned *references, size_t count, const double *values) {
    State *now = &unit->now;
    for (size_t k = 0; k < count; ++k) {
        const unsigned i = references[k];
        const int is_state = i >= AT_STATES && i < AT_ACCELERATIONS && now->mode <= INITIALIZING;
        if (!is_state && (i < AT_PARAMETERS || i >= AT_OUTPUTS)) return unknown(unit, i);
        if (!isFinite(values[k])) {
            snprintf(unit->message, sizeof unit->message, "the value of the variable with the reference %u is not finite", i);
            return say(unit, FAILED, unit->message);
        }
#ifdef HAS_RUN
        if (now->mode <= INITIALIZING) endRun(unit);
        else if (i < AT_INPUTS)
            return say(unit, FAILED, "the parameters of a machine with contacts or guides are fixed once it has been initialized");
#endif
        if (is_state) {
            now->states[i - AT_STATES] = values[k];
            now->is_set[i - AT_STATES] = 1;
        } else if (i < AT_INPUTS) {
            now->parameters[i - AT_PARAMETERS] = values[k];
            unit->is_prepared = 0;
            if (now->mode <= INITIALIZING) now->is_started = 0;
        } else {
            now->inputs[i - AT_INPUTS] = values[k];
        }
        now->is_unsettled = 1;
        unit->is_evaluated = 0;
    }
    return WELL;
}

static void setTime(Unit *unit, double time) {
    endRun(unit);
    unit->now.time = time;
    unit->is_evaluated = 0;
}

static void setStates(Unit *unit, const double *states) {
    prepare(unit); /* Otherwise a later initialization would overwrite them. */
    memcpy(unit->now.states, states, STATES * sizeof *states);
    unit->is_evaluated = 0;
}

/* The derivatives of all states. */
static Outcome getDerivatives(Unit *unit, double *to) {
    if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
    memcpy(to, unit->now.states + COORDINATES, COORDINATES * sizeof *to);
    memcpy(to + COORDINATES, unit->accelerations, COORDINATES * sizeof *to);
    return WELL;
}

/* The expressions that facts declare positive. A change of sign is an event. */
static void getFacts(Unit *unit, double *to) {
    const State *now = &unit->now;
    double all[FACTS + 1];
    (void)evaluate(unit);
    const double *v = now->states + COORDINATES;
    unitFacts(&unit->prepared, now->time, now->states, v, now->inputs, unit->accelerations, all);
    memcpy(to, all, FACTS * sizeof *to);
}

/* All event indicators. A change of sign is an event. */
static void getIndicators(Unit *unit, double *to) {
    getFacts(unit, to);
    watch(unit, unit->now.time, unit->now.states, to + FACTS);
}

/*
 * Events: formulas of the state that change their sign. Zero has no sign. If a run starts at a zero, up to round-off, the sign is the one
 * immediately after the start.
 */

static double sizeOf(double x) { return x < 0.0 ? -x : x; }

static int signOf(double x) { return (x > 0.0) - (x < 0.0); }

/* The sign of an event's formula that has this value at some state of the run; 0 until it has left the zero of the start. */
static int signOfEvent(Unit *unit, int k, double value) {
    if (sizeOf(value) <= unit->now.leave[k]) return 0;
    unit->now.leave[k] = 0.0;
    return signOf(value);
}

/* Whether a fact holds for this value. It does not hold for NaN. */
static int holds(int fact, double value) { return FACT_IS_STRICT[fact] ? value > 0.0 : value >= 0.0; }

/* The sign of any watched value; for a fact the sign says whether it holds. */
static int signOfWatched(Unit *unit, int k, double value) {
    if (k < EVENTS) return signOfEvent(unit, k, value);
    if (sizeOf(value) <= unit->now.leave[k]) return 0;
    unit->now.leave[k] = 0.0;
    return holds(k - EVENTS, value) ? 1 : -1;
}

/* The last sign of a watched value; 0 if it has none yet. */
static int sideOf(const Unit *unit, int k) {
    return k < EVENTS ? unit->now.side[k] : unit->now.is_broken[k - EVENTS] ? -1 : 1;
}

/* Whether a value lies after a change to this sign. */
static int isBehind(int k, int sign, double value) {
    return k < EVENTS ? sign * value > 0.0 : holds(k - EVENTS, value) == (sign > 0);
}

static Outcome withoutEvent(Unit *unit, int k, double t) {
    snprintf(unit->message, sizeof unit->message, "at t = %.17g s the formula of event %s is not a number", t, EVENT_NAMES[k]);
    return say(unit, FAILED, unit->message);
}

/* The signs of all formulas at the start; the accelerations must have been evaluated. */
static Outcome beginEvents(Unit *unit) {
    /* Round-off of the state, relative, and of a function of about ten operations: a formula that changes by no more than its effect
       may be zero. */
    const double rounding = 0x1p-48;
    State *now = &unit->now;
    double values[EVENTS + 1], moved[EVENTS + 1], noise[EVENTS + 1], states[STATES + 1];
    if (EVENTS == 0) return WELL;
    const double *q = now->states, *v = q + COORDINATES, *a = unit->accelerations;
    watch(unit, now->time, now->states, values);
    memset(noise, 0, sizeof noise);
    for (int number = -1; number < STATES; ++number) {
        double most[EVENTS + 1];
        memset(most, 0, sizeof most);
        for (int side = -1; side <= 1; side += 2) {
            memcpy(states, now->states, STATES * sizeof *states);
            if (number >= 0) states[number] *= 1.0 + side * rounding;
            watch(unit, now->time * (number < 0 ? 1.0 + side * rounding : 1.0), states, moved);
            for (int k = 0; k < EVENTS; ++k)
                if (sizeOf(moved[k] - values[k]) > most[k]) most[k] = sizeOf(moved[k] - values[k]);
        }
        for (int k = 0; k < EVENTS; ++k) noise[k] += most[k];
    }
    for (int k = 0; k < EVENTS; ++k) {
        if (values[k] != values[k]) return withoutEvent(unit, k, now->time);
        now->passed[k] = 0;
        now->leave[k] = 0.0;
        now->side[k] = (signed char)signOf(values[k]);
        if (sizeOf(values[k]) > noise[k]) continue;
        now->side[k] = 0;
        now->leave[k] = 2.0 * (noise[k] > sizeOf(values[k]) ? noise[k] : sizeOf(values[k]));
        /* The sign shortly after the start: at the first instant at which the formula exceeds the round-off. */
        for (double h = 1e-12; h < 1.0 && !now->side[k]; h *= 4.0) {
            for (int i = 0; i < COORDINATES; ++i) {
                states[i] = q[i] + h * (v[i] + 0.5 * h * a[i]);
                states[COORDINATES + i] = v[i] + h * a[i];
            }
            watch(unit, now->time + h, states, moved);
            if (sizeOf(moved[k]) > now->leave[k]) now->side[k] = (signed char)signOf(moved[k]);
        }
    }
    now->is_unsettled = 0;
    return WELL;
}

/* Counts an event at time t, after which its formula has this sign. */
static void countEvent(Unit *unit, int k, double t, int sign) {
    State *now = &unit->now;
    now->side[k] = (signed char)sign;
    /* The count saturates at the largest integer that an importer can read. */
    if (now->count[k] < 2147483647) ++now->count[k];
    snprintf(unit->message, sizeof unit->message, "at t = %.17g s event %s, %s", t, EVENT_NAMES[k], sign > 0 ? "rising" : "falling");
    say(unit, WELL, unit->message);
}

/* Whether a formula has changed its sign since the last check, for model exchange. Formulas without a sign get one. */
static int isCrossed(Unit *unit) {
    double values[EVENTS + 1];
    int is_crossed = 0;
    prepare(unit);
    watch(unit, unit->now.time, unit->now.states, values);
    for (int k = 0; k < EVENTS; ++k) {
        const int sign = signOfEvent(unit, k, values[k]);
        if (!unit->now.side[k]) unit->now.side[k] = (signed char)sign;
        else if (sign && sign != unit->now.side[k]) is_crossed = 1;
    }
    return is_crossed;
}

/* Counts events whose formula has changed its sign at the current state, or that ended a step. */
static void settleEvents(Unit *unit) {
    State *now = &unit->now;
    double values[EVENTS + 1];
    prepare(unit);
    watch(unit, now->time, now->states, values);
    for (int k = 0; k < EVENTS; ++k) {
        /* A step that ended at a crossing ended after it, even if rounding or a projection has since moved the state back. */
        const int sign = now->passed[k] ? now->passed[k] : signOfEvent(unit, k, values[k]);
        now->passed[k] = 0;
        if (now->side[k] && sign && sign != now->side[k]) countEvent(unit, k, now->time, sign);
        else if (sign) now->side[k] = (signed char)sign;
    }
    now->is_unsettled = 0;
}

/* Records that a fact changes at time t. A fact that ceases to hold is a warning; one that holds again is not reported. */
static void changeFact(Unit *unit, int fact, double t, int is_broken) {
    unit->now.is_broken[fact] = (unsigned char)is_broken;
    if (!is_broken) return;
    snprintf(unit->message, sizeof unit->message, "at t = %.17g s it no longer holds that %s", t, FACT_TEXTS[fact]);
    say(unit, WARNED, unit->message);
}

/* Checks all facts at the current state. */
static void checkFacts(Unit *unit) {
    double all[FACTS + 1];
    if (FACTS == 0) return;
    getFacts(unit, all);
    for (int i = 0; i < FACTS; ++i) {
        const int is_broken = !holds(i, all[i]);
        if (is_broken != unit->now.is_broken[i]) changeFact(unit, i, unit->now.time, is_broken);
    }
}

/*
 * Constraints. Accelerations satisfy them, so a run drifts off them only by the error of its steps. From time to time the state is projected
 * back by the smallest change in the metric of the mass matrix: dq = W G^T (G W G^T)^-1 (-g), where W is the inverse of the mass matrix, and
 * likewise the rates with their residuals. Coordinates that a spec keeps at the start do not change there.
 */

/* The part of the inertial scale in that of a residual: what the constraints keep at 0 is as inexact as everything else. */
#define OF_INERTIA 1e-4

/*
 * The scale of the residual of each constraint: the sum of the sizes of its terms, of positions or of rates (level 1), and a part of |G| |x|
 * in the metric of inertia; 1, the unit, if all are 0. An angle counts as at least 1 rad. Leaves the constraint matrix in the workspace.
 */
static void sizesOfTerms(Unit *unit, int level, double *to) {
    const int n = COORDINATES;
    const State *now = &unit->now;
    const double *q = now->states, *v = q + n, *x = level == 0 ? q : v;
    double rates_at_rest[CONSTRAINTS + 1], norm_squared = 0.0;
    unitConstraintMatrix(&unit->prepared, now->time, q, v, now->inputs, unit->rows);
    if (level == 1) {
        static const double at_rest[COORDINATES + 1];
        unitConstraintRates(&unit->prepared, now->time, q, at_rest, now->inputs, rates_at_rest);
    }
    double sizes[COORDINATES + 1];
    for (int i = 0; i < n; ++i) {
        sizes[i] = x[i] < 0.0 ? -x[i] : x[i];
    }
    for (int i = 0; level == 0 && i < ANGLES; ++i) {
        if (sizes[ANGLE[i]] < 1.0) sizes[ANGLE[i]] = 1.0;
    }
    for (int i = 0; i < n; ++i) norm_squared += unit->inertia[i] * sizes[i] * sizes[i];
    for (int k = 0; k < CONSTRAINTS; ++k) {
        double terms = level == 0 ? 0.0 : rates_at_rest[k] < 0.0 ? -rates_at_rest[k] : rates_at_rest[k], length = 0.0;
        for (int i = 0; i < n; ++i) {
            const double g = unit->rows[k * n + i];
            terms += (g < 0.0 ? -g : g) * sizes[i];
            if (unit->inertia[i] > 0.0) length += g * g / unit->inertia[i];
        }
        const double size = terms + OF_INERTIA * sqrt(length * norm_squared);
        to[k] = size > 0.0 ? size : 1.0;
    }
}

/* Replaces the mass matrix, without the coordinates that are kept, by its Cholesky factor L. Returns 0 if it is positive definite. */
static int factorizeMass(double *m, const unsigned char *is_kept) {
    const int n = COORDINATES;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            const int is_apart = is_kept && (is_kept[i] || is_kept[j]);
            double sum = is_apart ? i == j : m[i * n + j];
            for (int k = 0; k < j; ++k) sum -= m[i * n + k] * m[j * n + k];
            if (i == j) {
                if (!(sum > 1e-14 * (is_apart ? 1.0 : m[i * n + i]))) return 1;
                m[i * n + i] = sqrt(sum);
            } else {
                m[i * n + j] = sum / m[j * n + j];
            }
        }
    }
    return 0;
}

/*
 * Prepares corrections at the present pose: the Cholesky factor of the mass matrix, the rows of L^-1 G^T, and the Cholesky factor of their
 * products for the rows in `is_wanted`. Rows that depend on earlier ones are redundant and are left out.
 */
static void prepareCorrections(Unit *unit, const unsigned char *is_wanted, const unsigned char *is_kept) {
    const int n = COORDINATES, m = CONSTRAINTS;
    State *now = &unit->now;
    double *mass = unit->mass, *carried = unit->carried, *normal = unit->normal;
    const double *q = now->states, *v = q + n;
    unitConstraintMatrix(&unit->prepared, now->time, q, v, now->inputs, unit->rows);
    unitMassMatrix(&unit->prepared, now->time, q, v, now->inputs, mass);
    /* Of G alone if the mass matrix has no Cholesky factor because a coordinate has no inertia of its own. */
    const int is_plain = unit->is_plain = factorizeMass(mass, is_kept);
    unsigned char *is_left = unit->is_left;
    for (int k = 0; k < m; ++k) {
        for (int i = 0; i < n; ++i) {
            double sum = is_kept && is_kept[i] ? 0.0 : unit->rows[k * n + i];
            if (!is_plain) {
                for (int j = 0; j < i; ++j) sum -= mass[i * n + j] * carried[k * n + j];
                sum /= mass[i * n + i];
            }
            carried[k * n + i] = sum;
        }
    }
    for (int k = 0; k < m; ++k) {
        double whole = 0.0;
        for (int i = 0; i < n; ++i) whole += carried[k * n + i] * carried[k * n + i];
        for (int l = 0; l <= k; ++l) {
            if (l < k && is_left[l]) continue;
            double sum = 0.0;
            for (int i = 0; i < n; ++i) sum += carried[k * n + i] * carried[l * n + i];
            for (int j = 0; j < l; ++j)
                if (!is_left[j]) sum -= normal[k * m + j] * normal[l * m + j];
            if (l < k) normal[k * m + l] = sum / normal[l * m + l];
            else is_left[k] = !is_wanted[k] || !(sum > 1e-12 * whole);
            if (l == k && !is_left[k]) normal[k * m + k] = sqrt(sum);
        }
    }
}

/* Replaces residuals by their parts along the orthogonalized rows; returns their length, the distance to the constraints in the metric of
   inertia. */
static double alongRows(const Unit *unit, double *residuals) {
    const int m = CONSTRAINTS;
    double square = 0.0;
    for (int k = 0; k < m; ++k) {
        if (unit->is_left[k]) continue;
        for (int l = 0; l < k; ++l)
            if (!unit->is_left[l]) residuals[k] -= unit->normal[k * m + l] * residuals[l];
        residuals[k] /= unit->normal[k * m + k];
        square += residuals[k] * residuals[k];
    }
    return sqrt(square);
}

/* The correction of residuals, as parts along the rows: W G^T (G W G^T)^-1 residuals, to be subtracted; 0 where a value is kept. */
static void correctionOf(const Unit *unit, double *residuals, const unsigned char *is_kept, double *change) {
    const int n = COORDINATES, m = CONSTRAINTS;
    const unsigned char *is_left = unit->is_left;
    const double *mass = unit->mass;
    for (int k = m; k-- > 0;) {
        if (is_left[k]) continue;
        for (int l = k + 1; l < m; ++l)
            if (!is_left[l]) residuals[k] -= unit->normal[l * m + k] * residuals[l];
        residuals[k] /= unit->normal[k * m + k];
    }
    for (int i = 0; i < n; ++i) {
        change[i] = 0.0;
        for (int k = 0; k < m; ++k)
            if (!is_left[k]) change[i] += unit->carried[k * n + i] * residuals[k];
    }
    for (int i = n; i-- > 0;) {
        if (!unit->is_plain) {
            for (int j = i + 1; j < n; ++j) change[i] -= mass[j * n + i] * change[j];
            change[i] /= mass[i * n + i];
        }
        if (is_kept && is_kept[i]) change[i] = 0.0;
    }
}

/* The residuals of positions or of rates, level 1, and the largest of them relative to the size of its terms, of the rows in `is_wanted`. */
static double residualsOf(Unit *unit, int level, const unsigned char *is_wanted, double *residuals) {
    const State *now = &unit->now;
    const double *q = now->states, *v = q + COORDINATES;
    double sizes[CONSTRAINTS + 1], most = 0.0;
    if (level == 0) unitConstraintPositions(&unit->prepared, now->time, q, v, now->inputs, residuals);
    else unitConstraintRates(&unit->prepared, now->time, q, v, now->inputs, residuals);
    sizesOfTerms(unit, level, sizes);
    for (int k = 0; k < CONSTRAINTS; ++k) {
        const double off = (residuals[k] < 0.0 ? -residuals[k] : residuals[k]) / sizes[k];
        /* NaN counts as a violation. */
        if ((!is_wanted || is_wanted[k]) && !(off <= most)) most = off;
    }
    return most;
}

/* The largest residual of the constraints, relative to the size of its terms; 0 without constraints. */
static double isOff(Unit *unit) {
    double residuals[CONSTRAINTS + 1], most = 0.0;
    if (CONSTRAINTS == 0) return 0.0;
    prepare(unit);
    const State *now = &unit->now;
    unitMassMatrix(&unit->prepared, now->time, now->states, now->states + COORDINATES, now->inputs, unit->mass);
    for (int i = 0; i < COORDINATES; ++i) unit->inertia[i] = unit->mass[i * COORDINATES + i];
    for (int level = 0; level < 2; ++level) {
        const double off = residualsOf(unit, level, NULL, residuals);
        if (!(off <= most)) most = off;
    }
    return most;
}

/* Newton's method on positions or on rates, level 1, until the residuals are within round-off of their terms. As in the command it keeps the
   matrices of one pose as long as it contracts, and takes a part of a step that is too long. */
static void approach(Unit *unit, int level, const unsigned char *is_wanted, const unsigned char *is_kept) {
    double residuals[CONSTRAINTS + 1], change[COORDINATES + 1], before[COORDINATES + 1];
    double *x = unit->now.states + level * COORDINATES;
    int is_fresh = 1;
    double off = residualsOf(unit, level, is_wanted, residuals), far = alongRows(unit, residuals);
    for (int round = 0; round < 50 && !(off <= 2.5e-14); ++round) {
        double near, part = 1.0;
        correctionOf(unit, residuals, is_kept, change);
        memcpy(before, x, COORDINATES * sizeof *x);
        for (;; part *= 0.5) {
            for (int i = 0; i < COORDINATES; ++i) x[i] = before[i] - part * change[i];
            off = residualsOf(unit, level, is_wanted, residuals);
            near = alongRows(unit, residuals);
            if (near <= (1.0 - 0.25 * part) * far || part < 0.01 || off < 1e-3) break;
        }
        if (off <= 2.5e-14 || (is_fresh && !(near <= (1.0 - 0.125 * part) * far))) break;
        is_fresh = !(near <= 0.1 * far);
        if (is_fresh) {
            prepareCorrections(unit, is_wanted, is_kept);
            residualsOf(unit, level, is_wanted, residuals);
            near = alongRows(unit, residuals);
        }
        far = near;
    }
}

/* Projects the state, which is off the constraints, onto them; returns 0 on success. At the start some coordinates and rates are kept. */
static int project(Unit *unit, int is_start) {
    unsigned char all[CONSTRAINTS + 1];
    int is_keeping = 0;
    if (CONSTRAINTS == 0) return 0;
    for (int i = 0; i < STATES; ++i) is_keeping |= is_start && IS_KEPT[i];
    memset(all, 1, sizeof all);
    const unsigned char *kept = is_keeping ? IS_KEPT : NULL;
    prepareCorrections(unit, IS_HOLONOMIC, kept);
    approach(unit, 0, IS_HOLONOMIC, kept);
    if (kept) kept += COORDINATES;
    prepareCorrections(unit, all, kept);
    approach(unit, 1, all, kept);
    unit->is_evaluated = 0;
    return !(isOff(unit) <= LEFT);
}

/* Projects a start that violates the constraints onto them, and reports that. */
static Outcome projectStart(Unit *unit) {
#ifdef HAS_RUN
    endRun(unit);
    const Outcome begun = beginRun(unit);
    if (begun != WELL) say(unit, begun, unit->message);
    return begun == FAILED ? FAILED : WELL;
#endif
    double before[STATES + 1], most = 0.0;
    prepare(unit);
    memcpy(before, unit->now.states, sizeof before);
    if (!(isOff(unit) > LEFT)) return WELL;
    if (project(unit, 1)) {
        memcpy(unit->now.states, before, sizeof before);
        return say(unit, FAILED, "no state that satisfies the constraints was found near the start");
    }
    int which = 0;
    for (int i = 0; i < STATES; ++i) {
        const double moved = unit->now.states[i] - before[i], size = moved < 0.0 ? -moved : moved;
        if (size > most) most = size, which = i;
    }
    snprintf(unit->message, sizeof unit->message, "the start was moved onto the constraints, %s%s%s by %g",
             which < COORDINATES ? "" : "der(", COORDINATE_NAMES[which % (COORDINATES ? COORDINATES : 1)],
             which < COORDINATES ? "" : ")", most);
    say(unit, WARNED, unit->message);
    return WELL;
}

/*
 * Directional derivatives: the changes of unknowns when knowns change by a seed. These are coordinates, rates and outputs, and their
 * derivatives with respect to each other, to parameters and to inputs.
 */
static Outcome differentiateAlong(Unit *unit, const unsigned *unknowns, size_t unknown_count, const unsigned *knowns,
                                   size_t known_count, const double *seed, double *to) {
    if (!HAS_DERIVATIVES) return say(unit, FAILED, "this machine is too large for directional derivatives");
    if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
    /* Each array holds the values, followed by their changes. */
    const State *now = &unit->now;
    double x[2 * PARAMETERS + 1], q[2 * COORDINATES + 1], v[2 * COORDINATES + 1], a[2 * COORDINATES + 1], u[2 * INPUTS + 1];
    double y[OUTPUTS + 1];
    double *dx = x + PARAMETERS, *dq = q + COORDINATES, *dv = v + COORDINATES, *da = a + COORDINATES, *du = u + INPUTS;
    memcpy(x, now->parameters, PARAMETERS * sizeof *x);
    memcpy(q, now->states, COORDINATES * sizeof *q);
    memcpy(v, now->states + COORDINATES, COORDINATES * sizeof *v);
    memcpy(u, now->inputs, INPUTS * sizeof *u);
    memset(dx, 0, PARAMETERS * sizeof *dx);
    memset(dq, 0, COORDINATES * sizeof *dq);
    memset(dv, 0, COORDINATES * sizeof *dv);
    memset(du, 0, INPUTS * sizeof *du);
    for (size_t k = 0; k < known_count; ++k) {
        const unsigned i = knowns[k];
        if (i >= AT_STATES && i < AT_STATES + COORDINATES) dq[i - AT_STATES] += seed[k];
        else if (i >= AT_STATES + COORDINATES && i < AT_ACCELERATIONS) dv[i - AT_STATES - COORDINATES] += seed[k];
        else if (i >= AT_PARAMETERS && i < AT_INPUTS) dx[i - AT_PARAMETERS] += seed[k];
        else if (i >= AT_INPUTS && i < AT_OUTPUTS) du[i - AT_INPUTS] += seed[k];
        else return unknown(unit, i);
    }
    unitTangentPrepare(x, &unit->tangent);
    unit->singular = unitTangentAccelerations(&unit->tangent, now->time, q, v, u, a);
    if (unit->singular) {
        unit->is_evaluated = 0;
        return withoutAccelerations(unit, DISCARDED);
    }
    memcpy(a, unit->accelerations, COORDINATES * sizeof *a);
    unitTangentOutputs(&unit->tangent, now->time, q, v, u, a, y);
    for (size_t k = 0; k < unknown_count; ++k) {
        const unsigned i = unknowns[k];
        if (i >= AT_STATES && i < AT_STATES + COORDINATES) to[k] = dq[i - AT_STATES];
        else if (i >= AT_STATES + COORDINATES && i < AT_ACCELERATIONS) to[k] = dv[i - AT_STATES - COORDINATES];
        else if (i >= AT_ACCELERATIONS && i < AT_PARAMETERS) to[k] = da[i - AT_ACCELERATIONS];
        else if (i >= AT_OUTPUTS && i < AT_MULTIPLIERS) to[k] = y[i - AT_OUTPUTS];
        else return unknown(unit, i);
    }
    return WELL;
}

/* Adjoint derivatives: for each known the change of the seed-weighted sum of all unknowns. In reverse mode all knowns together cost a few
   evaluations of the accelerations. */
static Outcome differentiateBack(Unit *unit, const unsigned *unknowns, size_t unknown_count, const unsigned *knowns,
                                 size_t known_count, const double *seed, double *to) {
    /* Derivatives with respect to coordinates, rates, parameters and inputs, in the order of their references; those of outputs also with
       respect to accelerations. */
    enum { BY = STATES + PARAMETERS + INPUTS };
    if (!HAS_DERIVATIVES) return say(unit, FAILED, "this machine is too large for directional derivatives");
    if (evaluate(unit)) return withoutAccelerations(unit, DISCARDED);
    const State *now = &unit->now;
    const double *q = now->states, *v = q + COORDINATES;
    double sums[BY + 1], one[BY + COORDINATES + 1], u[INPUTS + COORDINATES + 1], of_outputs[OUTPUTS + 1];
    double *weights = u + INPUTS;
    memset(sums, 0, sizeof sums);
    memset(of_outputs, 0, sizeof of_outputs);
    memcpy(u, now->inputs, INPUTS * sizeof *u);
    memset(weights, 0, COORDINATES * sizeof *weights);
    for (size_t k = 0; k < unknown_count; ++k) {
        const unsigned i = unknowns[k];
        if (i >= AT_STATES && i < AT_ACCELERATIONS) sums[i - AT_STATES] += seed[k];
        else if (i >= AT_ACCELERATIONS && i < AT_PARAMETERS) weights[i - AT_ACCELERATIONS] += seed[k];
        else if (i >= AT_OUTPUTS && i < AT_MULTIPLIERS) of_outputs[i - AT_OUTPUTS] += seed[k];
        else return unknown(unit, i);
    }
    for (size_t k = 0; k < known_count; ++k) {
        const unsigned i = knowns[k];
        if (!(i >= AT_STATES && i < AT_ACCELERATIONS) && !(i >= AT_PARAMETERS && i < AT_OUTPUTS)) return unknown(unit, i);
    }
    unitAdjointPrepare(now->parameters, &unit->adjoint);
    /* An output with weight zero may have no derivative here. */
    for (int k = 0; k < OUTPUTS; ++k) {
        if (of_outputs[k] == 0.0) continue;
        unitAdjointOutput(&unit->adjoint, now->time, q, v, u, unit->accelerations, k, one);
        for (int i = 0; i < BY; ++i) sums[i] += of_outputs[k] * one[i];
        for (int i = 0; i < COORDINATES; ++i) weights[i] += of_outputs[k] * one[BY + i];
    }
    unit->singular = unitAdjointAccelerations(&unit->adjoint, now->time, q, v, u, one);
    if (unit->singular) {
        unit->is_evaluated = 0;
        return withoutAccelerations(unit, DISCARDED);
    }
    for (int i = 0; i < BY; ++i) sums[i] += one[i];
    for (size_t k = 0; k < known_count; ++k) {
        const unsigned i = knowns[k];
        to[k] = sums[i < AT_ACCELERATIONS ? i - AT_STATES : i - AT_PARAMETERS + STATES];
    }
    return WELL;
}

/* Whether states can be saved: a run is more than the numbers of a state. */
#ifdef HAS_RUN
enum { SAVES = 0 };
#else
enum { SAVES = 1 };
#endif

static void save(const Unit *unit, Saved *to) {
    memset(to, 0, sizeof *to);
    memcpy(to->token, TOKEN, sizeof TOKEN);
    memcpy(&to->state, &unit->now, sizeof to->state);
}

static Outcome restore(Unit *unit, const Saved *from) {
    if (memcmp(from->token, TOKEN, sizeof TOKEN)) return say(unit, FAILED, "the state belongs to another machine");
    memcpy(&unit->now, &from->state, sizeof from->state);
    unit->is_prepared = 0;
    unit->is_evaluated = 0;
    return WELL;
}

/* Creates a unit; returns NULL if there is no memory, or if the token is another machine's. */
static Unit *instantiate(const char *name, const char *token, Report *report, void *environment, void *callback, int is_logging,
                         int is_co_simulation) {
    Unit *unit = calloc(1, sizeof *unit);
    if (!unit) return NULL;
    unit->report = report;
    unit->environment = environment;
    unit->callback = callback;
    unit->is_logging = is_logging;
    unit->is_co_simulation = is_co_simulation;
    strncpy(unit->name, name ? name : "", sizeof unit->name - 1);
    if (!token || strcmp(token, TOKEN)) {
        say(unit, FAILED, "the token belongs to another machine");
        free(unit);
        return NULL;
    }
    restart(unit);
    return unit;
}

static void discard(Unit *unit) {
    if (unit) endRun(unit);
    free(unit);
}

static Outcome begin(Unit *unit, int has_tolerance, double tolerance, double start) {
    if (has_tolerance) {
        if (!(tolerance >= 1e-14 && tolerance < 1.0))
            return say(unit, FAILED, "a tolerance must be at least 1e-14 and less than 1");
        unit->now.tolerance = tolerance;
    }
    if (!isFinite(start)) return say(unit, FAILED, "the start time is not finite");
    setTime(unit, start);
    return WELL;
}

/* The maximum number of attempted steps between two communication points. */
#define MOST_TRIES 10000000L

/* The scale of the error in a state. */
static double scaleOf(const Unit *unit, double before, double after) {
    const double a = sizeOf(before), b = sizeOf(after);
    return unit->now.tolerance * (1.0 + (a > b ? a : b));
}

/* The length of the first step in s, chosen so that a step of Euler's method changes the state by a hundredth of its norm, where each state
   x is scaled by 1 + |x|. */
static double firstStep(const Unit *unit, double most) {
    double size = 0.0, rate = 0.0;
    for (int i = 0; i < STATES; ++i) {
        const double scale = scaleOf(unit, unit->now.states[i], 0.0) / unit->now.tolerance;
        const double x = unit->now.states[i] / scale, dx = unit->slopes[0][i] / scale;
        size += x * x;
        rate += dx * dx;
    }
    const double step = size > 1e-10 && rate > 1e-10 ? 0.01 * sqrt(size / rate) : 1e-6;
    return step < most ? step : most;
}

/* Attempts a step of length h from the current state; writes the new state to `point`. Returns its error, where 1 is just tolerable, or a
   negative number if accelerations do not exist on the way. */
static double tryStep(Unit *unit, double h) {
    const State *now = &unit->now;
    unit->tried = h;
    for (int stage = 1; stage <= STAGES; ++stage) {
        for (int i = 0; i < STATES; ++i) {
            double sum = 0.0;
            for (int k = 0; k < stage && k < STAGES; ++k) sum += COEFFICIENTS[stage][k] * unit->slopes[k][i];
            unit->point[i] = now->states[i] + h * sum;
        }
        if (stage == STAGES) break;
        unit->singular = differentiate(unit, now->time + NODES[stage] * h, unit->point, unit->slopes[stage]);
        if (unit->singular) return -1.0;
    }
    double fine = 0.0, coarse = 0.0;
    for (int i = 0; i < STATES; ++i) {
        double of_fine = 0.0, of_coarse = 0.0;
        for (int k = 0; k < STAGES; ++k) {
            of_fine += ERROR_WEIGHTS[k] * unit->slopes[k][i];
            of_coarse += COARSE_ERROR_WEIGHTS[k] * unit->slopes[k][i];
        }
        const double scale = scaleOf(unit, now->states[i], unit->point[i]);
        fine += (of_fine / scale) * (of_fine / scale);
        coarse += (of_coarse / scale) * (of_coarse / scale);
    }
    const double denominator = fine + 0.01 * coarse;
    if (denominator == 0.0) return 0.0;
    const double error = sizeOf(h) * fine / sqrt(denominator * (STATES > 0 ? STATES : 1));
    return isFinite(error) ? error : -1.0;
}

/*
 * Events and facts within a step: where a formula changes its sign along the motion. A formula is as smooth as the motion, so its
 * Chebyshev interpolant represents it to rounding, and the coefficients bound it: if the first is greater than the sum of the others there
 * is no root, and if the same holds of the derivative there is at most one. Where neither holds the interval is bisected. L. N. Trefethen,
 * Approximation Theory and Approximation Practice, 2013, chapters 3, 8 and 18. A body that turns uniformly takes long steps in which
 * formulas of its angle oscillate many times: such a step is divided into parts that the interpolant resolves.
 */
enum {
    /* Degrees of interpolants: the first counts sign changes, the second only decides whether the formula is far from zero. */
    COARSE = 4,
    /* The number of values for the first: at its nodes, and beside three of them. */
    SAMPLES = COARSE + 4,
    MIDDLE = 8,
    FINE = 16,
    FINEST = 64,
    /* How many times an interval is bisected that no interpolant resolves. If there is a kink, all nodes are checked in the end. */
    HALVINGS = 2,
    /* How many times in total an interval is bisected because the formula oscillates too fast. */
    HALVINGS_OF_SWINGS = 14,
    /* How many times a step is bisected in which the coarse interpolant is neither far from zero nor monotone. */
    MOST_BISECTIONS = 5
};

/* An interpolant resolves a formula if its last coefficients are below this fraction of the largest. */
#define CONVERGED 1e-12

/* The same for a formula that oscillates fast: one of an angle of 1e5 rad is only accurate to 1e-11. */
#define CONVERGED_WITH_NOISE 1e-7

/* A formula oscillates too fast for an interpolant if a coefficient in the upper half exceeds this fraction of the largest. For a jump the
   fraction is a fortieth, for a kink it is smaller. */
#define SWINGS 0.1

/* Distance of the three other places from their nodes, as a fraction of the step. They test the slopes of the interpolant. */
#define BESIDE 0.01

/* Allowance for round-off when values beside the nodes are compared with the interpolant, relative to the largest value. A formula that
   varies by less than this fraction of its size has no root. */
#define ROUNDING_OF_VALUES 1e-6

/* In rad: a coordinate that turns by more than this in a step may have returned to the same angle between two nodes. */
#define FARTHEST_TURN 3.14159265358979323846

/* Above this tolerance a step may be so long that a few values do not determine the motion within it. */
#define LOOSEST 1e-3

/* A forward search along the attempted step for sign changes of what is watched. */
typedef struct {
    Unit *unit;
    /* The length of the step. */
    double h;
    /* The index of what is watched now, the fraction of the step at which it was last evaluated, and the length of the step that ends just
       after the last change found, 0 before there is one. */
    int k;
    double seen, early;
    int is_over;
    /* The length of the step that ends just after the first event that may end it, the index of that event and the sign after it; without
       such an event, the whole step and -1. */
    double first;
    int which, sign;
} Search;

/* The motion within a step is y = c0 + x (c1 + (1 - x) (c2 + x (c3 + (1 - x) (c4 + ...)))) at the fraction x of it. The cubic interpolates
   both ends and their slopes, which are multiplied by the length here; the further terms are corrections to it. */
static void curveCubic(Unit *unit, int i, double start, double end, double slope, double slope_at_end) {
    const double rise = end - start, bend = slope - rise;
    unit->curve[0][i] = start;
    unit->curve[1][i] = rise;
    unit->curve[2][i] = bend;
    unit->curve[3][i] = rise - slope_at_end - bend;
}

/* Degree 5, through the coordinates, rates and accelerations at both ends; the rates are its derivative. It costs no evaluation because the
   last stage is near the acceleration at the end. */
static void curveThroughEnds(Unit *unit, double h) {
    unit->bends = 6;
    for (int i = 0; i < COORDINATES; ++i) {
        const int k = COORDINATES + i;
        const double v = unit->now.states[k], w = unit->end[k], a = unit->slopes[0][k];
        curveCubic(unit, i, unit->now.states[i], unit->end[i], h * v, h * w);
        const double rise = unit->curve[1][i], bend = unit->curve[2][i], twist = unit->curve[3][i];
        /* The second derivatives of the cubic at both ends are 2 (twist - bend) and -2 (bend + 2 twist). */
        const double of_start = 0.5 * h * h * a + bend - twist;
        const double of_end = 0.5 * h * h * unit->slopes[STAGES - 1][k] + bend + 2.0 * twist;
        const double b = 2.0 * (of_end - bend - 2.0 * twist) / (h * h);
        unit->curve[4][i] = of_start;
        unit->curve[5][i] = of_end - of_start;
        curveCubic(unit, k, v, w, h * a, h * b);
        /* The integral of the rates must be the rise of the coordinate; that of x^2 (1 - x)^2 is 1/30. */
        unit->curve[4][k] = 30.0 * (rise / h - 0.5 * (v + w) - h * (a - b) / 12.0);
        unit->curve[5][k] = 0.0;
    }
}

/* The dense output of the method in the last attempted step. Returns 0 if accelerations do not exist where it needs them. */
static int curveOfMethod(Unit *unit, double h) {
    double states[STATES + 1];
    const double t = unit->now.time;
    if (END == STAGES && differentiate(unit, t + h, unit->end, unit->slopes[STAGES])) return 0;
    for (int further = 0; further < FURTHER; ++further) {
        const int stage = STAGES + 1 + further;
        for (int i = 0; i < STATES; ++i) {
            double sum = 0.0;
            for (int k = 0; k < stage; ++k) sum += FURTHER_COEFFICIENTS[further][k] * unit->slopes[k][i];
            states[i] = unit->now.states[i] + h * sum;
        }
        if (differentiate(unit, t + FURTHER_NODES[further] * h, states, unit->slopes[stage])) return 0;
    }
    for (int i = 0; i < STATES; ++i) {
        curveCubic(unit, i, unit->now.states[i], unit->end[i], h * unit->slopes[0][i], h * unit->slopes[END][i]);
        for (int bend = 0; bend < BENDS; ++bend) {
            double sum = 0.0;
            for (int k = 0; k < SLOPES; ++k) sum += DENSE[bend][k] * unit->slopes[k][i];
            unit->curve[4 + bend][i] = h * sum;
        }
    }
    unit->bends = 4 + BENDS;
    return 1;
}

/* Everything that is watched, at a fraction of the step. */
static void watchAlong(const Unit *unit, double h, double x, double *to) {
    double states[STATES + 1];
    if (x == 1.0) {
        watchAll(unit, unit->now.time + h, unit->end, to);
        return;
    }
    for (int i = 0; i < STATES; ++i) {
        double sum = 0.0;
        for (int bend = unit->bends; --bend > 0;) sum = (bend % 2 ? x : 1.0 - x) * (unit->curve[bend][i] + sum);
        states[i] = unit->curve[0][i] + sum;
    }
    watchAll(unit, unit->now.time + x * h, states, to);
}

/* Node number `node` of the Chebyshev nodes between the fractions a and b. The first is at the end b, the last at the beginning a. */
static double nodeOf(int node, int degree, double a, double b) {
    if (node == 0) return b;
    if (node == degree) return a;
    return a + (b - a) * 0.5 * (1.0 + cos(3.14159265358979323846 * node / degree));
}

/* The Chebyshev coefficients of the interpolant through values at the nodes. */
static void interpolate(const double *values, int degree, double *to) {
    double cosines[FINEST + 1];
    for (int m = 0; m <= degree; ++m) cosines[m] = cos(3.14159265358979323846 * m / degree);
    for (int k = 0; k <= degree; ++k) {
        double sum = 0.0;
        for (int j = 0; j <= degree; ++j) {
            const int turn = j * k % (2 * degree), m = turn > degree ? 2 * degree - turn : turn;
            sum += (j == 0 || j == degree ? 0.5 : 1.0) * values[j] * cosines[m];
        }
        to[k] = (k == 0 || k == degree ? 1.0 : 2.0) / degree * sum;
    }
}

static double sumOfSizes(const double *c, int from, int degree) {
    double sum = 0.0;
    for (int k = from; k <= degree; ++k) sum += sizeOf(c[k]);
    return sum;
}

/* The largest absolute value of some coefficients; NaN if one of them is not finite. */
static double greatestOf(const double *c, int from, int degree) {
    double greatest = 0.0;
    for (int k = from; k <= degree; ++k) {
        const double size = sizeOf(c[k]);
        if (!(size <= greatest)) greatest = size;
        if (size != size) break;
    }
    return greatest;
}

/* The value of an interpolant at x between -1 and 1, by Clenshaw's recurrence. */
static double valueOf(const double *c, int degree, double x) {
    double one = 0.0, two = 0.0;
    for (int k = degree; k > 0; --k) {
        const double next = c[k] + 2.0 * x * one - two;
        two = one, one = next;
    }
    return c[0] + x * one - two;
}

/* Whether a formula is certainly nonzero, from values at the nodes. The coefficients of a smooth function keep decaying, so the truncation
   error is a small multiple of the last two. */
static int isFarFromZero(const double *values, int degree) {
    double c[MIDDLE + 1];
    interpolate(values, degree, c);
    const double last = sizeOf(c[degree]) > sizeOf(c[degree - 1]) ? sizeOf(c[degree]) : sizeOf(c[degree - 1]);
    return sizeOf(c[0]) > sumOfSizes(c, 1, degree) + 4.0 * (degree + 1) * last;
}

/* The signs that a formula has had: the last one, and how many times it changed. */
typedef struct {
    int latest, changes;
} Signs;

/* Appends a sign, after at most one change since the last. */
static void takeSign(Signs *signs, int sign) {
    signs->changes += signs->latest && signs->latest != sign;
    signs->latest = sign;
}

/*
 * Follows a polynomial of degree 4 from `middle - width` to `middle + width`, each value of which may be wrong by `beyond`. Returns whether
 * its signs are known: in a piece that is far from zero the sign is constant, and in adjacent monotone pieces it changes at most once. The
 * derivative of the truncated terms is at most the sum of k^2 |c_k|, for a motion of 10 rad 5.5 times `beyond`.
 */
static int followSigns(Signs *signs, const double *p, double middle, double width, double beyond, int halvings) {
    const double m = middle, r = width;
    const double value = p[0] + m * (p[1] + m * (p[2] + m * (p[3] + m * p[4])));
    const double slope = r * (p[1] + m * (2.0 * p[2] + m * (3.0 * p[3] + m * 4.0 * p[4])));
    const double second = sizeOf(r * r * (p[2] + m * (3.0 * p[3] + m * 6.0 * p[4])));
    const double third = sizeOf(r * r * r * (p[3] + m * 4.0 * p[4])), fourth = sizeOf(r * r * r * r * p[4]);
    if (sizeOf(value) > sizeOf(slope) + second + third + fourth + beyond) {
        takeSign(signs, signOf(value));
        return 1;
    }
    if (sizeOf(slope) > 2.0 * second + 3.0 * third + 4.0 * fourth + r * 5.5 * beyond) return 1;
    const double half = 0.5 * r;
    return halvings > 0 && followSigns(signs, p, m - half, half, beyond, halvings - 1) &&
           followSigns(signs, p, m + half, half, beyond, halvings - 1);
}

/* The fractions of a step at which signChanges needs values: the nodes of degree 4, from the end, and three places beside nodes. */
static double sampleAt(int place) {
    static const double beside[] = {BESIDE, 0.5 + BESIDE, 1.0 - BESIDE};
    return place <= COARSE ? nodeOf(place, COARSE, 0.0, 1.0) : beside[place - COARSE - 1];
}

/*
 * The number of sign changes of a formula within a step, from its values at these fractions; -1 if they do not decide it, because the
 * formula has an extreme too near to zero or is not as smooth as a motion. A formula that oscillates many times can look smooth at the
 * nodes, but hardly ever has the slopes of the interpolant as well. The truncation error and the error of the quintic are bounded by the
 * decay of the coefficients: a motion of frequency w has 2 J_k(z) with z = wh/2, which fall by z/10 or faster after the last one, and the
 * error of its quintic is (wh)^2/15 times the last one; so eight times the last suffices up to wh = 10. The last may be 0 by chance, so at
 * least a sixteenth of the one before it counts.
 */
static int signChanges(const double *values) {
    double c[COARSE + 1];
    interpolate(values, COARSE, c);
    const double falls = sizeOf(c[3]) / sizeOf(c[1]);
    const double share = falls > 1.0 ? 1.0 : falls > 0.0625 ? falls : 0.0625;
    const double of_third = c[3] == 0.0 ? 0.0 : sizeOf(c[3]) * share;
    const double beyond = 8.0 * (of_third > sizeOf(c[4]) ? of_third : sizeOf(c[4]));
    /* The interpolant in powers of x. */
    const double p[] = {c[0] - c[2] + c[4], c[1] - 3.0 * c[3], 2.0 * c[2] - 8.0 * c[4], 4.0 * c[3], 8.0 * c[4]};
    const double differs = 5.5 * beyond * 2.0 * BESIDE + ROUNDING_OF_VALUES * greatestOf(values, 0, SAMPLES - 1);
    for (int place = COARSE + 1; place < SAMPLES; ++place) {
        const double x = 2.0 * sampleAt(place) - 1.0, expected = p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * p[4])));
        if (!(sizeOf(values[place] - expected) <= differs)) return -1;
    }
    Signs signs = {signOf(values[COARSE]), 0};
    if (!followSigns(&signs, p, 0.0, 1.0, beyond, MOST_BISECTIONS)) return -1;
    takeSign(&signs, signOf(values[0]));
    return signs.changes;
}

/* The watched value k at the end of a step of length h by the method itself; NaN if there is no such step. */
static double atEndOf(Unit *unit, double h, int k) {
    double values[WATCHED + 1];
    if (tryStep(unit, h) < 0.0) return NAN;
    watchAll(unit, unit->now.time + h, unit->point, values);
    return values[k];
}

/*
 * The length of the step that ends just after a change of sign, found by steps of the method itself, so that it is as accurate as the end of
 * any step. After a step of length `late` the value is `at_late` and has the new sign `sign`; after one of length `early` it is `at_early`,
 * which is 0 if it is not known.
 */
static double locate(Unit *unit, int k, double early, double at_early, double late, double at_late, int sign) {
    const double instant = sizeOf(unit->now.time) + late;
    /* The accuracy is 1e-13 s, or the rounding of time if that is larger. */
    const double nearest = 1e-13 > 1e-15 * instant ? 1e-13 : 1e-15 * instant;
    for (int tries = 0; tries < 200 && late - early > nearest; ++tries) {
        double middle = 0.5 * (early + late);
        /* The zero of the chord, moved by half the required accuracy so that the interval closes from both sides. Every third time the
           interval is bisected, which bounds the number of tries for any formula. */
        if (tries % 3 != 2 && sign * at_early < 0.0) {
            const double chord = early + (late - early) * (at_early / (at_early - at_late));
            const double beside = chord - early < late - chord ? chord + 0.5 * nearest : chord - 0.5 * nearest;
            if (beside > early && beside < late) middle = beside;
        }
        if (!(middle > early && middle < late)) break;
        const double there = atEndOf(unit, middle, k);
        if (isBehind(k, sign, there)) late = middle, at_late = there;
        else early = middle, at_early = there;
    }
    return late;
}

/*
 * Looks for a change of sign at a fraction of the step; since the fraction before it there is at most one. Changes of facts are reported, and
 * events are counted if steps may not end at them; otherwise the first event is recorded, and changes after it are ignored because the step
 * will end there.
 */
static void lookAt(Search *search, double x) {
    Unit *unit = search->unit;
    State *now = &unit->now;
    const int k = search->k;
    const double seen = search->seen, late = x * search->h;
    if (search->is_over || !(x > seen)) return;
    if (seen > 0.0 && seen * search->h >= search->first) {
        search->is_over = 1;
        return;
    }
    double all[WATCHED + 1];
    search->seen = x;
    watchAlong(unit, search->h, x, all);
    const int sign = signOfWatched(unit, k, all[k]), side = sideOf(unit, k);
    if (k < EVENTS && !side) now->side[k] = (signed char)sign;
    if (!sign || !side || sign == side) return;
    /* The sign of the polynomial is not certain. */
    const double value = x < 1.0 ? atEndOf(unit, late, k) : all[k];
    if (late <= search->early || !isBehind(k, sign, value)) return;
    double from = seen * search->h, before = 0.0;
    if (from > search->early) before = atEndOf(unit, from, k);
    if (!(from > search->early) || isBehind(k, sign, before)) from = search->early, before = 0.0;
    const double at = locate(unit, k, from, before, late, value, sign);
    search->early = at;
    if (k < EVENTS && !unit->may_stop) {
        countEvent(unit, k, now->time + at, sign);
    } else if (k < EVENTS) {
        if (search->which < 0 || at < search->first) search->first = at, search->which = k, search->sign = sign;
        search->is_over = 1;
    } else if (at > search->first) {
        search->is_over = 1;
    } else {
        changeFact(unit, k - EVENTS, now->time + at, sign < 0);
    }
}

/* Calls lookAt at the ends of intervals that contain at most one zero of an interpolant. */
static void isolate(const double *c, int degree, double a, double b, double noise, Search *search) {
    double slopes[FINEST + 3], values[FINEST + 1], half[FINEST + 1];
    if (search->is_over) return;
    while (degree > 0 && sizeOf(c[degree]) <= noise) --degree;
    const double rest = sumOfSizes(c, 1, degree);
    if (sizeOf(c[0]) > rest + noise || rest + sizeOf(c[0]) <= noise) return;
    slopes[degree + 1] = slopes[degree] = 0.0;
    for (int k = degree; k >= 1; --k) slopes[k - 1] = slopes[k + 1] + 2.0 * k * c[k];
    slopes[0] *= 0.5;
    /* Zeros that are nearer to each other than this fraction of the step are treated as one that does not change the sign. */
    if (degree == 0 || sizeOf(slopes[0]) > sumOfSizes(slopes, 1, degree - 1) || b - a <= 0x1p-40) {
        lookAt(search, a);
        lookAt(search, b);
        return;
    }
    const double middle = 0.5 * (a + b);
    for (int side = 0; side < 2; ++side) {
        for (int node = 0; node <= degree; ++node) values[node] = valueOf(c, degree, nodeOf(node, degree, side - 1.0, side));
        interpolate(values, degree, half);
        isolate(half, degree, side ? middle : a, side ? b : middle, noise, search);
    }
}

/* The watched value at the nodes between two fractions of the step. */
static void sample(const Search *search, int degree, double a, double b, double *values) {
    double all[WATCHED + 1];
    for (int node = 0; node <= degree; ++node) {
        watchAlong(search->unit, search->h, nodeOf(node, degree, a, b), all);
        values[node] = all[search->k];
    }
}

/* Whether a formula has the slopes of its interpolant near both ends. A formula that oscillates many times may look smooth at the nodes. */
static int isFollowed(const Search *search, const double *values, int degree, double a, double b) {
    double c[MIDDLE + 1], all[WATCHED + 1];
    interpolate(values, degree, c);
    /* The truncation error may oscillate as fast as the interpolant has coefficients. */
    const double count = degree + 1.0, left_out = 4.0 * count * greatestOf(c, degree - 1, degree);
    const double differs = 2.0 * BESIDE * count * left_out + ROUNDING_OF_VALUES * greatestOf(c, 0, degree);
    for (int side = 0; side < 2; ++side) {
        const double x = side ? 1.0 - BESIDE : BESIDE;
        watchAlong(search->unit, search->h, a + (b - a) * x, all);
        if (!(sizeOf(all[search->k] - valueOf(c, degree, 2.0 * x - 1.0)) <= differs)) return 0;
    }
    return 1;
}

/* Whether an interpolant resolves a formula: its last coefficients are below this fraction of the largest. */
static int isEnough(const double *c, int degree, double share) {
    const double greatest = greatestOf(c, 0, degree);
    return isFinite(greatest) && greatestOf(c, degree - 2, degree) <= share * greatest;
}

/* Searches between two fractions of the step. */
static void lookBetween(Search *search, double a, double b, int halvings, int halvings_of_swings, double share) {
    double values[FINEST + 1], c[FINEST + 1];
    if (search->is_over) return;
    for (int degree = MIDDLE; degree <= FINEST; degree *= 2) {
        sample(search, degree, a, b, values);
        if (degree < FINE) {
            if (isFarFromZero(values, degree) && isFollowed(search, values, degree, a, b)) return;
            continue;
        }
        interpolate(values, degree, c);
        if (isEnough(c, degree, share)) {
            /* Below its round-off an interpolant is noise. */
            const double rounding = 1e-14 * greatestOf(c, 0, degree);
            const double rest = share > CONVERGED ? (degree + 1) * greatestOf(c, degree - 2, degree) : 0.0;
            isolate(c, degree, a, b, rest > rounding ? rest : rounding, search);
            return;
        }
    }
    if (greatestOf(c, FINEST / 2, FINEST) > SWINGS * greatestOf(c, 0, FINEST)) {
        /* The length of the parts is determined at the beginning of the interval. A formula without parts that an interpolant resolves, such
           as noise, cannot be searched. */
        for (int cuts = 1; cuts <= halvings_of_swings; ++cuts) {
            const int parts = 1 << cuts;
            sample(search, FINEST, a, a + (b - a) / parts, values);
            interpolate(values, FINEST, c);
            if (!isEnough(c, FINEST, CONVERGED_WITH_NOISE)) continue;
            for (int part = 0; part < parts && !search->is_over; ++part) {
                const double from = a + (b - a) * part / parts, to = part + 1 < parts ? a + (b - a) * (part + 1) / parts : b;
                lookAt(search, from);
                lookBetween(search, from, to, halvings, halvings_of_swings - cuts, CONVERGED_WITH_NOISE);
            }
            return;
        }
    }
    if (halvings == 0) {
        for (int node = FINEST - 1; node >= 0; --node) lookAt(search, nodeOf(node, FINEST, a, b));
        return;
    }
    const double middle = 0.5 * (a + b);
    lookBetween(search, a, middle, halvings - 1, halvings_of_swings, share);
    lookAt(search, middle);
    lookBetween(search, middle, b, halvings - 1, halvings_of_swings, share);
}

/* Whether an angle turns so far in the attempted step that a few values do not determine its functions. */
static int turnsFar(const Unit *unit, double h) {
    for (int k = 0; k < ANGLES; ++k) {
        const int i = ANGLE[k];
        const double turn = unit->end[i] - unit->now.states[i];
        const double at_start = h * unit->now.states[COORDINATES + i], at_end = h * unit->end[COORDINATES + i];
        if (sizeOf(turn) > FARTHEST_TURN || sizeOf(at_start) > FARTHEST_TURN || sizeOf(at_end) > FARTHEST_TURN) return 1;
    }
    return 0;
}

/* Decides for each watched value where its sign may change in the attempted step: only once, to another sign at the end, or, if `is_near` is
   set, at any zero along the motion within the step. Returns 0 if an event's formula is NaN at the end. */
static int lookAlong(Unit *unit, double h, int *is_near) {
    State *now = &unit->now;
    double seen[SAMPLES][WATCHED + 1], values[SAMPLES];
    int is_any_near = 0;
    memcpy(unit->end, unit->point, sizeof unit->end);
    const int is_of_method = END < STAGES, is_long = turnsFar(unit, h) || !(now->tolerance <= LOOSEST);
    if (is_of_method) curveOfMethod(unit, h);
    else curveThroughEnds(unit, h);
    /* The zeros of a long step are isolated in any case, for which its ends suffice. */
    for (int place = 0; place < SAMPLES; ++place)
        if (!is_long || place == 0 || place == COARSE) watchAlong(unit, h, sampleAt(place), seen[place]);
    for (int k = 0; k < WATCHED; ++k) {
        const double start = seen[COARSE][k], end = seen[0][k];
        if (k < EVENTS && end != end) {
            withoutEvent(unit, k, now->time + h);
            return 0;
        }
        /* The projection onto the constraints moved the end of the last step back before a change of sign that was already found. It is
           not another change. */
        const int side = sideOf(unit, k), is_before = k < EVENTS ? side * start < 0.0 : (side > 0) != holds(k - EVENTS, start);
        if (is_before && 2.0 * sizeOf(start) > now->leave[k]) now->leave[k] = 2.0 * sizeOf(start);
        int changes = -1;
        if (!is_long) {
            for (int place = 0; place < SAMPLES; ++place) values[place] = seen[place][k];
            changes = signChanges(values);
        }
        is_near[k] = !(side && isBehind(k, side, start) && changes == !isBehind(k, side, end));
        is_any_near |= is_near[k];
    }
    /* Use the polynomial of higher order, or the present one if its accelerations do not exist. */
    if (is_any_near && !is_of_method && !curveOfMethod(unit, h)) curveThroughEnds(unit, h);
    return 1;
}

/*
 * Looks for events and changes of facts in the attempted step. If steps may not end at events, events are counted and the step stays; otherwise
 * the step is repeated up to the first event. A fact that ceases to hold is a warning with its instant. Returns the length of the step whose
 * end is in `point`; 0 if a formula is NaN.
 */
static double lookForEvents(Unit *unit, double h) {
    State *now = &unit->now;
    double values[WATCHED + 1];
    int is_near[WATCHED + 1];
    Search search = {.unit = unit, .h = h, .first = h, .which = -1};
    if (!lookAlong(unit, h, is_near)) return 0.0;
    for (int k = 0; k < WATCHED; ++k) {
        search.k = k;
        search.seen = search.early = 0.0;
        search.is_over = 0;
        if (is_near[k]) lookBetween(&search, 0.0, 1.0, HALVINGS, HALVINGS_OF_SWINGS, CONVERGED);
        lookAt(&search, 1.0);
    }
    const double first = search.first;
    const int which = search.which;
    /* The search leaves the end of another step in `point`. */
    if (unit->tried != first) tryStep(unit, first);
    if (which < 0) return h;
    /* Other events at the same time, up to round-off. */
    watch(unit, now->time + first, unit->point, values);
    for (int k = 0; k < EVENTS; ++k) {
        const int sign = signOfEvent(unit, k, values[k]);
        if (sign && now->side[k] && sign != now->side[k]) now->passed[k] = (signed char)sign;
    }
    now->passed[which] = (signed char)search.sign;
    now->is_unsettled = 1;
    unit->has_stopped = 1;
    return first;
}

/*
 * Integrates up to a time, which is hit exactly by a shortened step; the step after it has the length that it would have had without that. If
 * integration fails earlier, the state is that of the last accepted step. If a step may end at events, integration ends just after the first
 * one and sets `has_stopped`.
 */
static Outcome integrate(Unit *unit, double until) {
    State *now = &unit->now;
    long tries = 0;
    if (!isFinite(until)) return say(unit, FAILED, "the end of the step is not finite");
    if (until < now->time) return say(unit, FAILED, "the step would end before it begins");
    prepare(unit);
#ifdef HAS_RUN
    if (beginRun(unit) == FAILED) return say(unit, FAILED, unit->message);
    unit->is_evaluated = 0;
    const int advanced = unitRunAdvance(unit->run, now->inputs, until, &now->time, now->states, unit->message, sizeof unit->message);
    if (advanced != WELL) say(unit, (Outcome)advanced, unit->message);
    return advanced == FAILED ? FAILED : WELL;
#endif
    if (now->is_unsettled) {
        settleEvents(unit);
        checkFacts(unit);
    }
    unit->is_evaluated = 0;
    unit->has_stopped = 0;
    int is_new = 1;
    while (now->time < until && !unit->has_stopped) {
        const double left = until - now->time;
        if (is_new) {
            unit->singular = differentiate(unit, now->time, now->states, unit->slopes[0]);
            if (unit->singular) return withoutAccelerations(unit, FAILED);
            if (!(now->step > 0.0)) now->step = firstStep(unit, left);
            is_new = 0;
        }
        /* The step is extended by up to 1 % so that no tiny last step remains. */
        const int is_last = 1.01 * now->step >= left;
        const double h = is_last ? left : now->step;
        const double error = tryStep(unit, h);
        if (error >= 0.0 && error <= 1.0) {
            const double gone = WATCHED > 0 ? lookForEvents(unit, h) : h;
            if (!(gone > 0.0)) return FAILED;
            memcpy(now->states, unit->point, STATES * sizeof *now->states);
            for (int i = 0; i < INPUTS; ++i) now->inputs[i] += gone * now->input_rates[i];
            now->time = is_last && gone == h ? until : now->time + gone;
            if (now->time > until) now->time = until;
            unit->is_evaluated = 0;
            if (isOff(unit) > LEFT && project(unit, 0)) {
                snprintf(unit->message, sizeof unit->message, "at t = %.17g s the state cannot be moved back onto the constraints",
                         now->time);
                return say(unit, FAILED, unit->message);
            }
            const double factor = error > 0.0 ? 0.9 * pow(error, -1.0 / ERROR_ORDER) : 6.0;
            const double next = h * (factor > 6.0 ? 6.0 : factor < 0.333 ? 0.333 : factor);
            if (!is_last || next > now->step) now->step = next;
            is_new = 1;
        } else {
            const double factor = error > 0.0 ? 0.9 * pow(error, -1.0 / ERROR_ORDER) : 0.25;
            now->step = h * (factor > 0.333 ? factor < 0.9 ? factor : 0.9 : factor > 0.1 ? factor : 0.1);
            if (now->step <= 1e-15 * (sizeOf(now->time) + 1e-3)) {
                if (unit->singular) return withoutAccelerations(unit, FAILED);
                snprintf(unit->message, sizeof unit->message, "at t = %.17g s steps become too short for the tolerance %g",
                         now->time, now->tolerance);
                return say(unit, FAILED, unit->message);
            }
        }
        if (++tries > MOST_TRIES) return say(unit, FAILED, "one communication step takes more than 1e7 integration steps");
    }
    for (int i = 0; i < INPUTS; ++i) now->input_rates[i] = 0.0;
    return WELL;
}

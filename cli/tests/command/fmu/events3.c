/* Events of a unit of FMI 3.0, in both kinds of units: when and how often they happen, and where steps end. */
#include "fmi3Functions.h"
#include "events.h"

/* Whether the unit has a fifth event, whose formula becomes undefined. */
#ifndef LOST
#define LOST 0
#endif

static void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)status;
    listen(category, message);
}

static void well(fmi3Status status, int rule) { must(status == fmi3OK, rule); }

static fmi3Instance slave(bool event_mode, bool early) {
    fmi3Instance unit = fmi3InstantiateCoSimulation("a", TOKEN, NULL, false, true, event_mode, early, NULL, 0, NULL, hear, NULL);
    must(unit != NULL, 3);
    well(fmi3EnterInitializationMode(unit, true, 1e-14, 0.0, false, 0.0), 4);
    well(fmi3ExitInitializationMode(unit), 5);
    return unit;
}

static int counted(fmi3Instance unit, int k) {
    const unsigned reference = AT_COUNTS + k;
    int count = -1;
    well(fmi3GetInt32(unit, &reference, 1, &count, 1), 6);
    return count;
}

static int all_of(fmi3Instance unit) {
    int sum = 0;
    for (int k = 0; k < EVENTS; ++k) sum += counted(unit, k);
    return sum;
}

static double formula(fmi3Instance unit, int k) {
    const unsigned reference = AT_FORMULAS + k;
    double value = 0.0;
    well(fmi3GetFloat64(unit, &reference, 1, &value, 1), 7);
    return value;
}

static void update(fmi3Instance unit) {
    bool again, end, nominals, values, next;
    double when;
    well(fmi3UpdateDiscreteStates(unit, &again, &end, &nominals, &values, &next, &when), 8);
    must(!again && !end && !values && !next, 8);
}

/* Counts events in steps of this length, without stopping at them. */
static void count_only(bool event_mode, double length) {
    bool event, terminate, early;
    double last;
    fmi3Instance unit = slave(event_mode, false);
    heard_count = 0;
    if (event_mode) {
        must(fmi3DoStep(unit, 0.0, length, true, &event, &terminate, &early, &last) == fmi3Error, 10);
        update(unit);
        well(fmi3EnterStepMode(unit), 10);
    } else {
        must(fmi3EnterEventMode(unit) == fmi3Error, 10);
    }
    const int steps = (int)(2.0 / length + 0.5);
    for (int k = 0; k < steps; ++k) {
        well(fmi3DoStep(unit, k * length, length, true, &event, &terminate, &early, &last), 11);
        must(!event && !early && last == k * length + length, 12);
    }
    must(counted(unit, HIGH) == 2 && counted(unit, LOW) == 1 && counted(unit, BEGIN) == 1 && counted(unit, BOTTOM) == 3, 13);
    compare(heard, heard_count, 14);
    must(fmi3SetInt32(unit, &(unsigned){AT_COUNTS}, 1, &(int){1}, 1) == fmi3Error, 15);
    must(fmi3GetInt32(unit, &(unsigned){AT_FACT}, 1, &(int){1}, 1) == fmi3Error, 15);
    must(fmi3GetFloat64(unit, &(unsigned){AT_COUNTS}, 1, &last, 1) == fmi3Error, 15);
    well(fmi3Reset(unit), 16);
    must(all_of(unit) == 0, 16);
    fmi3FreeInstance(unit);
}

/* Continues from the unit's state, stopping at events and at communication points: what happens until 2 s, how often,
   and the end. */
static int follow(fmi3Instance unit, double t, double length, Happening *found, double *end, fmi3FMUState *at, int save_at) {
    int count = 0;
    while (t < 2.0) {
        bool event, terminate, early;
        double last;
        int before[EVENTS];
        const double point = length * (floor(t / length + 1e-9) + 1.0);
        for (int k = 0; k < EVENTS; ++k) before[k] = counted(unit, k);
        well(fmi3DoStep(unit, t, point - t, true, &event, &terminate, &early, &last), 20);
        must(last > t && early == (last < point) && (!early || event), 21);
        t = last;
        if (!event) continue;
        /* Discrete variables only change in event mode. */
        for (int k = 0; k < EVENTS; ++k) must(counted(unit, k) == before[k], 22);
        if (count == save_at) well(fmi3GetFMUState(unit, at), 23);
        well(fmi3EnterEventMode(unit), 24);
        update(unit);
        for (int k = 0; k < EVENTS; ++k) {
            if (counted(unit, k) == before[k]) continue;
            must(counted(unit, k) == before[k] + 1, 25);
            const int sign = formula(unit, k) > 0.0 ? 1 : -1;
            if (count < HAPPENINGS) found[count] = (Happening){t, k, sign};
            ++count;
        }
        well(fmi3EnterStepMode(unit), 26);
    }
    const unsigned references[STATES] = {1, 2, 3, 4};
    well(fmi3GetFloat64(unit, references, STATES, end, STATES), 27);
    return count;
}

static void stop_early(double length) {
    Happening found[HAPPENINGS], again[HAPPENINGS];
    double end[STATES], other[STATES];
    fmi3FMUState saved = NULL;
    fmi3Instance unit = slave(true, true);
    update(unit);
    well(fmi3EnterStepMode(unit), 30);
    const int count = follow(unit, 0.0, length, found, end, &saved, 2);
    compare(found, count, 31);
    must(all_of(unit) == HAPPENINGS, 31);
    /* Every method integrates the parabola of the ball exactly, up to round-off. */
    place(2.0, 0.0, other);
    must(fabs(end[0] - other[0]) <= 1e-12 && fabs(end[2] - other[2]) <= 1e-12, 32);
    /* The state was saved after the step that ended at an event and before the event was handled, so the event is reported
       again, also in another unit. */
    for (int round = 0; round < 2; ++round) {
        fmi3Instance third = round ? slave(true, true) : unit;
        well(fmi3SetFMUState(third, saved), 33);
        must(all_of(third) == 2, 33);
        well(fmi3EnterEventMode(third), 34);
        update(third);
        must(all_of(third) == 3, 34);
        well(fmi3EnterStepMode(third), 35);
        must(follow(third, found[2].t, length, again, other, NULL, -1) == HAPPENINGS - 3, 35);
        must(!memcmp(again, found + 3, (HAPPENINGS - 3) * sizeof *found) && !memcmp(end, other, sizeof end), 36);
        if (round) fmi3FreeInstance(third);
    }
    well(fmi3FreeFMUState(unit, &saved), 37);
    fmi3FreeInstance(unit);
}

/* Model exchange, in which the importer integrates: it sees sign changes, and counts change in event mode. */
static void exchange(void) {
    double states[STATES], indicators[EVENTS + 1];
    bool enter, terminate;
    size_t count = 0;
    fmi3Instance unit = fmi3InstantiateModelExchange("a", TOKEN, NULL, false, true, NULL, hear);
    must(unit != NULL, 40);
    well(fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0), 41);
    well(fmi3ExitInitializationMode(unit), 41);
    update(unit);
    well(fmi3GetNumberOfEventIndicators(unit, &count), 42);
    must(count == EVENTS + 1, 42);
    well(fmi3EnterContinuousTimeMode(unit), 43);
    static const struct {
        double t, angle;
        int signs[EVENTS], crossed, counts[EVENTS];
    } points[] = {
        {0.01, 0.9, {-1, 1, 1, 1}, 0, {0, 0, 0, 0}},  {0.2, 0.5, {1, 1, 1, 1}, 1, {1, 0, 0, 0}},
        {0.45, -0.5, {1, 1, 1, -1}, 1, {1, 0, 0, 1}}, {0.6, -0.9, {-1, 1, 1, -1}, 1, {2, 0, 0, 1}},
        {0.61, -0.8, {-1, 1, 1, -1}, 0, {2, 0, 0, 1}}, {0.9, 0.1, {-1, -1, -1, 1}, 1, {2, 1, 1, 2}},
    };
    for (size_t at = 0; at < sizeof points / sizeof *points; ++at) {
        place(points[at].t, points[at].angle, states);
        well(fmi3SetTime(unit, points[at].t), 44);
        well(fmi3SetContinuousStates(unit, states, STATES), 44);
        well(fmi3GetEventIndicators(unit, indicators, EVENTS + 1), 45);
        /* The fact that y > -1000 m, then the formulas as written in the spec. */
        must(fabs(indicators[0] - (states[0] + 1000.0)) <= 1e-12, 46);
        must(fabs(indicators[1] - (states[0] - 2.3)) <= 1e-15 && indicators[1 + BOTTOM] == points[at].angle, 46);
        for (int k = 0; k < EVENTS; ++k) must((indicators[1 + k] > 0.0 ? 1 : -1) == points[at].signs[k], 47);
        well(fmi3CompletedIntegratorStep(unit, true, &enter, &terminate), 48);
        must(enter == points[at].crossed && !terminate, 48);
        if (!enter) continue;
        well(fmi3EnterEventMode(unit), 49);
        update(unit);
        for (int k = 0; k < EVENTS; ++k) must(counted(unit, k) == points[at].counts[k], 49);
        well(fmi3EnterContinuousTimeMode(unit), 49);
    }
    fmi3FreeInstance(unit);
}

/* A value that is set makes a formula jump: the event is counted at that time, by the next step or in event mode. */
static void jump(bool event_mode) {
    bool event, terminate, early;
    double last;
    fmi3Instance unit = slave(event_mode, event_mode);
    if (event_mode) {
        update(unit);
        well(fmi3EnterStepMode(unit), 60);
    }
    well(fmi3DoStep(unit, 0.0, 0.0625, true, &event, &terminate, &early, &last), 61);
    must(!event && counted(unit, HIGH) == 0, 61);
    heard_count = 0;
    well(fmi3SetFloat64(unit, &(unsigned){AT_HEIGHT}, 1, &(double){1.5}, 1), 62);
    if (event_mode) {
        well(fmi3EnterEventMode(unit), 63);
        update(unit);
        must(counted(unit, HIGH) == 1, 63);
        well(fmi3EnterStepMode(unit), 63);
    }
    well(fmi3DoStep(unit, 0.0625, 0.0625, true, &event, &terminate, &early, &last), 64);
    must(!event && last == 0.125 && counted(unit, HIGH) == 1 && all_of(unit) == 1, 64);
    must(heard_count == 1 && heard[0].t == 0.0625 && heard[0].sign == 1 && heard[0].event == HIGH, 65);
    fmi3FreeInstance(unit);
}

/* A formula that is NaN beyond some height: a step up to there succeeds; a step or a start beyond it is an error. */
static void lose(void) {
    bool event, terminate, early;
    double last;
    fmi3Instance unit = slave(false, false);
    well(fmi3DoStep(unit, 0.0, 1.0, true, &event, &terminate, &early, &last), 50);
    must(fmi3DoStep(unit, 1.0, 1.0, true, &event, &terminate, &early, &last) == fmi3Error, 51);
    /* The ball is at -9 m at (3 + sqrt(9 + 22 g))/g. */
    must(last >= 1.0 && last < (3.0 + sqrt(9.0 + 22.0 * 9.81)) / 9.81, 52);
    well(fmi3Reset(unit), 53);
    well(fmi3EnterInitializationMode(unit, true, 1e-14, 0.0, false, 0.0), 53);
    well(fmi3SetFloat64(unit, &(unsigned){1}, 1, &(double){-10.0}, 1), 53);
    must(fmi3ExitInitializationMode(unit) == fmi3Error, 54);
    fmi3FreeInstance(unit);
}

int main(void) {
    if (LOST) {
        lose();
        return 0;
    }
    count_only(false, 0.05);
    count_only(false, 0.5);
    count_only(true, 2.0);
    stop_early(2.0);
    stop_early(0.125);
    jump(false);
    jump(true);
    exchange();
    return 0;
}

/*
 * FMI 2.0 for one machine: model exchange and co-simulation. Compile only this file; it includes the others.
 */
#include "machine.c"

#include "runtime.c"

#include "fmi2Functions.h"

static void reportOf2(const Unit *unit, Outcome outcome, const char *message) {
    static const char *const categories[] = {"logEvents", "logStatusWarning", "logStatusDiscard", "logStatusError"};
    fmi2CallbackLogger log;
    memcpy(&log, &unit->callback, sizeof log);
    if (log) log(unit->environment, unit->name, (fmi2Status)outcome, categories[outcome], "%s", message);
}

static fmi2Status absent(fmi2Component c, const char *what) {
    Unit *unit = c;
    snprintf(unit->message, sizeof unit->message, "%s: not supported by this unit", what);
    return (fmi2Status)say(unit, FAILED, unit->message);
}

/* The rates at which inputs change until the next communication point. */
static Outcome setInputRates(Unit *unit, const unsigned *references, size_t count, const int *orders, const double *values) {
    for (size_t k = 0; k < count; ++k) {
        const unsigned i = references[k];
        if (i < AT_INPUTS || i >= AT_OUTPUTS) return unknown(unit, i);
#ifdef HAS_RUN
        return say(unit, FAILED, "the inputs of a machine with contacts or guides keep their values during a step");
#endif
        if (!unit->is_co_simulation || orders[k] != 1 || !isFinite(values[k]))
            return say(unit, FAILED, "only the first time derivative of an input can be set, in co-simulation, and to a finite number");
        unit->now.input_rates[i - AT_INPUTS] = values[k];
    }
    return WELL;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories, const fmi2String categories[]) {
    (void)nCategories, (void)categories;
    ((Unit *)c)->is_logging = loggingOn;
    return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID, fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean loggingOn) {
    (void)fmuResourceLocation, (void)visible;
    if (fmuType == fmi2CoSimulation ? !HAS_CO_SIMULATION : !HAS_MODEL_EXCHANGE) return NULL;
    void *callback = NULL;
    if (functions) memcpy(&callback, &functions->logger, sizeof functions->logger);
    void *environment = functions ? functions->componentEnvironment : NULL;
    return instantiate(instanceName, fmuGUID, reportOf2, environment, callback, loggingOn, fmuType == fmi2CoSimulation);
}

void fmi2FreeInstance(fmi2Component c) { discard(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    (void)stopTimeDefined, (void)stopTime;
    return (fmi2Status)begin(c, toleranceDefined, tolerance, startTime);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    ((Unit *)c)->now.mode = INITIALIZING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    Unit *unit = c;
    prepare(unit);
    unit->now.mode = unit->is_co_simulation ? STEPPING : EVENT;
    const Outcome started = projectStart(unit);
    if (started != WELL) return (fmi2Status)started;
    if (evaluate(unit)) return (fmi2Status)withoutAccelerations(unit, FAILED);
    checkFacts(unit);
    return (fmi2Status)beginEvents(unit);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    ((Unit *)c)->now.mode = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
    restart(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[]) {
    return (fmi2Status)get(c, vr, nvr, value);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[]) {
    return (fmi2Status)set(c, vr, nvr, value);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[]) {
    return (fmi2Status)getCounts(c, vr, nvr, value);
}

/* Counters cannot be set. */
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[]) {
    (void)value;
    return nvr ? (fmi2Status)unknown(c, vr[0]) : fmi2OK;
}

/* This model has no variables of these types. */
#define NO_VARIABLES(Type) \
    fmi2Status fmi2Get##Type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2##Type value[]) { \
        (void)vr, (void)value; \
        return nvr ? absent(c, "fmi2Get" #Type) : fmi2OK; \
    } \
    fmi2Status fmi2Set##Type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2##Type value[]) { \
        (void)vr, (void)value; \
        return nvr ? absent(c, "fmi2Set" #Type) : fmi2OK; \
    }

NO_VARIABLES(Boolean)
NO_VARIABLES(String)

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    if (!SAVES) return absent(c, "fmi2GetFMUstate");
    if (!*FMUstate) *FMUstate = malloc(sizeof(Saved));
    if (!*FMUstate) return (fmi2Status)say(c, FAILED, "there is not enough memory for the state");
    save(c, *FMUstate);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    if (!SAVES) return absent(c, "fmi2SetFMUstate");
    return (fmi2Status)restore(c, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    (void)c;
    free(*FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    (void)FMUstate;
    if (!SAVES) return absent(c, "fmi2SerializedFMUstateSize");
    *size = sizeof(Saved);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size) {
    if (!SAVES) return absent(c, "fmi2SerializeFMUstate");
    if (size < sizeof(Saved)) return (fmi2Status)say(c, FAILED, "the state needs more bytes than the given array has");
    memcpy(serializedState, FMUstate, sizeof(Saved));
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size, fmi2FMUstate *FMUstate) {
    if (!SAVES) return absent(c, "fmi2DeSerializeFMUstate");
    if (size != sizeof(Saved) || memcmp(serializedState, TOKEN, sizeof TOKEN))
        return (fmi2Status)say(c, FAILED, "the bytes are not a state of this machine");
    if (!*FMUstate) *FMUstate = malloc(sizeof(Saved));
    if (!*FMUstate) return (fmi2Status)say(c, FAILED, "there is not enough memory for the state");
    memcpy(*FMUstate, serializedState, sizeof(Saved));
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    return (fmi2Status)differentiateAlong(c, vUnknown_ref, nUnknown, vKnown_ref, nKnown, dvKnown, dvUnknown);
}

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    Unit *unit = c;
    if (unit->is_co_simulation) return absent(c, "fmi2EnterEventMode");
    unit->now.mode = EVENT;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *fmi2eventInfo) {
    Unit *unit = c;
    const int is_off = isOff(unit) > LEFT;
    if (is_off && project(unit, 0)) return (fmi2Status)say(unit, FAILED, "the state cannot be moved back onto the constraints");
    checkFacts(c);
    settleEvents(c);
    memset(fmi2eventInfo, 0, sizeof *fmi2eventInfo);
    fmi2eventInfo->valuesOfContinuousStatesChanged = is_off;
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    Unit *unit = c;
    if (unit->is_co_simulation) return absent(c, "fmi2EnterContinuousTimeMode");
    unit->now.mode = CONTINUOUS;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint, fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation) {
    (void)noSetFMUStatePriorToCurrentPoint;
    checkFacts(c);
    const int is_crossed = isCrossed(c);
    *enterEventMode = isOff(c) > LEFT || is_crossed;
    *terminateSimulation = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    setTime(c, time);
    return fmi2OK;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
    if (nx != STATES) return absent(c, "a different number of states");
    setStates(c, x);
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
    if (nx != STATES) return absent(c, "a different number of states");
    return (fmi2Status)getDerivatives(c, derivatives);
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni) {
    if (ni != INDICATORS) return absent(c, "a different number of event indicators");
    getIndicators(c, eventIndicators);
    return fmi2OK;
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
    Unit *unit = c;
    if (nx != STATES) return absent(c, "a different number of states");
    prepare(unit);
    memcpy(x, unit->now.states, STATES * sizeof *x);
    return fmi2OK;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
    if (nx != STATES) return absent(c, "a different number of states");
    for (int i = 0; i < STATES; ++i) x_nominal[i] = 1.0;
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer order[],
                                       const fmi2Real value[]) {
    return (fmi2Status)setInputRates(c, vr, nvr, order, value);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer order[],
                                        fmi2Real value[]) {
    (void)vr, (void)order, (void)value;
    return nvr ? absent(c, "fmi2GetRealOutputDerivatives") : fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    (void)noSetFMUStatePriorToCurrentPoint;
    Unit *unit = c;
    if (unit->now.mode != STEPPING)
        return (fmi2Status)say(unit, FAILED, "fmi2DoStep can be called only in co-simulation and after initialization");
    return (fmi2Status)integrate(unit, currentCommunicationPoint + communicationStepSize);
}

fmi2Status fmi2CancelStep(fmi2Component c) { return absent(c, "fmi2CancelStep"); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
    (void)s, (void)value;
    return absent(c, "fmi2GetStatus");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
    if (s != fmi2LastSuccessfulTime) return absent(c, "fmi2GetRealStatus");
    *value = ((Unit *)c)->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
    (void)s, (void)value;
    return absent(c, "fmi2GetIntegerStatus");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
    if (s != fmi2Terminated) return absent(c, "fmi2GetBooleanStatus");
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
    (void)s, (void)value;
    return absent(c, "fmi2GetStringStatus");
}

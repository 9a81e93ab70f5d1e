/*
 * FMI 3.0 for one machine: model exchange and co-simulation. Compile only this file; it includes the others.
 */
#include "machine.c"

#include "runtime.c"

#include "fmi3Functions.h"

static void reportOf3(const Unit *unit, Outcome outcome, const char *message) {
    static const char *const categories[] = {"logEvents", "logStatusWarning", "logStatusDiscard", "logStatusError"};
    fmi3LogMessageCallback log;
    memcpy(&log, &unit->callback, sizeof log);
    if (log) log(unit->environment, (fmi3Status)outcome, categories[outcome], message);
}

static fmi3Status absent(fmi3Instance instance, const char *what) {
    Unit *unit = instance;
    snprintf(unit->message, sizeof unit->message, "%s: not supported by this unit", what);
    return (fmi3Status)say(unit, FAILED, unit->message);
}

static Unit *instantiate3(fmi3String name, fmi3String token, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                          fmi3Boolean isLogging, int isCoSimulation) {
    void *callback = NULL;
    memcpy(&callback, &log, sizeof log);
    return instantiate(name, token, reportOf3, environment, callback, isLogging, isCoSimulation);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories, const fmi3String categories[]) {
    (void)nCategories, (void)categories;
    ((Unit *)instance)->is_logging = loggingOn;
    return fmi3OK;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                          fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    (void)resourcePath, (void)visible;
    if (!HAS_MODEL_EXCHANGE) return NULL;
    return instantiate3(instanceName, instantiationToken, instanceEnvironment, logMessage, loggingOn, 0);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                         fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
                                         fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate) {
    (void)resourcePath, (void)visible, (void)requiredIntermediateVariables, (void)nRequiredIntermediateVariables;
    (void)intermediateUpdate;
    if (!HAS_CO_SIMULATION) return NULL;
    Unit *unit = instantiate3(instanceName, instantiationToken, instanceEnvironment, logMessage, loggingOn, 1);
    if (unit) {
        unit->has_event_mode = EVENTS > 0 && eventModeUsed;
        unit->may_stop = unit->has_event_mode && earlyReturnAllowed;
    }
    return unit;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
                                               fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                               fmi3ClockUpdateCallback clockUpdate, fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption) {
    (void)instanceName, (void)instantiationToken, (void)resourcePath, (void)visible, (void)loggingOn, (void)instanceEnvironment;
    (void)logMessage, (void)clockUpdate, (void)lockPreemption, (void)unlockPreemption;
    return NULL;
}

void fmi3FreeInstance(fmi3Instance instance) { discard(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    (void)stopTimeDefined, (void)stopTime;
    Unit *unit = instance;
    const Outcome outcome = begin(unit, toleranceDefined, tolerance, startTime);
    if (outcome == WELL) unit->now.mode = INITIALIZING;
    return (fmi3Status)outcome;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    Unit *unit = instance;
    prepare(unit);
    unit->now.mode = unit->is_co_simulation && !unit->has_event_mode ? STEPPING : EVENT;
    const Outcome started = projectStart(unit);
    if (started != WELL) return (fmi3Status)started;
    if (evaluate(unit)) return (fmi3Status)withoutAccelerations(unit, FAILED);
    checkFacts(unit);
    return (fmi3Status)beginEvents(unit);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    Unit *unit = instance;
    if (unit->is_co_simulation && !unit->has_event_mode) return absent(instance, "fmi3EnterEventMode");
    unit->now.mode = EVENT;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    ((Unit *)instance)->now.mode = TERMINATED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    restart(instance);
    return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues) {
    if (nValues != nValueReferences) return absent(instance, "array variables");
    return (fmi3Status)get(instance, valueReferences, nValueReferences, values);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Float64 values[], size_t nValues) {
    if (nValues != nValueReferences) return absent(instance, "array variables");
    return (fmi3Status)set(instance, valueReferences, nValueReferences, values);
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Int32 values[], size_t nValues) {
    if (nValues != nValueReferences) return absent(instance, "array variables");
    return (fmi3Status)getCounts(instance, valueReferences, nValueReferences, values);
}

/* Counters cannot be set. */
fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Int32 values[], size_t nValues) {
    (void)values, (void)nValues;
    return nValueReferences ? (fmi3Status)unknown(instance, valueReferences[0]) : fmi3OK;
}

/* This model has no variables of these types. */
#define NO_VARIABLES(Type) \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
                             fmi3##Type values[], size_t nValues) { \
        (void)valueReferences, (void)values, (void)nValues; \
        return nValueReferences ? absent(instance, "fmi3Get" #Type) : fmi3OK; \
    } \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences, \
                             const fmi3##Type values[], size_t nValues) { \
        (void)valueReferences, (void)values, (void)nValues; \
        return nValueReferences ? absent(instance, "fmi3Set" #Type) : fmi3OK; \
    }

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(Int64)
NO_VARIABLES(UInt64)
NO_VARIABLES(Boolean)
NO_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         size_t valueSizes[], fmi3Binary values[], size_t nValues) {
    (void)valueReferences, (void)valueSizes, (void)values, (void)nValues;
    return nValueReferences ? absent(instance, "fmi3GetBinary") : fmi3OK;
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const size_t valueSizes[], const fmi3Binary values[], size_t nValues) {
    (void)valueReferences, (void)valueSizes, (void)values, (void)nValues;
    return nValueReferences ? absent(instance, "fmi3SetBinary") : fmi3OK;
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Clock values[]) {
    (void)valueReferences, (void)values;
    return nValueReferences ? absent(instance, "fmi3GetClock") : fmi3OK;
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Clock values[]) {
    (void)valueReferences, (void)values;
    return nValueReferences ? absent(instance, "fmi3SetClock") : fmi3OK;
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference, size_t *nDependencies) {
    (void)valueReference, (void)nDependencies;
    return absent(instance, "fmi3GetNumberOfVariableDependencies");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent, size_t elementIndicesOfDependent[],
                                       fmi3ValueReference independents[], size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    (void)dependent, (void)elementIndicesOfDependent, (void)independents, (void)elementIndicesOfIndependents;
    (void)dependencyKinds, (void)nDependencies;
    return absent(instance, "fmi3GetVariableDependencies");
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    if (!SAVES) return absent(instance, "fmi3GetFMUState");
    if (!*FMUState) *FMUState = malloc(sizeof(Saved));
    if (!*FMUState) return (fmi3Status)say(instance, FAILED, "there is not enough memory for the state");
    save(instance, *FMUState);
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    if (!SAVES) return absent(instance, "fmi3SetFMUState");
    return (fmi3Status)restore(instance, FMUState);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    (void)instance;
    free(*FMUState);
    *FMUState = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    (void)FMUState;
    if (!SAVES) return absent(instance, "fmi3SerializedFMUStateSize");
    *size = sizeof(Saved);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size) {
    if (!SAVES) return absent(instance, "fmi3SerializeFMUState");
    if (size < sizeof(Saved)) return (fmi3Status)say(instance, FAILED, "the state needs more bytes than the given array has");
    memcpy(serializedState, FMUState, sizeof(Saved));
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size, fmi3FMUState *FMUState) {
    if (!SAVES) return absent(instance, "fmi3DeserializeFMUState");
    if (size != sizeof(Saved) || memcmp(serializedState, TOKEN, sizeof TOKEN))
        return (fmi3Status)say(instance, FAILED, "the bytes are not a state of this machine");
    if (!*FMUState) *FMUState = malloc(sizeof(Saved));
    if (!*FMUState) return (fmi3Status)say(instance, FAILED, "there is not enough memory for the state");
    memcpy(*FMUState, serializedState, sizeof(Saved));
    return fmi3OK;
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                        fmi3Float64 sensitivity[], size_t nSensitivity) {
    if (nSeed != nKnowns || nSensitivity != nUnknowns) return absent(instance, "array variables");
    return (fmi3Status)differentiateAlong(instance, unknowns, nUnknowns, knowns, nKnowns, seed, sensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                    fmi3Float64 sensitivity[], size_t nSensitivity) {
    if (nSeed != nUnknowns || nSensitivity != nKnowns) return absent(instance, "array variables");
    return (fmi3Status)differentiateBack(instance, unknowns, nUnknowns, knowns, nKnowns, seed, sensitivity);
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) { return absent(instance, "fmi3EnterConfigurationMode"); }

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) { return absent(instance, "fmi3ExitConfigurationMode"); }

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                  fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]) {
    (void)valueReferences, (void)nValueReferences, (void)intervals, (void)qualifiers;
    return absent(instance, "fmi3GetIntervalDecimal");
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions, (void)qualifiers;
    return absent(instance, "fmi3GetIntervalFraction");
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                               fmi3Float64 shifts[]) {
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    return absent(instance, "fmi3GetShiftDecimal");
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return absent(instance, "fmi3GetShiftFraction");
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                  const fmi3Float64 intervals[]) {
    (void)valueReferences, (void)nValueReferences, (void)intervals;
    return absent(instance, "fmi3SetIntervalDecimal");
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                   const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return absent(instance, "fmi3SetIntervalFraction");
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                               const fmi3Float64 shifts[]) {
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    return absent(instance, "fmi3SetShiftDecimal");
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return absent(instance, "fmi3SetShiftFraction");
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    (void)instance;
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate, fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged, fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
    Unit *unit = instance;
    const int is_off = !unit->is_co_simulation && isOff(unit) > LEFT;
    if (is_off && project(unit, 0)) return (fmi3Status)say(unit, FAILED, "the state cannot be moved back onto the constraints");
    checkFacts(instance);
    settleEvents(unit);
    *discreteStatesNeedUpdate = fmi3False;
    *terminateSimulation = fmi3False;
    *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = is_off;
    *nextEventTimeDefined = fmi3False;
    *nextEventTime = 0.0;
    return fmi3OK;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    Unit *unit = instance;
    if (unit->is_co_simulation) return absent(instance, "fmi3EnterContinuousTimeMode");
    unit->now.mode = CONTINUOUS;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation) {
    (void)noSetFMUStatePriorToCurrentPoint;
    checkFacts(instance);
    const int is_crossed = isCrossed(instance);
    *enterEventMode = isOff(instance) > LEFT || is_crossed;
    *terminateSimulation = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    setTime(instance, time);
    return fmi3OK;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[], size_t nContinuousStates) {
    if (nContinuousStates != STATES) return absent(instance, "a different number of states");
    setStates(instance, continuousStates);
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t nContinuousStates) {
    if (nContinuousStates != STATES) return absent(instance, "a different number of states");
    return (fmi3Status)getDerivatives(instance, derivatives);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators) {
    if (nEventIndicators != INDICATORS) return absent(instance, "a different number of event indicators");
    getIndicators(instance, eventIndicators);
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates) {
    Unit *unit = instance;
    if (nContinuousStates != STATES) return absent(instance, "a different number of states");
    prepare(unit);
    memcpy(continuousStates, unit->now.states, STATES * sizeof *continuousStates);
    return fmi3OK;
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates) {
    if (nContinuousStates != STATES) return absent(instance, "a different number of states");
    for (int i = 0; i < STATES; ++i) nominals[i] = 1.0;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    (void)instance;
    *nEventIndicators = INDICATORS;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    (void)instance;
    *nContinuousStates = STATES;
    return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    Unit *unit = instance;
    if (!unit->is_co_simulation) return absent(instance, "fmi3EnterStepMode");
    unit->now.mode = STEPPING;
    return fmi3OK;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues) {
    (void)valueReferences, (void)nValueReferences, (void)orders, (void)values, (void)nValues;
    return absent(instance, "fmi3GetOutputDerivatives");
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    (void)noSetFMUStatePriorToCurrentPoint;
    Unit *unit = instance;
    *eventHandlingNeeded = fmi3False;
    *terminateSimulation = fmi3False;
    *earlyReturn = fmi3False;
    Outcome outcome = FAILED;
    const double until = currentCommunicationPoint + communicationStepSize;
    if (unit->now.mode == STEPPING) {
        outcome = integrate(unit, until);
        *eventHandlingNeeded = outcome == WELL && unit->has_stopped;
        *earlyReturn = *eventHandlingNeeded && unit->now.time < until;
    } else {
        say(unit, FAILED, "fmi3DoStep can be called only in co-simulation, after initialization and outside event mode");
    }
    *lastSuccessfulTime = unit->now.time;
    return (fmi3Status)outcome;
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference, fmi3Float64 activationTime) {
    (void)clockReference, (void)activationTime;
    return absent(instance, "fmi3ActivateModelPartition");
}

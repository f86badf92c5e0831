/* The controller as an FMU: FMI 2.0 for co-simulation, around umbilical_controller.c.
 *
@HEAD@ *
 * A step of the co-simulation is one update for each control period in it, the first at its beginning: the outputs after
 * fmi2DoStep() are what is commanded from that instant on. All memory that changes is one struct without pointers.
 */
#include "fmi2Functions.h"

#include "umbilical_controller.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GUID "@GUID@"
#define LONGEST_STEP 1e6 /* periods */

typedef struct {
    umb_state state;
    umb_readings readings;
    int status;
} memory_type;

typedef struct {
    fmi2CallbackFunctions callbacks;
    char name[128];
    memory_type memory;
} instance_type;

static fmi2Status refuse(const instance_type *c, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    if (c->callbacks.logger != NULL) {
        c->callbacks.logger(c->callbacks.componentEnvironment, c->name, fmi2Error, "logStatusError", "%s", text);
    }
    return fmi2Error;
}

static void begin(instance_type *c)
{
    static const memory_type nothing = {0};
    c->memory = nothing;
    c->memory.readings.valid = 1;
    c->memory.status = (int)UMB_STOPPED;
    umb_start(&c->memory.state);
}

/* Reals by their value references: the inputs first. */

#define INPUTS @INPUTS@

static double *real(memory_type *m, fmi2ValueReference reference)
{
    switch (reference) {
@REALS@
    default: return NULL;
    }
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    (void)c;
    (void)on;
    (void)count;
    (void)categories;
    return fmi2OK;
}

fmi2Component fmi2Instantiate(
    fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions *callbacks,
    fmi2Boolean visible, fmi2Boolean logging)
{
    instance_type *c = calloc(1, sizeof(*c));
    (void)resources;
    (void)visible;
    (void)logging;
    if (c == NULL) {
        return NULL;
    }
    if (callbacks != NULL) {
        c->callbacks = *callbacks;
    }
    (void)snprintf(c->name, sizeof(c->name), "%s", (name != NULL) ? name : "");
    if (type != fmi2CoSimulation) {
        (void)refuse(c, "this FMU is for co-simulation only");
    } else if ((guid == NULL) || (strcmp(guid, GUID) != 0)) {
        (void)refuse(c, "the GUID is not that of this FMU; description and binary are of different ones");
    } else {
        begin(c);
        return c;
    }
    free(c);
    return NULL;
}

void fmi2FreeInstance(fmi2Component component)
{
    free(component);
}

fmi2Status fmi2SetupExperiment(
    fmi2Component c, fmi2Boolean with_tolerance, fmi2Real tolerance, fmi2Real start, fmi2Boolean with_stop,
    fmi2Real stop)
{
    (void)c;
    (void)with_tolerance;
    (void)tolerance;
    (void)start;
    (void)with_stop;
    (void)stop;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    (void)c;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    begin(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference vr[], size_t count, fmi2Real value[])
{
    instance_type *c = component;
    size_t i;
    for (i = 0; i < count; i++) {
        const double *found = real(&c->memory, vr[i]);
        if (found == NULL) {
            return refuse(c, "there is no real number %u", vr[i]);
        }
        value[i] = *found;
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference vr[], size_t count, const fmi2Real value[])
{
    instance_type *c = component;
    size_t i;
    for (i = 0; i < count; i++) {
        double *found = real(&c->memory, vr[i]);
        if ((found == NULL) || (vr[i] >= INPUTS)) {
            return refuse(c, "the real number %u is no input", vr[i]);
        }
        *found = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference vr[], size_t count, fmi2Integer value[])
{
    instance_type *c = component;
    size_t i;
    for (i = 0; i < count; i++) {
        if (vr[i] != 0) {
            return refuse(c, "there is no integer %u", vr[i]);
        }
        value[i] = c->memory.status;
    }
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer value[])
{
    (void)vr;
    (void)value;
    return (count == 0) ? fmi2OK : refuse(c, "no integer is an input");
}

fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference vr[], size_t count, fmi2Boolean value[])
{
    instance_type *c = component;
    size_t i;
    for (i = 0; i < count; i++) {
        if (vr[i] != 0) {
            return refuse(c, "there is no boolean %u", vr[i]);
        }
        value[i] = (c->memory.readings.valid != 0) ? fmi2True : fmi2False;
    }
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(
    fmi2Component component, const fmi2ValueReference vr[], size_t count, const fmi2Boolean value[])
{
    instance_type *c = component;
    size_t i;
    for (i = 0; i < count; i++) {
        if (vr[i] != 0) {
            return refuse(c, "there is no boolean %u", vr[i]);
        }
        c->memory.readings.valid = (value[i] != fmi2False) ? 1 : 0;
    }
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2String value[])
{
    (void)vr;
    (void)value;
    return (count == 0) ? fmi2OK : refuse(c, "there are no strings");
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2String value[])
{
    (void)vr;
    (void)value;
    return (count == 0) ? fmi2OK : refuse(c, "there are no strings");
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    instance_type *c = component;
    if (*state == NULL) {
        *state = calloc(1, sizeof(memory_type));
    }
    if (*state == NULL) {
        return refuse(c, "there is no memory for a state");
    }
    (void)memcpy(*state, &c->memory, sizeof(memory_type));
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state)
{
    instance_type *c = component;
    if (state == NULL) {
        return refuse(c, "there is no such state");
    }
    (void)memcpy(&c->memory, state, sizeof(memory_type));
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    (void)c;
    (void)state;
    *size = sizeof(memory_type);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    if ((state == NULL) || (size != sizeof(memory_type))) {
        return refuse(c, "a state has %u bytes", (unsigned)sizeof(memory_type));
    }
    (void)memcpy(bytes, state, size);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    if (size != sizeof(memory_type)) {
        return refuse(c, "a state has %u bytes", (unsigned)sizeof(memory_type));
    }
    *state = calloc(1, size);
    if (*state == NULL) {
        return refuse(c, "there is no memory for a state");
    }
    (void)memcpy(*state, bytes, size);
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(
    fmi2Component c, const fmi2ValueReference unknown[], size_t unknowns, const fmi2ValueReference known[],
    size_t knowns, const fmi2Real seed[], fmi2Real sensitivity[])
{
    (void)unknown;
    (void)unknowns;
    (void)known;
    (void)knowns;
    (void)seed;
    (void)sensitivity;
    return refuse(c, "there are no derivatives");
}

fmi2Status fmi2SetRealInputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return refuse(c, "inputs are held over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return refuse(c, "outputs are held over a step");
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real step, fmi2Boolean no_going_back)
{
    instance_type *c = component;
    const double periods = floor((step / UMB_PERIOD) + 0.5);
    int i;
    (void)time;
    (void)no_going_back;
    if (!(periods >= 1.0) || (periods > LONGEST_STEP) || (fabs(step - (periods * UMB_PERIOD)) > (1e-6 * UMB_PERIOD))) {
        return refuse(
            c, "a step of %.9g s is no whole number of control periods of %.9g s: choose such a step", step,
            (double)UMB_PERIOD);
    }
    for (i = 0; i < (int)periods; i++) {
        c->memory.status = (int)umb_update(&c->memory.state, &c->memory.readings);
    }
    return fmi2OK;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return refuse(c, "a step is over when fmi2DoStep() returns");
}

#define NO_STATUS(function, type)                                                \
    fmi2Status function(fmi2Component c, const fmi2StatusKind kind, type *value) \
    {                                                                            \
        (void)kind;                                                              \
        (void)value;                                                             \
        return refuse(c, "a step is over when fmi2DoStep() returns");            \
    }

NO_STATUS(fmi2GetStatus, fmi2Status)
NO_STATUS(fmi2GetRealStatus, fmi2Real)
NO_STATUS(fmi2GetIntegerStatus, fmi2Integer)
NO_STATUS(fmi2GetBooleanStatus, fmi2Boolean)
NO_STATUS(fmi2GetStringStatus, fmi2String)

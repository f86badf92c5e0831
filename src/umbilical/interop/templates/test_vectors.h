/* Samples of the sensors, and what Umbilical's own controller decides on them.
 *
@HEAD@ */
#ifndef UMB_TEST_VECTORS_H
#define UMB_TEST_VECTORS_H

#include "umbilical_controller.h"

#define UPDATES @UPDATES@

static const char *const NAMES[] = {@NAMES@};

static const umb_readings READINGS[UPDATES] = {
@SAMPLES@
};

static const umb_decision DECISIONS[UPDATES] = {
@DECIDED@
};

static const double KAPPAS[UPDATES][UMB_ROOM + 1] = {
@KAPPAS@
};

#endif

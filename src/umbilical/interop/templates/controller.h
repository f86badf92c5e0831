/* Umbilical: the controller of a scenario, in C99, without heap and without library but sqrt().
 *
@HEAD@ *
 * Written by Umbilical from the scenario; do not edit. All numbers are in SI units and radians. How to build it, how it
 * is proved to be the same controller, and what it does when a sensor is lost: README.txt.
 */
#ifndef UMB_CONTROLLER_H
#define UMB_CONTROLLER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define UMB_MOTORS @MOTORS@
#define UMB_ROOM @ROOM@ /* entries of an array with one per motor: C has none of length 0 */
#define UMB_PERIOD @PERIOD@ /* s, from one update to the next: @PERIOD_WORDS@ */
#define UMB_HOLD @HOLD@ /* updates without a valid reading that keep the last command: @HOLD_WORDS@ */
#define UMB_SCENARIO "@HASH@"

typedef enum {
    UMB_OK = 0,      /* the command is new */
    UMB_HOLDING = 1, /* no valid reading: the last command is held */
    UMB_STOPPED = 2  /* no valid reading for longer than UMB_HOLD updates, or none yet: 0 V and 0 N */
} umb_status;

/* What the controller reads, as umbilical.control.contract has it. */

@READINGS@
typedef struct {
    int valid; /* 0: do not use this sample; what is not finite is never used */
    umb_tip_readings tip;@IDEAL_WORDS@
    umb_winch_readings winch;
    umb_motor_readings motors[UMB_ROOM];
} umb_readings;

/* What it decides and estimates. A drive takes motors[i].motor_voltage, an ideal thruster outer.thrust_command. */

@DECISION@
typedef struct {
    umb_outer_decision outer;
    umb_motor_decision motors[UMB_ROOM];
} umb_decision;

/* What it remembers. All of it is one struct without pointers: copy it to save it. */

@MEMORY@
typedef struct {
    int started;
    int lost; /* updates since the last valid reading */
    umb_outer_memory outer;
    double kappa[UMB_ROOM + 1]; /* adaptive allocation: kappa_0 in rad2/(N s2), kappa_1 ... in rad2/s2 */
    umb_motor_memory motors[UMB_ROOM];
    umb_decision decision;
} umb_state;

/* Before the first update, and to begin anew. */
void umb_start(umb_state *state);

/* Once per period: from a sample of the sensors to state->decision, which holds until the next update. */
umb_status umb_update(umb_state *state, const umb_readings *readings);

#ifdef __cplusplus
}
#endif

#endif

/* Proves on this machine, with this compiler, that the controller gives the bits that Umbilical's gives: exit code 0.
 *
 * Then that a lost reading is held and stopped as README.txt says.
 */
#include "umbilical_controller.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "test_vectors.h"

#define NUMBERS ((int)(sizeof(umb_decision) / sizeof(double)))

static int failures = 0;

static void check(int good, const char *what)
{
    if (good == 0) {
        failures += 1;
        (void)printf("FAILED: %s\n", what);
    }
}

static void differ(int update, const char *what, double found, double wanted)
{
    failures += 1;
    (void)printf("FAILED: update %d, %s: %a (%.17g), not %a (%.17g)\n", update, what, found, found, wanted, wanted);
}

static void compare(int update, const umb_state *state)
{
    double found[NUMBERS];
    double wanted[NUMBERS];
    int i;
    (void)memcpy(found, &state->decision, sizeof(found));
    (void)memcpy(wanted, &DECISIONS[update], sizeof(wanted));
    for (i = 0; i < NUMBERS; i++) {
        if (memcmp(&found[i], &wanted[i], sizeof(double)) != 0) {
            differ(update, NAMES[i], found[i], wanted[i]);
        }
    }
    for (i = 0; i <= UMB_MOTORS; i++) {
        if (memcmp(&state->kappa[i], &KAPPAS[update][i], sizeof(double)) != 0) {
            differ(update, "kappa", state->kappa[i], KAPPAS[update][i]);
        }
    }
}

static int is_still(const umb_state *state)
{
    int still = (state->decision.outer.thrust_command == 0.0) ? 1 : 0;
    int i;
    for (i = 0; i < UMB_MOTORS; i++) {
        still = ((still != 0) && (state->decision.motors[i].motor_voltage == 0.0)) ? 1 : 0;
    }
    return still;
}

static void lose_a_reading(umb_state *state, const umb_readings *lost, const char *what)
{
    const umb_state before = *state;
    int i;
    for (i = 0; i < UMB_HOLD; i++) {
        check(umb_update(state, lost) == UMB_HOLDING, what);
    }
    check(memcmp(&before.decision, &state->decision, sizeof(before.decision)) == 0, "the command is held");
    check(umb_update(state, lost) == UMB_STOPPED, what);
    check(is_still(state), "0 V and 0 N after UMB_HOLD updates");
}

int main(void)
{
    umb_state state;
    umb_readings lost = READINGS[0];
    int k;

    umb_start(&state);
    for (k = 0; k < UPDATES; k++) {
        check(umb_update(&state, &READINGS[k]) == UMB_OK, "a valid reading gives a new command");
        compare(k, &state);
    }
    lost.tip.tip_slope = (double)NAN;
    lose_a_reading(&state, &lost, "a reading that is no number is lost");
    check(umb_update(&state, &READINGS[0]) == UMB_OK, "a valid reading begins anew");
    compare(0, &state);
    lost = READINGS[1];
    lost.valid = 0;
    lose_a_reading(&state, &lost, "a reading that is marked as not valid is lost");
    umb_start(&state);
    lost.valid = 1;
    lost.winch.payout_acceleration = (double)INFINITY;
    check(umb_update(&state, &lost) == UMB_STOPPED, "without a first valid reading nothing is commanded");

    if (failures == 0) {
        (void)printf("selftest: %d updates with the bits of Umbilical's controller\n", UPDATES);
    } else {
        (void)printf("selftest: FAILED, %d differences: do not use this build\n", failures);
    }
    return (failures == 0) ? 0 : 1;
}

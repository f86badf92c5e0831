/* Umbilical: the controller of a scenario, in C99. See umbilical_controller.h.
 *
 * Only + - * /, fabs and sqrt, each rounded as IEEE 754 says, in the order of umbilical/control: the same bits as there.
 * Every section is named after the file of umbilical/control that it follows.
 */
#include "umbilical_controller.h"

#include <float.h>
#include <math.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && (__FINITE_MATH_ONLY__ != 0))
#error "do not compile with -ffast-math: it moves the numbers, and lost sensors would not be noticed"
#endif
#if (FLT_EVAL_METHOD == 2) || (FLT_EVAL_METHOD < 0)
#error "this target calculates in more than double precision; on x86 compile with -msse2 -mfpmath=sse"
#endif
/* A fused multiply-add rounds once where Umbilical rounds twice. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

enum { NONE, PD, BOUNDARY };
enum { KNOWN, ADAPTIVE };

@SETTINGS@

/* relations/formulas.py, relations/tension.py */

static double signed_square(double speed)
{
    return fabs(speed) * speed;
}

static double soft_signed_root(double demand, double width)
{
    return demand / sqrt(sqrt((demand * demand) + (width * width)));
}

static double tension(double distance, double net, const umb_hanging *hung)
{
    const double inertial = (hung->mass + (hung->line_density * distance)) * net;
    return inertial - (hung->buoyancy + (hung->line_buoyancy * distance));
}

static double sign(double value)
{
    return (double)((value > 0.0) - (value < 0.0));
}

static double clipped(double value, double lower, double upper)
{
    const double above = (lower > value) ? lower : value;
    return (upper < above) ? upper : above;
}

/* observers/high_gain.py: the rate of a measured signal, (17) and (19) */

static void start_high_gain(umb_high_gain_memory *memory, double signal)
{
    memory->filtered_signal = signal;
    memory->filtered_rate = 0.0;
}

static void advance_high_gain(const umb_high_gain *observer, umb_high_gain_memory *memory, double signal)
{
    const double pi1 = memory->filtered_signal;
    const double pi2 = memory->filtered_rate;
    const double *f0 = observer->form[0];
    const double *f1 = observer->form[1];
    memory->filtered_signal = ((f0[0] * pi1) + (f0[1] * pi2)) + (f0[2] * signal);
    memory->filtered_rate = ((f1[0] * pi1) + (f1[1] * pi2)) + (f1[2] * signal);
}

static double derivative_estimate(const umb_high_gain *observer, const umb_high_gain_memory *memory)
{
    return memory->filtered_rate / observer->time_constant;
}

/* observers/disturbance.py: the force on the ROV that the law does not know, (21) */

static void start_disturbance(
    const umb_disturbance *observer, umb_disturbance_memory *memory, double mass, double velocity)
{
    memory->disturbance_state = (-observer->gain * mass) * velocity;
}

static void advance_disturbance(
    const umb_disturbance *observer, umb_disturbance_memory *memory, double mass, double velocity, double error,
    double known_force)
{
    const double drive = ((observer->coupling * error) + known_force) - ((observer->gain * mass) * velocity);
    memory->disturbance_state = (observer->decay * memory->disturbance_state) + ((1.0 - observer->decay) * drive);
}

static double disturbance_estimate(
    const umb_disturbance *observer, const umb_disturbance_memory *memory, double mass, double velocity)
{
    return (observer->enabled != 0) ? (memory->disturbance_state + ((observer->gain * mass) * velocity)) : 0.0;
}

/* observers/table.py */

static void observe_rates(
    const umb_observers *s, umb_observer_memory *memory, const umb_tip_readings *tip, umb_outer_decision *out,
    int advance)
{
    if (advance != 0) {
        advance_high_gain(&s->velocity, &memory->velocity, tip->tip_displacement);
        advance_high_gain(&s->slope, &memory->slope, tip->tip_slope);
    }
    if (s->ideal_rates != 0) {
        out->tip_velocity_estimate = tip->tip_velocity;
        out->tip_slope_rate_estimate = tip->tip_slope_rate;
    } else {
        out->tip_velocity_estimate = derivative_estimate(&s->velocity, &memory->velocity);
        out->tip_slope_rate_estimate = derivative_estimate(&s->slope, &memory->slope);
    }
}

/* outer/law.py */

static double pull_of_the_cable(const umb_believed *believed, const umb_winch_readings *winch)
{
    return (winch->tip_tension != 0.0)
        ? winch->tip_tension
        : tension(0.0, believed->gravity - winch->payout_acceleration, &believed->hanging);
}

/* outer/pd.py, (66) */

static double pd_thrust(double position_gain, double velocity_gain, double displacement, double velocity)
{
    return (-position_gain * displacement) - (velocity_gain * velocity);
}

static void update_pd(const umb_pdgains *c, const umb_tip_readings *tip, umb_outer_decision *out)
{
    out->thrust_command =
        pd_thrust(c->position_gain, c->velocity_gain, tip->tip_displacement, out->tip_velocity_estimate);
}

/* outer/boundary.py, (22) */

static double boundary_error(double slope_gain, double velocity, double slope)
{
    return velocity + (slope_gain * slope);
}

static double boundary_thrust(
    double damping_gain, double slope_gain, double mass, double error, double slope_rate, double known_force,
    double disturbance)
{
    return (((-damping_gain * error) - ((slope_gain * mass) * slope_rate)) + known_force) - disturbance;
}

static void start_boundary(
    const umb_boundary *c, const umb_believed *believed, umb_boundary_memory *memory, const umb_tip_readings *tip,
    double velocity)
{
    memory->slope_mean = (c->station.washout_rate > 0.0) ? tip->tip_slope : 0.0;
    start_disturbance(&c->disturbance, &memory->disturbance, believed->payload_mass, velocity);
}

static void update_boundary(
    const umb_boundary *c, const umb_believed *believed, umb_boundary_memory *memory, const umb_readings *readings,
    umb_outer_decision *out, int advance)
{
    const umb_tip_readings *tip = &readings->tip;
    const umb_station *station = &c->station;
    const double mass = believed->payload_mass;
    const double velocity = out->tip_velocity_estimate;
    const double away = tip->tip_displacement - station->place;
    const double pull = pull_of_the_cable(believed, &readings->winch);
    double lasting;
    double error;
    double known;
    double changing;
    double thrust;
    double estimate;
    if (advance != 0) {
        memory->slope_mean += station->washout_share * (tip->tip_slope - memory->slope_mean);
    }
    lasting = memory->slope_mean;
    error = boundary_error(c->slope_gain, velocity, tip->tip_slope - lasting) + (station->gain * away);
    known = ((pull * tip->tip_slope) + (believed->payload_damping * velocity))
        + ((c->met_drag * fabs(velocity)) * velocity);
    if (advance != 0) {
        advance_disturbance(
            &c->disturbance, &memory->disturbance, mass, velocity, error, known - out->thrust_command);
    }
    estimate = disturbance_estimate(&c->disturbance, &memory->disturbance, mass, velocity);
    out->boundary_error = error;
    out->disturbance_estimate = estimate;
    changing = out->tip_slope_rate_estimate - (station->washout_rate * (tip->tip_slope - lasting));
    thrust = boundary_thrust(c->damping_gain, c->slope_gain, mass, error, changing, known, estimate);
    out->thrust_command = thrust - ((station->gain * mass) * velocity);
}

/* allocation/known.py */

static void known_demand(const umb_motors *s, double thrust, umb_motor_decision *motors)
{
    double total = 0.0;
    int i;
    for (i = 0; i < UMB_MOTORS; i++) {
        total += fabs(s->nominal[i].thrust_coefficient);
    }
    for (i = 0; i < UMB_MOTORS; i++) {
        motors[i].demand = (sign(s->nominal[i].thrust_coefficient) * thrust) / total;
    }
}

/* allocation/adaptive.py, (23) and (27) */

static void adapt(const umb_kappa_step *steps, double *kappa, double thrust, double error)
{
    int j;
    for (j = 0; j <= UMB_MOTORS; j++) {
        const umb_kappa_step *step = &steps[j];
        const double theta = (j == 0) ? thrust : 1.0;
        const double wanted = (step->kappa_decay * kappa[j]) - ((step->kappa_gain * theta) * error);
        kappa[j] = clipped(wanted, step->kappa_lower, step->kappa_upper);
    }
}

static void adaptive_demand(const umb_motors *s, const double *kappa, double thrust, umb_motor_decision *motors)
{
    double common = kappa[0] * thrust;
    int i;
    for (i = 1; i <= UMB_MOTORS; i++) {
        common += kappa[i];
    }
    for (i = 0; i < UMB_MOTORS; i++) {
        motors[i].demand = sign(s->nominal[i].thrust_coefficient) * common;
    }
}

/* motor/command_filter.py */

static void advance_filter(const umb_command_filter *filter, umb_reference *reference, double demand)
{
    const double root = soft_signed_root(demand, filter->width);
    const double w0 = reference->speed_reference;
    const double w1 = reference->speed_reference_rate;
    const double w2 = reference->speed_reference_curvature;
    const double *f0 = filter->form[0];
    const double *f1 = filter->form[1];
    const double *f2 = filter->form[2];
    reference->speed_reference = (((f0[0] * w0) + (f0[1] * w1)) + (f0[2] * w2)) + (f0[3] * root);
    reference->speed_reference_rate = (((f1[0] * w0) + (f1[1] * w1)) + (f1[2] * w2)) + (f1[3] * root);
    reference->speed_reference_curvature = (((f2[0] * w0) + (f2[1] * w1)) + (f2[2] * w2)) + (f2[3] * root);
}

/* motor/disturbance.py, (61) */

static double start_motor_disturbance(double gain, double scaled_current)
{
    return -gain * scaled_current;
}

static double advance_motor_disturbance(
    const umb_nominal_motor *c, double gain, double decay, double ups, double speed, double scaled_current,
    double drive)
{
    const double known = (((gain * scaled_current) + (c->f21 * speed)) + (c->f22 * scaled_current)) + drive;
    return (decay * ups) - ((1.0 - decay) * known);
}

/* motor/backstepping.py, (52) to (64) */

static double smooth_sign(double error, double width)
{
    return error / sqrt((error * error) + (width * width));
}

static double backstepping_drive(
    const umb_nominal_motor *c, const umb_backstepping *gains, double speed, double scaled_current,
    const umb_reference *reference)
{
    const double e1 = speed - reference->speed_reference;
    const double square = signed_square(speed);
    const double rate = (scaled_current + (c->f11 * speed)) + (c->f12 * square);
    const double e1_rate = rate - reference->speed_reference_rate;
    const double robust1 = gains->speed_bound * gains->robust_factor;
    const double soft = (e1 * e1) + (gains->speed_width * gains->speed_width);
    double wanted;
    double wanted_rate;
    double e2;
    double drive;

    wanted = (((-gains->speed_gain * e1) - (c->f11 * speed)) - (c->f12 * square)) + reference->speed_reference_rate;
    wanted -= robust1 * smooth_sign(e1, gains->speed_width);
    wanted_rate = ((-gains->speed_gain * e1_rate) - (c->f11 * rate)) - (((2.0 * c->f12) * fabs(speed)) * rate);
    wanted_rate += reference->speed_reference_curvature;
    wanted_rate -= (((robust1 * gains->speed_width) * gains->speed_width) * e1_rate) / (soft * sqrt(soft));

    e2 = scaled_current - wanted;
    drive = ((((-gains->current_gain * e2) - e1) - (c->f21 * speed)) - (c->f22 * scaled_current)) + wanted_rate;
    return drive - ((gains->current_bound * gains->robust_factor) * smooth_sign(e2, gains->current_width));
}

/* cascade.py: sample, estimate, decide, hold */

static void start_observers(umb_state *state, const umb_readings *readings)
{
    const umb_outer *s = &SETTINGS.outer;
    const umb_motors *m = &SETTINGS.motors;
    int i;
    start_high_gain(&state->outer.observers.velocity, readings->tip.tip_displacement);
    start_high_gain(&state->outer.observers.slope, readings->tip.tip_slope);
    start_boundary(
        &s->laws.boundary, &s->laws.believed, &state->outer.laws.boundary, &readings->tip,
        (s->observers.ideal_rates != 0) ? readings->tip.tip_velocity : 0.0);
    for (i = 0; i < UMB_MOTORS; i++) {
        const double scaled_current = m->nominal[i].current_scale * readings->motors[i].motor_current;
        state->motors[i].motor_disturbance_state = start_motor_disturbance(m->observer_gain, scaled_current);
    }
}

static void update_outer(umb_state *state, const umb_readings *readings)
{
    const umb_outer *s = &SETTINGS.outer;
    umb_outer_memory *memory = &state->outer;
    umb_outer_decision *out = &state->decision.outer;
    const int advance = (memory->updates > 0) ? 1 : 0;
    observe_rates(&s->observers, &memory->observers, &readings->tip, out, advance);
    if (s->laws.kind == PD) {
        update_pd(&s->laws.pd, &readings->tip, out);
    } else if (s->laws.kind == BOUNDARY) {
        update_boundary(&s->laws.boundary, &s->laws.believed, &memory->laws.boundary, readings, out, advance);
    }
}

static void allocate(umb_state *state)
{
    const umb_motors *s = &SETTINGS.motors;
    const umb_outer_decision *outer = &state->decision.outer;
    if (s->allocation.method == ADAPTIVE) {
        if (state->outer.updates > 0) {
            adapt(s->allocation.adaptation, state->kappa, outer->thrust_command, outer->boundary_error);
        }
        adaptive_demand(s, state->kappa, outer->thrust_command, state->decision.motors);
    } else {
        known_demand(s, outer->thrust_command, state->decision.motors);
    }
}

static void update_motors(umb_state *state, const umb_readings *readings)
{
    const umb_motors *s = &SETTINGS.motors;
    int i;
    for (i = 0; i < UMB_MOTORS; i++) {
        const umb_nominal_motor *c = &s->nominal[i];
        umb_motor_memory *memory = &state->motors[i];
        umb_motor_decision *out = &state->decision.motors[i];
        const double speed = readings->motors[i].motor_speed;
        const double scaled_current = c->current_scale * readings->motors[i].motor_current;
        double disturbance;
        double drive;
        if (state->outer.updates > 0) {
            advance_filter(&s->command_filter, &memory->reference, out->demand);
            memory->motor_disturbance_state = advance_motor_disturbance(
                c, s->observer_gain, s->observer_decay, memory->motor_disturbance_state, speed, scaled_current,
                memory->held_drive);
        }
        disturbance = memory->motor_disturbance_state + (s->observer_gain * scaled_current);
        drive = backstepping_drive(c, &s->backstepping, speed, scaled_current, &memory->reference) - disturbance;
        out->motor_voltage = clipped(drive / c->f23, -c->voltage_limit, c->voltage_limit);
        memory->held_drive = c->f23 * out->motor_voltage;
        out->speed_reference = memory->reference.speed_reference;
        out->motor_disturbance_estimate = disturbance;
    }
}

static void decide(umb_state *state, const umb_readings *readings)
{
    if ((state->outer.updates % SETTINGS.outer_every) == 0) {
        update_outer(state, readings);
        if (SETTINGS.motors.driven != 0) {
            allocate(state);
        }
    }
    if (SETTINGS.motors.driven != 0) {
        update_motors(state, readings);
    }
    state->outer.updates += 1;
}

/* Not in Umbilical, where such a run ends: what happens without a valid reading. */

static int usable(const umb_readings *readings)
{
    const umb_tip_readings *tip = &readings->tip;
    int good = (readings->valid != 0) && isfinite(tip->tip_displacement) && isfinite(tip->tip_slope)
        && isfinite(readings->winch.payout_acceleration);
    int i;
    if (SETTINGS.outer.observers.ideal_rates != 0) {
        good = good && isfinite(tip->tip_velocity) && isfinite(tip->tip_slope_rate);
    }
    for (i = 0; i < UMB_MOTORS; i++) {
        good = good && isfinite(readings->motors[i].motor_speed) && isfinite(readings->motors[i].motor_current);
    }
    return good;
}

static int commands_are_finite(const umb_decision *decision)
{
    int good = isfinite(decision->outer.thrust_command);
    int i;
    for (i = 0; i < UMB_MOTORS; i++) {
        good = good && isfinite(decision->motors[i].motor_voltage);
    }
    return good ? 1 : 0;
}

static void stop(umb_state *state)
{
    int i;
    state->started = 0;
    state->decision.outer.thrust_command = 0.0;
    for (i = 0; i < UMB_MOTORS; i++) {
        state->decision.motors[i].motor_voltage = 0.0;
    }
}

void umb_start(umb_state *state)
{
    static const umb_state nothing = {0};
    int j;
    *state = nothing;
    for (j = 0; j <= UMB_MOTORS; j++) {
        state->kappa[j] = INITIAL_KAPPA[j];
    }
}

umb_status umb_update(umb_state *state, const umb_readings *readings)
{
    umb_status status = UMB_HOLDING;
    umb_state next = *state;
    if (usable(readings) != 0) {
        if (next.started == 0) {
            umb_start(&next);
            start_observers(&next, readings);
            next.started = 1;
        }
        decide(&next, readings);
        if (commands_are_finite(&next.decision) != 0) {
            status = UMB_OK;
        }
    }
    if (status == UMB_OK) {
        next.lost = 0;
        *state = next;
    } else if ((state->started != 0) && (state->lost < UMB_HOLD)) {
        state->lost += 1;
    } else {
        stop(state);
        status = UMB_STOPPED;
    }
    return status;
}

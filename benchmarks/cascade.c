/* The paper's closed loop by hand, as fast as plain C gives it: a yardstick for the compiled loop.
 *
 * N intervals of equal length along xi = x/l, differences of second order, classical Runge-Kutta of order 4, one step
 * per control period; the whole cascade of control/cascade.py, sampled, with its observers exact in a period and its
 * filters and adaptive parts by Euler's rule. All numbers are those of the preset "paper", known to the compiler.
 *
 *     cascade N STEPS     prints milliseconds of the 50 s, then y(l,t) in metres, once a second
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 1024, MOTORS = 2 };
static const double DURATION = 50.0, RHO = 2.0, MASS = 500.0, DAMPING = 0.001, TIP_DAMPING = 0.001, GRAVITY = 10.0;
static const double INERTIA = 0.5, FRICTION = 0.015, K_T = 4.0, K_Q = 1.0, R = 0.08, L = 0.002, K_B = 0.5;
static const double THRUST[MOTORS] = {1.2, 0.8};
static const double K_A = 1e4, BETA = 0.01, EPS = 0.005, K_S = 5.0, SIGMA = 1.0;
static const double K_1 = 50.0, K_2 = 500.0, MU = 1.5, WIDTH_1 = 0.1, WIDTH_2 = 2.0, BOUND_1 = 4.0, BOUND_2 = 120.0;
static const double G_O = 100.0, W_C = 200.0, SOFT = 1e-3;

typedef struct { double length, speed, acceleration; } Winch;
typedef struct { double y[MOST + 1], w[MOST + 1], motor[MOTORS][2]; } State;   /* y, Dy/Dt; speed and current */
typedef struct { double first, second; } Observer;
typedef struct { Observer velocity, slope; double phi, filter[MOTORS][3], upsilon[MOTORS]; } Memory;

static int n;

static Winch winch(double t) {
    double q = t < DURATION ? t / DURATION : 1.0;
    return (Winch){450.0 + 50.0 * q * q * q * (10.0 - 15.0 * q + 6.0 * q * q),
                   q * q * (30.0 - 60.0 * q + 30.0 * q * q), (60.0 - 180.0 * q + 120.0 * q * q) * q / DURATION};
}

static double force(double t) { return 100.0 + 50.0 * sin(0.7 * t) + 30.0 * sin(0.5 * t) + 20.0 * sin(0.9 * t); }

/* Rates of motors under held voltages; returns the thrust that they give. */
static double drive(double t, const double (*motor)[2], const double *voltage, double (*rate)[2]) {
    double bell = (t - 25.0) / 8.0, outside[MOTORS] = {sin(20.0 * t), 1.0 / (1.0 + bell * bell * bell * bell)};
    double thrust = 0.0;
    for (int i = 0; i < MOTORS; i++) {
        double speed = motor[i][0], current = motor[i][1], squared = speed * fabs(speed);
        rate[i][0] = (K_T * current - FRICTION * speed - K_Q * squared + outside[i]) / INERTIA;
        rate[i][1] = (voltage[i] + 0.2 * outside[i] - R * current - K_B * speed) / L;
        thrust += THRUST[i] * squared;
    }
    return thrust;
}

/* Rates of the cable, material rates carried along the grid, and of the ROV at its end. */
static void rates(double t, const State *restrict s, const double *voltage, State *restrict out) {
    const double *restrict y = s->y, *restrict w = s->w;
    Winch top = winch(t);
    double h = 1.0 / n, net = GRAVITY - top.acceleration, hung = RHO * top.length;
    double carry = 0.5 * top.speed / top.length * n, stiff = net * n * n / (RHO * top.length * top.length);
    double loss = DAMPING / RHO;
    for (int i = 1; i < n; i++) {
        double left = 1.0 - i * h, drift = carry * left;
        double above = MASS + hung * (left + 0.5 * h), below = MASS + hung * (left - 0.5 * h);
        out->y[i] = w[i] - drift * (y[i + 1] - y[i - 1]);
        out->w[i] = stiff * (below * (y[i + 1] - y[i]) - above * (y[i] - y[i - 1])) - loss * w[i]
                    - drift * (w[i + 1] - w[i - 1]);
    }
    out->y[0] = out->w[0] = 0.0;
    double thrust = drive(t, s->motor, voltage, out->motor);
    double pull = (MASS + 0.5 * hung * h) * net * (y[n] - y[n - 1]) * n / top.length;
    out->y[n] = w[n];
    out->w[n] = (force(t) + thrust - TIP_DAMPING * w[n] - pull) / (MASS + 0.5 * hung * h);
}

/* At the vessel the material slides through at v: w = Dy/Dt = v y_x there, by a one-sided difference. */
static void hold_vessel(State *s, double t) {
    Winch top = winch(t);
    s->w[0] = top.speed / top.length * 0.5 * n * (4.0 * s->y[1] - 3.0 * s->y[0] - s->y[2]);
}

static void add(State *restrict to, const State *restrict from, double h, const State *restrict rate) {
    for (int i = 0; i <= n; i++) {
        to->y[i] = from->y[i] + h * rate->y[i];
        to->w[i] = from->w[i] + h * rate->w[i];
    }
    for (int i = 0; i < MOTORS; i++)
        for (int k = 0; k < 2; k++) to->motor[i][k] = from->motor[i][k] + h * rate->motor[i][k];
}

static void step(double t, double h, State *s, const double *voltage) {
    static State now, k[4];
    static const double at[4] = {0.0, 0.5, 0.5, 1.0};
    hold_vessel(s, t);
    rates(t, s, voltage, &k[0]);
    for (int j = 1; j < 4; j++) {
        add(&now, s, at[j] * h, &k[j - 1]);
        hold_vessel(&now, t + at[j] * h);
        rates(t + at[j] * h, &now, voltage, &k[j]);
    }
    for (int i = 0; i <= n; i++) {
        s->y[i] += h / 6.0 * (k[0].y[i] + 2.0 * (k[1].y[i] + k[2].y[i]) + k[3].y[i]);
        s->w[i] += h / 6.0 * (k[0].w[i] + 2.0 * (k[1].w[i] + k[2].w[i]) + k[3].w[i]);
    }
    for (int i = 0; i < MOTORS; i++)
        for (int c = 0; c < 2; c++)
            s->motor[i][c] += h / 6.0 * (k[0].motor[i][c] + 2.0 * (k[1].motor[i][c] + k[2].motor[i][c])
                                         + k[3].motor[i][c]);
}

/* One period of eps pi1' = pi2, eps pi2' = -2 pi2 - pi1 + input under a held input. */
static void observe(Observer *o, double input, double h) {
    double q = h / EPS, decay = exp(-q), first = o->first - input, second = o->second;
    o->first = input + decay * ((1.0 + q) * first + q * second);
    o->second = decay * ((1.0 - q) * second - q * first);
}

static double outer(Memory *m, double x1, double z1, double tension, double h) {
    double x2 = m->velocity.second / EPS, z2 = m->slope.second / EPS, error = x2 + BETA * z1;
    double known = tension * z1 + TIP_DAMPING * x2, estimate = m->phi + K_S * MASS * x2;
    double thrust = -K_A * error - BETA * MASS * z2 + known - estimate;
    m->phi += h * K_S * (SIGMA * error + known - thrust - estimate);
    observe(&m->velocity, x1, h);
    observe(&m->slope, z1, h);
    return thrust;
}

static double inner(Memory *m, int i, double wanted, const double *motor, double h) {
    const double f11 = -FRICTION / INERTIA, f12 = -K_Q / INERTIA, f21 = -K_T * K_B / (INERTIA * L), f22 = -R / L;
    const double f23 = K_T / (INERTIA * L);
    double *f = m->filter[i], speed = motor[0], z2 = K_T / INERTIA * motor[1];
    double rate = z2 + f11 * speed + f12 * speed * fabs(speed);
    double e1 = speed - f[0], e1_rate = rate - f[1], soft = sqrt(e1 * e1 + WIDTH_1 * WIDTH_1);
    double goal = -K_1 * e1 - f11 * speed - f12 * speed * fabs(speed) - BOUND_1 * MU * e1 / soft + f[1];
    double goal_rate = -K_1 * e1_rate - f11 * rate - 2.0 * f12 * fabs(speed) * rate
                       - BOUND_1 * MU * WIDTH_1 * WIDTH_1 * e1_rate / (soft * soft * soft) + f[2];
    double e2 = z2 - goal, estimate = m->upsilon[i] + G_O * z2;
    double v = -K_2 * e2 - e1 - f21 * speed - f22 * z2 - BOUND_2 * MU * e2 / sqrt(e2 * e2 + WIDTH_2 * WIDTH_2)
               + goal_rate - estimate;
    m->upsilon[i] -= h * G_O * (estimate + f21 * speed + f22 * z2 + v);
    f[2] += h * (W_C * W_C * W_C * (wanted - f[0]) - 3.0 * W_C * W_C * f[1] - 3.0 * W_C * f[2]);
    f[0] += h * f[1];
    f[1] += h * f[2];
    return v / f23;
}

static void period(double t, double h, State *s, Memory *m) {
    Winch top = winch(t);
    double slope = 0.5 * n * (3.0 * s->y[n] - 4.0 * s->y[n - 1] + s->y[n - 2]) / top.length, voltage[MOTORS];
    double demand = outer(m, s->y[n], slope, MASS * (GRAVITY - top.acceleration), h) / (THRUST[0] + THRUST[1]);
    double wanted = demand / sqrt(sqrt(demand * demand + SOFT * SOFT));
    for (int i = 0; i < MOTORS; i++) voltage[i] = inner(m, i, wanted, s->motor[i], h);
    step(t, h, s, voltage);
}

int main(int count, char **word) {
    static State s;
    static double seen[51];
    Memory m = {0};
    struct timespec begun, ended;
    n = count > 1 ? atoi(word[1]) : 100;
    int steps = count > 2 ? atoi(word[2]) : 50000;
    if (n < 4 || n > MOST || steps < 50 || steps % 50) return 2;
    clock_gettime(CLOCK_MONOTONIC, &begun);
    for (int k = 0; k < steps; k++) {
        if (k % (steps / 50) == 0) seen[k / (steps / 50)] = s.y[n];
        period(k * DURATION / steps, DURATION / steps, &s, &m);
    }
    seen[50] = s.y[n];
    clock_gettime(CLOCK_MONOTONIC, &ended);
    printf("%.3f\n", (ended.tv_sec - begun.tv_sec) * 1e3 + (ended.tv_nsec - begun.tv_nsec) * 1e-6);
    for (int k = 0; k <= 50; k++) printf("%.10g\n", seen[k]);
    return 0;
}

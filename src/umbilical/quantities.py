"""Words: the unit, the paper's symbol and the meaning attached to every public name.

One table serves the scenario's fields, the axis labels, the result files and ``docs/notation.md``.
"""

from __future__ import annotations

from typing import NamedTuple


class Quantity(NamedTuple):
    """What a name stands for.

    Attributes:
        unit: SI unit ("1" for a pure number, "" where a unit has no sense).
        symbol: the paper's symbol, as LaTeX without dollars; "" for what the paper does not have.
        meaning: one short line, also the ``long_name`` in result files.
        source: equation, table or section of the paper; "" for what is ours.
        clash: the other meaning the paper gives the same symbol, if any.
        over: what a channel depends on besides time: "sigma", "motor", "kappa_index", "axis", or two of them with a
            space between; "" for time alone.
    """

    unit: str
    symbol: str
    meaning: str
    source: str = ""
    clash: str = ""
    over: str = ""


# fmt: off
PARAMETERS: dict[str, Quantity] = {
    # the run
    "duration":            Quantity("s", "t", "length of the simulated time", "Table 2"),
    # cable, payload, environment
    "line_density":        Quantity("kg/m", r"\rho", "line density of the cable", "Table 2", "rho_i is the effectiveness of motor i"),
    "wet_line_density":    Quantity("kg/m", "", "weight of a metre of cable in water over g"),
    "cable_damping":       Quantity("N s/m2", "c", "viscous damping per metre of cable", "(6)", "Table 1 swaps c and c_tip"),
    "payload_mass":        Quantity("kg", "m", "mass of the ROV", "Table 2"),
    "wet_weight":          Quantity("N", "W", "weight of the ROV in water"),
    "payload_damping":     Quantity("N s/m", r"c_{tip}", "viscous damping of the ROV", "(8)", "Table 1 swaps c and c_tip"),
    "gravity":             Quantity("m/s2", "g", "gravitational acceleration", "Table 2"),
    # water
    "water_density":       Quantity("kg/m3", r"\rho_w", "density of the water"),
    "strumming":           Quantity("1", "A^*", "amplitude of vortex vibration over the diameter: drag grows by 1 + 2.1 A*"),
    "body_horizontal_added_mass": Quantity("kg", "A_h", "added mass of the ROV across the cable"),
    "body_vertical_added_mass": Quantity("kg", "A_z", "added mass of the ROV along the cable"),
    "body_linear_drag":    Quantity("N s/m", "D_l", "drag of the ROV over its speed through the water"),
    "body_quadratic_drag": Quantity("N s2/m2", "D_q", "drag of the ROV over the square of its speed through the water"),
    "body_vertical_drag":  Quantity("N s2/m2", "", "drag of the ROV along the cable over the square of the speed"),
    "body_across_added_mass": Quantity("kg", "", "added mass of the ROV in the direction y of the rope; left out, as along x"),
    "body_across_drag":    Quantity("N s2/m2", "", "drag of the ROV in the direction y of the rope over the square of the speed; left out, as along x"),
    "equilibrium_tip":     Quantity("m", "", "displacement at which the thrusters hold the ROV at the start; left out it is free"),
    # winch
    "length":              Quantity("m", "l", "cable length paid out", "Table 1"),
    "payout_speed":        Quantity("m/s", "v", "winch speed, positive paying out", "Table 1"),
    "winch_start":         Quantity("s", "", "instant the winch starts"),
    "winch_duration":      Quantity("s", "", "how long the winch runs"),
    "winch_start_length":  Quantity("m", "l(0)", "cable length at the start of the run"),
    "winch_end_length":    Quantity("m", "", "cable length when the winch has stopped"),
    "winch_top_speed":     Quantity("m/s", "", "speed of the winch between speeding up and braking"),
    "winch_acceleration":  Quantity("m/s2", "", "acceleration of the winch when it speeds up and brakes"),
    "winch_amplitude":     Quantity("m", "", "half of what a cosine winch law pays out and hauls in again"),
    "winch_frequency":     Quantity("rad/s", "", "angular frequency of a cosine winch law"),
    # vessel, loads along the cable, shape at the start
    "vessel_ramp":         Quantity("s", "", "time over which the vessel's motion is faded in"),
    "profile_center":      Quantity("1", "", "where a load is largest, sigma = x/l"),
    "profile_width":       Quantity("1", "", "width of a load in sigma = x/l"),
    "shape_amplitude":     Quantity("m", "", "size of the displacement at the start"),
    "shape_half_waves":    Quantity("1", "", "half waves between vessel and ROV"),
    "shape_distance":      Quantity("m", "", "distance from the ROV up to the middle of the shape"),
    "shape_width":         Quantity("m", "", "width of the shape"),
    "static_force":        Quantity("N", "", "steady force on the ROV that bent the cable"),
    # signals
    "signal_frequency":    Quantity("rad/s", "", "angular frequency of a sine"),
    "signal_phase":        Quantity("rad", "", "phase of a sine"),
    "signal_time":         Quantity("s", "", "an instant of the run"),
    "signal_width":        Quantity("s", "", "time from the top of a bell to half its height"),
    "signal_value":        Quantity("", "", "value in the unit of the signal it belongs to"),
    "signal_exponent":     Quantity("1", "", "half the exponent of a generalised bell"),
    "sigma":               Quantity("1", r"\sigma", "position along the cable, x/l: 0 vessel, 1 ROV"),
    # motors
    "inertia":             Quantity("kg m2", "J", "rotor and propeller inertia", "(15)"),
    "viscous_friction":    Quantity("N m s/rad", "B", "viscous friction of the shaft", "(15)"),
    "torque_constant":     Quantity("N m/A", "K_t", "torque constant", "(15)"),
    "load_coefficient":    Quantity("N m s2/rad2", "K_Q", "propeller torque coefficient", "(15)"),
    "resistance":          Quantity("ohm", "R", "armature resistance", "(15)"),
    "inductance":          Quantity("H", "L", "armature inductance", "(15)", "the paper writes the observer gain g_o with the same symbol"),
    "back_emf_constant":   Quantity("V s/rad", "K_b", "back-EMF constant", "(15)"),
    "thrust_coefficient":  Quantity("N s2/rad2", "K_T", "thrust per signed square of the speed", "(8)"),
    "voltage_limit":       Quantity("V", "", "drive voltage is clipped at plus and minus this"),
    # faults
    "effectiveness":       Quantity("1", r"\rho_i", "share of its thrust (or voltage) a motor still delivers", "(16)", "rho alone is the line density"),
    "stuck_value":         Quantity("rad2/s2 or V", "u_k", "value at which a motor's thrust demand or voltage is stuck", "(16)"),
    "fault_start":         Quantity("s", "t_f", "instant the fault begins", "(16)"),
    "fault_end":           Quantity("s", "", "instant the fault ends"),
    "fault_ramp":          Quantity("s", "", "time over which the effectiveness changes"),
    "fault_cycle":         Quantity("s", "", "time from one beginning of an intermittent fault to the next"),
    "duty":                Quantity("1", "", "share of each cycle during which an intermittent fault is present"),
    # sensors
    "sensor_noise":        Quantity("", "", "standard deviation of white noise, per sample, in the channel's unit"),
    "sensor_bias":         Quantity("", "", "constant error, in the channel's unit"),
    "sensor_resolution":   Quantity("", "", "quantisation step, in the channel's unit (0: none)"),
    "sensor_latency":      Quantity("s", "", "age of the reading when the controller gets it"),
    "sensor_dropout":      Quantity("1", "", "probability that a reading is lost and the last one held"),
    # control
    "control_period":      Quantity("s", "h", "period of the controller"),
    "outer_period":        Quantity("s", "", "period of the outer law, where it is not that of the controller"),
    "damping_gain":        Quantity("N s/m", "k_a", "boundary damping gain", "(22)"),
    "slope_gain":          Quantity("m/s", r"\beta", "weight of the boundary slope in u_a", "(22)"),
    "station_gain":        Quantity("1/s", r"\kappa_s", "weight of the distance from the station in u_a"),
    "station":             Quantity("m", "y_r", "displacement at which the ROV is to stay"),
    "washout_time":        Quantity("s", "", "time over which the law forgets a slope that lasts"),
    "position_gain":       Quantity("N/m", "k_p", "PD position gain", "(66)"),
    "velocity_gain":       Quantity("N s/m", "k_d", "PD velocity gain", "(66)"),
    "observer_time":       Quantity("s", r"\varepsilon", "time constant of a high-gain observer", "(17), (19)"),
    "observer_damping":    Quantity("1", r"\bar\lambda", "damping of a high-gain observer", "(17), (19)"),
    "disturbance_gain":    Quantity("1/s", r"k_\sigma", "gain of the disturbance observer", "(21)"),
    "disturbance_coupling": Quantity("kg/s", r"\varsigma", "weight of u_a in the disturbance observer", "(21)"),
    "adaptation_rate":     Quantity("rad2/(N2 m s2), rad2/(m s2)", r"\Gamma", "adaptation rates of kappa_0, and of each of kappa_1 ... kappa_n", "(27)"),
    "adaptation_leak":     Quantity("", r"\sigma_\kappa", "leak of the adaptive law; times a rate it is in 1/s", "(27)"),
    "kappa_initial":       Quantity("rad2/(N s2), rad2/s2", r"\kappa(0)", "start of kappa_0, and of each of kappa_1 ... kappa_n", "(23)"),
    "speed_gain":          Quantity("1/s", "k_1", "gain on the speed error", "(52)"),
    "current_gain":        Quantity("1/s", "k_2", "gain on the scaled current error", "(60)"),
    "robust_factor":       Quantity("1", r"\mu", "factor of the smooth robust terms, above 1", "(51)"),
    "speed_width":         Quantity("rad/s", r"\varepsilon_0", "softening of the speed robust term", "(51)", "epsilon_1, epsilon_2 are observer times"),
    "current_width":       Quantity("rad/s2", r"e_{02}", "softening of the current robust term"),
    "speed_bound":         Quantity("rad/s2", r"\bar d_{\Delta 1}", "bound on the torque disturbance over the inertia", "(52)"),
    "current_bound":       Quantity("rad/s3", r"\bar d_{\Delta 2}", "bound on what the motor observer leaves", "(60)"),
    "motor_observer_gain": Quantity("1/s", "g_o", "gain of the motor disturbance observer", "(61)", "the paper prints the inductance L_a"),
    "filter_frequency":    Quantity("rad/s", r"\omega_c", "poles of the command filter"),
    "root_width":          Quantity("rad2/s2", "s", "softening of the signed root of the demand"),
    # rope
    "axial_stiffness":     Quantity("N", "EA", "force over strain of the cable"),
    "cable_diameter":      Quantity("m", "d", "diameter of the cable"),
    "normal_drag":         Quantity("1", "C_{dn}", "drag coefficient across the cable"),
    "tangential_drag":     Quantity("1", "C_{dt}", "drag coefficient along the cable, over its circumference"),
    "added_mass":          Quantity("1", "C_a", "added mass across the cable over the displaced water"),
    "body_displaced":      Quantity("kg", "", "water that the body displaces: it follows waves"),
    "thrust_direction":    Quantity("rad", "", "direction of each motor's thrust, 0 along x, pi/2 along y"),
    # numerics
    "plant_step":          Quantity("s", "", "largest step of the plant; shorter where the waves on the cable demand it"),
    "output_interval":     Quantity("s", "", "time between stored samples"),
}

# In the order of result files.
CHANNELS: dict[str, Quantity] = {
    # winch, boundaries
    "length":                  Quantity("m", "l", "cable length paid out", "Table 1"),
    "payout_speed":            Quantity("m/s", "v", "winch speed, positive paying out", "Table 1"),
    "payout_acceleration":     Quantity("m/s2", "a", "winch acceleration", "Table 1"),
    "vessel_displacement":     Quantity("m", "e", "vessel displacement y(0,t)", "(7)"),
    "vessel_slope":            Quantity("1", r"y_x(0,t)", "cable slope at the vessel"),
    "tip_displacement":        Quantity("m", "x_1", "ROV displacement y(l,t)", "(17)"),
    "tip_velocity":            Quantity("m/s", "x_2", "ROV velocity Dy/Dt(l,t)", "(17)"),
    "tip_slope":               Quantity("1", "z_1", "cable slope at the ROV y_x(l,t)", "(19)", "z_1, z_2 are also the motor states of (46), (47)"),
    "tip_slope_rate":          Quantity("1/s", "z_2", "material rate of the slope at the ROV", "(19)", "z_1, z_2 are also the motor states of (46), (47)"),
    # outer law and its estimates
    "thrust_command":          Quantity("N", r"\alpha_c", "commanded thrust", "(22)"),
    "boundary_error":          Quantity("m/s", "u_a", "boundary variable x2 + beta z1, as estimated", "(22)"),
    "tip_velocity_estimate":   Quantity("m/s", r"\hat x_2", "observer's ROV velocity", "(17)"),
    "tip_slope_rate_estimate": Quantity("1/s", r"\hat z_2", "observer's slope rate", "(19)"),
    "disturbance_estimate":    Quantity("N", r"\hat D", "estimated disturbance of the ROV", "(21)"),
    # forces on the ROV
    "payload_force":           Quantity("N", "d", "external force on the ROV", "(8)"),
    "thrust":                  Quantity("N", r"\alpha", "delivered thrust", "(8)"),
    "disturbance":             Quantity("N", "D", "what the controller sees as disturbance: d + thrust - commanded thrust", "(8)"),
    # work done on the energy since the start
    "work_thrust":             Quantity("J", "", "work of the thrust"),
    "work_payload_force":      Quantity("J", "", "work of the external force on the ROV"),
    "work_payload_damping":    Quantity("J", "", "work of the ROV's damping"),
    "work_vessel":             Quantity("J", "", "energy that came through the vessel end (payout and vessel motion)"),
    "work_cable_damping":      Quantity("J", "", "work of the cable's damping"),
    "work_cable_load":         Quantity("J", "", "work of the load along the cable"),
    "work_tension":            Quantity("J", "", "work of the changing tension (winch jerk)"),
    "work_weight":             Quantity("J", "", "work of the weights in water"),
    "work_drag":               Quantity("J", "", "work of the drag on the cable; on the string less what the current gives"),
    "work_body_drag":          Quantity("J", "", "work of the drag on the ROV, less what the current gives"),
    "work_current":            Quantity("J", "", "what the current gives to cable and ROV: drag times its speed, and its acceleration"),
    "work_added_mass":         Quantity("J", "", "work of the moved water; on the string what of it leaves at the ROV as the cable slides"),
    "work_grid":               Quantity("J", "", "taken by the grid from waves it cannot carry (upwind flux)"),
    # motors
    "motor_speed":             Quantity("rad/s", r"\omega", "motor speed", "(15)", over="motor"),
    "motor_current":           Quantity("A", "i", "motor current", "(15)", over="motor"),
    "motor_voltage":           Quantity("V", "U", "commanded motor voltage", "(15)", over="motor"),
    "demand":                  Quantity("rad2/s2", "U_i", "demanded signed square of the motor speed", "(23)", "U is also the voltage", over="motor"),
    "speed_reference":         Quantity("rad/s", r"\omega_d", "filtered speed reference", "(48)", over="motor"),
    "motor_disturbance":       Quantity("rad/s3", r"d_{\Delta 2}", "scaled voltage disturbance f23 d2", "(57)", over="motor"),
    "motor_disturbance_estimate": Quantity("rad/s3", r"\hat d_{\Delta 2}", "estimated scaled voltage disturbance", "(61)", over="motor"),
    "effectiveness":           Quantity("1", r"\rho_i", "effectiveness of the motor's thrust", "(16)", over="motor"),
    "kappa":                   Quantity("", r"\kappa", "adaptive allocation: kappa_0 in rad2/(N s2), kappa_1 ... kappa_n in rad2/s2", "(23)", over="kappa_index"),
    # rope: in space, x along the string's displacement, y across it, z up
    "vessel_position":         Quantity("m", r"\mathbf{r}_v", "place of the sheave in space", over="axis"),
    "body_position":           Quantity("m", r"\mathbf{r}(l)", "place of the body in space", over="axis"),
    "body_velocity":           Quantity("m/s", r"\mathbf{V}", "velocity of the body in space", over="axis"),
    "body_thrust":             Quantity("N", r"\boldsymbol{\alpha}", "thrust on the body in space", over="axis"),
    "thrust_command_across":   Quantity("N", r"\alpha_c", "commanded thrust in the direction y"),
    "boundary_error_across":   Quantity("m/s", "u_a", "boundary variable of the direction y"),
    "disturbance_estimate_across": Quantity("N", r"\hat D", "estimated disturbance of the body in the direction y"),
    "top_tension":             Quantity("N", "N(0)", "tension at the sheave"),
    "end_tension":             Quantity("N", "N(l)", "tension at the body"),
    "lowest_tension":          Quantity("N", "", "smallest tension along the cable"),
    "slack_length":            Quantity("m", "", "length of cable that nothing pulls"),
    "position":                Quantity("m", r"\mathbf{r}", "place of the cable in space", over="axis sigma"),
    "tension":                 Quantity("N", "N", "tension along the cable", over="sigma"),
    # along the cable
    "displacement":            Quantity("m", "y", "transverse displacement of the cable", "(6)", over="sigma"),
    "slope":                   Quantity("1", "y_x", "slope of the cable", "(6)", over="sigma"),
    "velocity":                Quantity("m/s", r"\mathrm{D}y/\mathrm{D}t", "material velocity of the cable", "(6)", over="sigma"),
    # energy
    "energy":                  Quantity("J", "E", "energy of cable and ROV"),
    "energy_residual":         Quantity("J", "", "energy minus its start and all work: what the discretisation leaves open"),
}

# What plant, sensors and controller remember or get from outside, beside what a run publishes.
STATES: dict[str, Quantity] = {
    # from outside
    "net_gravity":             Quantity("m/s2", "g - a", "gravity less the winch acceleration"),
    "relative_jerk":           Quantity("1/s", "a'/(g - a)", "winch jerk over gravity less its acceleration"),
    "vessel_velocity":         Quantity("m/s", "e'", "vessel velocity"),
    "heave":                   Quantity("m", r"\zeta", "heave of the sheave, up"),
    "sink_speed":              Quantity("m/s", r"v - \zeta'", "speed at which the cable sinks through the water"),
    "sink_acceleration":       Quantity("m/s2", r"a - \zeta''", "acceleration at which it sinks"),
    "elastic_tension":         Quantity("N", "", "what the cable's stretch adds to the tension at the ROV"),
    "elastic_gradient":        Quantity("N/m", "", "what it adds per metre of cable above the ROV"),
    "elastic_tension_rate":    Quantity("N/s", "", "rate of what stretch adds at the ROV"),
    "elastic_gradient_rate":   Quantity("N/(m s)", "", "rate of what it adds per metre"),
    "slope_mean":              Quantity("1", "z_w", "slope at the ROV that lasts, as the law follows it"),
    "slip":                    Quantity("m/s", r"\rho_a (v - \zeta')/M", "how fast the mass that moves across lags behind the sliding cable"),
    "current_factor":          Quantity("1", "", "factor of the current's profile"),
    "current_rate":            Quantity("1/s", "", "rate of that factor"),
    "wave_place":              Quantity("1", "", "instant in the table of the waves' orbital motion"),
    "current_length":          Quantity("m", "l", "length for which the current at the nodes was last worked out"),
    "current_heave":           Quantity("m", r"\zeta", "heave for which it was"),
    "work_body_current":       Quantity("J", "", "what the current gives to the ROV"),
    "power_body_current":      Quantity("W", "", "present power of that"),
    "power_body_drag":         Quantity("W", "", "present power of the ROV's drag"),
    "power_added_mass":        Quantity("W", "", "present power of the moved water that leaves"),
    "torque_disturbance":      Quantity("N m", "d_1", "torque disturbance of a motor", "(15)"),
    "voltage_disturbance":     Quantity("V", "d_2", "voltage disturbance of a motor", "(15)"),
    "stuck_thrust":            Quantity("rad2/s2", "u_k", "value at which a motor's thrust demand is stuck", "(16)"),
    "drive_effectiveness":     Quantity("1", "", "share of its voltage that reaches a motor"),
    "stuck_voltage":           Quantity("V", "", "value at which a motor's voltage is stuck"),
    # rope
    "vessel_speed":            Quantity("m/s", r"\mathbf{r}_v'", "velocity of the sheave in space"),
    "body_force":              Quantity("N", r"\mathbf{d}", "external force on the body in space"),
    "thrust_before":           Quantity("N", "", "thrust on the body at the start of a step"),
    "tip_tension":             Quantity("N", "N(l)", "tension at the ROV as it is measured; 0 where the controller works it out"),
    "entering_stretch":        Quantity("1", r"\mathbf{p}^*", "r_x of the cable that passes the sheave"),
    "top_velocity":            Quantity("m/s", r"\mathbf{W}^*", "velocity of the cable at the sheave"),
    "top_pull":                Quantity("N", r"N\mathbf{t}(0)", "tension vector at the sheave"),
    "end_pull":                Quantity("N", r"N\mathbf{t}(l)", "tension vector at the body"),
    # step of the plant
    "tip_rates":               Quantity("m/s2", "", "rates of the ROV velocity at the last three instants, without thrust and external force"),
    "known_rates":             Quantity("1", "", "rates known before the present one"),
    "newest_rate":             Quantity("1", "", "which of the last three rates is the newest"),
    "rate_weights":            Quantity("s", "", "weights of the newest, the last and the one before in the present step"),
    "last_step":               Quantity("s", "", "length of the last step"),
    "slides":                  Quantity("1", "", "whether drag along the cable, added mass or stretch changed the tension in the last step"),
    "power_payload_damping":   Quantity("W", "", "power of the ROV's damping"),
    "power_vessel":            Quantity("W", "", "power through the vessel end"),
    # sensors
    "latency_samples":         Quantity("1", "", "age of a reading in control periods"),
    # record
    "samples":                 Quantity("1", "", "control samples so far"),
    "samples_at_limit":        Quantity("1", "", "control samples of a motor at its voltage limit"),
    "element":                 Quantity("1", "", "an element of the cable, counted from the vessel"),
    "slope_weights":           Quantity("1", "", "weights of an element's slopes in the displacement gained in it"),
    "peak":                    Quantity("", "", "largest size so far, in the unit of what is measured"),
    "squares":                 Quantity("", "", "sum of squares so far, in the squared unit of what is measured"),
    "slack_samples":           Quantity("1", "", "control samples with slack so far"),
    "was_slack":               Quantity("1", "", "1 if the last control sample had slack"),
    "snap_time":               Quantity("s", "", "instant at which the cable last became taut again"),
    "snap_window":             Quantity("s", "", "time after slack within which a peak counts as its snap"),
    # constants of a motor written in z1 = w, z2 = (K_t/J) i
    "f11":                     Quantity("1/s", "f_{11}", "-B/J", "(44)"),
    "f12":                     Quantity("1/rad", "f_{12}", "-K_Q/J", "(44)"),
    "f13":                     Quantity("1/(kg m2)", "f_{13}", "1/J", "(44)"),
    "f21":                     Quantity("1/s2", "f_{21}", "-K_t K_b/(J L)", "(45)"),
    "f22":                     Quantity("1/s", "f_{22}", "-R/L", "(45)"),
    "f23":                     Quantity("rad/(V s3)", "f_{23}", "K_t/(J L)", "(45)"),
    "current_scale":           Quantity("rad/(A s2)", "", "K_t/J: scaled current over current", "(46)"),
    # outer law and its observers
    "updates":                 Quantity("1", "", "updates of the controller so far"),
    "filtered_signal":         Quantity("", r"\pi_1, \chi_1", "first state of a high-gain observer, in its signal's unit", "(17), (19)"),
    "filtered_rate":           Quantity("", r"\pi_2, \chi_2", "second state of a high-gain observer: the estimated rate times the time constant", "(17), (19)"),
    "disturbance_state":       Quantity("N", r"\phi", "state of the disturbance observer", "(21)"),
    # adaptive allocation, for each of kappa_0 ... kappa_n
    "kappa_decay":             Quantity("1", "", "share of kappa that the leak leaves after one period", "(27)"),
    "kappa_gain":              Quantity("", "", "fall of kappa over one period per theta u_a", "(27)"),
    "kappa_lower":             Quantity("", "", "kappa is projected to no less"),
    "kappa_upper":             Quantity("", "", "kappa is projected to no more"),
    # loop of a motor
    "speed_reference_rate":    Quantity("rad/s2", r"\dot\omega_d", "rate of the filtered speed reference", "(59)"),
    "speed_reference_curvature": Quantity("rad/s3", r"\ddot\omega_d", "second derivative of the filtered speed reference", "(59)"),
    "motor_disturbance_state": Quantity("rad/s3", r"\upsilon", "state of a motor's disturbance observer", "(61)"),
    "held_drive":              Quantity("rad/s3", "V", "scaled voltage f23 U that is held", "(61)"),
}

METRICS: dict[str, Quantity] = {
    "tip_peak":                Quantity("m", "", "largest |y(l,t)|"),
    "tip_rms":                 Quantity("m", "", "root mean square of y(l,t)"),
    "tip_end":                 Quantity("m", "", "y(l,t) at the end"),
    "tip_peak_after_fault":    Quantity("m", "", "largest |y(l,t)| from the first fault on"),
    "mid_peak":                Quantity("m", "", "largest |y(l/2,t)|"),
    "mid_rms":                 Quantity("m", "", "root mean square of y(l/2,t)"),
    "quarter_peak":            Quantity("m", "", "largest |y(l/4,t)|"),
    "quarter_rms":             Quantity("m", "", "root mean square of y(l/4,t)"),
    "three_quarter_peak":      Quantity("m", "", "largest |y(3l/4,t)|"),
    "three_quarter_rms":       Quantity("m", "", "root mean square of y(3l/4,t)"),
    "slope_peak":              Quantity("1", "", "largest |y_x| anywhere"),
    "effort_rms":              Quantity("N", "", "root mean square of the commanded thrust"),
    "thrust_peak":             Quantity("N", "", "largest |delivered thrust|"),
    "motor_speed_peak":        Quantity("rad/s", "", "largest |motor speed|, over all motors"),
    "motor_voltage_peak":      Quantity("V", "", "largest |motor voltage|, over all motors"),
    "motor_voltage_rms":       Quantity("V", "", "root mean square of the motor voltages"),
    "motor_current_peak":      Quantity("A", "", "largest |motor current|, over all motors"),
    "saturated_share":         Quantity("1", "", "share of the control samples with the drive at its voltage limit, over the motors that have one"),
    "thrust_gap":              Quantity("N", "", "root mean square of commanded minus delivered thrust"),
    "top_tension_peak":        Quantity("N", "", "largest tension at the sheave"),
    "end_tension_peak":        Quantity("N", "", "largest tension at the body"),
    "lowest_tension":          Quantity("N", "", "smallest tension anywhere along the cable"),
    "slack_share":             Quantity("1", "", "share of the control samples with slack somewhere along the cable"),
    "snaps":                   Quantity("1", "", "times the cable became taut again after slack"),
    "largest_snap":            Quantity("N", "", "largest tension within one axial period after slack"),
    "watch_radius":            Quantity("m", "", "largest horizontal distance of the body from where it started"),
    "smallest_stretch":        Quantity("1", "", "smallest |r_x|: below 1 an average over loops the grid does not resolve"),
    "energy_balance_residual": Quantity("1", "", "largest |energy - start - work| over the larger of largest energy and gross work"),
    "grid_loss":               Quantity("1", "", "energy the grid took, over the larger of largest energy and gross work"),
}

CERTIFICATE: dict[str, Quantity] = {
    "rate":                    Quantity("1/s", r"\vartheta", "rate at which V is proved to decay, at least; amplitudes decay at half of it", "(36)"),
    "fixed_length_rate":       Quantity("1/s", r"\vartheta", "best rate with the winch stopped at its greatest length", "(36)"),
    "exact_rate":              Quantity("1/s", "", "rate of V by the exact eigenvalues of the ideal loop, winch stopped at its greatest length"),
    "cross":                   Quantity("1/s", r"\lambda/\gamma", "weight of V2 over that of V1", "(33)"),
    "vessel":                  Quantity("m/s", r"\lambda x_0/\gamma", "shift of the weight x in V2, times its weight"),
    "boundary":                Quantity("1", r"\eta/\gamma", "weight of V3 over that of V1", "(34)"),
    "lyapunov":                Quantity("J", "V", "Lyapunov function, gamma = 1", "(31)"),
    "start":                   Quantity("J", "V(0)", "Lyapunov function at the start, from the scenario"),
    "spent":                   Quantity("1/s", r"\delta", "part of the rate that pays for loads along the cable"),
    "residual":                Quantity("W", r"\Theta", "what bounded loads leave: V' <= -(rate - spent) V + residual", "(36)"),
}
# fmt: on


def find(name: str) -> Quantity:
    """Look up what a name inside a loop stands for: a channel, a state, a parameter or a metric.

    Raises:
        KeyError: there is no such quantity.

    >>> find("tip_velocity").unit
    'm/s'
    """
    for table in (CHANNELS, STATES, PARAMETERS, METRICS):
        if name in table:
            return table[name]
    raise KeyError(f"{name}: no channel, state or parameter of umbilical.quantities has this name")


def label(name: str, quantity: Quantity | None = None) -> str:
    """Axis label of a channel, e.g. ``ROV displacement y(l,t) $x_1$ [m]``."""
    q = quantity or CHANNELS.get(name) or METRICS.get(name) or CERTIFICATE.get(name) or PARAMETERS[name]
    unit = f" [{q.unit}]" if q.unit not in ("", "1") else ""
    return f"{q.meaning}{unit}"

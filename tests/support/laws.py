"""The outer laws and the loop of a motor as matrices, written out by hand from the equations.

The product takes these matrices from its kernels by differences; here each line is a row over (states, inputs).
"""

from __future__ import annotations

import numpy as np

from umbilical.control.cascade import Motors, Outer
from umbilical.control.outer.table import BOUNDARY, PD
from umbilical.engine.linearise import Linear
from umbilical.relations.formulas import MotorConstants
from umbilical.relations.tension import net_gravity, tension
from umbilical.stability.laws import READINGS, root_slope


def outer_law(outer: Outer) -> Linear:
    """From the four readings at the ROV to the commanded thrust alpha_c, eqs. (17), (19), (21), (22), (66).

    States are pi1, pi2, chi1, chi2, phi, z_w and the alpha_c that was commanded last; y_r is 0.
    """
    states = 7
    unit = np.eye(states + len(READINGS))
    pi, chi, phi, lasting, command = unit[:2], unit[2:4], unit[4], unit[5], unit[6]
    displacement, slope, velocity, slope_rate = unit[states:]
    observers, (kind, believed, pd, boundary) = outer
    pi = _advanced(observers.velocity.form, pi, displacement)
    chi = _advanced(observers.slope.form, chi, slope)
    if not observers.ideal_rates:
        velocity = pi[1] / observers.velocity.time_constant
        slope_rate = chi[1] / observers.slope.time_constant
    if kind == PD:
        thrust = -pd.position_gain * displacement - pd.velocity_gain * velocity
        return _from_rows(np.vstack([pi, chi, phi, lasting, thrust]), thrust)
    assert kind == BOUNDARY
    damping_gain, beta, _, station, d = boundary
    mass = believed.payload_mass
    kappa, _, rate, share = station
    lasting = lasting + share * (slope - lasting)
    error = velocity + beta * (slope - lasting) + kappa * displacement
    changing = slope_rate - rate * (slope - lasting)
    known = tension(0.0, net_gravity(believed.gravity), believed.hanging) * slope + believed.payload_damping * velocity
    drive = d.coupling * error + known - command - d.gain * mass * velocity
    phi = d.decay * phi + (1.0 - d.decay) * drive
    estimate = (phi + d.gain * mass * velocity) * d.enabled
    thrust = -damping_gain * error - mass * (beta * changing + kappa * velocity) + known - estimate
    return _from_rows(np.vstack([pi, chi, phi, lasting, thrust]), thrust)


def motor_law(motors: Motors, constants: MotorConstants, speed: float, demand: float, spread: float = 0.0) -> Linear:
    """From (demand U_i, w, i) to the voltage of one motor, eqs. (52)-(64), near a steady speed and demand.

    States are w_d, w_d', w_d'', ups and the V that was held last. ``spread`` as for :func:`root_slope`.
    """
    c, gains = constants, motors.backstepping
    unit = np.eye(8)
    reference, ups, last = unit[:3], unit[3], unit[4]
    wanted, w, current = unit[5:]
    scaled = c.current_scale * current
    root = root_slope(demand, motors.command_filter.width, spread) * wanted
    reference = _advanced(motors.command_filter.form, reference, root)
    decay = motors.observer_decay
    known = (motors.observer_gain + c.f22) * scaled + c.f21 * w + last
    ups = decay * ups - (1.0 - decay) * known

    brake = c.f11 + 2.0 * c.f12 * abs(speed)
    stiff1 = gains.speed_gain + gains.speed_bound * gains.robust_factor / gains.speed_width
    stiff2 = gains.current_gain + gains.current_bound * gains.robust_factor / gains.current_width
    rate = scaled + brake * w
    e1, e1_rate = w - reference[0], rate - reference[1]
    wish = -stiff1 * e1 - brake * w + reference[1]
    wish_rate = -stiff1 * e1_rate - brake * rate + reference[2]
    drive = -stiff2 * (scaled - wish) - e1 - c.f21 * w - c.f22 * scaled + wish_rate
    drive -= ups + motors.observer_gain * scaled
    return _from_rows(np.vstack([reference, ups, drive]), drive / c.f23)


def _advanced(form: np.ndarray, memory: np.ndarray, signal: np.ndarray) -> np.ndarray:
    """One exact step ``form [memory, signal]`` of a filter, on rows."""
    return form @ np.vstack([memory, signal])


def _from_rows(states: np.ndarray, output: np.ndarray) -> Linear:
    """The system whose new states and output are these rows over (states, inputs)."""
    n = states.shape[0]
    return Linear(states[:, :n], states[:, n:], output[None, :n], output[None, n:])

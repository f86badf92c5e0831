"""The built-in controller as linear systems: what its kernels do to small deviations, adaptation frozen.

The outer law with its observers is linear as it is. The loop of a motor is linearised at a steady speed w0,
where every error is zero and the smooth robust terms are gains ``bound * factor / width``. Both are tested
equal to differences of the kernels themselves.
"""

from __future__ import annotations

import numpy as np

from umbilical.analysis.discrete import Discrete
from umbilical.control.cascade import BOUNDARY, NONE, PD, Motors, Outer
from umbilical.relations.formulas import MotorConstants
from umbilical.relations.tension import net_gravity, tension

READINGS = 4
"""y(l), y_x(l) and, where they are granted, Dy/Dt and D(y_x)/Dt."""
_DEVIATIONS = np.linspace(-6.0, 6.0, 801)
_LIKELIHOOD = np.exp(-0.5 * _DEVIATIONS**2) / np.exp(-0.5 * _DEVIATIONS**2).sum()


def outer_law(outer: Outer) -> Discrete:
    """From the four readings at the ROV to the commanded thrust alpha_c, eqs. (17), (19), (21), (22), (66).

    States are pi1, pi2, chi1, chi2, phi and the alpha_c that was commanded last. The steps are written out as
    in ``control/cascade.py``, each line a row over (states, readings).
    """
    states = 6
    unit = np.eye(states + READINGS)
    pi, chi, phi, command = unit[:2], unit[2:4], unit[4], unit[5]
    displacement, slope, velocity, slope_rate = unit[states:]
    if outer.law == NONE:
        return _from_rows(np.zeros((states, states + READINGS)), np.zeros(states + READINGS))
    pi = _advanced(outer.velocity_observer.form, pi, displacement)
    chi = _advanced(outer.slope_observer.form, chi, slope)
    if not outer.ideal_rates:
        velocity = pi[1] / outer.velocity_observer.time_constant
        slope_rate = chi[1] / outer.slope_observer.time_constant
    if outer.law == PD:
        thrust = -outer.gains[0] * displacement - outer.gains[1] * velocity
        return _from_rows(np.vstack([pi, chi, phi, thrust]), thrust)
    assert outer.law == BOUNDARY
    (damping_gain, beta), mass, d = outer.gains, outer.payload_mass, outer.disturbance
    error = velocity + beta * slope
    known = tension(0.0, net_gravity(outer.gravity), outer.hanging) * slope + outer.payload_damping * velocity
    drive = d.coupling * error + known - command - d.gain * mass * velocity
    phi = d.decay * phi + (1.0 - d.decay) * drive
    estimate = (phi + d.gain * mass * velocity) * d.enabled
    thrust = -damping_gain * error - beta * mass * slope_rate + known - estimate
    return _from_rows(np.vstack([pi, chi, phi, thrust]), thrust)


def motor_law(motors: Motors, constants: MotorConstants, speed: float, demand: float, spread: float = 0.0) -> Discrete:
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


def root_slope(demand: float, width: float, spread: float = 0.0) -> float:
    """Slope of the softened root U/(U^2 + s^2)^(1/4) at a demand, s/rad.

    Args:
        demand: mean of the demand, rad2/s2.
        width: s, rad2/s2.
        spread: standard deviation of a normally distributed demand, rad2/s2; the slope is then the mean slope, the
            gain of the equivalent linear element (Roberts, Spanos: Random Vibration and Statistical Linearization).

    >>> round(root_slope(0.0, 1e-3), 2), round(root_slope(0.0, 1e-3, spread=4.0), 3)
    (31.62, 0.43)
    """
    if spread > 1e-3 * np.hypot(demand, width):
        # The mean slope is E[root(U) x]/spread (Stein's lemma), which needs no point close to the steep part.
        demands = demand + spread * _DEVIATIONS
        roots = demands / np.sqrt(np.hypot(demands, width))
        return float((roots * _DEVIATIONS * _LIKELIHOOD).sum() / spread)
    square = demand * demand + width * width
    return (0.5 * demand * demand + width * width) / square**1.25


def shares(motors: Motors, kappa: np.ndarray) -> np.ndarray:
    """Demand on each motor per commanded thrust, rad2/(N s2), kappa frozen where it adapts (23)."""
    coefficients = motors.nominal["thrust_coefficient"]
    factor = kappa[0] if motors.adaptation.enabled else 1.0 / np.abs(coefficients).sum()
    return np.sign(coefficients) * factor


def _advanced(form: np.ndarray, memory: np.ndarray, signal: np.ndarray) -> np.ndarray:
    """One exact step ``form [memory, signal]`` of a filter, on rows."""
    return form @ np.vstack([memory, signal])


def _from_rows(states: np.ndarray, output: np.ndarray) -> Discrete:
    """The system whose new states and output are these rows over (states, inputs)."""
    n = states.shape[0]
    return Discrete(states[:, :n], states[:, n:], output[None, :n], output[None, n:])

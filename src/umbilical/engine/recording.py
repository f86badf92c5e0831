"""What a run leaves behind: stored samples of everything, and measures of every control sample."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.contract import Decision
from umbilical.engine.sensing import true_slope_rate
from umbilical.engine.stepping import DELIVERED, SINCE_START, PlantState
from umbilical.plant.cable import PRESENT, TIP_DISPLACEMENT, TIP_SLOPE, TIP_VELOCITY, VESSEL_SLOPE
from umbilical.plant.exogenous import ACCELERATION, EFFECTIVENESS, FORCE, LENGTH, SPEED, VESSEL
from umbilical.plant.exogenous import VOLTAGE as VOLTAGE_DISTURBANCE
from umbilical.plant.layout import integrate, probe, to_nodal
from umbilical.plant.motors import CURRENT
from umbilical.plant.motors import SPEED as ROTOR_SPEED
from umbilical.plant.power import ALONG_TERMS, END_TERMS

SCALARS = (
    "length", "payout_speed", "payout_acceleration", "vessel_displacement", "vessel_slope",
    "tip_displacement", "tip_velocity", "tip_slope", "tip_slope_rate",
    "thrust_command", "boundary_error", "tip_velocity_estimate", "tip_slope_rate_estimate", "disturbance_estimate",
    "payload_force", "thrust", "disturbance",
)  # fmt: skip
WORKS = (
    "work_thrust", "work_payload_force", "work_payload_damping", "work_vessel",
    "work_cable_damping", "work_cable_load", "work_tension", "work_grid",
)  # fmt: skip
PER_MOTOR = (
    "motor_speed", "motor_current", "motor_voltage", "demand", "speed_reference", "motor_disturbance",
    "motor_disturbance_estimate", "effectiveness",
)  # fmt: skip

# Columns of Tally.measures, and its rows.
QUARTER, MID, THREE_QUARTER, TIP, TIP_AFTER_FAULT = range(5)
COMMAND, THRUST, MOTOR_VOLTAGE, MOTOR_SPEED, MOTOR_CURRENT, GAP = range(5, 11)
PEAK, SQUARES = range(2)
LIMIT, AT_LIMIT = range(2)  # rows of Tally.drives
STEEPEST = 1.0
"""Beyond this slope the model of small angles has ended, and the run with it."""


class Log(NamedTuple):
    """Stored samples; first dimension: the sample.

    Attributes:
        scalars: SCALARS, then WORKS.
        motors: PER_MOTOR, shape (samples, 8, motors).
        kappa: shape (samples, motors + 1).
        blocks: slopes and velocities at the nodes, shape (samples, 5, 2 n).
    """

    scalars: np.ndarray
    motors: np.ndarray
    kappa: np.ndarray
    blocks: np.ndarray


class Tally(NamedTuple):
    """Running measures over every control sample.

    Attributes:
        probes: where y(l/4), y(l/2), y(3l/4) are read: element, and weights of its slopes in the displacement
            gained in it, shape (3, 6).
        measures: largest size and sum of squares of each measure, shape (2, 11).
        slopes: largest |y_x| so far in each element, shape (n,).
        count: control samples so far, shape (1,).
        scales: f23 of each motor, which turns d2 into the disturbance its observer estimates.
        drives: voltage limit of each motor, V, and its control samples at it, shape (2, motors).
    """

    probes: np.ndarray
    measures: np.ndarray
    slopes: np.ndarray
    count: np.ndarray
    scales: np.ndarray
    drives: np.ndarray


def make_log(samples: int, motors: int, elements: int) -> Log:
    """Room for all samples of a run."""
    return Log(
        np.zeros((samples, len(SCALARS) + len(WORKS))),
        np.zeros((samples, len(PER_MOTOR), motors)),
        np.zeros((samples, motors + 1)),
        np.zeros((samples, 5, 2 * elements)),
    )


def make_tally(elements: int, scales: np.ndarray, limits: np.ndarray) -> Tally:
    """Nothing seen yet; f23 and voltage limit of each motor."""
    probes = np.array([[element, *weights] for element, weights in (probe(s, elements) for s in (0.25, 0.5, 0.75))])
    drives = np.stack([limits, np.zeros(limits.size)])
    return Tally(probes, np.zeros((2, 11)), np.zeros(elements), np.zeros(1, dtype=np.int64), scales, drives)


def channels(log: Log, samples: int, driven: bool) -> dict[str, np.ndarray]:
    """The first ``samples`` stored samples by name, fields ordered from vessel to ROV."""
    named = {name: log.scalars[:samples, k].copy() for k, name in enumerate(SCALARS + WORKS)}
    if driven:
        named |= {name: log.motors[:samples, k].copy() for k, name in enumerate(PER_MOTOR)}
        named["kappa"] = log.kappa[:samples].copy()
    return named | _along_cable(*inside(log, samples), named)


def inside(log: Log, samples: int) -> tuple[np.ndarray, np.ndarray]:
    """Slopes Y_sigma, m, and velocities, m/s, at the nodes of each element, each (samples, 5, n)."""
    elements = log.blocks.shape[2] // 2
    return log.blocks[:samples, :, :elements], log.blocks[:samples, :, elements:]


def _along_cable(slopes: np.ndarray, velocities: np.ndarray, named: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Displacement, slope and velocity along the cable, shape (samples, 4 n + 1); at the ROV they are its own."""
    displacement = named["vessel_displacement"][:, None] + integrate(slopes)
    slope, velocity = to_nodal(slopes) / named["length"][:, None], to_nodal(velocities)
    displacement[:, -1], velocity[:, -1] = named["tip_displacement"], named["tip_velocity"]
    slope[:, 0], slope[:, -1] = named["vessel_slope"], named["tip_slope"]
    return {"displacement": displacement, "slope": slope, "velocity": velocity}


@kernel
def watch_slopes(state: PlantState, slopes: np.ndarray) -> bool:
    """Keep the largest slopes; False if one is beyond :data:`STEEPEST` or not a number."""
    x = state.blocks[PRESENT]
    n = slopes.size
    scale = 1.0 / state.now[LENGTH]
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    for e in range(n):
        largest = max(max(max(abs(x0[e]), abs(x1[e])), max(abs(x2[e]), abs(x3[e]))), abs(x4[e]))
        # A maximum may lose what is not a number; the product with zero does not, nor does the comparison.
        slope = scale * largest + 0.0 * (x0[e] + x1[e] + x2[e] + x3[e] + x4[e])
        slopes[e] = slopes[e] if slope <= slopes[e] else slope
    tip = abs(state.ends[TIP_SLOPE])
    slopes[n - 1] = slopes[n - 1] if tip <= slopes[n - 1] else tip
    steep = 0
    for e in range(n):
        steep += 0 if slopes[e] <= STEEPEST else 1
    return steep == 0


@glue
def note(tally: Tally, place: int, value: float) -> None:
    """Peak and sum of squares of one measure."""
    tally.measures[PEAK, place] = max(tally.measures[PEAK, place], abs(value))
    tally.measures[SQUARES, place] += value * value


@glue
def measure(tally: Tally, state: PlantState, decision: Decision, after_fault: bool) -> bool:
    """Take one control sample into the tally; False if the model has ended (non-finite, or too steep)."""
    x, tip = state.blocks[PRESENT], state.ends[TIP_DISPLACEMENT]
    for p in range(3):
        e, w = int(tally.probes[p, 0]), tally.probes[p]
        gained = w[1] * x[0, e] + w[2] * x[1, e] + w[3] * x[2, e] + w[4] * x[3, e] + w[5] * x[4, e]
        note(tally, QUARTER + p, state.starts[e] + gained)
    note(tally, TIP, tip)
    if after_fault:
        note(tally, TIP_AFTER_FAULT, tip)
    note(tally, COMMAND, decision.outer[0].thrust_command)
    note(tally, THRUST, state.now[DELIVERED])
    # Python floats: infinite minus infinite is not worth a warning of numpy.
    note(tally, GAP, float(decision.outer[0].thrust_command) - float(state.now[DELIVERED]))
    finite = np.isfinite(tip) and np.isfinite(state.ends[TIP_VELOCITY]) and np.isfinite(state.now[DELIVERED])
    for k in range(state.motors.shape[1]):
        note(tally, MOTOR_VOLTAGE, decision.motors[k].motor_voltage)
        note(tally, MOTOR_SPEED, state.motors[ROTOR_SPEED, k])
        note(tally, MOTOR_CURRENT, state.motors[CURRENT, k])
        if abs(decision.motors[k].motor_voltage) >= tally.drives[LIMIT, k]:
            tally.drives[AT_LIMIT, k] += 1.0
        finite = finite and np.isfinite(state.motors[ROTOR_SPEED, k]) and np.isfinite(state.motors[CURRENT, k])
        finite = finite and np.isfinite(decision.motors[k].motor_voltage)
    tally.count[0] += 1
    return watch_slopes(state, tally.slopes) and finite


@glue
def store(log: Log, row: int, tally: Tally, state: PlantState, decision: Decision, kappa: np.ndarray) -> None:
    """Store one sample of everything."""
    store_scalars(log.scalars[row], state, decision)
    for k in range(kappa.size):
        log.kappa[row, k] = kappa[k]
    for node in range(state.blocks.shape[1]):
        for column in range(state.blocks.shape[2]):
            log.blocks[row, node, column] = state.blocks[PRESENT, node, column]
    for k in range(state.motors.shape[1]):
        out = log.motors[row, :, k]
        out[0], out[1] = state.motors[ROTOR_SPEED, k], state.motors[CURRENT, k]
        decided = decision.motors[k]
        out[2], out[3], out[4] = decided.motor_voltage, decided.demand, decided.speed_reference
        out[5] = tally.scales[k] * state.motors_now[VOLTAGE_DISTURBANCE, k]
        out[6], out[7] = decided.motor_disturbance_estimate, state.motors_now[EFFECTIVENESS, k]


@kernel
def store_scalars(out: np.ndarray, state: PlantState, decision: Decision) -> None:
    """SCALARS, then WORKS, in their order."""
    now, outer, ends = state.now, decision.outer[0], state.ends
    out[0], out[1], out[2], out[3] = now[LENGTH], now[SPEED], now[ACCELERATION], now[VESSEL]
    out[4], out[5], out[6] = ends[VESSEL_SLOPE], ends[TIP_DISPLACEMENT], ends[TIP_VELOCITY]
    out[7], out[8] = ends[TIP_SLOPE], true_slope_rate(state)
    out[9], out[10] = outer.thrust_command, outer.boundary_error
    out[11], out[12] = outer.tip_velocity_estimate, outer.tip_slope_rate_estimate
    out[13], out[14], out[15] = outer.disturbance_estimate, now[FORCE], now[DELIVERED]
    out[16] = now[FORCE] + now[DELIVERED] - outer.thrust_command
    for term in range(END_TERMS):
        out[17 + term] = state.power_ends[SINCE_START, term]
    for term in range(ALONG_TERMS):
        work = 0.0
        for e in range(state.power_along.shape[2]):
            work += state.power_along[SINCE_START, term, e]
        out[17 + END_TERMS + term] = work
    taken = 0.0
    for f in range(state.losses.shape[1]):
        taken += state.losses[SINCE_START, f]
    out[17 + END_TERMS + ALONG_TERMS] = taken

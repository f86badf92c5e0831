"""What a run leaves behind: stored samples of everything, and measures of every control sample."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from umbilical.compile import glue, kernel, row_kernel
from umbilical.control.contract import Decision, MotorDecision, OuterDecision
from umbilical.engine.sensing import true_slope_rate
from umbilical.engine.stepping import PlantState
from umbilical.frames import Frame, integer, part, real, vector
from umbilical.plant.cable import PRESENT, Ends
from umbilical.plant.exogenous import Exogenous
from umbilical.plant.forces.table import IN_WATER, AlongWorks, EndWorks, sum_works
from umbilical.plant.layout import integrate, probe, to_nodal
from umbilical.plant.motors import MotorState
from umbilical.quantities import CHANNELS
from umbilical.relations.formulas import motor_constants
from umbilical.scenario.hardware import Motor

STEEPEST = 1.0
"""Beyond this slope the model of small angles has ended, and the run with it."""


class Derived(Frame):
    """What the record works out beside what plant and controller hold."""

    tip_slope_rate = real()
    thrust = real()
    disturbance = real()


class MotorDerived(Frame):
    """Likewise of one motor."""

    motor_disturbance = real()


class Log(NamedTuple):
    """Stored samples: records as they were. The channels of a run are those of their fields that ``CHANNELS`` names.

    Attributes:
        outside, ends, works, along, outer, derived: shape (samples,).
        motors, decisions, motors_derived: shape (samples, motors).
        kappa: shape (samples, motors + 1).
        blocks: slopes and velocities at the nodes, shape (samples, 5, 2 n).
    """

    outside: Exogenous
    ends: Ends
    works: EndWorks
    along: AlongWorks
    outer: OuterDecision
    derived: Derived
    motors: MotorState
    decisions: MotorDecision
    motors_derived: MotorDerived
    kappa: np.ndarray
    blocks: np.ndarray


class Probe(Frame):
    """Where the displacement is read: an element, and weights of its slopes in the displacement gained in it."""

    element = integer()
    slope_weights = vector(5)


class Measure(Frame):
    """Largest size and sum of squares of a quantity so far."""

    peak = real()
    squares = real()


class Measures(Frame):
    """What is measured at every control sample; y(l/4), y(l/2) and y(3l/4) first, voltages of all motors together."""

    samples = integer()
    quarter = part(Measure)
    mid = part(Measure)
    three_quarter = part(Measure)
    tip = part(Measure)
    tip_after_fault = part(Measure)
    command = part(Measure)
    thrust = part(Measure)
    gap = part(Measure)
    voltage = part(Measure)
    speed = part(Measure)
    current = part(Measure)


class MotorTally(Frame):
    """Likewise of one motor, beside its constants; f23 turns d2 into the disturbance its observer estimates."""

    f23 = real()
    voltage_limit = real()
    samples_at_limit = integer()


class Tally(NamedTuple):
    """Running measures over every control sample.

    Attributes:
        probes: at l/4, l/2 and 3l/4.
        measures: one record.
        motors: one record per motor.
        slopes: largest |y_x| so far in each element, shape (n,).
    """

    probes: Probe
    measures: Measures
    motors: MotorTally
    slopes: np.ndarray


def make_log(samples: int, motors: int, elements: int) -> Log:
    """Room for all samples of a run."""
    frames = (Exogenous, Ends, EndWorks, AlongWorks, OuterDecision, Derived)
    rows, blocks = (frame.many(samples) for frame in frames), np.zeros((samples, 5, 2 * elements))
    return Log._make((*rows, *motor_log(samples, motors), blocks))


def motor_log(samples: int, motors: int) -> tuple[Any, ...]:
    """Room for ``motors``, ``decisions``, ``motors_derived`` and ``kappa`` of a log."""
    records = (frame.many(samples, motors) for frame in (MotorState, MotorDecision, MotorDerived))
    return *records, np.zeros((samples, motors + 1))


def make_tally(elements: int, motors: tuple[Motor, ...]) -> Tally:
    """Nothing seen yet."""
    return Tally(make_probes(elements), Measures.many(1), motor_tallies(motors), np.zeros(elements))


def make_probes(elements: int) -> Probe:
    """Probes at a quarter, half and three quarters of the cable."""
    probes = Probe.many(3)
    for k, sigma in enumerate((0.25, 0.5, 0.75)):
        probes[k] = probe(sigma, elements)
    return probes


def motor_tallies(motors: tuple[Motor, ...]) -> MotorTally:
    """Constants of every motor, and nothing seen yet."""
    tallies = MotorTally.many(len(motors))
    for k, motor in enumerate(motors):
        limit = np.inf if motor.voltage_limit is None else motor.voltage_limit
        tallies[k] = (motor_constants(motor).f23, limit, 0)
    return tallies


def channels(log: Log, samples: int, driven: bool, wet: bool) -> dict[str, np.ndarray]:
    """The first ``samples`` stored samples by name, in the order of ``CHANNELS``; fields from vessel to ROV.

    Without motors (``driven``) or water (``wet``) there are none of theirs.
    """
    records = log.outside, log.ends, log.works, log.along, log.outer, log.derived
    named = named_fields(log, records, samples, driven)
    named |= _along_cable(*inside(log, samples), named, log.ends["slip"][:samples])
    dry = () if wet else tuple(force.work for force in IN_WATER)
    return {name: named[name] for name in CHANNELS if name in named and name not in dry}


def named_fields(log: Any, records: Iterable[Any], samples: int, driven: bool) -> dict[str, np.ndarray]:
    """Stored samples of the fields of records that are channels, with those of the motors if there are any."""
    motors = (log.motors, log.motors["outside"], log.decisions, log.motors_derived) if driven else ()
    fields = ((name, rows) for rows in (*records, *motors) for name in rows.dtype.names if name in CHANNELS)
    named = {name: rows[name][:samples].copy() for name, rows in fields}
    return named | ({"kappa": log.kappa[:samples].copy()} if driven else {})


def inside(log: Log, samples: int) -> tuple[np.ndarray, np.ndarray]:
    """Slopes Y_sigma, m, and velocities, m/s, at the nodes of each element, each (samples, 5, n)."""
    elements = log.blocks.shape[2] // 2
    return log.blocks[:samples, :, :elements], log.blocks[:samples, :, elements:]


def _along_cable(
    slopes: np.ndarray, velocities: np.ndarray, named: dict[str, np.ndarray], slip: np.ndarray
) -> dict[str, np.ndarray]:
    """Displacement, slope and Dy/Dt along the cable, shape (samples, 4 n + 1); at the ROV they are its own."""
    displacement = named["vessel_displacement"][:, None] + integrate(slopes)
    slope, velocity = to_nodal(slopes) / named["length"][:, None], to_nodal(velocities)
    if slip.any():
        velocity += slip[:, None] * slope
    displacement[:, -1], velocity[:, -1] = named["tip_displacement"], named["tip_velocity"]
    slope[:, 0], slope[:, -1] = named["vessel_slope"], named["tip_slope"]
    return {"displacement": displacement, "slope": slope, "velocity": velocity}


@row_kernel
def watch_slopes(state: PlantState, slopes: np.ndarray) -> bool:
    """Keep the largest slopes; False if one is beyond :data:`STEEPEST` or not a number."""
    x = state.blocks[PRESENT]
    n = slopes.size
    scale = 1.0 / state.now[0].outside.length
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    steep = 0
    for e in range(n):
        largest = max(max(max(abs(x0[e]), abs(x1[e])), max(abs(x2[e]), abs(x3[e]))), abs(x4[e]))
        # A maximum may lose what is not a number; the product with zero does not, nor does the comparison.
        slope = scale * largest + 0.0 * (x0[e] + x1[e] + x2[e] + x3[e] + x4[e])
        kept = slopes[e] if slope <= slopes[e] else slope
        slopes[e] = kept
        steep += 0 if kept <= STEEPEST else 1
    tip = abs(state.now[0].ends.tip_slope)
    slopes[n - 1] = slopes[n - 1] if tip <= slopes[n - 1] else tip
    return steep == 0 and tip <= STEEPEST


@glue
def note(measure: Measure, value: float) -> None:
    """Peak and sum of squares of one measure."""
    measure.peak = max(measure.peak, abs(value))
    measure.squares += value * value


@glue
def probed(probe: Probe, state: PlantState) -> float:
    """Displacement at a probe, m."""
    x, e, w = state.blocks[PRESENT], probe.element, probe.slope_weights
    gained = w[0] * x[0, e] + w[1] * x[1, e] + w[2] * x[2, e] + w[3] * x[3, e] + w[4] * x[4, e]
    return state.starts[e] + gained


@glue
def measure(tally: Tally, state: PlantState, decision: Decision, after_fault: bool) -> bool:
    """Take one control sample into the tally; False if the model has ended (non-finite, or too steep)."""
    now, found = state.now[0], tally.measures[0]
    note(found.quarter, probed(tally.probes[0], state))
    note(found.mid, probed(tally.probes[1], state))
    note(found.three_quarter, probed(tally.probes[2], state))
    ends = now.ends
    finite = measure_loop(tally, ends.tip_displacement, ends.tip_velocity, now.thrust, state, decision, after_fault)
    return watch_slopes(state, tally.slopes) and finite


@glue
def measure_loop(
    tally: Any, tip: float, tip_velocity: float, thrust: float, state: Any, decision: Decision, after_fault: bool
) -> bool:
    """Take what string and rope have in common into the tally; False if it is not finite."""
    found, command = tally.measures[0], decision.outer[0].thrust_command
    note(found.tip, tip)
    if after_fault:
        note(found.tip_after_fault, tip)
    note(found.command, command)
    note(found.thrust, thrust)
    # Python floats: infinite minus infinite is not worth a warning of numpy.
    note(found.gap, float(command) - float(thrust))
    finite = np.isfinite(tip) and np.isfinite(tip_velocity) and np.isfinite(thrust)
    for k in range(state.motors.size):
        motor, voltage, seen = state.motors[k], decision.motors[k].motor_voltage, tally.motors[k]
        note(found.voltage, voltage)
        note(found.speed, motor.motor_speed)
        note(found.current, motor.motor_current)
        if abs(voltage) >= seen.voltage_limit:
            seen.samples_at_limit += 1
        finite = finite and np.isfinite(motor.motor_speed) and np.isfinite(motor.motor_current)
        finite = finite and np.isfinite(voltage)
    found.samples += 1
    return finite


def root_mean_square(tally: Any, measure: Measure) -> float:
    """Root mean square of a measure over the control samples so far."""
    return float(np.sqrt(measure.squares / max(tally.measures[0].samples, 1)))


@glue
def store(log: Log, row: int, tally: Tally, state: PlantState, decision: Decision, kappa: np.ndarray) -> None:
    """Store one sample of everything."""
    now = state.now[0]
    log.outside[row] = now.outside
    log.ends[row] = now.ends
    log.works[row] = now.works
    sum_works(state.work, now.works, log.along[row])
    store_derived(log.derived[row], state, decision)
    store_loop(log, row, tally, state, decision, kappa)
    for node in range(state.blocks.shape[1]):
        for column in range(state.blocks.shape[2]):
            log.blocks[row, node, column] = state.blocks[PRESENT, node, column]


@glue
def store_loop(log: Any, row: int, tally: Any, state: Any, decision: Decision, kappa: np.ndarray) -> None:
    """Store what string and rope have in common: the controller and the motors."""
    log.outer[row] = decision.outer[0]
    for k in range(state.motors.size):
        log.motors[row, k] = state.motors[k]
        log.decisions[row, k] = decision.motors[k]
        disturbance = tally.motors[k].f23 * state.motors[k].outside.voltage_disturbance
        log.motors_derived[row, k].motor_disturbance = disturbance
    for k in range(kappa.size):
        log.kappa[row, k] = kappa[k]


@kernel
def store_derived(out: Derived, state: PlantState, decision: Decision) -> None:
    """Work out what only the record holds."""
    now = state.now[0]
    out.tip_slope_rate = true_slope_rate(state)
    out.thrust = now.thrust
    out.disturbance = now.outside.payload_force + now.thrust - decision.outer[0].thrust_command

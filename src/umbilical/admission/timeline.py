"""Checks of times: periods, tables, pulses, and what happens after the end of the run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from umbilical.admission.findings import Finding, Notice, amount
from umbilical.errors import Problem
from umbilical.plant import signals
from umbilical.plant import winch as laws
from umbilical.scenario import Scenario
from umbilical.scenario.control import Control
from umbilical.scenario.document import look_up, to_dict
from umbilical.scenario.environment import Environment, InitialShape, TableProfile, TableShape
from umbilical.scenario.faults import Fault
from umbilical.scenario.hardware import Motor
from umbilical.scenario.problems import nearest
from umbilical.scenario.scenario import Grid, Output
from umbilical.scenario.signals import Pulse, Signal, Table
from umbilical.scenario.winch import TabulatedLength, Winch

MOST_STEPS = 1e8
_MOST_STORED = 1e8


def is_multiple(value: float, of: float) -> bool:
    """Whether ``value`` is a whole number of ``of``, at least one, to nine digits."""
    count = round(min(value / of, 1e15))
    return count >= 1 and abs(value - count * of) <= 1e-9 * value


def grid_of_time(duration: float, control: Control, output: Output) -> Iterator[Finding]:
    """Run, outer loop and stored samples keep step with the controller."""
    times = {
        "duration": duration,
        "control.outer_period": control.outer_period or control.period,
        "output.interval": output.interval,
    }
    for key, value in times.items():
        if not is_multiple(value, control.period):
            near = max(round(min(value / control.period, 1e15)), 1) * control.period
            yield Problem(
                key,
                amount(value, "s"),
                f"a multiple of control.period = {control.period:g} s",
                "the controller is called once per period, and everything else keeps step with it",
                f"for example {near:.9g} s",
            )


def size_of_the_run(duration: float, control: Control, grid: Grid, output: Output) -> Iterator[Finding]:
    """Neither the steps nor the stored numbers are absurd."""
    count = duration / min(grid.step, control.period)
    if count > MOST_STEPS:
        reason = "such a run would take hours"
        yield Problem(
            "duration",
            amount(duration, "s"),
            f"{MOST_STEPS:g} steps of the plant, not {count:.3g}",
            reason,
            "a shorter run, or a larger grid.step and control.period",
        )
    stored = (duration / output.interval + 1) * (4 * grid.elements + 1)
    if stored > _MOST_STORED:
        reason = "each stored field of the cable would be larger than the memory of most machines"
        yield Problem(
            "output.interval",
            amount(output.interval, "s"),
            f"{_MOST_STORED:g} stored values per field, not {stored:.3g}",
            reason,
            "a longer interval",
        )


def signals_of_the_environment(environment: Environment, duration: float) -> Iterator[Finding]:
    """Terms of the loads and of the vessel's motion make sense and cover the run."""
    for key, signal in _of_environment(environment):
        yield from _signal(key, signal, duration)


def signals_of_the_motors(motors: Sequence[Motor], duration: float) -> Iterator[Finding]:
    """Terms of the motors' disturbances make sense and cover the run."""
    for key, signal in _of_motors(motors):
        yield from _signal(key, signal, duration)


def tables_of_the_winch(winch: Winch, duration: float) -> Iterator[Finding]:
    """A tabulated length is sorted and covers the run."""
    if isinstance(winch, TabulatedLength):
        yield from _table("winch", "times", "lengths", winch.times, len(winch.lengths), (0.0, duration))


def shapes(environment: Environment, initial: InitialShape) -> Iterator[Finding]:
    """Tables over the cable run from the vessel to the ROV."""
    for number, load in enumerate(environment.cable_load, start=1):
        if isinstance(profile := load.profile, TableProfile):
            key = f"environment.cable_load.{number}.profile"
            yield from _table(
                key, "positions", "values", profile.positions, len(profile.values), (0.0, 1.0), exact=True
            )
    if isinstance(initial, TableShape):
        count = len(initial.displacements)
        yield from _table("initial", "positions", "displacements", initial.positions, count, (0.0, 1.0), exact=True)


def jumps_after_the_end(
    environment: Environment, motors: Sequence[Motor], faults: Sequence[Fault], winch: Winch, duration: float
) -> Iterator[Finding]:
    """What comes after the end of the run never happens: allowed, but worth a word."""
    late = {f"faults.{number}.start": fault.start for number, fault in enumerate(faults, start=1)}
    for key, signal in (*_of_environment(environment), *_of_motors(motors)):
        for number, term in enumerate(signal, start=1):
            if not isinstance(term, Table) and (instants := signals.jumps((term,))):
                late[f"{key}.{number}.{'start' if isinstance(term, Pulse) else 'time'}"] = instants[0]
    if not isinstance(winch, TabulatedLength):
        late["winch"] = next(iter(laws.jumps(winch)), 0.0)
    for key, instant in late.items():
        if instant > duration:
            yield Notice(key, f"at {instant:g} s, after the end of the run at {duration:g} s: it never happens")


def marks(scenario: Scenario) -> Iterator[Finding]:
    """Every mark *assumed* names a value of the scenario."""
    data = to_dict(scenario)
    for key in scenario.assumed:
        try:
            look_up(data, key)
        except KeyError:
            reason = "a mark without a value marks nothing"
            yield Problem(f"assumed.{key}", "a mark", "the key of a value", reason, nearest(key, _leaves(data)))


def _leaves(data: object, path: str = "") -> Iterator[str]:
    """Dotted keys of everything in plain data."""
    if path:
        yield path
    parts = data.items() if isinstance(data, dict) else enumerate(data, start=1) if isinstance(data, list) else ()
    for name, part in parts:
        yield from _leaves(part, f"{path}.{name}" if path else str(name))


def _of_environment(environment: Environment) -> Iterator[tuple[str, Signal]]:
    yield "environment.payload_force", environment.payload_force
    yield "environment.vessel_motion", environment.vessel_motion
    for number, load in enumerate(environment.cable_load, start=1):
        yield f"environment.cable_load.{number}.signal", load.signal


def _of_motors(motors: Sequence[Motor]) -> Iterator[tuple[str, Signal]]:
    for number, motor in enumerate(motors, start=1):
        yield f"motors.{number}.torque_disturbance", motor.torque_disturbance
        yield f"motors.{number}.voltage_disturbance", motor.voltage_disturbance


def _signal(key: str, signal: Signal, duration: float) -> Iterator[Finding]:
    for number, term in enumerate(signal, start=1):
        place = f"{key}.{number}"
        if isinstance(term, Table):
            yield from _table(place, "times", "values", term.times, len(term.values), (0.0, duration))
        if isinstance(term, Pulse) and term.end <= term.start:
            yield Problem(
                f"{place}.end",
                amount(term.end, "s"),
                f"above start = {term.start:g} s",
                "a pulse ends after it starts",
                "a later end",
            )


def _table(
    key: str,
    across: str,
    values: str,
    points: Sequence[float],
    count: int,
    span: tuple[float, float],
    exact: bool = False,
) -> Iterator[Finding]:
    """Problems of a table over ``points``: order, length, and whether it covers (or exactly spans) the span."""
    first, last = span
    if count != len(points):
        yield Problem(
            f"{key}.{values}",
            f"{count} entries",
            f"{len(points)} entries, one for each of {key}.{across}",
            "each point has one value",
            "make both lists equally long",
        )
    for number, (a, b) in enumerate(pairwise(points), start=1):
        if b <= a:
            yield Problem(
                f"{key}.{across}.{number + 1}",
                f"{b:g}",
                f"above the one before it, {a:g}",
                "the curve runs through increasing points",
                "sort the table; no point twice",
            )
            return
    covered = points[0] == first and points[-1] == last if exact else points[0] <= first and points[-1] >= last
    if not covered:
        yield Problem(
            f"{key}.{across}",
            f"{points[0]:g} to {points[-1]:g}",
            f"{'exactly' if exact else 'at least'} {first:g} to {last:g}",
            "nothing is known outside the table",
            "extend the table",
        )

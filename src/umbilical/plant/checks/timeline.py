"""Checks of times: periods, tables, pulses, and what happens after the end of the run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeVar

from umbilical.errors import Problem
from umbilical.plant import signals
from umbilical.plant import winch as laws
from umbilical.plant.checks.tables import TableOf, problems_of_a_table, smoothness
from umbilical.plant.exogenous import variation_of
from umbilical.relations.instants import apart, is_multiple, nearest_count, slack
from umbilical.scenario import Scenario
from umbilical.scenario.control import Control
from umbilical.scenario.document import look_up
from umbilical.scenario.environment import Environment, InitialShape, TableProfile, TableShape
from umbilical.scenario.faults import Fault
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Motor
from umbilical.scenario.problems import nearest
from umbilical.scenario.scenario import Grid, Output
from umbilical.scenario.signals import Pulse, Signal, Step, Table
from umbilical.scenario.winch import TabulatedLength, Winch

P = TypeVar("P")

MOST_STEPS = 1e8
_MOST_STORED = 1e8
MOST_JUMPS = 1e5
"""Instants of one fault or signal at which a step of the plant must end; as many take some seconds."""
TEARS = "a jump of the vessel would tear the cable's end to another place at once"
_SHAPE = TableOf("initial", "positions", "displacements", (0.0, 1.0), exact=True)
_UNITS = {"payload_force": "N", "vessel_motion": "m", "vessel_heave": "m", "variation": "1", "signal": "N/m",
          "torque_disturbance": "N m", "voltage_disturbance": "V"}  # fmt: skip


def numbered(key: str, parts: Iterable[P]) -> Iterator[tuple[str, P]]:
    """Parts of a list with their keys, counted from 1."""
    yield from ((f"{key}.{number}", part) for number, part in enumerate(parts, start=1))


def refuses(findings: Iterable[Finding]) -> bool:
    """Whether one of the findings is a problem."""
    return any(isinstance(finding, Problem) for finding in findings)


def grid_of_time(duration: float, control: Control, output: Output) -> Iterator[Finding]:
    """Run, outer loop and stored samples keep step with the controller."""
    outer = control.outer_period or control.period
    for key, value in (("duration", duration), ("control.outer_period", outer), ("output.interval", output.interval)):
        if not is_multiple(value, control.period):
            near = max(nearest_count(value, control.period), 1) * control.period
            yield Problem(key, f"{apart(value, near)[0]} s", f"a multiple of control.period = {control.period:g} s",
                          "the controller is called once per period, and everything else keeps step with it",
                          f"for example {near:.9g} s")  # fmt: skip


def size_of_the_run(duration: float, control: Control, grid: Grid, output: Output) -> Iterator[Finding]:
    """Neither the steps nor the stored numbers are absurd."""
    if (count := duration / min(grid.step, control.period)) > MOST_STEPS:
        yield Problem("duration", amount(duration, "s"), f"{MOST_STEPS:g} steps of the plant, not {count:.3g}",
                      "such a run would take hours",
                      "a shorter run, or a larger grid.step and control.period")  # fmt: skip
    if (stored := (duration / output.interval + 1) * (4 * grid.elements + 1)) > _MOST_STORED:
        yield Problem("output.interval", amount(output.interval, "s"),
                      f"{_MOST_STORED:g} stored values per field, not {stored:.3g}",
                      "each stored field of the cable would be larger than the memory of most machines",
                      "a longer interval")  # fmt: skip


def signals_of_the_environment(environment: Environment, duration: float) -> Iterator[Finding]:
    """Terms of the loads and of the vessel's motion make sense and cover the run."""
    for key, signal in of_environment(environment):
        yield from check_signal(key, signal, duration)


def signals_of_the_motors(motors: Sequence[Motor], duration: float) -> Iterator[Finding]:
    """Terms of the motors' disturbances make sense and cover the run."""
    for key, signal in of_motors(motors):
        yield from check_signal(key, signal, duration)


def tables_of_the_winch(winch: Winch, duration: float) -> Iterator[Finding]:
    """A tabulated length is sorted and covers the run."""
    if isinstance(winch, TabulatedLength):
        yield from problems_of_a_table(_of_lengths(duration), winch.times, len(winch.lengths))


def smooth_signals(environment: Environment, motors: Sequence[Motor], duration: float) -> Iterator[Finding]:
    """Smooth tables of loads, of the vessel's motion and of the motors' disturbances stay near their data."""
    for key, signal in (*of_environment(environment), *of_motors(motors)):
        for place, term in numbered(key, signal):
            if isinstance(term, Table) and term.interpolation == "smooth":
                yield from smoothness(_of_times(place, duration), term.times, term.values, _UNITS[key.split(".")[-1]])


def winch_is_smooth(winch: Winch, duration: float) -> Iterator[Finding]:
    """The length between the instants of its table stays near the data."""
    if isinstance(winch, TabulatedLength):
        yield from smoothness(_of_lengths(duration), winch.times, winch.lengths, "m")


def smooth_shape(initial: InitialShape) -> Iterator[Finding]:
    """The shape between the positions of its table stays near the data."""
    if isinstance(initial, TableShape):
        yield from smoothness(_SHAPE, initial.positions, initial.displacements, "m")


def shapes(environment: Environment, initial: InitialShape) -> Iterator[Finding]:
    """Tables over the cable run from the vessel to the ROV."""
    for key, load in numbered("environment.cable_load", environment.cable_load):
        if isinstance(profile := load.profile, TableProfile):
            table = TableOf(f"{key}.profile", "positions", "values", (0.0, 1.0), exact=True)
            yield from problems_of_a_table(table, profile.positions, len(profile.values))
    if isinstance(initial, TableShape):
        yield from problems_of_a_table(_SHAPE, initial.positions, len(initial.displacements))


def jumps_after_the_end(
    environment: Environment, motors: Sequence[Motor], faults: Sequence[Fault], winch: Winch, duration: float
) -> Iterator[Finding]:
    """What comes after the end of the run never happens: allowed, but worth a word."""
    starts = {f"{key}.start": fault.start for key, fault in numbered("faults", faults)}
    for key, signal in (*of_environment(environment), *of_motors(motors)):
        for place, term in numbered(key, signal):
            if not isinstance(term, Table) and (instants := signals.jumps((term,))):
                starts[f"{place}.{'start' if isinstance(term, Pulse) else 'time'}"] = instants[0]
    if not isinstance(winch, TabulatedLength):
        starts["winch"] = next(iter(laws.jumps(winch)), 0.0)
    for key, instant in starts.items():
        if instant > duration + slack(duration):
            late, end = apart(instant, duration)
            yield Notice(key, f"at {late} s, after the end of the run at {end} s: it never happens")


def marks(scenario: Scenario) -> Iterator[Finding]:
    """Every mark *assumed* names a value of the scenario."""
    data = scenario.to_dict()
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


def of_environment(environment: Environment) -> Iterator[tuple[str, Signal]]:
    yield "environment.payload_force", environment.payload_force
    yield "environment.vessel_motion", environment.vessel_motion
    yield "environment.vessel_heave", environment.vessel_heave or ()
    yield "environment.water.current.variation", variation_of(environment)
    loads = numbered("environment.cable_load", environment.cable_load)
    yield from ((f"{key}.signal", load.signal) for key, load in loads)


def of_motors(motors: Sequence[Motor]) -> Iterator[tuple[str, Signal]]:
    for key, motor in numbered("motors", motors):
        yield f"{key}.torque_disturbance", motor.torque_disturbance
        yield f"{key}.voltage_disturbance", motor.voltage_disturbance


def check_signal(key: str, signal: Signal, duration: float) -> Iterator[Finding]:
    """Terms of one signal make sense and cover the run."""
    for place, term in numbered(key, signal):
        if isinstance(term, Table):
            table = _of_times(place, duration, jumps=term.interpolation == "linear")
            yield from problems_of_a_table(table, term.times, len(term.values))
        if isinstance(term, Pulse):
            yield from ends_after_its_start(place, term, "a pulse ends after it starts", "a later end")


def ends_after_its_start(key: str, part: Pulse | Fault, reason: str, fix: str) -> Iterator[Finding]:
    """What has an end, ends later than it starts."""
    if part.end is not None and part.end <= part.start:
        end, start = apart(part.end, part.start)
        yield Problem(f"{key}.end", f"{end} s", f"above start = {start} s", reason, fix)


def vessel_does_not_jump(key: str, signal: Signal) -> Iterator[Finding]:
    """No term of a motion of the vessel jumps by its kind."""
    for place, term in numbered(key, signal):
        if isinstance(term, Step | Pulse):
            yield Problem(f"{place}.kind", f'"{term.kind}"', "constant, sine, bell or table", TEARS,
                          "a table of the motion, or a bell")  # fmt: skip


def _of_times(key: str, duration: float, *, jumps: bool = False) -> TableOf:
    return TableOf(key, "times", "values", (0.0, duration), jumps=jumps)


def _of_lengths(duration: float) -> TableOf:
    return TableOf("winch", "times", "lengths", (0.0, duration))

"""How a run ended, and what is kept of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from umbilical.analysis.energy import balance_residual, energy, relative_residual, scale_of, tension_at_ends
from umbilical.engine.recording import Log, channels, inside, root_mean_square
from umbilical.engine.saturation import saturation
from umbilical.engine.schedule import Clock
from umbilical.engine.setup import Setup
from umbilical.plant.exogenous import STRETCHING
from umbilical.plant.forces.table import IN_WATER, WORKS
from umbilical.plant.layout import positions
from umbilical.plant.seaway import may_heave
from umbilical.run import Run, Status, assemble
from umbilical.scenario.findings import Notice
from umbilical.scenario.scenario import Scenario

GRID_TOOK, UNBALANCED = 0.1, 0.01
"""Shares of ``grid_loss`` and ``energy_balance_residual`` from which on a run tells them: the presets stay below 0.002
and 1e-4, on four elements below 0.02 and 1e-3; a vessel whose velocity jumps every second has 0.5 and 0.1."""

_SUMMED = sorted(WORKS, key={force.work for force in IN_WATER}.__contains__)
"""Works in the order they are summed: those of water last, so that where they are zero all sums round as in air."""


class Ending(NamedTuple):
    """How the loop came back: after how many updates, at what time, and why."""

    status: Status
    reason: str
    updates: int
    time: float

    def told(self) -> dict[str, Any]:
        """What a run says of it."""
        return {"status": self.status, "reason": self.reason, "end_time": self.time}


def so_far(setup: Setup) -> tuple[int, float]:
    """Updates taken, and the time of the last one."""
    updates = int(setup.record.tally.measures[0].samples)
    return updates, max(updates - 1, 0) * setup.clock.period


def divergence(setup: Setup, update: int) -> Ending:
    time = update * setup.clock.period
    steepest = float(setup.record.tally.slopes.max())
    if steepest > 1.0:
        why = f"the cable's slope reached {steepest:.3g}: beyond 1 the model of small angles has ended"
    else:
        why = "a state or a voltage is no longer finite"
    return Ending(Status.DIVERGED, f"at t = {time:g} s {why}", update, time)


def assemble_run(
    scenario: Scenario,
    setup: Setup,
    ending: Ending,
    notices: tuple[str, ...],
    timing: dict[str, float],
    logged: Sequence[tuple[int, Mapping[str, float]]] = (),
) -> Run:
    """The run from what is recorded; ``logged``: values of a user's controller, by the update it logged them at."""
    record, clock = setup.record, setup.clock
    times = stored_times(scenario, ending, clock, record.every, record.log.outside.size)
    wet = setup.world.plant.forces.wet
    named = channels(record.log, times.size, bool(scenario.motors), wet)
    metrics = all_metrics(scenario, setup)
    if times.size:
        metrics |= _balance(scenario, record.log, named)
        notices += tuple(map(str, _of_the_grid(metrics)))
    updates = np.minimum(np.arange(times.size) * record.every, clock.periods)
    return assemble(
        scenario, named, time=times, **ending.told(), metrics=metrics, timing=timing, notices=notices,
        sigma=positions(scenario.grid.elements), logged=held_values(logged, updates),
    )  # fmt: skip


def stored_times(scenario: Scenario, ending: Ending, clock: Clock, every: int, room: int) -> np.ndarray:
    """Instants of the stored samples, s: one every so many updates, and the end of the run if there is room."""
    times = np.arange((ending.updates - 1) // every + 1) * every * clock.period
    ends = ending.status is Status.COMPLETED and room > times.size
    return np.append(times, scenario.duration) if ends else times


def _of_the_grid(metrics: Mapping[str, float]) -> Iterator[Notice]:
    """What a user should know of a run whose waves were too short for its grid."""
    lost, residual = metrics["grid_loss"], metrics["energy_balance_residual"]
    if lost > GRID_TOOK or residual > UNBALANCED:
        yield Notice(
            "grid.elements",
            f"the grid took {100.0 * lost:.2g} % of the energy and work, and their balance closes to "
            f"{100.0 * residual:.2g} %: waves or jumps too sharp for it; compare with a finer grid and smoother inputs",
        )


def held_values(logged: Sequence[tuple[int, Mapping[str, float]]], updates: np.ndarray) -> dict[str, np.ndarray]:
    """What a controller logged, held until it logs again, at some updates; NaN before the first value.

    >>> held_values([(0, {"error": 1.0}), (2, {"error": 3.0})], np.arange(4))
    {'error': array([1., 1., 3., 3.])}
    """
    found: dict[str, np.ndarray] = {}
    for update, values in logged:
        for name, value in values.items():
            column = found.setdefault(name, np.full(updates.size, np.nan))
            column[np.searchsorted(updates, update) :] = value
    return found


def _balance(scenario: Scenario, log: Log, named: dict[str, np.ndarray]) -> dict[str, float]:
    """As :func:`closed`, with the energy."""
    motion = {name: named[name] for name in ("tip_velocity", "length")}
    works = np.stack([named[name] for name in _SUMMED if name in named], axis=1)
    outside = {name: log.outside[name][: works.shape[0]] for name in ("net_gravity", "sink_speed", *STRETCHING[:2])}
    if may_heave(scenario.environment):
        named["top_tension"], named["end_tension"] = tension_at_ends(scenario, length=named["length"], **outside)
    named["energy"] = energy(scenario, *inside(log, works.shape[0]), **motion, **outside)
    return closed(named, works)


def closed(named: dict[str, np.ndarray], works: np.ndarray) -> dict[str, float]:
    """Adds the residual of the energy's balance to the channels; what it comes to over the run, as metrics."""
    named["energy_residual"] = balance_residual(named["energy"], works)
    lost = float(np.abs(named["work_grid"][-1]))
    return {
        "energy_balance_residual": relative_residual(named["energy"], works),
        "grid_loss": lost / scale_of(named["energy"], works) if lost else 0.0,
    }


def all_metrics(scenario: Scenario, setup: Setup) -> dict[str, float]:
    """Metrics of a run so far, without those of the power balance; what there was nothing to measure of is absent."""
    tally, tip = setup.record.tally, float(setup.world.state.now[0].ends.tip_displacement)
    return only_measured(scenario, base_metrics(tally, tip, slope_peak=float(tally.slopes.max()))) | saturation(
        scenario, tally
    )


def only_measured(scenario: Scenario, metrics: dict[str, float]) -> dict[str, float]:
    """The same without what there was nothing to measure of."""
    absent = {"tip_peak_after_fault": not scenario.faults, "effort_rms": np.isnan(metrics["effort_rms"])}
    return {name: value for name, value in metrics.items() if not absent.get(name)}


def base_metrics(tally: Any, tip_end: float, **others: float) -> dict[str, float]:
    """Metrics over every control sample; ``others`` stand between those of the cable and of the thrust."""
    found, rms = tally.measures[0], partial(root_mean_square, tally)
    return {
        "tip_peak": found.tip.peak,
        "tip_rms": rms(found.tip),
        "tip_end": tip_end,
        "tip_peak_after_fault": found.tip_after_fault.peak,
        "mid_peak": found.mid.peak,
        "mid_rms": rms(found.mid),
        "quarter_peak": found.quarter.peak,
        "quarter_rms": rms(found.quarter),
        "three_quarter_peak": found.three_quarter.peak,
        "three_quarter_rms": rms(found.three_quarter),
        **others,
        "effort_rms": rms(found.command),
        "thrust_peak": found.thrust.peak,
        "motor_speed_peak": found.speed.peak,
        "motor_voltage_peak": found.voltage.peak,
        "motor_voltage_rms": rms(found.voltage) / np.sqrt(max(tally.motors.size, 1)),
        "motor_current_peak": found.current.peak,
    }

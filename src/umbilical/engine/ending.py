"""How a run ended, and what is kept of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from umbilical.analysis.energy import balance_residual, relative_residual, scale_of
from umbilical.engine.recording import root_mean_square
from umbilical.engine.schedule import Clock
from umbilical.run import Status
from umbilical.scenario.scenario import Scenario


class Ending(NamedTuple):
    """How the loop came back: after how many updates, at what time, and why."""

    status: Status
    reason: str
    updates: int
    time: float

    def told(self) -> dict[str, Any]:
        """What a run says of it."""
        return {"status": self.status, "reason": self.reason, "end_time": self.time}


def stored_times(scenario: Scenario, ending: Ending, clock: Clock, every: int, room: int) -> np.ndarray:
    """Instants of the stored samples, s: one every so many updates, and the end of the run if there is room."""
    times = np.arange((ending.updates - 1) // every + 1) * every * clock.period
    ends = ending.status is Status.COMPLETED and room > times.size
    return np.append(times, scenario.duration) if ends else times


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


def closed(named: dict[str, np.ndarray], works: np.ndarray) -> dict[str, float]:
    """Adds the residual of the energy's balance to the channels; what it comes to over the run, as metrics."""
    named["energy_residual"] = balance_residual(named["energy"], works)
    lost = float(np.abs(named["work_grid"][-1]))
    return {
        "energy_balance_residual": relative_residual(named["energy"], works),
        "grid_loss": lost / scale_of(named["energy"], works) if lost else 0.0,
    }


def only_measured(scenario: Scenario, metrics: dict[str, float]) -> dict[str, float]:
    """Metrics without what there was nothing to measure of."""
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

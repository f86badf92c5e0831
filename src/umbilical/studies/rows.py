"""The row a member leaves in a study: for each arm how it ended, and its metrics."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, NamedTuple

from umbilical.engine.simulate import Common, MeasuredRun, in_turns, measuring, simulate
from umbilical.errors import ControllerError, FileError, ScenarioError
from umbilical.formats import to_netcdf
from umbilical.quantities import METRICS
from umbilical.scenario import Scenario
from umbilical.studies.controllers import describe_error, make_controller, shortened
from umbilical.studies.journal import BEGIN_ANEW
from umbilical.studies.members import Draws, Member

STATUSES = ("COMPLETED", "DIVERGED", "REFUSED", "FAILED")
"""How a member may end; a refused one was no possible scenario, a failed one had a controller that failed."""
NAMES = tuple(name for name in METRICS if name not in ("energy_balance_residual", "grid_loss"))
"""Metrics of a row: all but those of the power balance, which need stored fields."""


class Cell(NamedTuple):
    """One member in one arm; ``metrics`` in the order of :data:`NAMES`, not a number where there is none."""

    status: str
    reason: str
    end_time: float
    metrics: tuple[float, ...]


class Row(NamedTuple):
    """One member: its number and a cell for each arm; stored runs as NetCDF where they were asked for."""

    number: int
    cells: tuple[Cell, ...]
    runs: tuple[bytes | None, ...] = ()


def from_entry(entry: Any, members: int, arms: int) -> Row:
    """The row of a line of a journal, which holds a row's first two fields.

    Raises:
        FileError: the line is no row of a study with so many members and arms.
    """
    try:
        number, cells = entry
        row = Row(number, tuple(Cell(s, r, float(end), tuple(map(float, metrics))) for s, r, end, metrics in cells))
        sound = type(number) is int and 1 <= number <= members and len(cells) == arms
        if sound and all(map(_is_cell, row.cells)):
            return row
    except (TypeError, ValueError):
        pass
    raise FileError(f"the journal holds a line that is no row of this study; {BEGIN_ANEW}")


def _is_cell(cell: Cell) -> bool:
    return cell.status in STATUSES and isinstance(cell.reason, str) and len(cell.metrics) == len(NAMES)


def run_member(draws: Draws, member: Member) -> Row:
    """Simulate one member in every arm, in turns. Whatever becomes of it, it is a row.

    >>> from umbilical.studies.load import load_study
    >>> draws = Draws(load_study("fault-map").replace({"scenario.duration": 0.1, "changes": {"grid.elements": 8}}))
    >>> [cell.status for cell in run_member(draws, draws.member(1)).cells]
    ['COMPLETED', 'COMPLETED']
    """
    stored, common = draws.study.trajectories.keep == "all", Common()
    found = in_turns([_run_cell(draws, member, arm, stored, common) for arm in range(len(draws.study.arms))])
    return Row(member.number, tuple(cell for cell, _ in found), tuple(run for _, run in found) if stored else ())


def _run_cell(
    draws: Draws, member: Member, arm: int, stored: bool, common: Common
) -> Generator[None, None, tuple[Cell, bytes | None]]:
    try:
        scenario = draws.scenario(member, arm)
        controller = make_controller(draws.study.arms[arm].controller, scenario)
        if stored:
            return _stored(scenario, controller)
        return _cell((yield from measuring(scenario, controller, common))), None
    except ScenarioError as error:
        problem = error.problems[0]
        return _without_metrics("REFUSED", f"{problem.key} = {problem.value}: allowed is {problem.bound}"), None
    except ControllerError as error:
        return _without_metrics("FAILED", shortened(str(error))), None
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a study of a thousand must not end with its seven hundred and thirty-first
        return _without_metrics("FAILED", describe_error(error)), None


def _stored(scenario: Scenario, controller: Any) -> tuple[Cell, bytes]:
    run = simulate(scenario, controller)
    return _cell(MeasuredRun(run.status, run.reason, run.end_time, run.metrics)), to_netcdf(run.data)


def _cell(outcome: MeasuredRun) -> Cell:
    metrics = tuple(float(outcome.metrics.get(name, float("nan"))) for name in NAMES)
    return Cell(outcome.status.name, outcome.reason, float(outcome.end_time), metrics)


def _without_metrics(status: str, reason: str) -> Cell:
    return Cell(status, reason, 0.0, (float("nan"),) * len(NAMES))

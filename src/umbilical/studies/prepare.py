"""What is done with a study before anything is drawn: one grid for all members, memory for the result, controllers."""

from __future__ import annotations

from umbilical import machine
from umbilical.engine.resolution import choose_grid
from umbilical.engine.simulate import measure
from umbilical.errors import Problem, ScenarioError
from umbilical.studies.controllers import check_controllers
from umbilical.studies.engines import in_order
from umbilical.studies.members import Draws
from umbilical.studies.rows import NAMES
from umbilical.studies.study import Study

_NUMBER = 8
_COPIES = 5
"""Of every number, while a result is assembled and written: rows, columns, the file and its buffers."""
_CELL, _DRAW, _MEMBER = 100, 100, 300
"""Bytes beside the metrics of a member in an arm (status, time, reason), of one of its draws, and of the member."""


def prepare_study(study: Study, *, trust: bool) -> Study:
    """The study on one grid, after the checks that need the machine or run code.

    Raises:
        ScenarioError: there is not memory enough, or as for
            :func:`~umbilical.studies.controllers.check_controllers`.
    """
    study = _on_one_grid(study)
    check_study_memory(study)
    check_controllers(study, trust=trust)
    return study


def _on_one_grid(study: Study) -> Study:
    """A study on one grid, where its scenario asks for one that is chosen by runs; itself where it names its grid.

    The arms are run before anything is drawn, under the laws of their scenarios, and the finest grid is taken.
    """
    asking = [scenario for scenario in Draws(study).undrawn() if scenario.grid.tolerance is not None]
    if not asking:
        return study
    found = in_order(lambda scenario: choose_grid(scenario, measure), asking)
    own = {key: value for key, value in study.changes.items() if not key.startswith("grid.")}
    grid = {"grid.elements": max(c.elements for c in found), "grid.step": min(c.step for c in found)}
    return study.replace({"scenario.grid.tolerance": None, "changes": own | grid})


def memory_needed(study: Study) -> int:
    """Bytes at the end of a study, when all its rows become one result; an upper estimate."""
    cells = len(study.arms) * (_COPIES * _NUMBER * len(NAMES) + _CELL)
    return len(Draws(study)) * (cells + _DRAW * len(study.variables) + _MEMBER)


def check_study_memory(study: Study) -> None:
    """Refuse a study whose result this machine could not hold.

    Raises:
        ScenarioError: with the memory it needs, what there is, and how many members that is enough for.
    """
    need, there, members = memory_needed(study), machine.memory(), len(Draws(study))
    if need > there:
        value = f"{members}, which take {need / 1e9:.3g} GB of memory"
        bound = f"at most {int(members * there / need)}, for the {there / 1e9:.3g} GB of this machine"
        fix = "take fewer members or arms, or several studies with seeds of their own"
        why = Problem("members", value, bound, "all rows become one result at the end", fix)
        raise ScenarioError([why], study.name)

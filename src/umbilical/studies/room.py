"""Main memory that a study takes, held against the machine's before anything is drawn."""

from __future__ import annotations

from umbilical import machine
from umbilical.errors import Problem, ScenarioError
from umbilical.studies.members import Draws
from umbilical.studies.rows import NAMES
from umbilical.studies.study import Study

_NUMBER = 8
_COPIES = 5
"""Of every number, while a result is assembled and written: rows, columns, the file and its buffers."""
_CELL, _DRAW, _MEMBER = 100, 100, 300
"""Bytes beside the metrics of a member in an arm (status, time, reason), of one of its draws, and of the member."""


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

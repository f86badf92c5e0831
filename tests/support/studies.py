"""A study small enough to run in a second: two draws and a fault, two arms, a tenth of a second on eight elements."""

from __future__ import annotations

from typing import Any

from umbilical.studies.load import load_study
from umbilical.studies.study import Study

SMALL = {
    "scenario.duration": 0.2,
    "scenario.grid.elements": 8,
    "members": 12,
    "campaigns.1.start": {"kind": "uniform", "low": 0.0, "high": 0.15},
    "limits": {"tip_peak": 0.01},
}


def small_study(**changes: Any) -> Study:
    """The robustness study in small, with PD and the proposed law; changes with ``__`` for the dot of a key."""
    study = load_study("paper-robustness")
    arms = [arm.model_dump() for arm in study.arms if arm.name in ("PD", "proposed")]
    return study.replace({**SMALL, "arms": arms, **{key.replace("__", "."): value for key, value in changes.items()}})

"""Tables of RAOs in files: columns by name, in the units of their header."""

from __future__ import annotations

from typing import Any

from umbilical.columns import Columns, Wanted, factor, lists_of
from umbilical.errors import Problem
from umbilical.scenario.ship import MOTIONS

_TRANSLATIONS = MOTIONS[:3]


def rao_lists(columns: Columns, key: str) -> tuple[dict[str, Any], list[Problem]]:
    """Lists of a RAO record, and what is wrong.

    Columns: ``heading [deg]``, ``period [s]`` or ``frequency [Hz]``, and of each motion ``heave [m/m]`` with
    ``heave phase [deg]``. Rotations are per metre, ``pitch [deg/m]``, or per wave slope, ``pitch [-]``.
    """
    names = {name.lower().replace("_", " ").strip() for name in columns.names}
    units = {name.lower(): columns.units[name] for name in columns.names}
    per_slope = [name for name in MOTIONS[3:] if name in names and factor(_slope(units[name]), "1") is not None]
    wanted = [Wanted("heading", ("heading", "direction"), "rad"),
              Wanted("frequency", ("frequency", "period", "omega"), "rad/s")]  # fmt: skip
    for name in MOTIONS:
        needed = name == "heave" or name in names or f"{name} phase" in names
        unit = "1" if name in _TRANSLATIONS or name in per_slope else "rad/m"
        wanted += [Wanted(name, (name, f"{name} amplitude"), unit, needed),
                   Wanted(f"{name}_phase", (f"{name} phase",), "rad", needed)]  # fmt: skip
    found, problems = lists_of(columns, wanted, key)
    lists: dict[str, Any] = {name: values.tolist() for name, values in found.items()}
    mixed = [name for name in MOTIONS[3:] if name in names and name not in per_slope]
    if per_slope and mixed:
        told = f"{', '.join(per_slope)} per slope, {', '.join(mixed)} per metre"
        problems.append(Problem(key, told, "one of both", "rotations have one convention", "convert some"))
    if per_slope:
        lists["rotations"] = "per_slope"
    return lists, problems


def _slope(unit: str) -> str:
    """Degrees per degree and radian per radian are pure numbers."""
    return "1" if unit in ("deg/deg", "rad/rad") else unit

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
    units = {name.lower().replace("_", " ").strip(): columns.units[name] for name in columns.names}
    sizes = {motion: [units[name] for name in _sizes(motion) if name in units] for motion in MOTIONS}
    turned = [name for name in MOTIONS[3:] if sizes[name]]
    per_slope = [name for name in turned if factor(sizes[name][0], "1") is not None]
    scales = ("frequency", "period", "omega", "wave frequency", "wave period")
    wanted = [
        Wanted("heading", ("heading", "direction", "wave heading", "wave direction"), "rad"),
        Wanted("frequency", scales, "rad/s"),
    ]
    for name in MOTIONS:
        needed = bool(name == "heave" or sizes[name] or units.keys() & set(_phases(name)))
        unit = "1" if name in _TRANSLATIONS or name in per_slope else "rad/m"
        wanted += [Wanted(name, _sizes(name), unit, needed), Wanted(f"{name}_phase", _phases(name), "rad", needed)]
    found, problems = lists_of(columns, wanted, key)
    lists: dict[str, Any] = {name: values.tolist() for name, values in found.items()}
    mixed = [name for name in turned if name not in per_slope]
    if per_slope and mixed:
        told = f"{', '.join(per_slope)} per slope, {', '.join(mixed)} per metre"
        problems.append(Problem(key, told, "one of both", "rotations have one convention", "convert some"))
    if per_slope:
        lists["rotations"] = "per_slope"
    return lists, problems


def _sizes(motion: str) -> tuple[str, ...]:
    """How a column of a motion's amplitude may be headed."""
    return motion, *(f"{motion} {word}" for word in ("amplitude", "amp", "rao", "magnitude"))


def _phases(motion: str) -> tuple[str, ...]:
    return f"{motion} phase", f"{motion} phase angle"

"""Several columns of a file by their names, each in the unit it is wanted in: tables of RAOs, of sea states."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from umbilical.columns.reading import Columns
from umbilical.columns.units import factor, known
from umbilical.errors import Problem


class Wanted(NamedTuple):
    """A list to fill: its name, which columns may fill it (lower case), its SI unit, and whether it must be there."""

    name: str
    columns: tuple[str, ...]
    unit: str
    needed: bool = True


def lists_of(columns: Columns, wanted: Iterable[Wanted], key: str) -> tuple[dict[str, np.ndarray], list[Problem]]:
    """Lists by name, in SI units, and everything that is wrong: columns, units, blanks.

    Names are compared without case, and with ``_`` and blanks alike.
    """
    there = {name.lower().replace("_", " ").strip(): name for name in columns.names}
    found: dict[str, np.ndarray] = {}
    problems: list[Problem] = []
    for want in wanted:
        names = [there[name] for name in want.columns if name in there]
        if len(names) > 1 or (want.needed and not names):
            has = f"{' and '.join(names)} both" if names else "missing"
            bound = f"one of {', '.join(want.columns)}; there are {', '.join(columns.names)}"
            problems.append(Problem(f"{key}.{want.name}", has, bound, "columns are found by name", "rename one column"))
        elif names:
            taken = _taken(columns, names[0], want, key)
            if isinstance(taken, Problem):
                problems.append(taken)
            else:
                found[want.name] = taken
    return found, problems


def _taken(columns: Columns, name: str, want: Wanted, key: str) -> np.ndarray | Problem:
    values, unit = columns.values[name], columns.units[name]
    if not np.isfinite(values).all():
        line = columns.lines[int(np.argmin(np.isfinite(values)))]
        reason = "every row of this table counts"
        blank = f"a blank in {name}, line {line}"
        return Problem(f"{key}.{want.name}", blank, "a number in every row", reason, "fill it")
    if want.unit == "rad/s" and factor(unit, "s") is not None:  # a period
        with np.errstate(divide="ignore"):
            return 2.0 * np.pi / (values * float(factor(unit, "s") or 1.0))
    scale = factor(unit, want.unit)
    if scale is None:
        units = ", ".join(known(want.unit))
        shown = f'"{unit}" of column {name}' if unit else f"none, for column {name}"
        fix = f'write it in the header, as in "{name} [{want.unit}]"'
        return Problem(f"{key}.{want.name}", shown, f"one of {units}", "numbers without their unit are guesses", fix)
    return values * scale

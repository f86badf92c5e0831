"""Units of :mod:`umbilical.quantities` as exponents of SI base units."""

from __future__ import annotations

import re
from collections import Counter

BASE = ("kg", "m", "s", "A", "rad")
_DERIVED: dict[str, dict[str, int]] = {
    "N": {"kg": 1, "m": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
    "V": {"kg": 1, "m": 2, "s": -3, "A": -1},
    "ohm": {"kg": 1, "m": 2, "s": -3, "A": -2},
    "H": {"kg": 1, "m": 2, "s": -2, "A": -2},
}


def base_units(unit: str) -> dict[str, int]:
    """Exponents of the base units of a unit as it is written here, e.g. ``N s2/rad2``; those of 0 are left out.

    Raises:
        KeyError: a part of it is no unit.

    >>> base_units("V"), base_units("kg/(N s2)"), base_units("1")
    ({'kg': 1, 'm': 2, 's': -3, 'A': -1}, {'m': -1}, {})
    """
    over, _, under = unit.partition("/")
    found = Counter[str]()
    for text, sign in ((over, 1), (under.strip("()"), -1)):
        for name, power in re.findall(r"([A-Za-z]+)(\d*)", text):
            for base, exponent in (_DERIVED[name] if name not in BASE else {name: 1}).items():
                found[base] += sign * exponent * int(power or 1)
    return {base: exponent for base, exponent in found.items() if exponent}

"""Units as they stand in the headers of files, and what turns their numbers into SI units and radians."""

from __future__ import annotations

from math import pi

_LENGTHS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "ft": 0.3048, "feet": 0.3048, "in": 0.0254,
            "metre": 1.0, "metres": 1.0, "meter": 1.0, "meters": 1.0}  # fmt: skip
_TIMES = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "second": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "hr": 3600.0,
          "hours": 3600.0}  # fmt: skip
_ANGLES = {"rad": 1.0, "deg": pi / 180.0, "degree": pi / 180.0, "degrees": pi / 180.0, "°": pi / 180.0}
_FORCES = {"N": 1.0, "kN": 1e3, "MN": 1e6, "kgf": 9.80665, "tf": 9806.65, "lbf": 4.4482216152605}
_SPEEDS = {"m/s": 1.0, "m s-1": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "km/h": 1.0 / 3.6, "kn": 1852.0 / 3600.0,
           "knots": 1852.0 / 3600.0}  # fmt: skip
_KNOWN = {
    "m": _LENGTHS,
    "s": _TIMES,
    "rad": _ANGLES,
    "N": _FORCES,
    "m/s": _SPEEDS,
    "N/m": {f"{force}/m": scale for force, scale in _FORCES.items()},
    "N m": {"N m": 1.0, "Nm": 1.0, "N*m": 1.0, "kN m": 1e3, "kNm": 1e3, "mNm": 1e-3},
    "V": {"V": 1.0, "mV": 1e-3, "kV": 1e3},
    "1": {"1": 1.0, "-": 1.0, "m/m": 1.0, "deg/deg": 1.0, "rad/rad": 1.0, "%": 1e-2},
    "rad/s": {"rad/s": 1.0, "Hz": 2.0 * pi, "deg/s": pi / 180.0},
    "rad/m": {f"{angle}/m": scale for angle, scale in _ANGLES.items()},
}


def factor(unit: str, wanted: str) -> float | None:
    """What a number in ``unit`` is multiplied by to be in the SI unit ``wanted``; None if it is no such unit.

    >>> factor("mm", "m"), factor("kn", "m/s"), factor("kg", "m")
    (0.001, 0.5144444444444445, None)
    """
    return known(wanted).get(unit.strip())


def known(wanted: str) -> dict[str, float]:
    """Units that can be read where ``wanted`` is meant, each with its factor."""
    return _KNOWN.get(wanted, {wanted: 1.0})

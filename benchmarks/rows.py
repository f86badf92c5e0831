"""One measurement."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One measurement.

    Attributes:
        name: what was measured.
        value: in ``unit``.
        unit: ``s``, ``ms``, ``MB``, or ``x`` for a ratio.
        speed: simulated seconds per second, where that has a sense.
        note: how it was measured.
    """

    name: str
    value: float
    unit: str
    speed: float | None = None
    note: str = ""

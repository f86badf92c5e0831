"""Gains against the periods they are sampled at.

A gain is a rate, 1/s; held for a period it must move what it acts on by less than the whole way. The plant
in between is exact, so these bounds are about the controller alone. They are necessary, not sufficient: the
stability of the whole sampled loop is judged by its spectrum, not here.
"""

from __future__ import annotations

from collections.abc import Iterator

from umbilical.errors import Problem
from umbilical.scenario.control import Control
from umbilical.scenario.findings import Finding, amount


def outer_period(control: Control) -> float:
    """Period of the outer law, its observers and its adaptation, s."""
    return control.outer_period or control.period


def drives_motors(control: Control, ideal_thruster: bool) -> bool:
    """Whether the inner loops run: a thrust is commanded and motors deliver it."""
    return not ideal_thruster and control.law.closes_loop


def within_a_period(key: str, gain: float, unit: str, factor: float, period: float) -> Iterator[Finding]:
    """The rate ``gain * factor``, 1/s, times the period stays below 1."""
    if gain * factor * period >= 1.0:
        yield Problem(
            key,
            amount(gain, unit),
            f"below {1.0 / (factor * period):.6g}{' ' * bool(unit)}{unit} at a period of {period:g} s",
            f"held for one period it moves what it acts on by {gain * factor * period:.3g} of the way, past its goal",
            "a smaller gain or a shorter period",
        )

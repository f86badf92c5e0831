"""How a number, or a choice, is drawn: each distribution is its quantile function."""

from __future__ import annotations

from functools import singledispatch
from math import exp, floor, log, log10
from typing import Annotated, Any, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record

_ROUNDING = 1e-12
_DECIMALS = 12
"""Of a step, or of 1 where a step is larger: beyond them is round-off."""

Drawn = float | int | str | bool
Entry = Annotated[float, Field(ge=-1e12, le=1e12)] | int | str | bool


class Uniform(Record):
    """Every value between two bounds is as likely as any other; with a step, every one of its values."""

    kind: Literal["uniform"]
    low: Number = Field(description="smallest value")
    high: Number = Field(description="largest value")
    step: float | None = Field(default=None, gt=0.0, le=1e12, description="values are low and whole steps above it")


class LogUniform(Record):
    """Every factor between two bounds is as likely as any other: for what is known to an order of magnitude."""

    kind: Literal["log-uniform"]
    low: float = Field(gt=0.0, le=1e12, description="smallest value")
    high: float = Field(gt=0.0, le=1e12, description="largest value")


class Normal(Record):
    """The bell curve, cut off beyond ``cut`` deviations so that no draw is absurd."""

    kind: Literal["normal"]
    mean: Number = Field(description="its middle")
    deviation: float = Field(gt=0.0, le=1e12, description="standard deviation")
    cut: float = Field(default=3.0, gt=0.0, le=8.0, description="deviations beyond which nothing is drawn")


class Choice(Record):
    """One of a few values, each as likely as any other."""

    kind: Literal["choice"]
    values: tuple[Entry, ...] = Field(min_length=1, max_length=10_000, description="numbers, texts or truth values")


class GridPoints(Record):
    """Evenly spaced values, both bounds among them."""

    kind: Literal["grid"]
    low: Number = Field(description="first value")
    high: Number = Field(description="last value")
    count: int = Field(ge=2, le=10_000, description="how many values")


Distribution = Annotated[Uniform | LogUniform | Normal | Choice | GridPoints, Field(discriminator="kind")]


def draw_value(distribution: Distribution, share: float) -> Drawn:
    """Value below which the given share, 0 to 1, of all draws lies.

    >>> width, side = Uniform(kind="uniform", low=2.0, high=4.0), Choice(kind="choice", values=("a", "b"))
    >>> draw_value(width, 0.5), draw_value(side, 0.5)
    (3.0, 'b')
    """
    return _quantile(distribution, share)


def count(distribution: Distribution) -> int | None:
    """How many values there are; None for a continuum."""
    return len(distribution.values) if isinstance(distribution, Choice) else getattr(distribution, "count", None)


def is_number(distribution: Distribution) -> bool:
    """Whether what is drawn can be multiplied."""
    return not isinstance(distribution, Choice) or all(type(value) in (int, float) for value in distribution.values)


@singledispatch
def _quantile(distribution: Any, share: float) -> Drawn:
    raise TypeError(f"not a distribution: {distribution!r}")


@_quantile.register
def _(distribution: Uniform, share: float) -> Drawn:
    low, span, step = distribution.low, distribution.high - distribution.low, distribution.step
    if step is None:
        return low + share * span
    steps = floor(span / step * (1.0 + _ROUNDING))  # 0.3 / 0.1 is a little below 3
    return round(low + _place(share, steps + 1) * step, _DECIMALS - min(floor(log10(step)), 0))


@_quantile.register
def _(distribution: LogUniform, share: float) -> Drawn:
    return exp(log(distribution.low) + share * (log(distribution.high) - log(distribution.low)))


@_quantile.register
def _(distribution: Normal, share: float) -> Drawn:
    from scipy.special import ndtr, ndtri

    below = float(ndtr(-distribution.cut))
    return distribution.mean + distribution.deviation * float(ndtri(below + share * (1.0 - 2.0 * below)))


@_quantile.register
def _(distribution: Choice, share: float) -> Drawn:
    return distribution.values[_place(share, len(distribution.values))]


@_quantile.register
def _(distribution: GridPoints, share: float) -> Drawn:
    place = _place(share, distribution.count) / (distribution.count - 1)
    return distribution.low + place * (distribution.high - distribution.low)


def _place(share: float, places: int) -> int:
    return min(int(share * places), places - 1)

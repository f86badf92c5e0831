"""How a number, or a choice, is drawn: each distribution is its quantile function."""

from __future__ import annotations

from math import exp, floor, log, log10
from typing import Annotated, Literal, NamedTuple

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

    def at(self, share: float) -> Drawn:
        """Value below which the given share, 0 to 1, of all draws lies.

        >>> Uniform(kind="uniform", low=2.0, high=4.0).at(0.5)
        3.0
        """
        if self.step is None:
            return between(self.low, self.high, share)
        steps = floor((self.high - self.low) / self.step * (1.0 + _ROUNDING))  # 0.3 / 0.1 is a little below 3
        value = self.low + _place(share, steps + 1) * self.step
        return round(value, _DECIMALS - min(floor(log10(self.step)), 0))


class LogUniform(Record):
    """Every factor between two bounds is as likely as any other: for what is known to an order of magnitude."""

    kind: Literal["log-uniform"]
    low: float = Field(gt=0.0, le=1e12, description="smallest value")
    high: float = Field(gt=0.0, le=1e12, description="largest value")

    def at(self, share: float) -> Drawn:
        """Value below which the given share, 0 to 1, of all draws lies."""
        return between(self.low, self.high, share, logarithmic=True)


class Normal(Record):
    """The bell curve, cut off beyond ``cut`` deviations so that no draw is absurd."""

    kind: Literal["normal"]
    mean: Number = Field(description="its middle")
    deviation: float = Field(gt=0.0, le=1e12, description="standard deviation")
    cut: float = Field(default=3.0, gt=0.0, le=8.0, description="deviations beyond which nothing is drawn")

    def at(self, share: float) -> Drawn:
        """Value below which the given share, 0 to 1, of all draws lies."""
        from scipy.special import ndtr, ndtri

        below = float(ndtr(-self.cut))
        return self.mean + self.deviation * float(ndtri(below + share * (1.0 - 2.0 * below)))


class Choice(Record):
    """One of a few values, each as likely as any other."""

    kind: Literal["choice"]
    values: tuple[Entry, ...] = Field(min_length=1, max_length=10_000, description="numbers, texts or truth values")

    def at(self, share: float) -> Drawn:
        """Value below which the given share, 0 to 1, of all draws lies, in the order they are given in.

        >>> Choice(kind="choice", values=("a", "b")).at(0.5)
        'b'
        """
        return self.values[_place(share, len(self.values))]


class GridPoints(Record):
    """Evenly spaced values, both bounds among them."""

    kind: Literal["grid"]
    low: Number = Field(description="first value")
    high: Number = Field(description="last value")
    count: int = Field(ge=2, le=10_000, description="how many values")

    def at(self, share: float) -> Drawn:
        """Value below which the given share, 0 to 1, of all draws lies."""
        return between(self.low, self.high, _place(share, self.count) / (self.count - 1))


Distribution = Annotated[Uniform | LogUniform | Normal | Choice | GridPoints, Field(discriminator="kind")]


class DrawnVariable(NamedTuple):
    """Something drawn: its column's name, its distribution, and unit and meaning if no scenario gives them."""

    name: str
    distribution: Distribution
    unit: str = ""
    meaning: str = ""


def between(low: float, high: float, share: float, *, logarithmic: bool = False) -> float:
    """The value at a share, 0 to 1, of the way from low to high."""
    if logarithmic:
        return exp(log(low) + share * (log(high) - log(low)))
    return low + share * (high - low)


def count(distribution: Distribution) -> int | None:
    """How many values there are; None for a continuum."""
    return len(distribution.values) if isinstance(distribution, Choice) else getattr(distribution, "count", None)


def is_number(distribution: Distribution) -> bool:
    """Whether what is drawn can be multiplied."""
    return not isinstance(distribution, Choice) or all(type(value) in (int, float) for value in distribution.values)


def _place(share: float, places: int) -> int:
    return min(int(share * places), places - 1)

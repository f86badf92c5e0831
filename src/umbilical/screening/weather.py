"""Weather windows: how much of the sea states of a place an operation can work in, and for how long at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from umbilical.result import ResultFaces
from umbilical.screening.criteria import Criterion
from umbilical.screening.labels import labelled
from umbilical.screening.operate import Operability, operate
from umbilical.screening.operation import Operation
from umbilical.screening.seas import Seas

if TYPE_CHECKING:
    import xarray

_PERIODS = 24
SHORTEST, LONGEST = 2.0, 30.0
"""s; peak periods beyond are taken as these."""


@dataclass(frozen=True)
class Weather(ResultFaces):
    """Sea states against limits.

    Attributes:
        found: limits over depth, period and heading.
        seas: of the place.
        limit: Hs that is workable at each sea's period, at all depths and headings, m, shape (seas,).
        needed: how long the operation takes, s.
    """

    shown_by: ClassVar[str] = "umbilical.faces.weather"
    drawn_by: ClassVar[str] = "plot_weather"

    found: Operability
    seas: Seas
    limit: np.ndarray
    needed: float

    @property
    def workable(self) -> np.ndarray:
        """Whether each sea keeps the criteria, shape (seas,)."""
        return self.seas.height <= self.limit

    @property
    def share(self) -> float:
        """Share of the sea states that are workable."""
        return float(self.seas.weight[self.workable].sum())

    @property
    def windows(self) -> np.ndarray:
        """Lengths of the times without a break in which all seas are workable, s, in order; none of a scatter table.

        A sea lasts until the next one, the last as long as the one before it; a gap in the record of more than three
        of its usual steps ends a window.
        """
        starts, ends = self._runs()
        return ends - starts

    @property
    def window_share(self) -> float:
        """Share of the time at which an operation of the needed length can begin and be finished."""
        if self.seas.time is None:
            return float("nan")
        starts, ends = self._runs()
        total = self.seas.time[-1] + self._steps()[-1]
        return float(np.maximum(ends - starts - self.needed, 0.0).sum() / max(total - self.needed, self._steps()[-1]))

    def _steps(self) -> np.ndarray:
        time = self.seas.time
        assert time is not None
        steps = np.diff(time) if time.size > 1 else np.array([3600.0])
        return np.append(steps, steps[-1])[: time.size]

    def _runs(self) -> tuple[np.ndarray, np.ndarray]:
        """Start and end of each window, s."""
        time = self.seas.time
        if time is None:
            return np.zeros(0), np.zeros(0)
        steps = self._steps()
        usual = float(np.median(steps))
        lasts = np.minimum(steps, usual) if (steps > 3.0 * usual).any() else steps
        good, follows = self.workable, np.append(False, np.diff(time) <= 3.0 * usual)
        begins = good & ~(np.append(False, good[:-1]) & follows)
        last = good & ~np.append(good[1:] & follows[1:], False)
        return time[begins], time[last] + lasts[last]

    def summary(self) -> str:
        """How much is workable, in one line."""
        name, head = self.found.operation.name, f"{self.share:.1%} of the sea states are workable"
        if self.seas.time is None:
            return f"{name}: {head}"
        enough = int((self.windows >= self.needed).sum())
        longest = float(self.windows.max(initial=0.0))
        return (
            f"{name}: {head}; {self.window_share:.1%} of the time {self.needed / 3600.0:g} h can begin, "
            f"{enough} windows of {self.windows.size}, the longest {longest / 3600.0:.4g} h"
        )

    def to_dict(self) -> dict[str, Any]:
        """As plain data."""
        timed = self.seas.time is not None
        return {
            **self.found.to_dict(), "headline": self.summary(), "workable_share": self.share, "needed": self.needed,
            "window_share": self.window_share if timed else None, "windows": self.windows.tolist() if timed else None,
            "seas": int(self.seas.height.size),
        }  # fmt: skip

    def to_dataset(self) -> xarray.Dataset:
        """Limits and seas as labelled arrays with units."""
        rows = [
            ("sea_height", "sea", self.seas.height, "m", "significant wave height"),
            ("sea_period", "sea", self.seas.period, "s", "peak period Tp"),
            ("sea_weight", "sea", self.seas.weight, "1", "share of the sea states"),
            ("sea_limit", "sea", self.limit, "m", "workable significant wave height at this period"),
            ("sea_workable", "sea", self.workable.astype("i1"), "1", "whether the sea is workable"),
        ]
        if self.seas.time is not None:
            rows.append(("sea_time", "sea", self.seas.time, "s", "time from the first sea"))
        return self.found.to_dataset().assign(labelled(rows))


def weather(
    operation: Operation, criteria: Sequence[Criterion | str], seas: Seas, *, depth: np.ndarray | Sequence[float],
    heading: np.ndarray | Sequence[float], needed: float = 3 * 3600.0,
    progress: Callable[[float], None] = lambda share: None,
) -> Weather:  # fmt: skip
    """Hold the sea states of a place against the limits of an operation.

    Args:
        operation: vessel, cable, body.
        criteria: what must hold.
        seas: of the place; :func:`umbilical.screening.seas.read_seas` reads them.
        depth, heading: as for :func:`operate`; the worst of them counts.
        needed: how long the operation takes, s.
        progress: called with the share that is done.

    >>> from umbilical.screening import load_operation
    >>> seas = Seas(np.array([1.0, 3.0]), np.array([8.0, 8.0]), np.array([0.7, 0.3]), None)
    >>> found = weather(load_operation("work-class"), ["slack=1e-2/3h"], seas, depth=[1500.0],
    ...                 heading=np.radians([135.0]))
    >>> round(found.share, 3)
    0.7
    """
    period = np.clip(seas.period, SHORTEST, LONGEST)
    low, high = float(period.min()), float(period.max())
    grid = np.linspace(low, high, _PERIODS) if high > low else np.array([low])
    found = operate(operation, criteria, depth=depth, period=grid, heading=heading, progress=progress)
    worst = found.limit.min(axis=(0, 2))
    return Weather(found, seas, np.interp(period, grid, worst), needed)

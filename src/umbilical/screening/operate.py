"""Limiting significant wave height over depth, period and heading.

For a linear damping k of the body everything is proportional to Hs. So a table over k gives, for each sea, the height
that belongs to k by linearised drag, and the height at which a criterion is met with that k; where they cross is the
limit. No sea is iterated.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from umbilical.relations.axial import Bar, HeaveTransfer, axial_period, heave_transfer
from umbilical.relations.tension import hanging_of, net_gravity, tension
from umbilical.screening.criteria import USUAL, Criterion, read_criteria
from umbilical.screening.labels import ScreeningResult, labelled
from umbilical.screening.load import bar_of
from umbilical.screening.operation import Operation
from umbilical.screening.response import FREQUENCIES, Spread, check_vessel, largest_rms, sheave_energy, spread
from umbilical.sea.spectrum import Spectrum

if TYPE_CHECKING:
    import xarray

STEEPEST = 1.0 / 7.0
"""Hs over the deep-water wavelength of the peak period: steeper seas do not exist."""
MARGIN = 0.1
"""Simulations gave 5 % more tension than the linearisation: until one confirms a limit, keep 10 % clear of it."""
TYPICAL_LOSS = 0.02
"""Loss factor of steel armour, assumed; what the limits are held against where the operation gives none."""
MOVED = 0.2
"""Share of a limit."""
_DAMPINGS = 120
_PLACES = np.array([1.0, 0.75, 0.5, 0.25, 0.0])
"""Shares of the length where slack is looked for, the body first."""


@dataclass(frozen=True)
class Operability(ScreeningResult):
    """Limits over depth, period and heading.

    Attributes:
        operation: vessel, cable, body.
        criteria: what must hold.
        depth, period, heading: axes; m, s (Tp), rad.
        limits: Hs at which each criterion is just met, m, shape (criteria, depth, period, heading); at most that of
            the steepest sea.
        axial_period: T1 at each depth, s.
        undamped: where the limit hangs on a damping of the cable itself that the operation leaves at 0: a loss factor
            of :data:`TYPICAL_LOSS` moves it by more than :data:`MOVED`; shape (depth, period, heading).
    """

    shown_by: ClassVar[str] = "umbilical.faces.operability"
    drawn_by: ClassVar[str] = "plot_operability"

    operation: Operation
    criteria: tuple[Criterion, ...]
    depth: np.ndarray
    period: np.ndarray
    heading: np.ndarray
    limits: np.ndarray
    axial_period: np.ndarray
    undamped: np.ndarray

    @property
    def limit(self) -> np.ndarray:
        """Hs at which the first criterion fails, m, shape (depth, period, heading)."""
        return self.limits.min(axis=0)

    @property
    def steepest(self) -> np.ndarray:
        """Where no heading has a limit below the steepest sea of the period, shape (depth, period)."""
        return self.limit.min(axis=2) >= steepest_height(self.period)

    @property
    def worst(self) -> tuple[int, int, int]:
        """Places of the lowest limit in depth, period and heading, counted from 0."""
        where = np.unravel_index(int(np.argmin(self.limit)), self.limit.shape)
        return int(where[0]), int(where[1]), int(where[2])

    def holds(self, height: float) -> bool:
        """Whether a sea of this Hs, m, keeps every criterion at all depths, periods and headings."""
        return bool(np.all(self.limit >= height))

    def summary(self) -> str:
        """The lowest limit and where it is, in one line."""
        (d, p, h), height = self.worst, self.limit.min()
        if height >= steepest_height(self.period)[p]:
            return f"{self.operation.name}: no limit below the steepest seas"
        return (
            f"{self.operation.name}: Hs up to {height:.3g} m; lowest at {self.depth[d]:.4g} m, "
            f"Tp {self.period[p]:.3g} s, heading {np.degrees(self.heading[h]):.0f} deg "
            f"({self.criteria[int(np.argmin(self.limits[:, d, p, h]))]})"
        )

    def notices(self) -> tuple[str, ...]:
        """What the limits do not know."""
        said = super().notices()
        if count := int(self.undamped.sum()):
            said += (
                f"{count} of {self.undamped.size} limits hang on the cable's own damping, which is 0 here: a loss "
                f"factor of {TYPICAL_LOSS:g} moves them by more than {MOVED:.0%} (cable.loss_factor)",
            )
        return said

    def to_dataset(self) -> xarray.Dataset:
        """As labelled arrays with units."""
        import xarray

        dims, most = ("depth", "period", "heading"), "largest significant wave height that keeps"
        rows = (
            ("limit", dims, self.limit, "m", f"{most} all criteria"),
            ("limit_by_criterion", ("criterion", *dims), self.limits, "m", f"{most} the criterion"),
            ("axial_period", "depth", self.axial_period, "s", "longest axial period T1"),
            (
                "undamped",
                dims,
                self.undamped.astype("i1"),
                "1",
                "the limit hangs on a damping of the cable that is 0 here",
            ),
            ("depth", "depth", self.depth, "m", "cable paid out"),
            ("period", "period", self.period, "s", "peak period Tp"),
            ("heading", "heading", self.heading, "rad", "direction the waves go to, 0 following"),
        )
        axes = {"criterion": [str(criterion) for criterion in self.criteria]}
        about = {"operation": self.operation.name, "operation_hash": self.operation.hash}
        return xarray.Dataset(labelled(rows), axes, about)

    def to_dict(self) -> dict[str, Any]:
        """As plain data."""
        place = dict(zip(("depth", "period", "heading"), self.worst, strict=True))
        at = {axis: float(getattr(self, axis)[number]) for axis, number in place.items()}
        return self.plain(
            "depth period heading limit axial_period undamped",
            criteria=[str(criterion) for criterion in self.criteria],
            lowest={"height": float(self.limit[self.worst]), **at},
        )


def operate(
    operation: Operation, criteria: Sequence[Criterion | str] = USUAL, *, depth: np.ndarray | Sequence[float],
    period: np.ndarray | Sequence[float], heading: np.ndarray | Sequence[float],
    progress: Callable[[float], None] = lambda share: None,
) -> Operability:  # fmt: skip
    """Find the limiting Hs of long-crested seas over depth, peak period and heading.

    Args:
        operation: vessel, cable, body, compensation.
        criteria: what must hold, one or more, such as ``"top_tension:250e3=1e-2/3h"``; no slack if left out.
        depth: cable paid out, m, shape (d,).
        period: peak periods Tp, s, shape (p,).
        heading: directions the waves go to, rad, shape (h,).
        progress: called with the share that is done.

    >>> import numpy as np
    >>> from umbilical.screening import load_operation
    >>> found = operate(load_operation("work-class"), ["slack=1e-2/3h"], depth=[1500.0], period=[8.0],
    ...                 heading=np.radians([135.0]))
    >>> round(float(found.limit[0, 0, 0]), 2)
    1.64
    """
    depth, period, heading = (np.asarray(axis, dtype=float) for axis in (depth, period, heading))
    criteria = read_criteria(criteria)
    seas = _unit_seas(operation, period, heading)
    bars, found, damped = [bar_of(operation, length) for length in depth.tolist()], [], []
    for number, bar in enumerate(bars, start=1):
        found.append(_limits_at(operation, criteria, bar, seas))
        damped.append(_limits_at(operation, criteria, _with_typical_loss(bar), seas))
        progress(number / depth.size)
    shape = (len(criteria), depth.size, period.size, heading.size)
    steepest = steepest_height(period)[None, None, :, None]
    limits, held = (np.minimum(np.stack(part, axis=1).reshape(shape), steepest) for part in (found, damped))
    axial = np.array([axial_period(bar) for bar in bars])
    undamped = abs(held.min(axis=0) - limits.min(axis=0)) > MOVED * limits.min(axis=0)
    return Operability(operation, criteria, depth, period, heading, limits, axial, undamped)


def _with_typical_loss(bar: Bar) -> Bar:
    return bar if bar.loss_factor > 0.0 else bar._replace(loss_factor=TYPICAL_LOSS)


def steepest_height(period: float | np.ndarray) -> Any:
    """Hs of the steepest sea of a peak period, m."""
    return STEEPEST * 9.81 * period**2 / (2.0 * np.pi)


def _unit_seas(operation: Operation, period: np.ndarray, heading: np.ndarray) -> np.ndarray:
    """Spectra of the sheave's heave for Hs = 1 m, shape (frequencies, periods x headings)."""
    seas = [Spectrum(1.0, float(tp), operation.sea.peakedness) for tp in period]
    check_vessel(operation, seas, heading.tolist())
    gains = [sheave_energy(operation, np.ones_like(FREQUENCIES), float(beta)) for beta in heading]
    return np.array([sea.density(FREQUENCIES) * gain for sea in seas for gain in gains]).T


def _limits_at(operation: Operation, criteria: tuple[Criterion, ...], bar: Bar, seas: np.ndarray) -> np.ndarray:
    """Limiting Hs of each criterion in each sea at one depth, m, shape (criteria, seas)."""
    drag = operation.payload.quadratic_drag
    scale = drag * np.sqrt(8.0 / np.pi)
    damping = scale * np.geomspace(1e-4, 30.0, _DAMPINGS) if drag > 0.0 else np.zeros(1)
    answer = heave_transfer(bar, damping, FREQUENCIES)
    velocity = spread(abs(answer.body) ** 2 * FREQUENCIES**2, seas).rms
    height = damping[:, None] / (scale * velocity) if drag > 0.0 else np.full_like(velocity, np.nan)
    rows = []
    for criterion in criteria:
        allowed = np.min([
            largest_rms(level, process.period, criterion.probability, criterion.duration) / process.rms
            for level, process in _processes(operation, criterion, bar, answer, seas)
        ], axis=0)  # fmt: skip
        rows.append(allowed[0] if drag == 0.0 else _crossing(height, allowed))
    return np.array(rows)


def _processes(
    operation: Operation, criterion: Criterion, bar: Bar, answer: HeaveTransfer, seas: np.ndarray
) -> list[tuple[float, Spread]]:
    """What a criterion bounds, and by which level above its mean; for Hs = 1 m."""
    hung = hanging_of(operation.cable, operation.payload, operation.environment)
    still = net_gravity(operation.environment.gravity)
    match criterion.name:
        case "top_tension":
            return [(criterion.level - tension(bar.length, still, hung), spread(abs(answer.top) ** 2, seas))]
        case "body_heave":
            return [(criterion.level, spread(abs(answer.body) ** 2, seas))]
    below = [(1.0 - share) * bar.length for share in _PLACES]
    return [(tension(s, still, hung), spread(abs(answer.tension_at(bar.length - s)) ** 2, seas)) for s in below]


def _crossing(height: np.ndarray, allowed: np.ndarray) -> np.ndarray:
    """First height, along the damping, at which the sea is as high as allowed; shape (dampings, seas) to (seas,)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        gap = np.log(height) - np.log(allowed)
        above, seas = gap >= 0.0, np.arange(height.shape[1])
        first = np.argmax(above, axis=0)
        before = np.maximum(first - 1, 0)
        share = -gap[before, seas] / (gap[first, seas] - gap[before, seas])
        share = np.where((first > 0) & np.isfinite(share), share, 1.0)
        crossed = np.exp((1.0 - share) * np.log(height[before, seas]) + share * np.log(height[first, seas]))
    crossed = np.where(allowed[first, seas] <= 0.0, 0.0, crossed)
    return np.where(above.any(axis=0), crossed, height[-1])

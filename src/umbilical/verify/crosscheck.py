"""Peaks of |y(l,t)| over 50 s that two separately written codes agree on.

Continuous law, ideal thrust, l = 500 m fixed, d = 100 + 100 sin 0.5t + 50 sin t. The continuous law is the limit of
the sampled one at first order in the period.
"""

from __future__ import annotations

from collections.abc import Iterator

from umbilical.analysis.convergence import Curve
from umbilical.library import load
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, each, order_reached
from umbilical.verify.orders import PERIOD_ORDER

PEAKS = {"crosscheck-none": 12.086, "crosscheck-pd": 4.173, "crosscheck-no-observer": 0.5008}
PROPOSED = 0.002294
TOLERANCE = 2e-3
PERIODS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)


def _peak(preset: str, period: float = 1e-3) -> float:
    """Largest |y(l,t)| over the run, m."""
    return engine.completed(load(preset, {"control.period": period, "grid.step": period})).metrics["tip_peak"]


def _published(preset: str) -> Iterator[Check]:
    """A peak that hardly depends on the period."""
    why = "printed with four digits for the continuous law, ours has a period of 1 ms"
    yield close("peak of |y(l,t)|, m", _peak(preset), PEAKS[preset], TOLERANCE, why)


def _proposed() -> Iterator[Check]:
    """The peak under the boundary law, which does depend on it."""
    coarse, fine = (_peak("crosscheck-proposed", period) for period in PERIODS[:2])
    yield close("peak of |y(l,t)|, m, at 1 ms", coarse, PROPOSED, 1e-2, "first order in the period")
    why = "the codes agree to 0.00229 ... 0.00231"
    yield close("its limit for short periods, m", 2.0 * fine - coarse, PROPOSED, TOLERANCE, why)


def _refined() -> Iterator[Check]:
    """How it goes to its limit."""
    peaks = [_peak("crosscheck-proposed", period) for period in PERIODS]
    limit = 2.0 * peaks[-1] - peaks[-2]
    yield close("limit for short periods, m", limit, PROPOSED, 2e-4, "the last digit printed")
    off = tuple(abs(p - limit) for p in peaks[:-1])
    curve = Curve("the peak under the boundary law", "the period, s", PERIODS[:-1], off, PERIOD_ORDER)
    yield order_reached(curve, "stated")


CODES = "two codes, continuous law"
SOURCE = "public cross-check of the paper's system"
CASES = (
    *each("{}", CODES, SOURCE, _published, tuple(PEAKS)),
    Case("crosscheck-proposed", CODES, SOURCE, _proposed),
    Case("crosscheck-proposed, refined", CODES, SOURCE, _refined, quick=False),
)

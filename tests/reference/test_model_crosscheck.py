"""Peak of |y(l,t)| over 50 s that two separately written codes agree on.

Continuous law, ideal thrust, l = 500 m fixed, d = 100 + 100 sin 0.5t + 50 sin t. The continuous law is the
limit of the sampled one at first order in the period.
"""

from __future__ import annotations

import pytest

import umbilical
from tests.support.scenarios import run

PROPOSED, TOLERANCE = 0.002294, 1e-2


def peak(preset: str, period: float = 1e-3) -> float:
    return run(umbilical.load(preset, {"control.period": period, "grid.step": period})).metrics["tip_peak"]


@pytest.mark.parametrize(
    ("preset", "published"), [("crosscheck-none", 12.086), ("crosscheck-pd", 4.173), ("crosscheck-no-observer", 0.5008)]
)
def test_peaks_at_one_millisecond(preset: str, published: float) -> None:
    assert peak(preset) == pytest.approx(published, rel=2e-3)


def test_proposed_law_tends_to_the_continuous_one_at_first_order() -> None:
    peaks = [peak("crosscheck-proposed", period) for period in (1e-3, 5e-4, 2.5e-4, 1.25e-4)]
    limit = 2.0 * peaks[-1] - peaks[-2]
    assert limit == pytest.approx(PROPOSED, rel=2e-4)
    assert peaks[0] == pytest.approx(PROPOSED, rel=TOLERANCE)
    assert peaks[2] == pytest.approx(PROPOSED, rel=2e-3)
    coarse, middle, fine = (p - limit for p in peaks[:3])
    assert coarse / middle == pytest.approx(2.0, abs=0.2)
    assert middle / fine == pytest.approx(2.0, abs=0.1)

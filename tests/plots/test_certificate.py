"""The picture of a certificate: all that is drawn is seen, and no decade without data."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import umbilical
from tests.support.certificates import GAIN
from umbilical.plots.certificate import draw_bounds, plot_certificate
from umbilical.studies.audit import Audit, audit


@pytest.fixture(scope="module")
def audited() -> Audit:
    return audit(umbilical.load("ringdown", {GAIN: 20.0, "duration": 4.0}))


def test_axis_of_v_fits_what_is_drawn(audited: Audit) -> None:
    """The real loop starts far above its bound, with its motors at rest: its start must be in the picture."""
    ax = Figure().add_subplot()
    draw_bounds(ax, audited.certificate, audited)
    low, high = ax.get_ylim()
    left, right = ax.get_xlim()
    assert audited.real[0] > 5.0 * audited.bound.max()
    assert low < audited.real[0] < high
    assert left < 0.0 < audited.time[-1] < right
    drawn = np.concatenate([np.asarray(line.get_ydata()) for line in ax.lines])
    assert np.quantile(drawn, 0.02) < 3.0 * low
    assert drawn.max() > high / 3.0


def test_both_bounds_are_drawn(audited: Audit) -> None:
    ax = plot_certificate(audited.certificate).axes[0]
    assert [line.get_label() for line in ax.lines] == ["bound of V", "bound of V1 + V2"]
    assert len(plot_certificate(audited.certificate, audited).axes[0].lines) == 5


def test_what_is_not_certified_has_no_bound() -> None:
    found = umbilical.certify(umbilical.load("haul-in", {GAIN: 0.5}))
    assert not plot_certificate(found).axes[0].lines

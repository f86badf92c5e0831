"""A certificate over time: V under its bound, the proved rate, and the margins of its conditions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.certificate import bound, cable_bound
from umbilical.plots.figure import ABOVE, COLOURS, ONE_ROW, QUIET, dress, new_figure
from umbilical.quantities import CERTIFICATE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.certificate import Certificate
    from umbilical.studies.audit import Audit

LEGEND = ABOVE | {"ncols": ONE_ROW}
SAMPLES = 801
DECADES = 8
"""Powers of ten that are drawn of V at most, from its largest value down."""
RARE = 0.005
"""Share of the samples that may lie below the picture."""
ROOM = 1.5
"""Factor between what is drawn and the edges of the picture."""
LEAST_MARGIN = 1e-4
"""Margins are drawn on a logarithmic scale down to here, for those that are hard to keep are thousandths."""
EDGE = 0.01
"""Share of the time axis beside it, so that what happens at the start is seen."""


def plot_certificate(certificate: Certificate, audit: Audit | None = None) -> Figure:
    """V and its bound, the rate, and the margins, one above the other.

    Args:
        certificate: from :func:`umbilical.certify`.
        audit: its two simulations, drawn beside the bound.

    >>> import umbilical
    >>> certificate = umbilical.certify(umbilical.load("ringdown", {"control.law.slope_gain": 5.0}))
    >>> umbilical.plot_certificate(certificate).savefig("certificate.png")
    """
    figure = new_figure(9.0, 8.0)
    of_v, of_rate, of_margin = figure.subplots(3, 1, sharex=True)
    draw_bounds(of_v, certificate, audit)
    draw_rates(of_rate, certificate)
    draw_margins(of_margin, certificate)
    of_margin.set_xlabel("time [s]")
    verdict = "certified" if certificate.holds else "not certified"
    figure.suptitle(f"{certificate.scenario.name}: {verdict}", fontsize=12)
    return figure


def draw_bounds(ax: Axes, certificate: Certificate, audit: Audit | None) -> None:
    """The bounds of V and of V1 + V2 from the start of the ideal run, or of the scenario; V of both runs."""
    if np.isfinite(certificate.rates).all():
        t = audit.time if audit else np.linspace(0.0, float(certificate.edges[-1]), SAMPLES)
        of_v = audit.bound if audit else bound(certificate, t)
        of_cable = audit.cable_bound if audit else cable_bound(certificate, t)
        ax.plot(t, of_v, color=COLOURS[6], linewidth=1.4, label="bound of V")
        ax.plot(t, of_cable, color=COLOURS[6], linewidth=1.2, linestyle=":", label="bound of V1 + V2")
    if audit:
        _draw_runs(ax, audit)
    _fit(ax)
    dress(ax, CERTIFICATE["lyapunov"].meaning, LEGEND, ylabel="$V$ [J]").margins(x=EDGE)


def _draw_runs(ax: Axes, audit: Audit) -> None:
    """V of both runs; the real one starts at a dot, because it may fall from there faster than the eye can follow."""
    start = {"marker": "o", "markevery": [0], "markersize": 5.0}
    ax.plot(audit.real_time, audit.real, color=COLOURS[1], linewidth=1.2, label="V, the run as it is", **start)
    ax.plot(audit.time, audit.ideal, color=COLOURS[0], linewidth=1.2, linestyle="--", label="V, ideal loop")
    lower = {"color": COLOURS[2], "linewidth": 1.0, "linestyle": "-.", "zorder": 1.5}
    ax.plot(audit.time, audit.cable, label="V1 + V2, ideal loop", **lower)


def _fit(ax: Axes) -> None:
    """Decades around all that is drawn, but for what rises from nothing, and at most :data:`DECADES`."""
    drawn = np.concatenate([np.zeros(0), *(np.asarray(line.get_ydata(), dtype=np.float64) for line in ax.lines)])
    seen = drawn[np.isfinite(drawn) & (drawn > 0.0)]
    if seen.size:
        highest = float(seen.max())
        lowest = max(float(np.quantile(seen, RARE)), highest * 10.0**-DECADES)
        ax.set_yscale("log")
        ax.set_ylim(lowest / ROOM, highest * ROOM)


def draw_rates(ax: Axes, certificate: Certificate) -> None:
    """The proved rate of each slab, beside the rates with the winch stopped."""
    proved = {"baseline": None, "color": COLOURS[0], "linewidth": 1.4, "label": "proved, winch as it runs"}
    ax.stairs(certificate.rates, certificate.edges, **proved)
    ax.axhline(certificate.fixed_length_rate, color=COLOURS[2], linewidth=1.2, linestyle="--", label="winch stopped")
    ax.axhline(certificate.exact_rate, color=COLOURS[1], linewidth=1.2, linestyle=":", label="exact, winch stopped")
    ax.axhline(0.0, color=QUIET, linewidth=0.8)
    dress(ax, "rate of decay of V", LEGEND, ylabel=r"$\vartheta$ [1/s]").margins(x=EDGE)


def draw_margins(ax: Axes, certificate: Certificate) -> None:
    """Smallest margin of each condition in each slab, over its larger side."""
    for number, (name, margin) in enumerate(certificate.margins.items()):
        colour, dashes = COLOURS[number % len(COLOURS)], ("-", "--", ":")[number // 3 % 3]
        ax.stairs(margin, certificate.edges, baseline=None, color=colour, linestyle=dashes, linewidth=1.3, label=name)
    ax.axhline(0.0, color=QUIET, linewidth=0.8)
    lowest = min(float(np.nanmin(margin)) for margin in certificate.margins.values())
    ax.set_yscale("symlog", linthresh=LEAST_MARGIN)
    ax.set_ylim(min(2.0 * lowest, -LEAST_MARGIN), 2.0)
    dress(ax, "margin over the larger side: below 0 a condition fails", LEGEND, ylabel="margin").margins(x=EDGE)

"""What the linearised loop is worth: reflection over frequency, and the opened loop with its margins."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, new_figure
from umbilical.scenario.control import BoundaryLaw

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.analysis.margins import Judgement
    from umbilical.design.margins import MarginReport

LOWEST = 1e-2
"""rad/s; nothing happens below."""
SHOWN_LOOP = 3.0
"""Largest |L| in the Nyquist picture, where a margin is read."""
MOST_POINTS = 40_000
"""Points of one curve."""


def plot_margins(report: MarginReport) -> Figure:
    """Reflection, size and angle of the opened loop, and its Nyquist curve near 1; a colour for each length."""
    figure = new_figure(11.0, 8.0)
    places = figure.subplots(2, 2)
    plot_reflection(report, ax=places[0, 0])
    plot_nyquist(report, ax=places[0, 1])
    plot_bode(report, (places[1, 0], places[1, 1]))
    state = "stable" if report.stable else "not stable"
    figure.suptitle(f"{report.scenario.name}: {state}, motors at {report.operating_thrust:.4g} N", fontsize=12)
    return figure


def plot_reflection(report: MarginReport, *, ax: Axes) -> Axes:
    """|R| of the controlled ROV; above 1/|echo| it feeds the waves more than the cable takes."""
    for number, j in enumerate(report.judgements):
        ax.semilogx(j.frequency, j.reflection, color=COLOURS[number], linewidth=1.4, label=f"{j.length:g} m")
    shortest = min(report.judgements, key=lambda j: j.length)
    ax.semilogx(
        shortest.sweep.coarse, 1.0 / shortest.sweep.loudest, color=QUIET, linestyle=":", label="what the cable takes"
    )
    law = report.scenario.control.law
    if isinstance(law, BoundaryLaw):
        speed = shortest.sweep.cable.tip_wave_speed
        ideal = abs(speed - law.slope_gain) / (speed + law.slope_gain)
        ax.axhline(ideal, color=QUIET, linestyle="--", linewidth=1.0, label="ideal law")
    ax.set_xlim(LOWEST, None)
    return _finish(ax, "reflection of the ROV |R|", "")


def plot_nyquist(report: MarginReport, *, ax: Axes) -> Axes:
    """L in the complex plane near 1, where the closed loop has a pole on the unit circle."""
    for number, j in enumerate(report.judgements):
        curve = _thinned(j)[1]
        curve = np.where(np.abs(curve) < 2.0 * SHOWN_LOOP, curve, np.nan)
        ax.plot(np.real(curve), np.imag(curve), color=COLOURS[number], linewidth=0.7)
        if j.margins:
            edges = [1.0 / g.size for g in (j.margins.gain_low, j.margins.gain_high) if 0.0 < g.size < np.inf]
            ax.plot(edges, np.zeros(len(edges)), "|", color=COLOURS[number], markersize=12)
    circle = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 200))
    ax.plot(np.real(circle), np.imag(circle), color=QUIET, linestyle=":", linewidth=1.0)
    ax.plot([1.0], [0.0], "+", color="black", markersize=10)
    ax.set(xlim=(-SHOWN_LOOP, SHOWN_LOOP), ylim=(-SHOWN_LOOP, SHOWN_LOOP), aspect="equal")
    return _finish(ax, "opened loop L; the bars are the gain margins", "imaginary part", "real part")


def plot_bode(report: MarginReport, axes: tuple[Axes, Axes]) -> None:
    """Size and angle of L; marks where phase and delay are used up."""
    size, angle = axes
    for number, j in enumerate(report.judgements):
        w, curve = _thinned(j)
        size.loglog(w, np.abs(curve), color=COLOURS[number], linewidth=0.7)
        angle.semilogx(w, np.degrees(np.angle(curve)), ".", color=COLOURS[number], markersize=0.8)
        for limit in (j.margins.phase, j.margins.delay) if j.margins else ():
            if np.isfinite(limit.frequency):
                size.axvline(limit.frequency, color=COLOURS[number], linestyle=":", linewidth=0.9)
    size.axhline(1.0, color=QUIET, linestyle=":", linewidth=1.0)
    for ax in axes:
        ax.set_xlim(LOWEST, None)
    _finish(size, "size of L; lines where phase and delay are used up", "|L|")
    _finish(angle, "angle of L", "degrees")


def _thinned(j: Judgement) -> tuple[np.ndarray, np.ndarray]:
    w, curve = j.sweep.w, j.sweep.transfer()
    keep = slice(None, None, max(1, w.size // MOST_POINTS))
    return w[keep], curve[keep]


def _finish(ax: Axes, title: str, ylabel: str, xlabel: str = "frequency [rad/s]") -> Axes:
    ax.set_title(title, fontsize=9.5, loc="left")
    ax.set(xlabel=xlabel, ylabel=ylabel)
    ax.grid(alpha=0.25, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    if ax.get_legend_handles_labels()[1]:
        ax.legend(fontsize=8, frameon=False)
    return ax

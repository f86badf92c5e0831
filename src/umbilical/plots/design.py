"""What a design changes: decay over beta with what the motors can follow, reflection, rejection, simulations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, at_sigma, new_figure
from umbilical.stability.sampled import loop_response
from umbilical.synthesis.score import changes as demanded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.synthesis.design import Design


LEAST_TAKEN = 1e-4
"""Share of a wave, down to which it is shown what a round trip takes."""
SOLID = 4
"""Lines drawn solid in colours that nobody confuses; those that follow are dashed."""


def plot_design(design: Design) -> Figure:
    """Six panels: beta, reflection, rejection, round trips, midpoint and ROV over time, before and after.

    Args:
        design: from :func:`umbilical.design`.
    """
    figure = new_figure(11.0, 10.5)
    panels = figure.subplots(3, 2)
    plot_followed(design, panels[0, 0])
    plot_reflections(design, panels[0, 1])
    plot_rejection(design, panels[1, 0])
    plot_trips(design, panels[1, 1])
    plot_motion(design, panels[2, 0], 0.5, "midpoint")
    plot_motion(design, panels[2, 1], 1.0, "ROV")
    figure.suptitle(f"{design.before.scenario.name}: designed for {design.objective}", fontsize=12)
    return figure


def plot_followed(design: Design, ax: Axes) -> None:
    """Decay of the first modes over beta; thick where the demanded margins are there."""
    trip = design.after.report.judgements[0].sweep.cable.round_trip
    speed = design.after.report.judgements[0].sweep.cable.tip_wave_speed
    decay = -np.log(np.maximum(design.reflections, 1e-6)) / trip
    ideal = -np.log(np.maximum(np.abs(speed - design.betas) / (speed + design.betas), 1e-6)) / trip
    ax.loglog(design.betas, ideal, color=QUIET, linestyle="--", linewidth=1.0, label="ideal law")
    ax.loglog(design.betas, decay, color=COLOURS[1], linewidth=0.9, label="these motors")
    inside = np.where(design.followed, decay, np.nan)
    ax.loglog(design.betas, inside, color=COLOURS[0], linewidth=3.0, label="with all margins")
    law = design.after.scenario.control.law
    ax.axvline(getattr(law, "slope_gain", np.nan), color=QUIET, linestyle=":", linewidth=1.0)
    _finish(ax, "slowest of the first modes: decay over beta", "beta [m/s]", "decay [1/s]")


def plot_reflections(design: Design, ax: Axes) -> None:
    """|R| over frequency."""
    for number, side in enumerate((design.before, design.after)):
        j = side.report.judgements[0]
        ax.semilogx(j.frequency, j.reflection, color=COLOURS[1 - number], label=("before", "after")[number])
    sweep = design.after.report.judgements[0].sweep
    ax.semilogx(sweep.coarse, 1.0 / sweep.loudest, color=QUIET, linestyle=":", label="what the cable takes")
    ax.set_xlim(1e-2, None)
    _finish(ax, "reflection of the ROV |R|", "frequency [rad/s]", "")


def plot_rejection(design: Design, ax: Axes) -> None:
    """Displacement of the ROV per force on it: the disturbance that gets through."""
    for number, side in enumerate((design.before, design.after)):
        j = side.report.judgements[0]
        response = loop_response(j.sweep.cable, j.sweep.loop, 1j * j.frequency)
        label = ("before", "after")[number]
        ax.loglog(j.frequency, response.compliance(), color=COLOURS[1 - number], linewidth=1.2, label=label)
    ax.set_xlim(1e-2, None)
    _finish(ax, "ROV per force on it, the cable without an end", "frequency [rad/s]", "displacement per force [m/N]")


def plot_trips(design: Design, ax: Axes) -> None:
    """What a round trip takes off a wave under each change that the new loop shall survive: above 0, or it grows."""
    sweep = design.after.report.judgements[0].sweep
    changes = demanded(design.after.demands, design.after.scenario.control.period)
    for number, (name, factor) in enumerate(changes.items()):
        size = sweep.loudest * np.abs(sweep.opened.reflection(factor(1j * sweep.coarse)))
        label = name if size.max() < 1.0 else f"{name}: grows where there is no line"
        style = {"color": COLOURS[number % SOLID], "linestyle": ("-", (0, (5, 2)))[number // SOLID % 2]}
        ax.loglog(sweep.coarse, np.where(size < 1.0, 1.0 - size, np.nan), linewidth=1.2, label=label, **style)
    ax.set(xlim=(1.0, None), ylim=(LEAST_TAKEN, 1.0))
    _finish(ax, "what a round trip takes, under what shall be survived", "frequency [rad/s]", "1 - |echo R|")


def plot_motion(design: Design, ax: Axes, sigma: float, name: str) -> None:
    """Displacement over time."""
    for number, side in enumerate((design.before, design.after)):
        y = at_sigma(side.trial.run, sigma)
        label = ("before", "after")[number]
        ax.plot(y["time"].values, y.values, color=COLOURS[1 - number], linewidth=1.4, label=label)
    _finish(ax, f"displacement of the {name}", "time [s]", "y [m]")


def _finish(ax: Axes, title: str, xlabel: str, ylabel: str) -> None:
    ax.set_title(title, fontsize=9.5, loc="left")
    ax.set(xlabel=xlabel, ylabel=ylabel)
    ax.grid(alpha=0.25, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(fontsize=8, frameon=False)

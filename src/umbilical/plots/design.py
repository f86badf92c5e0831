"""What a design changes: decay over beta with what the motors can follow, reflection, rejection, simulations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, at_sigma, dress, new_figure
from umbilical.stability.sampled import loop_response
from umbilical.synthesis.score import changes as demanded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.synthesis.design import Design
    from umbilical.synthesis.iterate import Evaluation


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
    for ax, draw in zip(panels.flat, (_draw_followed, _draw_reflections, _draw_rejection, _draw_trips), strict=False):
        draw(design, ax)
    _draw_motion(design, panels[2, 0], 0.5, "midpoint")
    _draw_motion(design, panels[2, 1], 1.0, "ROV")
    figure.suptitle(f"{design.before.scenario.name}: designed for {design.objective}", fontsize=12)
    return figure


def _draw_followed(design: Design, ax: Axes) -> None:
    """Decay of the first modes over beta; thick where the demanded margins are there."""
    trip = design.after.report.judgements[0].sweep.cable.round_trip
    speed = design.after.report.judgements[0].sweep.cable.tip_wave_speed
    decay = -np.log(np.maximum(design.reflections, 1e-6)) / trip
    ideal = -np.log(np.maximum(np.abs(speed - design.betas) / (speed + design.betas), 1e-6)) / trip
    ax.loglog(design.betas, ideal, color=QUIET, linestyle="--", linewidth=1.0, label="ideal law")
    ax.loglog(design.betas, decay, color=COLOURS[1], linewidth=0.9, label="with these motors")
    inside = np.where(design.followed, decay, np.nan)
    ax.loglog(design.betas, inside, color=COLOURS[0], linewidth=3.0, label="and all margins kept")
    law = design.after.scenario.control.law
    ax.axvline(getattr(law, "slope_gain", np.nan), color=QUIET, linestyle=":", linewidth=1.0)
    dress(
        ax, "decay of the slowest of the first modes over slope_gain", xlabel="slope_gain [m/s]", ylabel="decay [1/s]"
    )


def _draw_reflections(design: Design, ax: Axes) -> None:
    """|R| over frequency."""
    for side, style in _sides(design):
        j = side.report.judgements[0]
        ax.semilogx(j.frequency, j.reflection, **style)
    sweep = design.after.report.judgements[0].sweep
    ax.semilogx(sweep.coarse, 1.0 / sweep.loudest, color=QUIET, linestyle=":", label="limit: above it waves grow")
    dress(
        ax, "wave thrown back by the ROV over the wave that arrives, |R|", xlabel="frequency [rad/s]", xlim=(1e-2, None)
    )


def _draw_rejection(design: Design, ax: Axes) -> None:
    """Displacement of the ROV per force on it: the disturbance that gets through."""
    for side, style in _sides(design):
        j = side.report.judgements[0]
        response = loop_response(j.sweep.cable, j.sweep.loop, 1j * j.frequency)
        ax.loglog(j.frequency, response.compliance(), linewidth=1.2, **style)
    labels: dict[str, Any] = {"xlabel": "frequency [rad/s]", "ylabel": "displacement per force [m/N]"}
    dress(ax, "displacement of the ROV per force on it, long cable", xlim=(1e-2, None), **labels)


def _draw_trips(design: Design, ax: Axes) -> None:
    """What a round trip takes off a wave under each change that the new loop shall survive: above 0, or it grows."""
    sweep = design.after.report.judgements[0].sweep
    changes = demanded(design.after.demands, design.after.scenario.control.period)
    for number, (name, factor) in enumerate(changes.items()):
        size = sweep.loudest * np.abs(sweep.opened.reflection(factor(1j * sweep.coarse)))
        label = name if size.max() < 1.0 else f"{name}: grows where there is no line"
        style = {"color": COLOURS[number % SOLID], "linestyle": ("-", (0, (5, 2)))[number // SOLID % 2]}
        ax.loglog(sweep.coarse, np.where(size < 1.0, 1.0 - size, np.nan), linewidth=1.2, label=label, **style)
    ax.set(xlabel="frequency [rad/s]", ylabel="1 - |echo R|", xlim=(1.0, None), ylim=(LEAST_TAKEN, 1.0))
    dress(ax, "share a wave loses per round trip, under each change to survive")


def _draw_motion(design: Design, ax: Axes, sigma: float, name: str) -> None:
    """Displacement over time."""
    for side, style in _sides(design):
        y = at_sigma(side.trial.run, sigma)
        ax.plot(y["time"].values, y.values, linewidth=1.4, **style)
    dress(ax, f"displacement of the {name}", xlabel="time [s]", ylabel="y [m]")


def _sides(design: Design) -> list[tuple[Evaluation, dict[str, Any]]]:
    """Both sides with the look of their curves."""
    return [
        (design.before, {"color": COLOURS[1], "label": "before"}),
        (design.after, {"color": COLOURS[0], "label": "after"}),
    ]

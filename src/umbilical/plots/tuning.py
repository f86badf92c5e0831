"""What a search over gains found, as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, dress, new_figure
from umbilical.quantities import METRICS
from umbilical.studies.tune import tuning_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.studies.study import Objective
    from umbilical.studies.tune import Tuned

_DECADE = 10.0


def plot_tuning(found: Tuned, *, ax: Axes | None = None) -> Axes:
    """Trials that keep every condition: over both objectives with the front, numbered as its files are; of a single
    objective one after the other.

    Raises:
        ValueError: no trial keeps every condition.
    """
    if not found.front:
        raise ValueError(f"{found.study.name}: no trial keeps every condition")
    ax = ax or new_figure(6.4, 4.4).add_subplot()
    objectives = tuning_of(found.study).objectives
    sound = [(k, t.verdict.values) for k, t in enumerate(found.trials, start=1) if t.verdict.broken == 0.0]
    points = np.array([values if len(objectives) == 2 else (number, *values) for number, values in sound])
    places = {values: number for number, values in reversed(sound)}
    front = [trial.verdict.values for trial in found.front]
    best = np.array([values if len(objectives) == 2 else (places[values], *values) for values in front])
    ax.scatter(*points.T, s=16, color=QUIET, label=f"{len(points)} of {len(found.trials)} trials keep every condition")
    ax.plot(*best.T, "o-", color=COLOURS[1], label="no other trial beats these")
    for number, point in enumerate(best, start=1):
        aside = (4, 4) if number % 2 else (-4, -11)  # above and below by turns: neighbours stand close
        ax.annotate(str(number), point, xytext=aside, textcoords="offset points", fontsize=8)
    words = [label_of(objective) for objective in objectives]
    ax.set(**dict(zip(("xlabel", "ylabel"), words if len(words) == 2 else ("trial", *words), strict=True)))
    for axis, values in (("x", points[:, 0]), ("y", points[:, 1])):
        if values.min() > 0.0 and values.max() > _DECADE * values.min() and (axis == "y" or len(words) == 2):
            ax.set(**{f"{axis}scale": "log"})
    legend = {"frameon": True, "framealpha": 0.9, "edgecolor": "none", "loc": "best"}
    return dress(ax, f"{found.study.name}: {', '.join(found.conditions)}", legend)


def label_of(objective: Objective) -> str:
    """An objective in words, with its unit."""
    return f"{objective} [{METRICS[objective.metric].unit}]"

"""Errors over the size of what was refined, beside the stated slope."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, dress, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.analysis.convergence import Curve

COLUMNS = 3
MARKERS = "osD^vP"


def plot_convergence(curves: Sequence[Curve]) -> Figure:
    """One panel for each case, on logarithmic axes: errors, and in grey the slope that is stated.

    A curve's name is ``case: what``; curves of one case and one kind of refinement share a panel.
    """
    panels: dict[tuple[str, str], list[Curve]] = {}
    for curve in curves:
        panels.setdefault((curve.name.partition(": ")[0], curve.size), []).append(curve)
    rows = -(-len(panels) // COLUMNS)
    figure = new_figure(4.2 * COLUMNS, 3.2 * max(rows, 1))
    for number, ((case, size), members) in enumerate(panels.items(), start=1):
        _panel(figure.add_subplot(rows, COLUMNS, number), case, size, members)
    return figure


def _panel(ax: Axes, case: str, size: str, members: Sequence[Curve]) -> None:
    """Errors, and the stated order through the finest of them."""
    for k, curve in enumerate(members):
        sizes, name = np.array(curve.sizes), f"{curve.name.partition(': ')[2]}: {curve.order:g}"
        ax.loglog(sizes, curve.errors, MARKERS[k % 6] + "-", color=COLOURS[k % 6], markersize=4, label=name)
        ax.loglog(sizes, curve.errors[-1] * (sizes / sizes[-1]) ** curve.order, ":", color=QUIET, linewidth=0.9)
    ax.set_xticks(members[0].sizes, [f"{value:.3g}" for value in members[0].sizes])
    ax.set_xticks([], minor=True)
    ax.yaxis.set_minor_formatter("")
    low, high = np.log10(ax.get_ylim())
    decades = (10.0 ** np.floor(low), 10.0 ** np.ceil(high))  # whole ones: no axis with a single number on it
    legend = {"title": "stated order of", "title_fontsize": 8}
    xlabel = f"{size.removeprefix('the ').replace(', ', ' [')}]"
    dress(ax, case, legend, xlabel=xlabel, ylabel="error, SI units", ylim=decades)

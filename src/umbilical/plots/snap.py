"""The largest tensions of seeds of a sea."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import gumbel_r

from umbilical.plots.figure import COLOURS, QUIET, dress, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.studies.snap import SnapStudy


def plot_snaps(found: SnapStudy) -> Axes:
    """Share of the runs that exceed a tension, with the Gumbel distribution, its interval at 1 % and the rule of thumb.

    Raises:
        ValueError: no run completed.
    """
    if not found.completed.any():
        raise ValueError(f"{found.scenario.name}: no run completed, there is nothing to draw")
    ax = new_figure(8.0, 4.5).add_subplot()
    tension, snapped = found.largest_tension[found.completed] / 1e3, found.snaps[found.completed] > 0
    order = np.argsort(tension)[::-1]
    share = (np.arange(tension.size) + 0.56) / (tension.size + 0.12)  # Gringorten's places, for a Gumbel distribution
    for chosen, colour, name in ((snapped, COLOURS[1], "with a snap"), (~snapped, COLOURS[0], "without a snap")):
        here = chosen[order]
        if here.any():
            ax.plot(tension[order][here], share[here], "o", color=colour, label=f"largest tension of a run {name}")
    if (fit := found.extreme) is not None:
        x = np.linspace(tension.min(), max(tension.max(), fit.exceeded.high / 1e3), 200)
        ax.plot(x, gumbel_r.sf(1e3 * x, fit.location, fit.scale), color="black", linewidth=1.2, label="Gumbel")
        ends = np.array([[fit.exceeded.value - fit.exceeded.low], [fit.exceeded.high - fit.exceeded.value]]) / 1e3
        bar = {"color": "black", "capsize": 4, "label": "95 % at one in a hundred"}
        ax.errorbar(fit.exceeded.value / 1e3, 0.01, xerr=ends, **bar)
    ax.axvline(found.static_tension / 1e3, color=QUIET, linewidth=1.0, label="static, at the vessel")
    ax.axvline(found.rule_of_thumb / 1e3, color=QUIET, linestyle="--", linewidth=1.0, label=r"static + $v\sqrt{KM}$")
    title = f"{found.scenario.name}: {tension.size} seeds of {found.scenario.duration:g} s"
    ax.set(xlabel="largest tension of a run [kN]", ylabel="share of the runs that exceed it", yscale="log")
    return dress(ax, title, ylim=(5e-3, 1.2))

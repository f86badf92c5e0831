"""Where the adaptive law helps, where it harms, and what a box changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import Picture, along, weights

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ADAPTATION = {
    "without": "blind, dead, without",
    "with": "blind, dead, with",
    "fast": "blind, dead, fast",
    "boxed": "blind, dead, boxed",
}
"""Arms of the figure on the adaptive law, by the experiments that show them."""
LARGEST_KAPPA = 5.0
"""rad2/(N s2), ten times the exact value: beyond, the loop has gone."""


def adaptation(runs: Runs) -> xarray.Dataset:
    """The ROV and kappa_0 without the disturbance observer, motor 2 dead."""
    chosen = [runs[name] for name in ADAPTATION.values()]
    size = {"units": "m", "symbol": "|y(l,t)|", "long_name": "size of the ROV's displacement"}
    tips = [abs(run["tip_displacement"]).assign_attrs(size) for run in chosen]
    gains = [weights(run)["kappa_0"] for run in chosen]
    arms = list(ADAPTATION)
    return xarray.Dataset({"tip_size": along(tips, "arm", arms), "kappa_0": along(gains, "arm", arms)})


def draw_adaptation(data: xarray.Dataset) -> Figure:
    """``tip_size`` and ``kappa_0`` over ``arm`` and ``time``; an arm ends where its run diverged."""
    figure, panels = style.column(2, 1.6)
    for number, (ax, name) in enumerate(zip(panels, ("tip_size", "kappa_0"), strict=True)):
        for arm in data["arm"].values:
            values = data[name].sel(arm=arm).dropna("time")
            style.line(ax, values, str(arm))
            if values.sizes["time"] < data.sizes["time"]:
                ax.plot(
                    values["time"][-1],
                    min(float(values[-1]), LARGEST_KAPPA),
                    "x",
                    color=style.LOOKS[arm].colour,
                    ms=4,
                    clip_on=False,
                )
        style.panel(ax, f"{style.letter(number)} {data[name].attrs['long_name']}", style.unit_label(data[name]))
    panels[0].set_yscale("log")
    panels[0].set_ylim(bottom=1e-3)
    style.log_axis(panels[0].yaxis)
    panels[1].set_ylim(0.0, LARGEST_KAPPA)
    style.time_panels(panels, data)
    style.legend(figure, 2)
    return figure


PICTURE = Picture(
    "adaptation",
    "Where adaptation helps and harms",
    "Motor 2 dead, no disturbance observer. The adaptive law helps; ten times faster it runs away (the line "
    "ends); in "
    "a box it does not.",
    draw_adaptation,
    tuple(ADAPTATION.values()),
    adaptation,
    "blind, dead, with",
)

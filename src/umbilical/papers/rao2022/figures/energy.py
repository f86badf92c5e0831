"""The power balance: energy, and the work of everything that acts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import xarray

from umbilical import Run
from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, Picture, abreast, by_controller
from umbilical.papers.rao2022.figures.style import LOOKS, TYPE, Look, Panel, over_time
from umbilical.plots.figure import COLOURS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NEGLIGIBLE = 0.02
"""Share of the largest work below which a line would lie on zero."""
WORK_DASHES = ((), (4, 1.5), (1, 1), (6, 1.5, 1, 1.5))


def _data(runs: Runs) -> xarray.Dataset:
    """Energy, the work of everything that acts, and what the balance leaves open, for three controllers."""
    channels = [str(name) for name in runs["pd"].data.data_vars if str(name).startswith("work_")]

    def work(run: Run) -> xarray.DataArray:
        return abreast({name.removeprefix("work_").replace("_", " "): run[name] for name in channels}, "source")

    words = {"units": "J", "symbol": "", "long_name": "work since the start"}
    residual = [runs[name].metrics["energy_balance_residual"] for name in CONTROLLERS.values()]
    about = {"units": "1", "long_name": "what the balance leaves open", "symbol": ""}
    return xarray.Dataset(
        {
            "energy": by_controller(runs, lambda run: run["energy"]),
            "work": by_controller(runs, work).assign_attrs(words),
            "residual": ("controller", residual, about),
        }
    )


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    """Where energy came from and went; sources whose work shows for at least one controller."""
    sizes = abs(data["work"]).max("time")
    large = (sizes / sizes.max("source")).max("controller") > NEGLIGIBLE
    for who in data["controller"].values:
        one = data.sel(controller=who)
        work = one["work"].assign_attrs(one["energy"].attrs)
        works = [
            (work.sel(source=source), Look(str(source), COLOURS[k], WORK_DASHES[k % len(WORK_DASHES)]))
            for k, source in enumerate(data["source"].values[large.values])
        ]
        energy = one["energy"], Look("energy", COLOURS[6], width=0.7)
        yield Panel(LOOKS[str(who)].text, [*works, energy])


def _draw(data: xarray.Dataset) -> Figure:
    figure = over_time(_panels, 1.35, 4)(data)
    for ax in figure.axes:
        ax.ticklabel_format(axis="y", style="sci", scilimits=(-3, 4), useMathText=True)
        ax.yaxis.get_offset_text().set_fontsize(TYPE - 1)
    return figure


PICTURE = Picture(
    "energy",
    "Power balance",
    "Energy of cable and ROV, and the work on it since the start. What the balance leaves open is in the data.",
    "C2",
    _draw,
    tuple(CONTROLLERS.values()),
    _data,
)

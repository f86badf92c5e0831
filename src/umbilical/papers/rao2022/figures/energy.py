"""The power balance: energy, and the work of everything that acts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures import style
from umbilical.papers.rao2022.figures.picture import CONTROLLERS, THREE, Picture, along
from umbilical.plots.figure import COLOURS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INK = COLOURS[6]
NEGLIGIBLE = 0.02
"""Share of the largest work below which a line would lie on zero."""
WORK_DASHES = ((), (4, 1.5), (1, 1), (6, 1.5, 1, 1.5))


def balance(runs: Runs) -> xarray.Dataset:
    """Energy and the work of everything that acts, for three controllers."""
    channels = [str(name) for name in runs["pd"].data.data_vars if str(name).startswith("work_")]
    names = [name.removeprefix("work_").replace("_", " ") for name in channels]
    works = [along([runs[n][channel] for channel in channels], "source", names) for n in CONTROLLERS.values()]
    words = {"units": "J", "symbol": "", "long_name": "work since the start"}
    residual = [runs[n].metrics["energy_balance_residual"] for n in CONTROLLERS.values()]
    who = list(CONTROLLERS)
    return xarray.Dataset(
        {
            "energy": along([runs[n]["energy"] for n in CONTROLLERS.values()], "controller", who),
            "work": along(works, "controller", who).assign_attrs(words),
            "residual": (
                "controller",
                residual,
                {"units": "1", "long_name": "what the balance leaves open", "symbol": ""},
            ),
        }
    )


def draw_energy(data: xarray.Dataset) -> Figure:
    """``energy`` and ``work`` over ``controller``, ``source`` and ``time``: where energy came from and went."""
    figure, panels = style.column(data.sizes["controller"], 1.35)
    for number, (ax, who) in enumerate(zip(panels, data["controller"].values, strict=True)):
        one = data.sel(controller=who)
        for k, source in enumerate(_large(data["work"])):
            (drawn,) = ax.plot(one["time"], one["work"].sel(source=source), color=COLOURS[k], linewidth=1.0)
            drawn.set_label(str(source))
            if WORK_DASHES[k % len(WORK_DASHES)]:
                drawn.set_dashes(WORK_DASHES[k % len(WORK_DASHES)])
        ax.plot(one["time"], one["energy"], color=INK, linewidth=0.7, label="energy")
        style.panel(ax, f"{style.letter(number)} {style.LOOKS[str(who)].text}", style.unit_label(data["energy"]))
        ax.ticklabel_format(axis="y", style="sci", scilimits=(-3, 4), useMathText=True)
        ax.yaxis.get_offset_text().set_fontsize(style.TYPE - 1)
    style.time_panels(panels, data)
    style.legend(figure, 4)
    return figure


def _large(work: xarray.DataArray) -> list[str]:
    """Sources whose work shows for at least one controller."""
    sizes = abs(work).max("time")
    shares = (sizes / sizes.max("source")).max("controller")
    return [str(name) for name in work["source"].values if float(shares.sel(source=name)) > NEGLIGIBLE]


PICTURE = Picture(
    "energy",
    "Power balance",
    "Energy of cable and ROV, and the work on it since the start. What the balance leaves open is in the data.",
    draw_energy,
    THREE,
    balance,
)

"""Beyond the paper: the whole cable over time, its power balance, the Lyapunov function, the weights kappa."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.papers.rao2022.drawing.style import (
    LOOKS,
    TYPE,
    column,
    legend,
    letter,
    line,
    log_axis,
    mark_fault,
    panel,
    time_panels,
    unit_label,
)
from umbilical.plots.figure import COLOURS

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK = COLOURS[6]
ROWS = 500
"""Of pixels along the cable, more than a panel has."""
NEGLIGIBLE = 0.02
"""Share of the largest work below which a line would lie on zero."""
WORK_DASHES = ((), (4, 1.5), (1, 1), (6, 1.5, 1, 1.5))


def draw_spacetime(data: xarray.Dataset) -> Figure:
    """``displacement`` over ``controller``, ``time`` and ``sigma``; the coloured region ends where the cable ends."""
    y = data["displacement"]
    figure, panels = column(y.sizes["controller"], 1.45)
    for number, (ax, who) in enumerate(zip(panels, y["controller"].values, strict=True)):
        _cable(figure, ax, y.sel(controller=who), data["length"])
        panel(ax, f"{letter(number)} {LOOKS[str(who)].text}", "$x$ [m]")
        ax.grid(visible=False)
    time_panels(panels, data)
    return figure


def _cable(figure: Figure, ax: Axes, y: xarray.DataArray, length: xarray.DataArray) -> None:
    """One map with its own colours; a power of ten stands in the label, so that all bars are alike."""
    times, longest = y["time"].values, float(length.max())
    x = np.linspace(0.0, longest, ROWS)
    ends = zip(length.values, y.values, strict=True)
    values = np.array([np.interp(x, y["sigma"].values * end, row, right=np.nan) for end, row in ends])
    size = float(np.abs(y.values).max())
    power = 3 * int(np.floor(np.log10(size) / 3.0))
    look = {"cmap": "RdBu_r", "vmin": -size / 10.0**power, "vmax": size / 10.0**power, "aspect": "auto"}
    picture = ax.imshow(values.T / 10.0**power, extent=(times[0], times[-1], longest, 0.0), **look)
    bar = figure.colorbar(picture, ax=ax, pad=0.02)
    unit = unit_label(y)
    bar.set_label(unit.replace("[", f"[$10^{{{power}}}$ ") if power else unit, fontsize=TYPE)
    bar.ax.tick_params(labelsize=TYPE - 1, length=2, pad=2)


def draw_energy(data: xarray.Dataset) -> Figure:
    """``energy`` and ``work`` over ``controller``, ``source`` and ``time``: where energy came from and went."""
    figure, panels = column(data.sizes["controller"], 1.35)
    for number, (ax, who) in enumerate(zip(panels, data["controller"].values, strict=True)):
        one = data.sel(controller=who)
        for k, source in enumerate(_large(data["work"])):
            (drawn,) = ax.plot(one["time"], one["work"].sel(source=source), color=COLOURS[k], linewidth=1.0)
            drawn.set_label(str(source))
            if WORK_DASHES[k % len(WORK_DASHES)]:
                drawn.set_dashes(WORK_DASHES[k % len(WORK_DASHES)])
        ax.plot(one["time"], one["energy"], color=INK, linewidth=0.7, label="energy")
        panel(ax, f"{letter(number)} {LOOKS[str(who)].text}", unit_label(data["energy"]))
        ax.ticklabel_format(axis="y", style="sci", scilimits=(-3, 4), useMathText=True)
        ax.yaxis.get_offset_text().set_fontsize(TYPE - 1)
    time_panels(panels, data)
    legend(figure, 4)
    return figure


def _large(work: xarray.DataArray) -> list[str]:
    """Sources whose work shows for at least one controller."""
    sizes = abs(work).max("time")
    shares = (sizes / sizes.max("source")).max("controller")
    return [str(name) for name in work["source"].values if float(shares.sel(source=name)) > NEGLIGIBLE]


def draw_lyapunov(data: xarray.Dataset) -> Figure:
    """``lyapunov`` over ``case``, ``part`` and ``time``, on a logarithmic axis; V_2 changes sign, its size is drawn."""
    values = data["lyapunov"]
    figure, panels = column(values.sizes["case"], 1.5)
    for number, (ax, case) in enumerate(zip(panels, values["case"].values, strict=True)):
        ax.plot(values["time"], values.sel(case=case, part="V"), color=COLOURS[5], linewidth=3.0, label="$V$")
        for who, part in (("proposed", "V_1"), ("load", "V_2"), ("pd", "V_3")):
            line(ax, abs(values.sel(case=case, part=part)), who, f"$|{part}|$" if part == "V_2" else f"${part}$")
        panel(ax, f"{letter(number)} {case}", unit_label(values))
        ax.set_yscale("log")
        ax.set_ylim(1e-9, 2.0 * float(values.max()))
        log_axis(ax.yaxis)
    time_panels(panels, data, marked=False)
    mark_fault(panels[-1], float(data.attrs["fault_time"]))
    legend(figure, 5)
    return figure


def draw_kappa(data: xarray.Dataset) -> Figure:
    """``kappa_0`` and ``kappa_sum`` over ``case`` and ``time``, each with its ``ideal``, after the fault."""
    names = ("kappa_0", "kappa_sum")
    figure, panels = column(len(names) * data.sizes["case"], 0.95)
    places = [(case, name) for case in data["case"].values for name in names]
    for number, (ax, (case, name)) in enumerate(zip(panels, places, strict=True)):
        line(ax, data[name].sel(case=case), "with", "adapted")
        line(ax, data[f"{name}_ideal"].sel(case=case), "ideal", "ideal")
        panel(ax, f"{letter(number)} motor {data.attrs['fault_motor']} {case}", unit_label(data[name]))
    time_panels(panels, data)
    legend(figure)
    return figure

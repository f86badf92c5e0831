"""In which sea an operation is possible: limits over depth and period, and the risk of lowering over winch speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, as_figure, dress, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.screening.lower import Lowering
    from umbilical.screening.operate import Operability

BELOW: dict[str, Any] = {"ncols": 4, "loc": "upper center", "bbox_to_anchor": (0.5, -0.14)}
LEVELS = np.array([0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0])
"""Limiting Hs at which contours are drawn, m."""


def plot_operability(found: Operability, *, ax: Axes | None = None) -> Figure | Axes:
    """Limiting Hs of the worst heading: a map over depth and period, or over depth for a single period.

    A line marks the depths whose axial period is the sea's peak period.

    Args:
        found: from :func:`umbilical.operate`.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import numpy as np
    >>> import umbilical
    >>> depth, period = np.array([500.0, 1500.0, 3000.0]), np.array([8.0])
    >>> found = umbilical.operate(umbilical.load_operation("work-class"), ["slack=1e-2/3h"],
    ...                           depth=depth, period=period, heading=np.radians([135.0]))
    >>> umbilical.plot_operability(found).get_figure().savefig("limits.png")
    """
    given, ax = ax, ax or new_figure(8.0, 5.0).add_subplot()
    draw = _map if min(found.depth.size, found.period.size) > 1 else _lines
    draw(found, ax, f"{found.operation.name}: largest Hs that keeps {', '.join(map(str, found.criteria))}")
    return given or as_figure(ax)


def _map(found: Operability, ax: Axes, title: str) -> None:
    worst = found.limit.min(axis=2)
    style = {"cmap": "YlGnBu_r", "vmin": 0.0, "vmax": LEVELS[-1], "shading": "gouraud"}
    drawn = ax.pcolormesh(found.period, found.depth, worst, **style)
    lines = ax.contour(found.period, found.depth, worst, LEVELS, colors="black", linewidths=0.8)
    ax.clabel(lines, fmt="%g m", fontsize=8)
    ax.plot(found.axial_period, found.depth, color=COLOURS[1], linewidth=1.8, label="Tp equals the axial period T1")
    if found.steepest.any():
        hatched = {"colors": "none", "hatches": ["///"], "levels": [0.5, 1.5]}
        ax.contourf(found.period, found.depth, found.steepest.astype(float), **hatched)
        ax.fill([], [], facecolor="none", edgecolor="black", hatch="///", label="no limit below the steepest sea")
    as_figure(ax).colorbar(drawn, ax=ax, label="limiting Hs, worst heading [m]", extend="max")
    ends: dict[str, Any] = {"xlim": np.sort(found.period)[[0, -1]], "ylim": np.sort(found.depth)[[-1, 0]]}
    dress(ax, title, BELOW, xlabel="peak period Tp [s]", ylabel="cable paid out [m]", **ends)
    ax.grid(visible=False)


def _lines(found: Operability, ax: Axes, title: str) -> None:
    """One line for each heading, over whichever axis has more than one value."""
    deep = found.depth.size >= found.period.size
    x = found.depth if deep else found.period
    for number, heading in enumerate(found.heading):
        y = found.limit[:, 0, number] if deep else found.limit[0, :, number]
        ax.plot(
            x, y, color=COLOURS[number % len(COLOURS)], linestyle=("-", "--", ":")[number // len(COLOURS) % 3],
            marker="o" if x.size < 20 else None, markersize=3, label=f"{np.degrees(heading):.0f} deg",
        )  # fmt: skip
    fixed = f"Tp {found.period[0]:g} s" if deep else f"{found.depth[0]:g} m"
    ax.set(xlabel="cable paid out [m]" if deep else "peak period Tp [s]", ylabel=f"limiting Hs at {fixed} [m]")
    dress(ax, title, BELOW | {"title": "waves go towards (180: head sea)"}, ylim=(0.0, None))


def plot_lowering(found: Lowering) -> Figure:
    """Risk of slack over winch speed, and over depth how often the cable would go slack at three of the speeds.

    Args:
        found: from :func:`umbilical.lower`.

    >>> import numpy as np
    >>> import umbilical
    >>> from umbilical.sea import Spectrum
    >>> work = umbilical.load_operation("work-class")
    >>> depth, speed = np.linspace(100.0, 3000.0, 8), np.array([0.5, 1.0, 3.0])
    >>> found = umbilical.lower(work, Spectrum(1.5, 8.0), heading=np.radians(135.0), depth=depth, speed=speed)
    >>> umbilical.plot_lowering(found).savefig("lowering.png")
    """
    figure = new_figure(10.0, 4.5)
    left, right = figure.subplots(1, 2)
    left.semilogy(found.speed, np.maximum(found.risk, 1e-12), color=COLOURS[0], marker="o", markersize=3)
    left.axvline(found.speed[found.best], color=QUIET, linestyle="--", linewidth=1.0)
    left.annotate(f"best: {found.speed[found.best]:.3g} m/s", (found.speed[found.best], 1.0), xytext=(4, -2),
                  textcoords="offset points", va="top", fontsize=8, xycoords=("data", "axes fraction"))  # fmt: skip
    dress(
        left,
        xlabel="winch speed [m/s]",
        ylabel="probability of slack in the descent",
        ylim=(max(1e-8, 0.1 * float(found.risk.min())), 2.0),
    )
    chosen = dict.fromkeys((0, found.best, found.speed.size - 1))
    for number, row in enumerate(chosen):
        right.semilogx(found.slack_rate[row] * 3600.0, found.depth, color=COLOURS[number],
                       linestyle=("-", "--", "-.")[number], label=f"{found.speed[row]:.3g} m/s")  # fmt: skip
    if found.resonant.any():
        band = found.depth[found.resonant]
        right.axhspan(band[0], band[-1], color=COLOURS[4], alpha=0.2, label="resonant with Tp")
    most = max(3600.0 * float(found.slack_rate.max()), 1e-7)
    shown: dict[str, Any] = {"xlim": (1e-9, 10.0 * most), "ylim": (found.depth.max(), found.depth.min())}
    dress(right, "", BELOW, xlabel="expected slack events per hour", ylabel="cable paid out [m]", **shown)
    sea = found.spectrum
    waves = f"Hs {sea.significant_height:g} m, Tp {sea.peak_period:g} s, waves towards"
    title = f"{found.operation.name}: lowering in {waves} {np.degrees(found.heading):.0f} deg"
    figure.suptitle(title, fontsize=12)
    return figure

"""What all pictures share: axes, colours, labels from the data, marks of events, files."""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from umbilical import files
from umbilical.errors import OutputError, expect
from umbilical.plant.exogenous import named_jumps

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.run import Run

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Okabe and Ito's: told apart by everyone. Lines that belong together differ in dashes, too."""
QUIET = "#808080"
MANY_JUMPS = 20
"""More marks than this would hide the curves."""
WORDS_WIDTH = 0.3
"""Share of the time axis that the name of an event takes at most."""
UPRIGHT_WIDTH = 0.035
"""Share of the time axis that an upright name takes."""
MOST_TURNS, BAND = 300, 400
"""A signal that turns more often is drawn as a band, lowest and highest value in each of so many columns."""
_PAPER = {"facecolor": "white", "edgecolor": "none", "alpha": 0.6, "pad": 0.5}
PLAIN_POWERS = (-4, 5)
"""Powers of ten between which ticks are written out."""
CLOCKS: dict[str, dict[str, None]] = {"png": {"Software": None}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}
"""Kinds of picture, and what each must not say about when and with what it was made."""
ABOVE: dict[str, Any] = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.2}
"""Where a legend stands above the axes, on the right."""
ONE_ROW = 4
"""Names in one row of a legend; it stands above the axes, where no curve is."""


_Drawn = TypeVar("_Drawn", "Axes", "Figure")


def axes_for(run: Run, ax: Axes | None) -> Axes:
    """The axes given, or those of a new figure.

    Raises:
        ValueError: the run ended before there was anything to draw.
    """
    check_drawable(run)
    if ax is not None:
        return ax
    return _shown_in_notebooks(new_figure(8.0, 4.0).add_subplot())


def check_drawable(run: Run) -> None:
    """Refuse a run of which there is no curve.

    Raises:
        ValueError: the run ended before there was anything to draw.
    """
    expect(run, "Run", "open_run")
    if run["time"].size < 2:
        raise ValueError(f"{run.name}: the run ended before there was anything to draw")


def new_figure(width: float, height: float) -> Figure:
    """A figure that pyplot does not know of; inches."""
    from matplotlib.figure import Figure

    return _shown_in_notebooks(Figure(figsize=(width, height), layout="constrained"))


def _shown_in_notebooks(drawn: _Drawn) -> _Drawn:
    """Let a notebook show the picture, which it does by itself only for figures that pyplot knows of."""
    drawn.__dict__["_repr_png_"] = lambda: render(as_figure(drawn), "png", dpi=100)
    return drawn


def as_figure(drawn: Axes | Figure) -> Figure:
    """The figure of what a ``plot_*`` returned."""
    from matplotlib.figure import Figure

    if isinstance(drawn, Figure):
        return drawn
    figure = drawn.get_figure(root=True)
    assert figure is not None
    return figure


def render(figure: Figure, kind: str, *, dpi: int = 150) -> bytes:
    """A figure as ``png``, ``pdf`` or ``svg``: fonts inside, no clock, so that equal figures give equal bytes.

    An SVG has no background: it lies on whatever page it is put on.
    """
    from matplotlib import rc_context

    picture = io.BytesIO()
    with rc_context({"svg.hashsalt": "umbilical", "pdf.fonttype": 42}):
        figure.savefig(picture, format=kind, dpi=dpi, metadata=CLOCKS[kind], transparent=kind == "svg")
    return picture.getvalue()


def save_figure(figure: Figure, path: str | os.PathLike[str], *, force: bool = False) -> Path:
    """Store a figure as ``.png``, ``.pdf`` or ``.svg``; whole or not at all.

    Raises:
        OutputError: another ending, or the file cannot be written.
    """
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in CLOCKS:
        raise OutputError(f"{path}: a picture's name must end with {', '.join('.' + k for k in CLOCKS)}")
    return files.write(path, render(figure, kind), force=force)


def axis_label(array: xarray.DataArray) -> str:
    """Symbol and unit of a channel, for an axis."""
    symbol, unit = (array.attrs.get(name, "") for name in ("symbol", "units"))
    parts = [f"${symbol}$" if symbol else "", f"[{unit}]" if unit not in ("", "1") else ""]
    return " ".join(part for part in parts if part)


def draw_channel(
    ax: Axes, array: xarray.DataArray, label: str = "", colour: int = 0, dashed: bool = False, width: float = 1.4
) -> None:
    """One channel of time as a line, or as a band where it turns too often for a line.

    A dashed line lies on top, so that both show where they agree; of a dashed band only the outline does.
    """
    time, values, paint = array["time"].values, array.values, COLOURS[colour % len(COLOURS)]
    if turns(values).size > MOST_TURNS:
        edges = np.linspace(0, time.size - 1, BAND + 1).astype(int)[:-1]
        low, high = np.minimum.reduceat(values, edges), np.maximum.reduceat(values, edges)
        look = {"facecolor": "none" if dashed else paint, "edgecolor": paint, "linewidth": 0.5}
        ax.fill_between(time[edges], low, high, step="post", alpha=0.6, label=label or None, **look)
        return
    (line,) = ax.plot(time, values, color=paint, linewidth=width)
    if label:
        line.set_label(label)
    if dashed:
        line.set(linestyle=(0, (4, 3)), linewidth=1.2, zorder=3)


def turns(values: np.ndarray) -> np.ndarray:
    """Where a signal turns round, as places among its samples."""
    steps = np.flatnonzero(np.diff(values))
    rising = np.diff(values)[steps] > 0.0
    return steps[1:][rising[1:] != rising[:-1]]


def remark(ax: Axes, text: str) -> None:
    """A remark inside the axes, below on the left."""
    if text:
        ax.text(0.01, 0.02, text, transform=ax.transAxes, fontsize=8, color="#404040", bbox=_PAPER)


def dress(ax: Axes, title: str = "", legend: dict[str, Any] | None = None, **labels: Any) -> Axes:
    """Title, grid, no frame above and on the right, and a legend where something is named.

    ``labels`` are properties of the axes, as ``Axes.set`` takes them; ``legend`` changes the legend.
    """
    ax.set_title(title, fontsize=9.5, loc="left")
    ax.set(**labels)
    ax.grid(alpha=0.25, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    if ax.get_legend_handles_labels()[1]:
        ax.legend(**{"fontsize": 8, "frameon": False} | (legend or {}))
    return ax


def finish(ax: Axes, run: Run, title: str, ylabel: str) -> Axes:
    """Axes over the time of a run, dressed, with the marks of events."""
    mark_events(ax, run)
    ax.ticklabel_format(axis="y", style="sci", scilimits=PLAIN_POWERS, useMathText=True)
    ax.margins(x=0.0)
    names = len(ax.get_legend_handles_labels()[1])
    legend = ABOVE | {"ncols": names if names <= ONE_ROW else -(-names // 2), "borderpad": 0.1, "columnspacing": 1.0}
    xlabel = f"{run['time'].attrs['long_name']} [{run['time'].attrs['units']}]"
    return dress(ax, title, legend | {"handlelength": 1.5}, xlabel=xlabel, ylabel=ylabel)


def mark_events(ax: Axes, run: Run) -> None:
    """Dashed lines where faults begin and end, dotted ones where anything else jumps, all of them named."""
    last = float(ax.dataLim.x1)  # of what is shown
    named = fault_words(run)
    others = {t: text for t, text in named_jumps(run.scenario).items() if 0.0 < t < last and t not in named}
    if len(others) <= MANY_JUMPS:
        _mark_jumps(ax, others, last)
    for t, text in named.items():
        if t < last:
            ax.axvline(t, color=QUIET, linewidth=1.0, linestyle="--")
            _name(ax, t, text, (3, -2 - 10 * _lines_before(t, named, WORDS_WIDTH * last)), va="top")


def _mark_jumps(ax: Axes, jumps: dict[float, tuple[str, ...]], last: float) -> None:
    """Named upright along their lines; of those close together only the first."""
    free = 0.0
    for t, text in jumps.items():
        ax.axvline(t, color=QUIET, linewidth=0.8, linestyle=":")
        if t >= free:
            _name(ax, t, ", ".join(text), (2, -2), va="top", rotation=90)
            free = t + UPRIGHT_WIDTH * last


def _name(ax: Axes, t: float, text: str, offset: tuple[float, float], **how: Any) -> None:
    style: dict[str, Any] = {"fontsize": 8, "color": "#404040", "bbox": _PAPER, "textcoords": "offset points"}
    ax.annotate(text, (t, 1.0), xycoords=("data", "axes fraction"), xytext=offset, **style, **how)


def _lines_before(t: float, named: dict[float, str], near: float) -> int:
    """Lines of the names that begin shortly before, and that this one must stand below."""
    return sum(text.count("\n") + 1 for other, text in named.items() if t - near < other < t)


def fault_words(run: Run) -> dict[float, str]:
    """What happens to the motors, by instant, s."""
    text: dict[float, list[str]] = {}
    for fault in run.scenario.faults:
        text.setdefault(fault.start, []).append(f"motor {fault.motor}: {fault.kind}")
        if fault.end is not None:
            text.setdefault(fault.end, []).append(f"motor {fault.motor}: healthy")
    return {t: "\n".join(text[t]) for t in sorted(text)}


def at_sigma(run: Run, sigma: float) -> xarray.DataArray:
    """Displacement at a share of the length, between nodes along a straight line, over time."""
    nodes = run["sigma"].values
    right = int(np.clip(np.searchsorted(nodes, sigma), 1, nodes.size - 1))
    share = (sigma - nodes[right - 1]) / (nodes[right] - nodes[right - 1])
    y = run["displacement"]
    return (1.0 - share) * y.isel(sigma=right - 1) + share * y.isel(sigma=right)

"""Panels over channels of a run: the ROV, the winch, the motors, the observers, the energy; and pages of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.analysis.comparison import distinct_names
from umbilical.errors import expect
from umbilical.plots.cable import plot_cable, plot_positions
from umbilical.plots.figure import (
    COLOURS,
    QUIET,
    axes_for,
    axis_label,
    check_drawable,
    draw_channel,
    finish,
    new_figure,
    remark,
)
from umbilical.plots.rope import plot_tensions
from umbilical.run import Run

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Panel = Callable[..., object]
SHOWN_MOTORS = 4
"""Motors with a panel of their own; a page has an end."""
NAMED = 6
"""Motors with a name in the legend; there are no more colours to tell them apart."""
NEAR = 4.0
"""A limit further from the curves, as a multiple of their largest value, is not drawn."""
MISSED = 1.05
"""Peak over the largest stored value from which it is told that samples miss it."""
NEGLIGIBLE = 1e-3
"""Works smaller than this share of the largest are left out: their lines would lie on zero."""
FAST, SHOWN_TURNS = 80, 20
"""Of a signal that changes sides more often than the first, so many changes are shown."""
ESTIMATES = {
    name: f"{name}_estimate" for name in ("tip_velocity", "tip_slope_rate", "disturbance", "motor_disturbance")
}
"""Truths and the estimates of them."""


def plot_tip(run: Run | Sequence[Run], *, names: Sequence[str] = (), ax: Axes | None = None) -> Axes:
    """Displacement of the ROV over time, m; of several runs one line each, named by ``names`` or each by its own.

    Args:
        run: one result or several.
        names: a name for each of several.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_tip([run, run], names=["one", "the same"]).get_ylabel()
    '$x_1$ [m]'
    """
    runs: list[Any] = [*run] if isinstance(run, list | tuple) else [run]
    if not runs:
        raise ValueError("there is no run to draw")
    ax = axes_for(runs[0], ax)
    labels = list(names) or (list(distinct_names(runs)) if len(runs) > 1 else [""])
    for number, (one, label) in enumerate(zip(runs, labels, strict=True)):
        draw_channel(ax, one["tip_displacement"], label, number)
    y = runs[0]["tip_displacement"]
    return finish(ax, runs[0], y.attrs["long_name"], axis_label(y))


def _plot_thrust(run: Run, *, ax: Axes) -> Axes:
    draw_channel(ax, run["thrust"], "delivered")
    draw_channel(ax, run["thrust_command"], "commanded", colour=1, dashed=True)
    return finish(ax, run, "thrust", axis_label(run["thrust"]))


def plot_winch(run: Run, *, ax: Axes | None = None) -> Axes:
    """Length of the cable (left, m) and winch speed (right, m/s; positive pays out) over time.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_winch(run).get_ylabel()
    '$l$ [m]'
    """
    ax = axes_for(run, ax)
    draw_channel(ax, run["length"], "length")
    ax.plot([], [], color=COLOURS[1], linestyle="--", label="speed, right")
    beside = ax.twinx()
    draw_channel(beside, run["payout_speed"], colour=1, dashed=True)
    beside.set_ylabel(axis_label(run["payout_speed"]))
    beside.spines[["top"]].set_visible(False)
    return finish(ax, run, "winch", axis_label(run["length"]))


def plot_motors(run: Run, channel: str = "motor_speed", *, ax: Axes | None = None) -> Axes:
    """One channel of every motor over time: ``motor_speed`` (with its reference), ``motor_voltage``, ``motor_current``.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        channel: which, of every motor.
        ax: axes to draw into; those of a figure of its own if left out.

    Raises:
        ValueError: the run has no motors, or no such channel of them.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_motors(run, "motor_voltage").get_ylabel()
    '$U$ [V]'
    """
    expect(run, "Run", "open_run")
    if channel not in run.data or "motor" not in run[channel].dims or not run.data.sizes["motor"]:
        raise ValueError(f"{run.name}: this run has no {channel} of motors")
    ax = axes_for(run, ax)
    numbers = run["motor"].values
    for place, number in enumerate(numbers):  # each thinner than those below it, which so remain to be seen
        width = 1.2 + 1.4 * (numbers.size - 1 - place) / (numbers.size - 1) if numbers.size > 1 else 1.4
        draw_channel(
            ax, run[channel].isel(motor=place), f"motor {number}" if number <= NAMED else "", place, width=width
        )
    if channel == "motor_speed" and run["speed_reference"].any():
        for place in range(numbers.size):
            draw_channel(
                ax, run["speed_reference"].isel(motor=place), "" if place else "reference", colour=6, dashed=True
            )
    if channel == "motor_voltage":
        _draw_limits(ax, run)
    remark(ax, _between_samples(run, channel))
    title = "motor voltage, as commanded" if channel == "motor_voltage" else run[channel].attrs["long_name"]
    return finish(ax, run, title, axis_label(run[channel]))


def _draw_limits(ax: Axes, run: Run) -> None:
    """Voltage limits that are near what was asked for; far ones, which would flatten the curves, in words."""
    limits = sorted({motor.voltage_limit for motor in run.scenario.motors if motor.voltage_limit is not None})
    largest = float(abs(run["motor_voltage"]).max())
    near = [limit for limit in limits if limit <= NEAR * largest]
    for limit in near:
        for level, label in ((limit, f"limit {limit:g} V"), (-limit, None)):
            ax.axhline(level, color=QUIET, linewidth=1.0, linestyle="-.", label=label)
    if far := [f"{limit:g} V" for limit in limits if limit not in near]:
        ax.text(0.99, 0.02, f"limit {', '.join(far)}", transform=ax.transAxes, ha="right", fontsize=8, color="#404040")


def _between_samples(run: Run, channel: str) -> str:
    """What the stored samples miss of a fast signal."""
    peak, seen = run.metrics.get(f"{channel}_peak", 0.0), float(abs(run[channel]).max())
    if peak <= MISSED * seen:
        return ""
    unit, interval = run[channel].attrs["units"], run.scenario.output.interval
    return f"peak {peak:.3g} {unit}, between samples, which are stored every {interval:g} s"


def _plot_allocation(run: Run, *, ax: Axes) -> Axes:
    """Weights kappa of the adaptive allocation over time.

    kappa_0 (per N) and the others (rad2/s2) have different units, so every one is divided by its largest size.
    """
    for place, number in enumerate(run["kappa_index"].values):
        values = run["kappa"].isel(kappa_index=place)
        size = float(abs(values).max())
        draw_channel(ax, values / (size or 1.0), rf"$\kappa_{number}$ / {size:.3g}", colour=place, dashed=place > 1)
    return finish(ax, run, "adaptive allocation", "")


def plot_observers(run: Run, channel: str = "disturbance", *, motor: int = 1, ax: Axes | None = None) -> Axes:
    """A truth and its estimate over time; ``channel`` is a key of ``ESTIMATES``, ``motor`` counts from 1.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        channel: the truth that was estimated.
        motor: of a motor's channel, which, from 1.
        ax: axes to draw into; those of a figure of its own if left out.

    Raises:
        ValueError: nothing of that name was estimated in this run, or there is no such motor.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_observers(run).get_ylabel()
    '$D$ [N]'
    """
    expect(run, "Run", "open_run")
    known = _estimated(run)
    if channel not in known:
        there = ", ".join(known) or "nothing"
        raise ValueError(f"{run.name}: {channel} was not estimated; estimated: {there}")
    truth, estimate = run[channel], run[ESTIMATES[channel]]
    title = truth.attrs["long_name"].partition(":")[0]
    if "motor" in truth.dims:
        if motor not in truth["motor"].values:
            raise ValueError(f"{run.name}: there is no motor {motor}")
        truth, estimate, title = truth.sel(motor=motor), estimate.sel(motor=motor), f"{title}, motor {motor}"
    ax = axes_for(run, ax)
    shown = _first_turns(truth)
    if shown < truth.sizes["time"]:
        truth, estimate = truth.isel(time=slice(shown)), estimate.isel(time=slice(shown))
        title = f"{title}: the first {float(truth['time'][-1]):.3g} s"
    draw_channel(ax, truth, "truth")
    draw_channel(ax, estimate, "estimate", colour=1, dashed=True)
    return finish(ax, run, title, axis_label(truth))


def _first_turns(truth: xarray.DataArray) -> int:
    """Samples that are shown: of a fast signal so many that its estimate can be told from it."""
    values = truth.values
    aside = values - 0.5 * (values.max() + values.min())
    far = np.flatnonzero(np.abs(aside) > 0.1 * np.abs(aside).max())  # a ripple on a slow curve does not count
    crossings = far[1:][np.diff(aside[far] > 0.0)]
    return int(crossings[SHOWN_TURNS]) + 1 if crossings.size > FAST else values.size


def plot_energy(run: Run, *, ax: Axes | None = None) -> Axes:
    """Energy of cable and ROV over time, and every work on it since the start that is not negligible, J.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.
        ax: axes to draw into; those of a figure of its own if left out.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_energy(run).get_ylabel()
    '$E$ [J]'
    """
    ax = axes_for(run, ax)
    draw_channel(ax, run["energy"], "energy", colour=6, dashed=True)
    sizes = {name: float(abs(run[name]).max()) for name in map(str, run.data.data_vars) if name.startswith("work_")}
    large = [name for name, size in sizes.items() if size > NEGLIGIBLE * max(sizes.values())]
    for number, name in enumerate(large):
        draw_channel(ax, run[name], name.removeprefix("work_").replace("_", " "), colour=number % 6, dashed=number >= 6)
    residual = run.metrics.get("energy_balance_residual", float("nan"))
    return finish(ax, run, f"energy and work done on it; balance within {residual:.1e}", axis_label(run["energy"]))


def plot_overview(run: Run) -> Figure:
    """Everything worth a first look on one page; what the run does not have gets no panel.

    Args:
        run: a result, from :func:`umbilical.simulate` or :func:`umbilical.open_run`.

    Raises:
        ValueError: the run ended before there was anything to draw.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper", {"duration": 0.5}))
    >>> umbilical.plot_overview(run).savefig("run.png")
    """
    check_drawable(run)
    driven, known = _moved(run, "motor_voltage"), _estimated(run)
    wanted: list[tuple[Panel, bool]] = [
        (plot_tip, True),
        (plot_cable, True),
        (plot_positions, True),
        (plot_winch, _moved(run, "payout_speed")),
        (plot_tensions, "position" in run.data),
        (_plot_thrust, _moved(run, "thrust")),
        *((partial(plot_motors, channel=name), driven) for name in ("motor_speed", "motor_voltage")),
        *((partial(plot_observers, channel=name), name in known) for name in ("tip_velocity", "disturbance")),
        (_plot_allocation, "kappa" in run.data and bool((run["kappa"] != run["kappa"].isel(time=0)).any())),
    ]
    panels = [panel for panel, there in wanted if there]
    head = [panels.pop(panels.index(plot_cable))] if len(panels) % 2 else []
    pairs = [panels[k : k + 2] for k in range(0, len(panels), 2)]
    return _page(run, [[panel] for panel in head] + pairs + [[plot_energy]])


def plot_all_motors(run: Run) -> Figure:
    """Speeds, voltages and currents, one above the other.

    Raises:
        ValueError: the run has no motors.
    """
    channels = ("motor_speed", "motor_voltage", "motor_current")
    return _page(run, [[partial(plot_motors, channel=name)] for name in channels])


def plot_all_observers(run: Run) -> Figure:
    """Every estimate on top of its truth, one above the other.

    Raises:
        ValueError: nothing was estimated.
    """
    names = _estimated(run)
    if not names:
        raise ValueError(f"{run.name}: nothing was estimated in this run")
    panels = [partial(plot_observers, channel=name) for name in names if name != "motor_disturbance"]
    numbers = run["motor"].values[:SHOWN_MOTORS] if "motor_disturbance" in names else ()
    panels += [partial(plot_observers, channel="motor_disturbance", motor=k) for k in numbers]
    return _page(run, [[panel] for panel in panels])


def _estimated(run: Run) -> list[str]:
    """Truths that an observer of this run estimated; one that never left zero was not running."""
    return [truth for truth, estimate in ESTIMATES.items() if _moved(run, estimate)]


def _moved(run: Run, channel: str) -> bool:
    """Whether a channel is there and ever left zero."""
    return channel in run.data and bool(run[channel].any())


def _page(run: Run, rows: Sequence[Sequence[Panel]]) -> Figure:
    """Rows of panels, each row as wide as the page."""
    widest = max(map(len, rows))
    figure = new_figure(12.0 if widest > 1 else 9.0, 2.7 * len(rows) + 0.5)
    grid = figure.add_gridspec(len(rows), widest)
    for number, row in enumerate(rows):
        for column, panel in enumerate(row):
            panel(run, ax=figure.add_subplot(grid[number, column] if len(row) > 1 else grid[number, :]))
    figure.suptitle(f"{run.name}: {run.status.name.lower()} at t = {run.end_time:.6g} s", fontsize=12)
    return figure

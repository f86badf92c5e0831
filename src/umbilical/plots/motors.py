"""The motors: speeds, voltages, currents, and the weights of the adaptive allocation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.plots.figure import axes_for, axis_label, draw, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run

NAMED = 6
"""Motors with a name in the legend; there are no more colours to tell them apart."""


def plot_motors(run: Run, channel: str = "motor_speed", *, ax: Axes | None = None) -> Axes:
    """One channel of every motor over time: ``motor_speed`` (with its reference), ``motor_voltage``, ``motor_current``.

    Raises:
        ValueError: the run has no motors, or no such channel of them.
    """
    if channel not in run.data or "motor" not in run[channel].dims or not run.data.sizes["motor"]:
        raise ValueError(f"{run.scenario.name}: this run has no {channel} of motors")
    ax = axes_for(run, ax)
    for place, number in enumerate(run["motor"].values):
        draw(ax, run[channel].isel(motor=place), f"motor {number}" if number <= NAMED else "", colour=place)
    if channel == "motor_speed" and run["speed_reference"].any():
        for place in range(run.data.sizes["motor"]):
            draw(ax, run["speed_reference"].isel(motor=place), "" if place else "reference", colour=6, dashed=True)
    return finish(ax, run, run[channel].attrs["long_name"], axis_label(run[channel]))


def plot_allocation(run: Run, *, ax: Axes | None = None) -> Axes:
    """Weights kappa of the adaptive allocation over time.

    kappa_0 (per N) and the others (rad2/s2) have different units, so every one is divided by its largest size.

    Raises:
        ValueError: nothing was adapted in this run.
    """
    if "kappa" not in run.data or not adapted(run):
        raise ValueError(f"{run.scenario.name}: nothing was adapted in this run")
    ax = axes_for(run, ax)
    for place, number in enumerate(run["kappa_index"].values):
        values = run["kappa"].isel(kappa_index=place)
        size = float(abs(values).max())
        draw(ax, values / (size or 1.0), rf"$\kappa_{number}$ / {size:.3g}", colour=place, dashed=place > 1)
    return finish(ax, run, "adaptive allocation", "")


def adapted(run: Run) -> bool:
    """Whether any weight of the allocation moved."""
    return "kappa" in run.data and bool((run["kappa"] != run["kappa"].isel(time=0)).any())

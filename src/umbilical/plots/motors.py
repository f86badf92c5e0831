"""The motors: speeds, voltages, currents, and the weights of the adaptive allocation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.errors import expect
from umbilical.plots.figure import QUIET, axes_for, axis_label, draw, finish, note

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run

NAMED = 6
"""Motors with a name in the legend; there are no more colours to tell them apart."""
NEAR = 4.0
"""A limit further from the curves, as a multiple of their largest value, is not drawn."""
MISSED = 1.05
"""Peak over the largest stored value from which it is told that samples miss it."""


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
        raise ValueError(f"{run.scenario.name}: this run has no {channel} of motors")
    ax = axes_for(run, ax)
    numbers = run["motor"].values
    for place, number in enumerate(numbers):  # each thinner than those below it, which so remain to be seen
        width = 1.2 + 1.4 * (numbers.size - 1 - place) / max(numbers.size - 1, 1) if numbers.size > 1 else 1.4
        draw(ax, run[channel].isel(motor=place), f"motor {number}" if number <= NAMED else "", place, width=width)
    if channel == "motor_speed" and run["speed_reference"].any():
        for place in range(numbers.size):
            draw(ax, run["speed_reference"].isel(motor=place), "" if place else "reference", colour=6, dashed=True)
    if channel == "motor_voltage":
        _draw_limits(ax, run)
    note(ax, _between_samples(run, channel))
    title = "motor voltage, as commanded" if channel == "motor_voltage" else run[channel].attrs["long_name"]
    return finish(ax, run, title, axis_label(run[channel]))


def _draw_limits(ax: Axes, run: Run) -> None:
    """Voltage limits that are near what was asked for; far ones, which would flatten the curves, in words."""
    limits = sorted({motor.voltage_limit for motor in run.scenario.motors if motor.voltage_limit is not None})
    largest = float(abs(run["motor_voltage"]).max())
    near = [limit for limit in limits if limit <= NEAR * largest]
    for limit in near:
        for level, label in ((limit, f"limit {limit:g} V"), (-limit, "")):
            ax.axhline(level, color=QUIET, linewidth=1.0, linestyle="-.", label=label or None)
    if far := [f"{limit:g} V" for limit in limits if limit not in near]:
        ax.text(0.99, 0.02, f"limit {', '.join(far)}", transform=ax.transAxes, ha="right", fontsize=8, color="#404040")


def _between_samples(run: Run, channel: str) -> str:
    """What the stored samples miss of a fast signal."""
    peak, seen = run.metrics.get(f"{channel}_peak", 0.0), float(abs(run[channel]).max())
    if peak <= MISSED * seen:
        return ""
    unit, interval = run[channel].attrs["units"], run.scenario.output.interval
    return f"peak {peak:.3g} {unit}, between samples, which are stored every {interval:g} s"


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

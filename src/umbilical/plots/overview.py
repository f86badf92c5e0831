"""Several panels on one page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from umbilical.plots.cable import plot_cable, plot_positions
from umbilical.plots.energy import plot_energy
from umbilical.plots.figure import check_drawable, new_figure
from umbilical.plots.motors import adapted, plot_allocation, plot_motors
from umbilical.plots.observers import estimated, plot_observers
from umbilical.plots.rope import plot_tensions
from umbilical.plots.tip import plot_thrust, plot_tip
from umbilical.plots.winch import moves, plot_winch

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from umbilical.run import Run

Panel = Callable[..., object]
SHOWN_MOTORS = 4
"""Motors with a panel of their own; a page has an end."""


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
    motors = driven(run)
    panels: list[Panel] = [plot_tip, plot_cable, plot_positions]
    panels += [plot_winch] if moves(run) else []
    panels += [plot_tensions] if "position" in run.data else []
    panels += [plot_thrust] if bool(run["thrust"].any()) else []
    panels += [partial(plot_motors, channel=name) for name in ("motor_speed", "motor_voltage") if motors]
    panels += [
        partial(plot_observers, channel=name) for name in ("tip_velocity", "disturbance") if name in estimated(run)
    ]
    panels += [plot_allocation] if adapted(run) else []
    head = [panels.pop(panels.index(plot_cable))] if len(panels) % 2 else []
    return page(run, [[panel] for panel in head] + pairs(panels) + [[plot_energy]])


def plot_all_motors(run: Run) -> Figure:
    """Speeds, voltages and currents, one above the other.

    Raises:
        ValueError: the run has no motors.
    """
    channels = ("motor_speed", "motor_voltage", "motor_current")
    return page(run, [[partial(plot_motors, channel=name)] for name in channels])


def plot_all_observers(run: Run) -> Figure:
    """Every estimate on top of its truth, one above the other.

    Raises:
        ValueError: nothing was estimated.
    """
    names = estimated(run)
    if not names:
        raise ValueError(f"{run.scenario.name}: nothing was estimated in this run")
    panels = [partial(plot_observers, channel=name) for name in names if name != "motor_disturbance"]
    numbers = run["motor"].values[:SHOWN_MOTORS] if "motor_disturbance" in names else ()
    panels += [partial(plot_observers, channel="motor_disturbance", motor=k) for k in numbers]
    return page(run, [[panel] for panel in panels])


def driven(run: Run) -> bool:
    """Whether the run has motors that somebody drove."""
    return "motor_voltage" in run.data and bool(run["motor_voltage"].any())


def pairs(panels: Sequence[Panel]) -> list[list[Panel]]:
    """Panels two by two."""
    return [list(panels[k : k + 2]) for k in range(0, len(panels), 2)]


def page(run: Run, rows: Sequence[Sequence[Panel]]) -> Figure:
    """Rows of panels, each row as wide as the page."""
    figure = new_figure(12.0 if max(map(len, rows)) > 1 else 9.0, 2.7 * len(rows) + 0.5)
    grid = figure.add_gridspec(len(rows), max(map(len, rows)))
    for number, row in enumerate(rows):
        for column, panel in enumerate(row):
            panel(run, ax=figure.add_subplot(grid[number, column] if len(row) > 1 else grid[number, :]))
    figure.suptitle(f"{run.scenario.name}: {run.status.name.lower()} at t = {run.end_time:.6g} s", fontsize=12)
    return figure

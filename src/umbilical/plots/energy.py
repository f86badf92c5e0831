"""The power balance: where the energy came from and where it went."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.plots.figure import axes_for, axis_label, draw, finish

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from umbilical.run import Run


NEGLIGIBLE = 1e-3
"""Works smaller than this share of the largest are left out: their lines would lie on zero."""


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
    draw(ax, run["energy"], "energy", colour=6, dashed=True)
    for number, name in enumerate(large_works(run)):
        draw(ax, run[name], name.removeprefix("work_").replace("_", " "), colour=number % 6, dashed=number >= 6)
    residual = run.metrics.get("energy_balance_residual", float("nan"))
    title = f"energy and work done on it, closing to {residual:.1e}"
    return finish(ax, run, title, axis_label(run["energy"]))


def large_works(run: Run) -> list[str]:
    """Names of the works that would show."""
    sizes = {
        str(name): float(abs(run[str(name)]).max()) for name in run.data.data_vars if str(name).startswith("work_")
    }
    return [name for name, size in sizes.items() if size > NEGLIGIBLE * max(sizes.values())]

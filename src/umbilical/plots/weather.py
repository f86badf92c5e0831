"""Sea states of a place against what an operation can work in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from umbilical.plots.figure import COLOURS, QUIET, dress, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from umbilical.screening.weather import Weather


def plot_weather(found: Weather) -> Figure:
    """Seas over period and height with the limit; of a hindcast, how long its windows are, too.

    Args:
        found: from :func:`umbilical.screening.weather`.

    >>> import numpy as np
    >>> import umbilical
    >>> from umbilical.screening import Seas, weather
    >>> seas = Seas(np.array([1.0, 3.0]), np.array([8.0, 9.0]), np.array([0.7, 0.3]), None)
    >>> found = weather(umbilical.load_operation("work-class"), ["slack=1e-2/3h"], seas,
    ...                 depth=np.array([1500.0]), heading=np.radians([135.0]))
    >>> umbilical.plot_weather(found).savefig("weather.png")
    """
    timed = found.seas.time is not None
    figure = new_figure(10.0 if timed else 6.0, 4.5)
    axes = np.atleast_1d(figure.subplots(1, 2 if timed else 1))
    left, good = axes[0], found.workable
    size = np.clip(4000.0 * found.seas.weight, 4.0, 60.0)
    for mask, colour, name in ((good, COLOURS[0], "workable"), (~good, COLOURS[1], "not workable")):
        left.scatter(found.seas.period[mask], found.seas.height[mask], s=size[mask], color=colour, alpha=0.5,
                     linewidths=0.0, label=name)  # fmt: skip
    left.plot(found.found.period, found.found.limit.min(axis=(0, 2)), color="black", linewidth=1.5, label="limit")
    dress(left, xlabel="peak period Tp [s]", ylabel="significant wave height Hs [m]", ylim=(0.0, None))
    if timed:
        right, hours = axes[1], np.sort(found.windows)[::-1] / 3600.0
        right.step(hours, np.arange(1, hours.size + 1), color=COLOURS[0], where="post", marker="o", markersize=3)
        right.axvline(found.needed / 3600.0, color=QUIET, linestyle="--", linewidth=1.0, label="needed")
        shown = {"xscale": "log", "ylim": (0.0, None)}
        dress(right, xlabel="length of a window [h]", ylabel="windows that last as long", **shown)
    figure.suptitle(f"{found.found.operation.name}: {found.share:.1%} of the sea states are workable", fontsize=12)
    return figure

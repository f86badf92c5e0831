"""What the linearised loop is worth: reflection over frequency, and the opened loop with its margins."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.patches import Circle

from umbilical.plots.figure import COLOURS, QUIET, as_figure, dress, new_figure
from umbilical.stability.sampled import loop_response

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from umbilical.stability.judgement import Judgement
    from umbilical.stability.margins import MarginReport

FREQUENCY = "frequency [rad/s]"
LOWEST = 1e-2
"""rad/s; nothing happens below."""
SHOWN_LOOP = 3.0
"""Largest |L| in the Nyquist picture, where a margin is read."""
DRAWN_MODES = 12
"""Modes up to which L is drawn itself; above, a band says where it is with the echo in any phase."""
PER_MODE = 2_000
"""Points of the curve for each mode, which are narrow."""
CIRCLES, STRAIGHT = 60, 4.0
"""How many, and from which radius on they pass the picture as straight lines."""


def plot_margins(report: MarginReport) -> Figure:
    """Reflection, size and angle of the opened loop, and its Nyquist curve near 1; a colour for each length.

    Args:
        report: from :func:`umbilical.margins`.

    >>> import umbilical
    >>> report = umbilical.margins(umbilical.load("paper"), [450.0])
    >>> umbilical.plot_margins(report).savefig("margins.png")
    """
    figure = new_figure(11.0, 8.0)
    places = figure.subplots(2, 2)
    _draw_reflection(report, ax=places[0, 0])
    _draw_nyquist(report, ax=places[0, 1])
    _draw_bode(report, (places[1, 0], places[1, 1]))
    state = "unresolved" if report.resolved is False else "stable" if report.stable else "not stable"
    figure.suptitle(f"{report.name}: {state}, motors at {report.operating_thrust:.4g} N", fontsize=12)
    return figure


def _draw_reflection(report: MarginReport, *, ax: Axes) -> None:
    """|R| of the controlled ROV; above 1/|echo| it feeds the waves more than the cable takes."""
    for number, j in enumerate(report.judgements):
        ax.semilogx(j.frequency, j.reflection, color=COLOURS[number], linewidth=1.4, label=f"{j.length:g} m")
    shortest = min(report.judgements, key=lambda j: j.length)
    taken = 1.0 / shortest.sweep.loudest
    ax.semilogx(shortest.sweep.coarse, taken, color=QUIET, linestyle=":", label="limit: above it waves grow")
    gains = report.scenario.control.law.boundary_gains
    if gains and not report.controller:
        speed = shortest.sweep.cable.tip_wave_speed
        ideal = abs(speed - gains[1]) / (speed + gains[1])
        ax.axhline(ideal, color=QUIET, linestyle="--", linewidth=1.0, label="ideal law")
    dress(ax, "wave thrown back by the ROV over the wave that arrives, |R|", xlabel=FREQUENCY, xlim=(LOWEST, None))


def _draw_nyquist(report: MarginReport, *, ax: Axes) -> None:
    """L in the complex plane near 1, where the closed loop has a pole on the unit circle, at the length where it comes
    closest: a circle for each frequency, since the echo has any phase, and an arrow where the circles are nearest to 1.
    """
    closest = min(report.judgements, key=lambda j: float(_distances(j).min()))
    colours = ScalarMappable(LogNorm(*closest.sweep.coarse[[_first_mode(closest), -1]]), "viridis")
    for w, centre, radius in _circles(closest):
        place, paint = (float(centre.real), float(centre.imag)), colours.to_rgba(np.array([w]))[0]
        ax.add_patch(Circle(place, radius, fill=False, edgecolor=paint, linewidth=0.7, alpha=0.8))
    bar = as_figure(ax).colorbar(colours, ax=ax, label="frequency [rad/s]", pad=0.02)
    bar.ax.tick_params(labelsize=8)
    circle = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 200))
    ax.plot(np.real(circle), np.imag(circle), color=QUIET, linestyle=":", linewidth=1.0)
    ax.plot([1.0], [0.0], "+", color="black", markersize=10)
    _point_at_closest(ax, closest)
    shown: dict[str, Any] = {"xlim": (-SHOWN_LOOP, SHOWN_LOOP), "ylim": (-SHOWN_LOOP, SHOWN_LOOP), "aspect": "equal"}
    title = f"opened loop L near the critical point 1, {closest.length:g} m"
    dress(ax, title, xlabel="real part", ylabel="imaginary part", **shown)


def _point_at_closest(ax: Axes, j: Judgement) -> None:
    """An arrow to the point of all circles that is nearest to 1, with its frequency and distance."""
    distances = _distances(j)
    k = int(distances.argmin())
    centre, radius = (values[k] for values in j.sweep.circles())
    nearest = centre + radius * (1.0 - centre) / (abs(1.0 - centre) or 1.0)
    words = f"{distances[k]:.2g} from 1\nat {j.sweep.coarse[k]:.3g} rad/s"
    box = {"facecolor": "white", "edgecolor": QUIET, "pad": 2.0, "linewidth": 0.5}
    arrow = {"arrowstyle": "->", "color": "black"}
    place = (0.55 * SHOWN_LOOP, -0.7 * SHOWN_LOOP)
    ax.annotate(words, (nearest.real, nearest.imag), place, fontsize=8, bbox=box, arrowprops=arrow, ha="center")


def _distances(j: Judgement) -> np.ndarray:
    """How far from 1 the circle of each frequency is."""
    centre, radius = j.sweep.circles()
    return np.abs(np.abs(centre - 1.0) - radius)


def _draw_bode(report: MarginReport, axes: tuple[Axes, Axes]) -> None:
    """Size and angle of L: bands for the echo in any phase, lines for the first modes and where margins are used up."""
    size, angle = axes
    for number, j in enumerate(report.judgements):
        colour = COLOURS[number]
        centre, radius = j.sweep.circles()
        middle = np.unwrap(np.angle(centre))
        low, high = np.abs(np.abs(centre) - radius), np.abs(centre) + radius
        aside = np.where(radius < np.abs(centre), np.arcsin(np.minimum(1.0, radius / np.abs(centre))), np.pi)
        w, curve = _first_modes(j)
        beside = np.interp(w, j.sweep.coarse, middle)
        beside += np.angle(curve * np.exp(-1j * beside))
        size.fill_between(j.sweep.coarse, low, high, color=colour, alpha=0.2, linewidth=0)
        size.loglog(w, np.abs(curve), color=colour, linewidth=0.7)
        low, high = np.degrees(middle - aside), np.degrees(middle + aside)
        angle.fill_between(j.sweep.coarse, low, high, color=colour, alpha=0.2, linewidth=0)
        angle.semilogx(w, np.degrees(beside), ".", color=colour, markersize=0.8)
        for limit in (j.margins.phase, j.margins.delay) if j.margins else ():
            if np.isfinite(limit.frequency):
                size.axvline(limit.frequency, color=colour, linestyle=":", linewidth=0.9)
    size.axhline(1.0, color=QUIET, linestyle=":", linewidth=1.0)
    labels: dict[str, Any] = {"xlabel": FREQUENCY, "xlim": (LOWEST, None)}
    dress(size, "|L|; band: echo in any phase; dotted: phase and delay margins", ylabel="|L|", **labels)
    dress(angle, "angle of L; band: echo in any phase", ylabel="degrees", **labels)


def _first_modes(j: Judgement) -> tuple[np.ndarray, np.ndarray]:
    """L over the first modes, on frequencies that resolve them."""
    s = j.sweep
    last = min(2.0 * np.pi * DRAWN_MODES / s.cable.round_trip, s.coarse[-1])
    w = np.concatenate([s.coarse[s.coarse < LOWEST], np.linspace(LOWEST, last, PER_MODE * DRAWN_MODES)])
    return w, loop_response(s.cable, s.loop, 1j * w).loop


def _first_mode(j: Judgement) -> int:
    return min(int(np.searchsorted(j.sweep.coarse, 2.0 * np.pi / j.sweep.cable.round_trip)), j.sweep.coarse.size - 2)


def _circles(j: Judgement) -> Iterator[tuple[float, complex, float]]:
    """Frequency, centre and radius of where L is from the first mode on, the echo in any phase.

    Those that pass the picture as straight lines are left out, but for the one nearest to 1.
    """
    centre, radius = j.sweep.circles()
    chosen = np.unique(np.geomspace(_first_mode(j) + 1, centre.size, CIRCLES).astype(int)) - 1
    for k in sorted({*chosen[radius[chosen] < STRAIGHT], int(_distances(j).argmin())}):
        yield float(j.sweep.coarse[k]), complex(centre[k]), float(radius[k])

"""Manufactured solutions of the full problem: tension varying along the cable and in time, l growing and shrinking,
both dampings, the vessel in motion, v, a and a' all at work. Observed orders on four grids, and the error's size.

The solution is that of :mod:`umbilical.verify.references.manufactured`; what drives it enters as any user's load
would, as tables, dense enough to count below the finest grid.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from umbilical.analysis.convergence import Curve
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, each, history_close, order_reached, small
from umbilical.verify.engine import constant, open_loop, sine
from umbilical.verify.orders import DISPLACEMENT_ORDER, TIME_ORDER, TIP_ORDER, VELOCITY_ORDER
from umbilical.verify.references import manufactured as exact
from umbilical.verify.references.manufactured import Sea, StringProblem

UNTIL = 2.0
ALONG, OVER = 1001, 801
"""Points of the tables along the cable, beside those at the nodes, and of those over time."""
ELEMENTS = (4, 8, 16, 32)
STEPS = (4e-3, 2e-3, 1e-3, 5e-4)
FINE_STEPS = (2e-4, 1e-4)
"""Two steps from which the error in time is taken out where the grid is studied."""
DENSITY, DEEPEST = 1025.0, 200.0
AT_SEA = Sea(
    displaced=0.6, added=0.9, normal=4.0, tangential=1.5, body_displaced=12.0, body_added=20.0, body_vertical=15.0,
    body_axial=4.0, body_linear=6.0, body_quadratic=9.0, surface=2.5, shear=8e-3, surge=0.1, heave=0.35,
)  # fmt: skip
"""Every term counts, and the current outruns the cable everywhere: |u_r| u_r is smooth where u_r keeps its sign."""
LESS_DRAG = AT_SEA._replace(normal=0.2, body_linear=3.0, body_quadratic=4.0)
"""For orders: strong drag takes more of the error of a coarse grid than of a fine one, which hides them."""
SIZES = {"growing": 4.0, "shrinking": -4.0}
TERMS_OFF = {
    "all terms": StringProblem(4.0),
    "winch at a steady speed": StringProblem(4.0, steady=True),
    "winch stopped": StringProblem(0.0),
    "vessel still": StringProblem(4.0, vessel=0.0),
    "cable undamped": StringProblem(4.0, damping=0.0),
    "ROV undamped": StringProblem(4.0, tip_damping=0.0),
    "cable without weight": StringProblem(2.0, cable_weight=0.0),
    "lighter in water, growing": StringProblem(4.0, weight=350.0, cable_weight=8.0),
    "lighter in water, shrinking": StringProblem(-4.0, weight=350.0, cable_weight=8.0),
    "at sea, growing": StringProblem(4.0, sea=AT_SEA),
    "at sea, shrinking": StringProblem(-4.0, sea=AT_SEA),
}
TERM_TOLERANCE = 5e-5


class _Answer(NamedTuple):
    """y and Dy/Dt at the nodes at the end; y and D(y_x)/Dt at the ROV over time."""

    sigma: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    tip: np.ndarray
    tip_slope_rate: np.ndarray


def _positions(elements: int) -> np.ndarray:
    """Where the tables have their points: at every node, where the engine reads them, and between."""
    nodes = engine.completed(open_loop(grid__elements=elements, duration=0.01, output__interval=0.01))["sigma"].values
    return np.unique(np.concatenate([nodes, np.linspace(0.0, 1.0, ALONG)]))


def _separated(field: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Profiles and histories whose products add up to a field, shape (instants, places), to round-off."""
    histories, sizes, profiles = np.linalg.svd(field, full_matrices=False)
    for k in np.flatnonzero(sizes > 1e-14 * sizes[0]):
        yield profiles[k] * np.sqrt(sizes[k]), histories[:, k] * np.sqrt(sizes[k])


@cache
def _driven(problem: StringProblem, elements: int) -> Scenario:
    """The scenario, at any step."""
    t, sigma = np.linspace(0.0, UNTIL, OVER), _positions(elements)

    def history(values: np.ndarray) -> list[dict[str, Any]]:
        return [{"kind": "table", "times": t.tolist(), "values": values.tolist()}]

    loads = [
        {"profile": {"shape": "table", "positions": sigma.tolist(), "values": profile.tolist()},
         "signal": history(values)}
        for profile, values in _separated(exact.cable_load(problem, sigma, t[:, None]))
    ]  # fmt: skip
    wet_line_density, sea = problem.cable_weight / problem.gravity, problem.sea
    return open_loop(
        duration=UNTIL, output__interval=0.1, grid__elements=elements, environment__gravity=problem.gravity,
        cable={"line_density": problem.line_density, "wet_line_density": wet_line_density, "damping": problem.damping},
        payload={"mass": problem.mass, "damping": problem.tip_damping, "wet_weight": problem.weight},
        environment__vessel_heave=_from_rest(sea.heave, exact.HEAVING) if sea.heave else None,
        environment__cable_load=loads, environment__payload_force=history(exact.tip_force(problem, t)),
        environment__vessel_motion=_from_rest(problem.vessel, 1.3), winch=_winch(problem),
        initial={"shape": "sine", "amplitude": problem.start, "half_waves": exact.WAVENUMBER / np.pi},
    ).replace(_water(sea))  # fmt: skip


def _from_rest(size: float, frequency: float) -> list[dict[str, Any]]:
    """The terms of ``size (1 - cos w t)``."""
    return [constant(size), sine(-size, frequency, np.pi / 2.0)]


def _water(sea: Sea) -> dict[str, Any]:
    """Sections of a sea, by coefficients that are usual for a cable of this diameter."""
    if sea == Sea():
        return {}
    area, dynamic = sea.displaced / DENSITY, 0.5 * DENSITY
    diameter = float(np.sqrt(4.0 * area / np.pi))
    depths = [-10.0, DEEPEST]
    current = {"depths": depths, "speeds": [sea.surface + sea.shear * depth for depth in depths],
               "variation": [sine(sea.surge, exact.SURGING)]}  # fmt: skip
    return {
        "environment.water": {"density": DENSITY, "current": current},
        "cable.water": {
            "diameter": diameter, "normal_drag": sea.normal / dynamic / diameter,
            "tangential_drag": sea.tangential / dynamic / (np.pi * diameter), "added_mass": sea.added / sea.displaced,
        },
        "payload.water": {
            "added_mass": sea.body_added, "vertical_added_mass": sea.body_vertical, "linear_drag": sea.body_linear,
            "displaced_mass": sea.body_displaced, "quadratic_drag": sea.body_quadratic,
            "vertical_drag": sea.body_axial,
        },
    }  # fmt: skip


def _winch(problem: StringProblem) -> dict[str, Any]:
    law = {"start_length": problem.start_length}
    if problem.steady:
        return law | {"law": "speed", "speed": problem.speed}
    return law | {"law": "cosine", "amplitude": problem.swing, "frequency": problem.frequency}


def _solve(problem: StringProblem, elements: int, step: float) -> _Answer:
    """The engine's answer at the end."""
    run = engine.completed(_driven(problem, elements).replace({"grid.step": step, "control.period": step}))
    along = (run[name].values[-1] for name in ("displacement", "velocity"))
    return _Answer(run["sigma"].values, *along, *(run[name].values for name in ("tip_displacement", "tip_slope_rate")))


def _errors(problem: StringProblem, elements: int) -> tuple[float, float, float]:
    """Root mean squares: of y and Dy/Dt along the cable at the end, of y at the ROV over time; no error in time.

    That is taken out by extrapolation from two steps.
    """
    coarse, fine = (_solve(problem, elements, step) for step in FINE_STEPS)
    power = 2.0**TIME_ORDER
    y, w, tip, rate = ((power * f - c) / (power - 1.0) for c, f in zip(coarse[1:], fine[1:], strict=True))
    without = _Answer(fine.sigma, y, w, tip, rate)
    off_y, off_w, off_tip = _missed(problem, without)
    y_rms, w_rms = (float(np.sqrt(np.trapezoid(off**2, fine.sigma))) for off in (off_y, off_w))
    return y_rms, w_rms, float(np.sqrt(np.mean(off_tip**2)))


def _missed(problem: StringProblem, found: _Answer) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What y, Dy/Dt and y at the ROV are off by."""
    return (
        found.displacement - exact.displacement(problem, found.sigma, UNTIL),
        found.velocity - exact.velocity(problem, found.sigma, UNTIL),
        found.tip - exact.displacement(problem, np.asarray(1.0), np.linspace(0.0, UNTIL, found.tip.size)),
    )


def in_space(problem: StringProblem) -> Iterator[Check]:
    """Orders in the size of an element, on four grids."""
    found = np.array([_errors(problem, n) for n in ELEMENTS])
    sizes = tuple(60.0 / n for n in ELEMENTS)
    stated = {"y": DISPLACEMENT_ORDER, "Dy/Dt": VELOCITY_ORDER, "y(l,t)": TIP_ORDER}
    for row, (name, order) in zip(found.T, stated.items(), strict=True):
        yield order_reached(Curve(name, "the element, m", sizes, tuple(row), order), "stated")
    leading = exact.wave_amplitude(problem, UNTIL) * (exact.WAVENUMBER / ELEMENTS[-1]) ** 5 / (2.0**9 * 120.0)
    what = f"error of Dy/Dt on {ELEMENTS[-1]} elements, over the leading term"
    why = "max |Dy/Dt +- c y_x| (k h)^5/(2^9 5!): what polynomials of degree 4 leave of a wave, at its worst place"
    yield small(what, found[-1, 1] / leading, 3.0, why)


def _in_time(problem: StringProblem) -> Iterator[Check]:
    """Orders in the step, from differences on one grid, where the grid's own error drops out."""
    solutions = [_solve(problem, 8, step) for step in STEPS]
    for place, name in ((1, "y"), (2, "Dy/Dt"), (3, "y(l,t)")):
        changes = tuple(float(np.abs(b[place] - a[place]).max()) for a, b in pairwise(solutions))
        yield order_reached(Curve(f"{name}, change", "the step, s", STEPS[:-1], changes, TIME_ORDER), "stated")
    off = np.abs(_missed(problem, _solve(problem, 32, 1e-3))[0]).max()
    # Rates of p and q are up to 2 rad/s, and the moving domain adds to them.
    leading = 3.0 / 8.0 * 1e-9 * 2.5**4 * UNTIL
    why = "3/8 dt^3 y_tttt t, |y| = 1, were it never to change its sign"
    yield small("error of y at 1 ms on 32 elements, over the leading term", off / leading, 0.3, why)


def _slope_rate(swing: float) -> Iterator[Check]:
    """What an ideal sensor of the slope's rate reads at the ROV: no state, but made from the last element."""
    problem = StringProblem(swing)
    found = _solve(problem, 16, 1e-3).tip_slope_rate
    exact_rate = exact.tip_slope_rate(problem, np.linspace(0.0, UNTIL, found.size))
    why = "a derivative on 16 elements; with the ROV's velocity of the wrong sign it misses by 8e-4"
    yield history_close("D(y_x)/Dt(l,t), 1/s", found, exact_rate, 8e-5, why)


def terms_off() -> Iterator[Check]:
    """All terms at work, then each off in turn: where only the rows without it hold, it is the term that is wrong."""
    for name, problem in TERMS_OFF.items():
        off = max(np.abs(part).max() for part in _missed(problem, _solve(problem, 16, 1e-3)))
        yield small(f"y, Dy/Dt, y(l,t): {name}", off, TERM_TOLERANCE, "ten times what grid and step leave")


REFERENCE = "y = p sin(k sigma) + q cos(k sigma)"
SOURCE = "(6)-(8), loads derived by hand, checked by sympy"
CASES = (
    *(
        Case(f"manufactured solution, l {way}, {what}", REFERENCE, SOURCE, partial(find, StringProblem(swing)))
        for way, swing in SIZES.items()
        for what, find in (("in space", in_space), ("in time", _in_time))
    ),
    *each("manufactured solution, l {}, rate of the slope", REFERENCE, SOURCE, _slope_rate, SIZES),
    Case("manufactured solution, term by term", REFERENCE, SOURCE, terms_off),
)

"""Manufactured solutions of the full problem: tension varying along the cable and in time, l growing and shrinking,
both dampings, the vessel in motion, v, a and a' all at work. Observed orders on four grids, and the error's size.

The solutions are those of :mod:`umbilical.verify.references.manufactured`. What drives the string enters as any user's
load would, as tables, dense enough to count below the finest grid; what drives the rope is added to the engine's rates.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from umbilical.plant.layout import WEIGHTS, positions
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, SteadyCurrent, make_rope, water_of
from umbilical.plant.rope.rates import evaluate_rope
from umbilical.plant.rope.records import make_rope_state
from umbilical.plant.rope.statics import node_positions
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, orders_reached, same_history, small
from umbilical.verify.engine import from_rest, open_loop, sine
from umbilical.verify.references import integrated
from umbilical.verify.references import manufactured as exact
from umbilical.verify.references.manufactured import RopeProblem, Sea, StringProblem
from umbilical.verify.rope import COMPUTED, quintic_winch, waving

CASES, AT_SEA_CASES, ROPE_CASES = Cases(), Cases(), Cases()
STATED = {"y": 6, "Dy/Dt": 5, "y(l,t)": 7}
"""Stated orders in the size of an element (docs/theory.md). At the ROV twice the degree is 8 in theory; on grids that
round-off allows, 7.2 to 8 is seen."""
TIME_ORDER = 3
ROPE_ORDER = 4.75
"""Of the rope's r_x and Dr/Dt on up to 32 elements, where 4.85 is seen and rises: 4.9 on 64, and 5 in theory."""
UNTIL = 2.0
ALONG, OVER = 1001, 801
"""Points of the tables along the cable, beside those at the nodes, and of those over time."""
ELEMENTS = (4, 8, 16, 32)
SIZES = [60.0 / n for n in ELEMENTS]
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
WAYS = {"growing": 4.0, "shrinking": -4.0}
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


def _separated(field: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Profiles and histories whose products add up to a field, shape (instants, places), to round-off."""
    histories, sizes, profiles = np.linalg.svd(field, full_matrices=False)
    for k in np.flatnonzero(sizes > 1e-14 * sizes[0]):
        yield profiles[k] * np.sqrt(sizes[k]), histories[:, k] * np.sqrt(sizes[k])


@cache
def _driven(problem: StringProblem, elements: int) -> Scenario:
    """The scenario, at any step; the tables have points at every node, where the engine reads them, and between."""
    t, sea = np.linspace(0.0, UNTIL, OVER), problem.sea
    sigma = np.unique(np.concatenate([positions(elements), np.linspace(0.0, 1.0, ALONG)]))

    def history(values: np.ndarray) -> list[dict[str, Any]]:
        return [{"kind": "table", "times": t.tolist(), "values": values.tolist()}]

    winch: dict[str, Any] = {"law": "cosine", "amplitude": problem.swing, "frequency": problem.frequency}
    if problem.steady:
        winch = {"law": "speed", "speed": problem.speed}
    return open_loop(
        duration=UNTIL, output__interval=0.1, grid__elements=elements, environment__gravity=problem.gravity,
        cable={"line_density": problem.line_density, "wet_line_density": problem.cable_weight / problem.gravity,
               "damping": problem.damping},
        payload={"mass": problem.mass, "damping": problem.tip_damping, "wet_weight": problem.weight},
        environment__vessel_heave=from_rest(sea.heave, exact.HEAVING) if sea.heave else None,
        environment__cable_load=[
            {"profile": {"shape": "table", "positions": sigma.tolist(), "values": profile.tolist()},
             "signal": history(values)}
            for profile, values in _separated(exact.cable_load(problem, sigma, t[:, None]))
        ],
        environment__payload_force=history(exact.tip_force(problem, t)),
        environment__vessel_motion=from_rest(problem.vessel, 1.3),
        winch=winch | {"start_length": problem.start_length},
        initial={"shape": "sine", "amplitude": problem.start, "half_waves": exact.WAVENUMBER / np.pi},
    ).replace(_water(sea))  # fmt: skip


def _water(sea: Sea) -> dict[str, Any]:
    """Sections of a sea, by coefficients that are usual for a cable of this diameter."""
    if sea == Sea():
        return {}
    dynamic, diameter = 0.5 * DENSITY, float(np.sqrt(4.0 / np.pi * sea.displaced / DENSITY))
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


def _solve(problem: StringProblem, elements: int, step: float) -> list[np.ndarray]:
    """The engine's y and Dy/Dt at the nodes at the end; y and D(y_x)/Dt at the ROV over time."""
    run = engine.finished(_driven(problem, elements).replace({"grid.step": step, "control.period": step}))
    at_the_end = [run[name].values[-1] for name in ("displacement", "velocity")]
    return [*at_the_end, run["tip_displacement"].values, run["tip_slope_rate"].values]


def _missed(problem: StringProblem, elements: int, found: list[np.ndarray]) -> tuple[np.ndarray, ...]:
    """What y, Dy/Dt and y at the ROV are off by."""
    sigma, t = positions(elements), np.linspace(0.0, UNTIL, found[2].size)
    y, w, tip = found[:3]
    return (y - exact.displacement(problem, sigma, UNTIL), w - exact.velocity(problem, sigma, UNTIL),
            tip - exact.displacement(problem, np.ones(()), t))  # fmt: skip


def _errors(problem: StringProblem, elements: int) -> list[float]:
    """Root mean squares: of y and Dy/Dt along the cable at the end, of y at the ROV over time; no error in time.

    That is taken out by extrapolation from two steps.
    """
    power = 2.0**TIME_ORDER
    coarse, fine = (_solve(problem, elements, step) for step in FINE_STEPS)
    without = [(power * f - c) / (power - 1.0) for c, f in zip(coarse, fine, strict=True)]
    *fields, tip = _missed(problem, elements, without)
    along = [float(np.sqrt(np.trapezoid(off**2, positions(elements)))) for off in fields]
    return [*along, float(np.sqrt(np.mean(tip**2)))]


REFERENCE = "y = p sin(k sigma) + q cos(k sigma)"
BY_HAND = (REFERENCE, "(6)-(8), loads derived by hand, checked by sympy", WAYS)


@AT_SEA_CASES.add("manufactured solution, at sea, l {}", REFERENCE, "(A0) of docs/theory.md, loads derived by hand",
                  {way: StringProblem(swing, sea=LESS_DRAG) for way, swing in WAYS.items()})  # fmt: skip
@CASES.add("manufactured solution, l {}, in space", *BY_HAND[:2], {w: StringProblem(s) for w, s in WAYS.items()})
def _in_space(problem: StringProblem) -> Checks:
    """Orders in the size of an element, on four grids."""
    found = np.array([_errors(problem, n) for n in ELEMENTS])
    yield from orders_reached(STATED, "the element, m", SIZES, found)
    leading = exact.wave_amplitude(problem, UNTIL) * (exact.WAVENUMBER / ELEMENTS[-1]) ** 5 / (2.0**9 * 120.0)
    what = f"error of Dy/Dt on {ELEMENTS[-1]} elements, over the leading term"
    why = "max |Dy/Dt +- c y_x| (k h)^5/(2^9 5!): what polynomials of degree 4 leave of a wave, at its worst place"
    yield small(what, found[-1, 1] / leading, 3.0, why)


def _changes(found: list[Any]) -> list[list[float]]:
    """Largest change of each part from one step to the next."""
    return [[float(np.abs(b - a).max()) for a, b in zip(*two, strict=True)] for two in pairwise(found)]


@CASES.add("manufactured solution, l {}, in time", *BY_HAND)
def _in_time(swing: float) -> Checks:
    """Orders in the step, from differences on one grid, where the grid's own error drops out."""
    problem = StringProblem(swing)
    found = _changes([_solve(problem, 8, step) for step in STEPS])
    yield from orders_reached({f"{name}, change": TIME_ORDER for name in STATED}, "the step, s", STEPS[:-1], found)
    off = np.abs(_missed(problem, 32, _solve(problem, 32, 1e-3))[0]).max()
    # Rates of p and q are up to 2 rad/s, and the moving domain adds to them.
    leading = 3.0 / 8.0 * 1e-9 * 2.5**4 * UNTIL
    why = "3/8 dt^3 y_tttt t, |y| = 1, were it never to change its sign"
    yield small("error of y at 1 ms on 32 elements, over the leading term", off / leading, 0.3, why)


@CASES.add("manufactured solution, l {}, rate of the slope", *BY_HAND)
def _slope_rate(swing: float) -> Checks:
    """What an ideal sensor of the slope's rate reads at the ROV: no state, but made from the last element."""
    problem = StringProblem(swing)
    found = _solve(problem, 16, 1e-3)[3]
    wanted = exact.tip_slope_rate(problem, np.linspace(0.0, UNTIL, found.size))
    why = "a derivative on 16 elements; with the ROV's velocity of the wrong sign it misses by 8e-4"
    yield same_history("D(y_x)/Dt(l,t), 1/s", found, wanted, 8e-5, why)


@CASES.add("manufactured solution, term by term", *BY_HAND[:2])
def terms_off() -> Checks:
    """All terms at work, then each off in turn: where only the rows without it hold, it is the term that is wrong."""
    for name, problem in TERMS_OFF.items():
        off = max(np.abs(part).max() for part in _missed(problem, 16, _solve(problem, 16, 1e-3)))
        yield small(f"y, Dy/Dt, y(l,t): {name}", off, 5e-5, "ten times what grid and step leave")


class _DrivenRope:
    """The engine's rates with the loads of the manufactured solution; unknowns are l r_x, W and the body's velocity."""

    def __init__(self, problem: RopeProblem, elements: int) -> None:
        p = problem
        cable = CableData(p.stiffness, p.density, p.weight, p.diameter, p.normal, p.tangential, p.added_mass)
        self.rope = make_rope(cable, BodyData(p.mass, p.body_weight, p.body_added, drag=p.body_drag), elements)
        self.water, self.state = water_of(SteadyCurrent(velocities=(p.current,))), make_rope_state(elements)
        self.problem, self.elements, self.sigma = problem, elements, node_positions(elements).ravel()

    def exact(self, t: float) -> np.ndarray:
        """The solution's unknowns."""
        winch = self.problem.winch(t)
        r, end = self.problem.at(self.sigma, t), self.problem.at(np.ones(1), t)
        parts = np.concatenate([winch[0] * r.x, r.along(*winch[1:])[0]]).reshape(6, 5, self.elements)
        return np.append(np.moveaxis(parts, 0, 1), end.along(*winch[1:])[0])

    def rates(self, t: float, values: np.ndarray) -> np.ndarray:
        """Rates of all unknowns."""
        state, outside, n = self.state, self.state.outside[0], self.elements
        outside.length, outside.payout_speed, _ = self.problem.winch(t)
        top = self.problem.at(np.zeros(1), t)
        outside.vessel_position[:], outside.vessel_speed[:] = top.value[:, 0], top.t[:, 0]
        outside.body_force[:] = exact.body_force(self.problem, t)
        state.now[:], state.body[0] = values[:-3].reshape(state.now.shape), values[-3:]
        evaluate_rope(self.rope, state, outside, np.zeros(0), self.water, 0, False)
        given = exact.acceleration_given(self.problem, self.sigma, t).reshape(3, 5, n)
        state.rate[:, 3 * n :] += np.moveaxis(given, 0, 1).reshape(5, 3 * n)
        return np.append(state.rate, state.body[2])

    def missed(self, until: float) -> tuple[float, float, float]:
        """Root mean squares of what r_x and W are off by, and the largest error of the body's velocity."""
        times, options = np.array([0.0, until]), {"method": "DOP853", "rtol": 1e-10, "atol": 1e-11}
        off = integrated(self.rates, self.exact(0.0), times, **options)[:, -1] - self.exact(until)
        square = np.einsum("j,jie->i", WEIGHTS / (2.0 * self.elements), off[:-3].reshape(5, 6, -1) ** 2)
        slope, velocity = np.sqrt(square.reshape(2, 3).sum(axis=1)).tolist()
        return slope / self.problem.winch(until)[0], velocity, float(np.abs(off[-3:]).max())


@ROPE_CASES.add("rope, manufactured, l {}", "r = a + b sigma + c sin(k sigma) + d cos(k sigma)",
                "derived by hand from docs/rope.md", WAYS)  # fmt: skip
def _rope_in_space(swing: float) -> Checks:
    """Orders in the size of an element, and what is left on the finest grid."""
    found = [_DrivenRope(RopeProblem(swing), elements).missed(1.0) for elements in ELEMENTS]
    names = {f"{name} of the rope": ROPE_ORDER for name in ("r_x", "Dr/Dt")}
    yield from orders_reached(names, "the element, m", SIZES, found)
    why = "half more than was found; a wave of 4.5 m/s on 32 elements"
    yield small("error of Dr/Dt on 32 elements, m/s", found[-1][1], 3.75e-8, why)
    yield small("error of the body's velocity, m/s", found[-1][2], 5e-9, "four times what was found")


@ROPE_CASES.add("rope, order in time", "differences of steps", COMPUTED)
def _rope_in_time() -> Checks:
    """The order in the step, from differences on one grid: paying out, the vessel in motion, in a current, taut."""
    cable, body = CableData(2e4, 2.0, 15.0, 0.04, 1.2), BodyData(40.0, 300.0, 20.0, drag=10.0)
    motion = Motion(quintic_winch(60.0, 61.0, 2.0), waving({0: (0.3, 2.0), 2: (0.1, 2.5)}, 1.0))
    current = SteadyCurrent(velocities=((0.3, -0.4, 0.0),))
    found, steps = [], (8e-3, 4e-3, 2e-3, 1e-3)
    for step in steps:
        model = RopeModel(cable, body, motion, current, elements=4, step=step)
        model.step(2.0)
        found.append([np.array([model.position, model.velocity])])
    yield from orders_reached({"r and Dr/Dt, change": TIME_ORDER}, "the step, s", steps[:-1], _changes(found))

"""What a scenario says to a certificate: constants of the ideal loop, and the winch, slab by slab of time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from umbilical.errors import Problem, ScenarioError
from umbilical.plant import winch as laws
from umbilical.plant.exogenous import variation_of
from umbilical.plant.seaway import heaving
from umbilical.plant.top import top_within
from umbilical.relations.tension import Hanging, hanging, net_gravity, relative_jerk
from umbilical.relations.water import in_water, line_inertia, payload_inertia
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.winch import ConstantLength, Cosine, Winch

SLABS = 48
"""Slabs of time in a run; more where a cosine law turns often."""
SAMPLES = 9
"""Instants looked at in each slab, its ends included."""
_SLABS_PER_TURN, _MOST_SLABS = 12, 600


class Loop(NamedTuple):
    """Constants of cable, ROV and ideal loop, in the paper's letters.

    Attributes:
        rho: line density, kg/m.
        m: mass of the ROV, kg.
        g: gravity, m/s2.
        wet, weight: density of the cable, kg/m, and weight of the ROV, N, in water; None as in air.
        c: damping of the cable, N s/m2.
        beta: slope gain, m/s.
        k_a: boundary damping that is left for the proof, N s/m: all of it, or half when no disturbance observer
            takes the disturbance off the law and the other half must.
        k_s: gain of the disturbance observer, 1/s; None without one.
        vs: its coupling, kg/s.
    """

    rho: float
    m: float
    g: float
    wet: float | None
    weight: float | None
    c: float
    beta: float
    k_a: float
    k_s: float | None
    vs: float

    @property
    def hanging(self) -> Hanging:
        """What hangs on the cable."""
        return hanging(self.m, self.rho, self.g, self.weight, self.wet)

    def over(self, ctx: Any) -> Loop:
        """The same constants as intervals of a context of mpmath, exactly as they are stored."""
        exact: list[Any] = [None if value is None else ctx.mpf(value) for value in self]
        return Loop(*exact)


class Payout(NamedTuple):
    """The winch at sampled instants, arrays (slabs, samples), or over an interval of time: t, l, v, a, g - a and a'."""

    t: Any
    l: Any  # noqa: E741 - the paper's letter
    v: Any
    a: Any
    net: Any
    jerk: Any

    @property
    def relative_jerk(self) -> Any:
        """a'/(g - a), 1/s."""
        return relative_jerk(self.jerk, self.net)


def payout_of(t: Any, winch: Any, gravity: Any) -> Payout:
    """The motion at t of what has a length, a speed, an acceleration and a jerk."""
    net = net_gravity(gravity, winch.acceleration)
    return Payout(t, winch.length, winch.speed, winch.acceleration, net, winch.jerk)


def ideal_constants(scenario: Scenario) -> Loop:
    """Constants of the ideal loop.

    A steady current pushes a ROV with linear damping by a constant force, which is one of its loads; added mass is
    inertia where the winch stands still.

    Raises:
        ScenarioError: the outer law is not the boundary law, or its slope gain is 0; or the water does what no proof
            covers: quadratic drag, a current that changes, added mass or drag along a cable that moves.
    """
    law, observer = scenario.control.law, scenario.control.disturbance_observer
    if not law.boundary_gains:
        reason = "the certificate is about the boundary law, eq. (22)"
        raise ScenarioError([_problem("control.law.kind", f'"{law.kind}"', '"boundary"', reason)], scenario.name)
    damping_gain, slope_gain = law.boundary_gains
    if slope_gain <= 0.0:
        reason = "without the slope u_a says nothing about the waves in the cable; nothing can be certified"
        raise ScenarioError([_problem("control.law.slope_gain", "0 m/s", "above 0 m/s", reason)], scenario.name)
    if problems := list(_not_covered(scenario)):
        raise ScenarioError(problems, scenario.name)
    observes = observer is not None and observer.enabled
    cable, payload, environment = scenario.cable, scenario.payload, scenario.environment
    return Loop(
        rho=line_inertia(cable, payload, environment), m=payload_inertia(payload), g=environment.gravity,
        wet=cable.wet_line_density, weight=payload.wet_weight, c=cable.damping, beta=slope_gain,
        k_a=damping_gain if observes else damping_gain / 2.0, k_s=observer.gain if observer and observes else None,
        vs=observer.coupling if observer is not None else 1.0,
    )  # fmt: skip


def _not_covered(scenario: Scenario) -> Iterator[Problem]:
    """What the water does that the proof says nothing of, by name."""
    found = in_water(scenario.cable, scenario.payload, scenario.environment)
    linear = "the proof takes every damping as linear; drag grows with the square of the speed"
    moves = "the proof has one mass and one tension of a cable that slides; added mass and drag along it are another"
    still, fix = isinstance(scenario.winch, ConstantLength), "take it to 0 for a certificate, and judge it by margins"
    heave, dragged = bool(heaving(scenario.environment)), found.tangential + found.body_axial > 0.0
    moved = found.added + found.body_vertical > 0.0
    current = scenario.environment.water.current if scenario.environment.water else None
    sheared = current is not None and found.body_linear > 0.0 and len({*current.speeds}) > 1
    holds = "V3 holds no distance from a station, and no slope that is washed out"
    law = scenario.control.law
    for key, wrong, reason in (
        ("control.law.station_gain", bool(getattr(law, "station_gain", None)), holds),
        ("control.law.washout_time", bool(getattr(law, "washout_time", None)), holds),
        ("cable.water.normal_drag", found.normal > 0.0, linear),
        ("payload.water.quadratic_drag", found.body_quadratic > 0.0, linear),
        ("environment.water.current.variation", bool(variation_of(scenario.environment)), "a steady current only"),
        ("environment.water.current.speeds", not still and sheared, "a ROV that sinks meets another current"),
        ("environment.vessel_heave", heave, "the tension follows the winch alone"),
        ("cable.water", not still and (moved or dragged), moves),
    ):
        if wrong:
            yield Problem(key, "given", "none of it", reason, fix)


def _problem(key: str, value: str, bound: str, reason: str) -> Problem:
    fix = "the boundary law, as in `umbilical presets --copy paper`: `certify` names a slope_gain if one is proved"
    return Problem(key, value, bound, reason, fix)


def slab_edges(winch: Winch, duration: float) -> np.ndarray:
    """Instants between which rates are constant, s: every jump of the winch, and evenly between them."""
    if isinstance(winch, ConstantLength):
        return np.array([0.0, duration])
    count = SLABS
    if isinstance(winch, Cosine):
        turns = winch.frequency * duration / (2.0 * np.pi)
        count = int(min(max(SLABS, _SLABS_PER_TURN * turns), _MOST_SLABS))
    marks = np.unique(np.clip([0.0, *laws.jumps(winch), duration], 0.0, duration))
    edges = [np.linspace(a, b, max(1, round(count * (b - a) / duration)) + 1)[:-1] for a, b in pairwise(marks)]
    return np.append(np.concatenate(edges), duration)


def sampled(winch: Winch, gravity: float, edges: np.ndarray) -> Payout:
    """The winch at :data:`SAMPLES` instants of each slab; limits at its ends are those from inside."""
    t = np.linspace(edges[:-1], edges[1:], SAMPLES, axis=1)
    return payout_of(t, top_within(winch, t), gravity)


def stopped(motion: Payout, gravity: float) -> Payout:
    """The same cable with the winch stopped at its greatest length; one slab, one sample."""
    zero = np.zeros((1, 1))
    return Payout(zero, np.full((1, 1), motion.l.max()), zero, zero, zero + net_gravity(gravity), zero)

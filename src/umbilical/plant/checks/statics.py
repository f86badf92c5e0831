"""The slope at which the cable comes to rest under loads that last: a model of small angles must allow it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from umbilical.errors import Problem
from umbilical.plant import signals
from umbilical.plant.checks.moving import MovingCable, sampled_top
from umbilical.plant.checks.timeline import shapes, signals_of_the_environment
from umbilical.plant.current import speeds_at
from umbilical.plant.equilibrium import from_below
from umbilical.plant.exogenous import current_at, profile
from umbilical.plant.stretching import stretching
from umbilical.plant.top import top_at
from umbilical.relations.tension import (
    axial_drag_of,
    hanging_of,
    sinking,
    stretched,
    tension,
)
from umbilical.relations.water import in_water, line_inertia
from umbilical.scenario.control import Control
from umbilical.scenario.environment import Environment, InitialShape
from umbilical.scenario.findings import Finding, Notice
from umbilical.scenario.scenario import Scenario

_STEEPEST = 0.3
"""There the offset of a cable in a current is 3 % too large, at 0.5 it is 10 %, at 0.9 27 %."""
_INSTANTS, _POSITIONS = 121, 101


class Steady(NamedTuple):
    """Steepest slope that lasts, where it is (x/l), and whether the run is long enough to get there."""

    slope: float
    sigma: float
    reached: bool


def static_slope(moving: MovingCable, control: Control, initial: InitialShape) -> Iterator[Finding]:
    """The loads that last bend the cable less than a model of small angles allows."""
    environment, duration = moving.environment, moving.duration
    broken = (*signals_of_the_environment(environment, duration), *shapes(environment, initial))
    if broken or not sampled_top(moving.winch, environment, duration) or not _profile_is_sound(environment):
        return
    found = steady_slope(moving, control)
    if not found.slope > _STEEPEST:
        return
    where = f"a static slope of {found.slope:.3g} at x/l = {found.sigma:.2g}, under the loads that last"
    share = _STEEPEST / found.slope
    if found.reached or initial.shape == "equilibrium":  # where it starts
        eased = f"loads below {share:.3g} times these" if environment.cable_load or environment.payload_force else ""
        slower = f"a current below {np.sqrt(share):.3g} times this one" if flows(environment) else ""
        weaker = " and ".join(filter(None, (eased, slower)))
        yield Problem("environment", where, f"at most {_STEEPEST:g}",
                      "the cable comes to rest there, or swings beyond; small angles set it 3 % too far at a slope of "
                      "0.3, 27 % at 0.9, and at 1 a run of the string ends",
                      f'model = "rope", which has no small angles; or {weaker}, or a heavier payload: the slope is '
                      "load over tension")  # fmt: skip
    else:
        words = f"{where}; small angles end at {_STEEPEST:g}, but the run is too short for the cable to come to rest "
        yield Notice("environment", words + "there")


class Statics(NamedTuple):
    """What a string comes to before its first step.

    Attributes:
        slope, sigma: steepest slope that lasts, and where it is, x/l.
        least, largest: tension over the whole run without vibration, N.
    """

    slope: float
    sigma: float
    least: float
    largest: float

    def __str__(self) -> str:
        bent = f"static slope up to {self.slope:.3g} at x/l = {self.sigma:.2g} under the loads that last"
        tension = f"tension {self.least:.6g} to {self.largest:.6g} N without vibration"
        return f"{bent if self.slope else 'no load that lasts bends the cable'}, {tension}"


def statics(scenario: Scenario) -> Statics | None:
    """Static slope and range of the tension of a scenario that is admitted; None for a rope, which has no such bounds.

    >>> import umbilical
    >>> [round(number, 3) for number in statics(umbilical.load("work-class-1000m-current"))]
    [0.025, 0.0, 35000.0, 75456.44]
    """
    moving = MovingCable.of(scenario)
    if scenario.model == "rope" or not (sampled := moving.sampled()):
        return None
    found, (least, largest) = steady_slope(moving, scenario.control), moving.tension_range(sampled[1])
    return Statics(found.slope, found.sigma, float(np.min(least)), float(np.max(largest)))


def steady_slope(moving: MovingCable, control: Control) -> Steady:
    """Steepest static slope under loads that last for half a period of the slowest wave, two crossings of the cable.

    Statics: ``T y_x = F + integral of f from x to l``, F the force that the thrusters leave on the ROV: all of it
    without a law; what the spring ``k_p`` leaves under PD; under the boundary law, which meets the force on the ROV,
    what it takes to hold the ROV, and less as it creeps at ``-beta y_x`` where no station holds it. The thrusters are
    taken to give what the law asks for.
    """
    winch, environment, duration, cable, payload = moving
    loaded = environment.cable_load or flows(environment)
    if not loaded and (not environment.payload_force or control.law.boundary_gains):
        return Steady(0.0, 0.0, True)
    t, sigma = np.linspace(0.0, duration, _INSTANTS), np.linspace(0.0, 1.0, _POSITIONS)
    elastic = stretching(winch, environment, cable, payload, duration)
    motion = top_at(winch, t, environment=environment, stretching=elastic)
    length = motion.length[:, None]
    net = motion.net_gravity(environment.gravity)[:, None]
    hung, drag = hanging_of(cable, payload, environment), axial_drag_of(cable, payload, environment)
    stretch = motion.elastic_tension[:, None], motion.elastic_gradient[:, None]
    hung = stretched(sinking(hung, drag, motion.sink_speed[:, None]), *stretch)
    pull = tension(length * (1.0 - sigma), net, hung)
    if not pull.min() > 0.0:
        return Steady(0.0, 0.0, True)  # a slack cable has its own problem
    found = in_water(cable, payload, environment)
    water = speeds_at(environment, length * sigma - motion.heave[:, None]) * current_at(environment, t)[0][:, None]
    loads = _loads(environment, t, sigma) + found.normal * np.abs(water) * water
    below = length * from_below(loads, sigma)
    passing = water[:, -1]
    pushed = (found.body_linear + found.body_quadratic * np.abs(passing)) * passing
    carried, alone = from_below(length * below / pull, sigma)[:, 0], from_below(length / pull, sigma)[:, 0]
    left = _left_at_the_payload(environment, control, t, pull[:, -1], carried, alone, pushed)
    slopes = (left[:, None] + below) / pull
    slowness = np.sqrt(line_inertia(cable, payload, environment) / pull)
    crossing = float(np.max(length[:, 0] * from_below(slowness, sigma)[:, 0]))
    wanted = int(np.ceil(2.0 * crossing / duration * (_INSTANTS - 1))) + 1
    window = min(wanted, _INSTANTS)
    lasting = np.maximum(_least(slopes, window), _least(-slopes, window)).max(axis=0)
    worst = int(np.argmax(lasting))
    return Steady(max(float(lasting[worst]), 0.0), float(sigma[worst]), wanted <= _INSTANTS)


def _profile_is_sound(environment: Environment) -> bool:
    """A table of the current that has no problem of its own."""
    current = environment.water.current if environment.water else None
    if current is None:
        return True
    return len(current.depths) == len(current.speeds) and bool(np.all(np.diff(current.depths) > 0.0))


def flows(environment: Environment) -> bool:
    """Whether there is a current."""
    return environment.water is not None and environment.water.current is not None


def _loads(environment: Environment, t: np.ndarray, sigma: np.ndarray) -> np.ndarray:
    """Load on a metre of cable, N/m, shape (instants, positions)."""
    total = np.zeros((t.size, sigma.size))
    for load in environment.cable_load:
        total += np.outer(signals.evaluate(load.signal, t), profile(load.profile, sigma))
    return total


def _left_at_the_payload(
    environment: Environment, control: Control, t: np.ndarray, pull: np.ndarray, carried: np.ndarray,
    alone: np.ndarray, pushed: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Force on the ROV that the cable has to bear, N, shape (instants,).

    With it the ROV is at ``carried + alone F``, m; ``pull`` is the tension there, N, ``pushed`` its drag at rest, N.
    """
    force = signals.evaluate(environment.payload_force, t) + pushed
    if control.law.boundary_gains:
        return _creeping(t, carried, alone, pull, control.law)
    spring = control.law.spring
    return (force - spring * carried) / (1.0 + spring * alone)


def _creeping(t: np.ndarray, carried: np.ndarray, alone: np.ndarray, pull: np.ndarray, law: Any) -> np.ndarray:
    """What the boundary law leaves: it holds the ROV and lets it creep, by the implicit Euler method.

    The ROV is at ``y = carried + alone F``, starts at 0 and moves at ``-beta (z - z_w) - kappa (y - y_r)``, z = F/T.
    """
    beta, kappa, place = law.boundary_gains[1], law.station_gain or 0.0, law.station or 0.0
    left = -carried / alone
    kept = left[0] / pull[0] if law.washout_time else 0.0
    for k in range(1, t.size):
        step = t[k] - t[k - 1]
        washed = 1.0 + (step / law.washout_time if law.washout_time else 0.0)
        creep, holds = step * beta / washed, 1.0 + step * kappa
        before = carried[k - 1] + alone[k - 1] * left[k - 1] + creep * kept + step * kappa * place
        left[k] = (before - holds * carried[k]) / (holds * alone[k] + creep / pull[k])
        kept += (left[k] / pull[k] - kept) * (1.0 - 1.0 / washed)
    return left


def _least(values: np.ndarray, window: int) -> np.ndarray:
    """Least value over each window of instants."""
    return np.lib.stride_tricks.sliding_window_view(values, window, axis=0).min(axis=-1)

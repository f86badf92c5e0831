"""Everything that acts on the plant from outside, sampled at the steps of a stretch of the run.

Signals, winch and faults are ordinary numpy here; the kernels read arrays. A new signal, winch law or
fault therefore needs no kernel. Columns are start, (middle) and end of each step; at a published jump the
end of one step takes the value before it and the start of the next the value after it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from math import inf
from typing import Any, NamedTuple

import numpy as np

from umbilical.frames import Frame, real
from umbilical.plant import faults, orbital, signals, winch
from umbilical.plant.layout import positions
from umbilical.plant.seaway import heaving
from umbilical.plant.stretching import Stretching, stretching
from umbilical.plant.top import top_at, vessel_at
from umbilical.relations.instants import slack
from umbilical.scenario.environment import Environment, GaussianProfile, Profile, SineProfile, TableProfile
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.winch import Winch

Array = np.ndarray


@dataclass(frozen=True, eq=False)
class Steps:
    """Consecutive steps of the plant: ``start`` and ``end``, s, shape (steps,); ``jumps`` published among them.

    Never changed, and known by identity. Where runs share them, what was sampled is kept.
    """

    start: Array
    end: Array
    jumps: Array
    shared: bool = False

    @cached_property
    def jumped(self) -> Array:
        """Numbers of the steps that something jumps at the start of."""
        return np.flatnonzero(np.isin(self.start, self.jumps)) if self.jumps.size else np.zeros(0, dtype=np.int64)

    @cached_property
    def entered(self) -> Array:
        """Numbers of the steps that do not begin as the one before ended, as far as is known: the first, and those."""
        return np.union1d([0], self.jumped)


START, END, MIDDLE = range(3)  # only motors have a middle


class Exogenous(Frame):
    """What acts on cable and ROV from outside, at an instant."""

    length = real()
    payout_speed = real()
    payout_acceleration = real()
    net_gravity = real()
    relative_jerk = real()
    vessel_displacement = real()
    vessel_velocity = real()
    payload_force = real()
    heave = real()
    sink_speed = real()
    sink_acceleration = real()
    elastic_tension = real()
    elastic_gradient = real()
    elastic_tension_rate = real()
    elastic_gradient_rate = real()
    current_factor = real()
    current_rate = real()
    wave_place = real()


class MotorExogenous(Frame):
    """What acts on one motor from outside, at an instant."""

    torque_disturbance = real()
    voltage_disturbance = real()
    effectiveness = real()
    stuck_thrust = real()
    drive_effectiveness = real()
    stuck_voltage = real()


WINCH = ("length", "payout_speed", "payout_acceleration", "net_gravity", "relative_jerk")
"""Quantities of :class:`Exogenous` that the winch gives, the first it has."""
SINKING = ("heave", "sink_speed", "sink_acceleration")
"""What it gives besides where there is water or the sheave heaves."""
STRETCHING = ("elastic_tension", "elastic_gradient", "elastic_tension_rate", "elastic_gradient_rate")
"""What follows besides where heave stretches the cable."""
EFFECTS: dict[faults.Target, tuple[str, str]] = {
    "thrust": ("effectiveness", "stuck_thrust"),
    "voltage": ("drive_effectiveness", "stuck_voltage"),
}
"""Quantities of :class:`MotorExogenous` that faults give, by their target."""


Rows = tuple[Sequence[Array], ...]
"""Functions of time, one after the other: at the start of steps that are entered, at the end of all, in the middle."""


class Inputs(NamedTuple):
    """What acts from outside, step by step.

    Attributes:
        dt: length of the step, s, shape (steps,).
        refresh: whether something jumped at its start, so that forces must be evaluated anew.
        world: records of cable and ROV at the step's start and end, shape (2, steps).
        motors: records of each motor at the step's start, end and middle, shape (3, steps, motors).
        loads: signals of the loads along the cable, N/m, at the step's start and end, shape (steps, loads, 2).
        orbits: motion of the waves at instants of the stretch and their levels, as ``plant/orbital.py`` tabulates it.

    Records at the start are those of the first step and of steps with ``refresh``: others begin as the last one ended.
    """

    dt: Array
    refresh: Array
    world: Exogenous
    motors: MotorExogenous
    loads: Array
    orbits: Array


def published_jumps(scenario: Scenario) -> tuple[float, ...]:
    """Every instant within the run at which something outside jumps, increasing, s."""
    return tuple(named_jumps(scenario))


def named_jumps(scenario: Scenario) -> dict[float, tuple[str, ...]]:
    """What jumps at every instant within the run at which something outside does, by instant, increasing, s."""
    found: dict[float, tuple[str, ...]] = {}
    last = -inf
    for t, name in sorted(
        (t, name) for name, times in _jumps(scenario) for t in times if 0.0 <= t <= scenario.duration
    ):
        last = last if t - last <= slack(t) else t  # what differs by round-off is one instant
        found[last] = tuple(dict.fromkeys((*found.get(last, ()), name)))
    return found


def _jumps(scenario: Scenario) -> Iterator[tuple[str, Iterable[float]]]:
    environment = scenario.environment
    named = [
        ("force on the ROV", environment.payload_force),
        ("vessel", environment.vessel_motion),
        ("current", variation_of(environment)),
        *(("load on the cable", load.signal) for load in environment.cable_load),
        *((f"torque on motor {k}", m.torque_disturbance) for k, m in enumerate(scenario.motors, start=1)),
        *((f"voltage of motor {k}", m.voltage_disturbance) for k, m in enumerate(scenario.motors, start=1)),
    ]
    if (rope := scenario.rope) is not None:
        named += [("vessel", rope.vessel_across)]
        named += [("force on the ROV", rope.force_across), ("force on the ROV", rope.force_up)]
    yield from ((name, signals.jumps(signal)) for name, signal in named)
    yield "vessel's full motion", (environment.vessel_ramp,)
    yield "winch", winch.jumps(scenario.winch)
    yield "fault", faults.jumps(scenario.faults, scenario.duration)


def variation_of(environment: Environment) -> signals.Signal:
    """How the current varies with time; none where it is steady."""
    current = environment.water.current if environment.water else None
    return current.variation if current else ()


def current_at(environment: Environment, t: Array, side: signals.Side = "right") -> tuple[Array, Array]:
    """Factor of the current's profile and its rate, 1/s, each of the shape of the instants."""
    variation = variation_of(environment)
    return 1.0 + signals.evaluate(variation, t, side), signals.derivative(variation, t, side)


def profile(shape: Profile, sigma: Array) -> Array:
    """A load's profile at positions ``sigma = x/l``, same shape."""
    match shape:
        case SineProfile():
            return np.sin(shape.half_waves * np.pi * sigma)
        case GaussianProfile():
            return np.exp(-(((sigma - shape.center) / shape.width) ** 2))
        case TableProfile():
            return np.interp(sigma, shape.positions, shape.values)
        case _:
            return np.ones_like(sigma)


def profiles(scenario: Scenario) -> Array:
    """Profiles of all loads along the cable, shape (loads, 4 n + 1)."""
    sigma = positions(scenario.grid.elements)
    rows = [profile(load.profile, sigma) for load in scenario.environment.cable_load]
    return np.array(rows) if rows else np.zeros((0, 4 * scenario.grid.elements + 1))


class Outside:
    """Samples the outside world of a scenario, stretch by stretch, into the same arrays.

    Two are equal that sample the same: one of them then does for runs that are taken in turns, as the last stretch is
    kept.
    """

    __hash__ = None  # pyright: ignore[reportAssignmentType]

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self._inputs, self._sampled = _empty(scenario, 0), None
        environment = scenario.environment
        in_plane = scenario.model == "string"  # a rope heaves and stretches of itself
        self._sea = environment if in_plane and heaving(environment) else None
        known = scenario.winch, environment, scenario.cable, scenario.payload, scenario.duration
        self._stretching = stretching(*known) if in_plane else None
        directions = 1 if in_plane else 3
        self._orbits: Any = orbital.orbits(environment, directions) if orbital.moves_the_water(environment) else None
        sinks = SINKING if in_plane and (heaving(environment) or environment.water) else ()
        self._wanted = WINCH + sinks + (STRETCHING if self._stretching else ())
        self._faulty: set[tuple[str, int]] = set()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Outside) and self._read() == other._read()

    def _read(self) -> tuple[Any, ...]:
        s = self._scenario
        return s.model, s.duration, s.winch, s.faults, s.motors, s.environment, s.cable, s.payload

    def sample(self, steps: Steps) -> Inputs:
        """All inputs at the given steps. The arrays are used again by the next call for others."""
        if steps is not self._sampled:
            self._sampled, self._inputs = steps, self._sample(steps)
        return self._inputs

    def _sample(self, steps: Steps) -> Inputs:
        count = steps.start.size
        if self._inputs.dt.size != count:
            self._inputs = _empty(self._scenario, count)
        inputs, environment = self._inputs, self._scenario.environment
        np.subtract(steps.end, steps.start, out=inputs.dt)
        inputs.refresh[:] = False
        inputs.refresh[steps.jumped] = True
        rows = _kept(_winch_at, steps)(self._scenario.winch, self._sea, self._stretching, environment.gravity, steps)
        _put(inputs.world, self._wanted, rows, steps)
        if variation_of(environment):
            rows = _rows(lambda t, side: current_at(environment, t, side), steps)
            _put(inputs.world, ("current_factor", "current_rate"), rows, steps)
        if environment.vessel_motion or environment.sea:
            rows = _rows(lambda t, side: vessel_at(environment, t, side), steps)
            _put(inputs.world, ("vessel_displacement", "vessel_velocity"), rows, steps)
        _put_signal(inputs.world, "payload_force", environment.payload_force, steps)
        for k, load in enumerate(environment.cable_load):
            if load.signal:
                (starts,), (ends,) = _kept(_signal_at, steps)(load.signal, steps)
                inputs.loads[:, k, END], inputs.loads[1:, k, START] = ends, ends[:-1]
                inputs.loads[steps.entered, k, START] = starts
        self._sample_motors(steps, inputs.motors)
        return inputs if self._orbits is None else self._with_waves(steps, inputs)

    def _with_waves(self, steps: Steps, inputs: Inputs) -> Inputs:
        """The same with the waves' orbital motion, and where in its rows each step begins and ends."""
        first, rows = self._orbits.rows(float(steps.start[0]), float(steps.end[-1]))
        place = inputs.world["wave_place"]
        place[START], place[END] = steps.start / orbital.STEP - first, steps.end / orbital.STEP - first
        return inputs._replace(orbits=rows)

    def _sample_motors(self, steps: Steps, out: MotorExogenous) -> None:
        for k, motor in enumerate(self._scenario.motors):
            _put_signal(out[:, :, k], "torque_disturbance", motor.torque_disturbance, steps)
            _put_signal(out[:, :, k], "voltage_disturbance", motor.voltage_disturbance, steps)
        for fault in self._scenario.faults:
            if fault.start <= steps.end[-1]:
                self._faulty.add((fault.target, fault.motor))
        for target, names in EFFECTS.items():  # a motor is healthy until its first fault, as the arrays are made
            for number in sorted(motor for kind, motor in self._faulty if kind == target):
                rows = _rows(partial(faults.effect, self._scenario.faults, number, target), steps, middle=True)
                _put(out[:, :, number - 1], names, rows, steps)


def _empty(scenario: Scenario, steps: int) -> Inputs:
    """Nothing acts, and every motor is healthy."""
    motors = MotorExogenous.many(3, steps, len(scenario.motors))
    motors["effectiveness"] = motors["drive_effectiveness"] = 1.0
    loads = np.zeros((steps, len(scenario.environment.cable_load), 2))
    world = Exogenous.many(2, steps)
    world["current_factor"] = 1.0
    return Inputs(np.zeros(steps), np.zeros(steps, dtype=np.bool_), world, motors, loads, orbital.AT_REST)


# The runs of a study share the winch and most signals, and these cost a sixth of a run: kept by steps and record.
@lru_cache(maxsize=32)
def _winch_at(law: Winch, sea: Environment | None, elastic: Stretching | None, gravity: float, steps: Steps) -> Rows:
    """Winch and what follows from it, rows as :data:`WINCH` and what else is wanted name them; ``sea`` if it heaves."""

    def motion(t: Array, side: signals.Side) -> Sequence[Array]:
        top = top_at(law, t, side, sea, elastic)
        own = top.length, top.speed, top.acceleration, top.net_gravity(gravity), top.relative_jerk(gravity)
        more = (top.heave, top.sink_speed, top.sink_acceleration, *top[-len(STRETCHING) :])
        return own + more[: len(SINKING) + len(STRETCHING) * bool(elastic)]

    return _rows(motion, steps)


@lru_cache(maxsize=128)
def _signal_at(signal: signals.Signal, steps: Steps, middle: bool = False) -> Rows:
    return _rows(lambda t, side: (signals.evaluate(signal, t, side),), steps, middle=middle)


def _kept(function: Any, steps: Steps) -> Callable[..., Rows]:
    """The function with its memory, or without it at steps that will not come again."""
    return function if steps.shared else function.__wrapped__


def _put_signal(out: Any, name: str, signal: signals.Signal, steps: Steps) -> None:
    """A signal into a field of records, shape (2 or 3, steps); those of absent signals stay zero."""
    if signal:
        _put(out, (name,), _kept(_signal_at, steps)(signal, steps, len(out) > MIDDLE), steps)


def _put(out: Any, names: Sequence[str], rows: Rows, steps: Steps) -> None:
    """Rows into fields of records, shape (2 or 3, steps), at the start where the plant looks at it.

    Fields lie far apart in memory, so that writing them costs more than working them out.
    """
    for name, start, *others in zip(names, *rows, strict=False):
        out[START][name][steps.entered] = start
        for column, row in enumerate(others, start=END):
            out[column][name] = row


def _rows(function: Callable[[Array, signals.Side], Sequence[Array]], steps: Steps, *, middle: bool = False) -> Rows:
    """Functions of time; only motors look at the ``middle``."""
    if steps.jumps.size:
        starts, ends = function(steps.start[steps.entered], "right"), function(steps.end, "left")
    else:  # nothing jumps: each knot serves as the end of one step and the start of the next
        knots = function(np.append(steps.start, steps.end[-1]), "right")
        starts, ends = [k[:1] for k in knots], [k[1:] for k in knots]
    return (starts, ends, function(0.5 * (steps.start + steps.end), "right")) if middle else (starts, ends)

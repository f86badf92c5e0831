"""Explicit limits on the step of the plant, computed from the scenario."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf, pi, sqrt

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.checks.moving import MovingCable, wave_terms
from umbilical.plant.checks.timeline import MOST_STEPS
from umbilical.plant.forces.table import decays
from umbilical.plant.multistep import DECAY_LIMIT, courant_limit
from umbilical.plant.rope.assemble import rope_step
from umbilical.plant.top import top_at
from umbilical.relations.formulas import motor_rates, steady_speed
from umbilical.relations.instants import count_up
from umbilical.relations.tension import hanging_of, net_gravity, tension
from umbilical.relations.water import line_inertia, payload_inertia
from umbilical.scenario.control import Control
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Cable, Motor, Payload
from umbilical.scenario.scenario import Grid, Scenario

_MARGIN = 0.9
"""Share of the multistep method's limits that a step may take: those are for uniform cables."""
_RUNGE_KUTTA = 2.5
"""Largest product of step and pole; the classical fourth-order method is stable below 2.785 on the real axis."""
_USUAL_SPEED = 100.0
"""Speed at which a motor's poles are judged when no voltage limit bounds it, rad/s."""


def plant_step(control: Control, grid: Grid) -> float:
    """The largest step taken, s: the control period in as few equal parts as ``grid.step`` allows."""
    return _whole_part(control.period, grid.step)


def grid_of_a_rope(model: str, grid: Grid) -> Iterator[Problem]:
    """The grid that a run chooses is the string's."""
    if model == "rope" and grid.tolerance is not None:
        reason = "only the string's grid is chosen by runs; a rope has elements of its own"
        yield Problem("grid.tolerance", f"{grid.tolerance:g}", "left out", reason, "compare runs with rope.elements")


def chosen_step(scenario: Scenario) -> float:
    """The step taken, s: as :func:`plant_step`, and short enough for the waves on the cable all through the run.

    On a rope those are the waves along the cable.

    >>> import umbilical
    >>> chosen_step(umbilical.load("paper")), chosen_step(umbilical.load("paper", {"grid.elements": 400}))
    (0.001, 0.0003333333333333333)
    """
    rope = scenario.model == "rope"
    longest = rope_step(scenario) if rope else wave_step(MovingCable.of(scenario), scenario.grid)
    return _whole_part(scenario.control.period, min(scenario.grid.step, longest))


def _whole_part(period: float, largest: float) -> float:
    return period / max(count_up(period, largest), 1)


def wave_step(moving: MovingCable, grid: Grid) -> float:
    """Longest stable step for the fastest wave in the shortest element throughout the run, s."""
    if not (sampled := moving.sampled()):
        return inf  # the winch has its own problem
    found = wave_terms(moving, sampled[1])
    speed = found.fastest + np.maximum(np.abs(found.at_vessel), np.abs(found.at_payload))
    crossing = float(np.min(np.maximum(sampled[1].length, 0.0) / speed))
    return _MARGIN * courant_limit() * crossing / grid.elements if crossing > 0.0 else inf


def step_for_waves(moving: MovingCable, grid: Grid) -> Iterator[Finding]:
    """The steps that the waves demand are not absurdly many."""
    step = wave_step(moving, grid)
    if step * MOST_STEPS < moving.duration:
        why = f"waves cross an element of this cable in so short a time that a step may last {step:.3g} s at most"
        yield Problem("grid.elements", str(grid.elements),
                      f"{MOST_STEPS:g} steps of the plant, not {moving.duration / step:.3g}", why,
                      "fewer grid.elements, or check cable.line_density, payload.mass and "
                      "environment.gravity")  # fmt: skip


def step_for_damping(
    cable: Cable, payload: Payload, environment: Environment, control: Control, grid: Grid
) -> Iterator[Finding]:
    """Damping is explicit too: within a step it takes less than about half of the speed."""
    step = plant_step(control, grid)
    for found in decays(cable, payload, environment):
        limit = _MARGIN * DECAY_LIMIT * found.inertia / step
        if found.coefficient >= limit:
            bound = f"below {limit:.6g} {found.unit} at a step of {step:g} s"
            reason = "within one step it would take more than half of the speed"
            yield Problem(found.key, amount(found.coefficient, found.unit), bound, reason, "a smaller grid.step")


def waves_that_leave(moving: MovingCable, control: Control, grid: Grid) -> Iterator[Finding]:
    """The ROV loses momentum to the waves it sends up the cable, at the rate ``sqrt(rho T)/m``."""
    if not (sampled := moving.sampled()):
        return
    net, hung = sampled[1].net_gravity(moving.environment.gravity), moving.sunk(sampled[1])
    pull, inertia = max(float(np.max(tension(0.0, net, hung))), 0.0), payload_inertia(moving.payload)
    step = plant_step(control, grid)
    impedance = sqrt(line_inertia(moving.cable, moving.payload, moving.environment) * pull)
    limit = impedance * step / (_MARGIN * DECAY_LIMIT)
    if inertia < limit:
        yield Problem("payload.mass", amount(moving.payload.mass, "kg"),
                      f"at least {limit:.6g} kg at a step of {step:g} s",
                      f"the cable resists with {impedance:.4g} N s/m and would take more than half of its speed within "
                      "a step", "a smaller grid.step")  # fmt: skip


def motors(motors: Sequence[Motor], ideal_thruster: bool, control: Control, grid: Grid) -> Iterator[Finding]:
    """The step resolves the fastest pole of each motor over the speeds it reaches."""
    if ideal_thruster:
        return
    step = plant_step(control, grid)
    for number, motor in enumerate(motors, start=1):
        speed = reachable_speed(motor)
        pole = max(fastest_pole(motor, speed), fastest_pole(motor, 0.0))
        if not pole * step <= _RUNGE_KUTTA:
            why = f"motor {number} has a pole at {pole:.6g} 1/s at {speed:.6g} rad/s; the scheme is explicit"
            fix = f"a smaller grid.step, or check motors.{number}.inductance and motors.{number}.inertia"
            yield Problem("grid.step", amount(step, "s"), f"at most {_RUNGE_KUTTA / pole:.4g} s", why, fix)


def reachable_speed(motor: Motor) -> float:
    """Steady speed at the voltage limit, rad/s; a usual one where there is no bound."""
    speed = inf if motor.voltage_limit is None else steady_speed(motor, motor.voltage_limit)
    return speed if speed < inf else _USUAL_SPEED


def fastest_pole(motor: Motor, speed: float) -> float:
    """Largest modulus, 1/s, of the poles of eq. (15) linearised at a speed, rad/s; infinite if they overflow."""
    matrix, _ = motor_rates(motor, speed)
    return float(np.abs(np.linalg.eigvals(matrix)).max()) if np.isfinite(matrix).all() else inf


_FELT_FROM = 0.2
"""Share of the wave speed at the ROV from which on a slope gain lets the motors chatter at waves no grid carries."""


def grid_near_the_payload(moving: MovingCable, control: Control, grid: Grid) -> Iterator[Finding]:
    """Waves too short for the grid are damped where a real cable sends them back from the vessel."""
    sections = moving.cable, moving.payload, moving.environment
    pull = tension(0.0, net_gravity(moving.environment.gravity), hanging_of(*sections))
    speed, gains = sqrt(pull / line_inertia(*sections)), control.law.boundary_gains
    if gains and gains[1] >= _FELT_FROM * speed:
        band = 2.0 * pi * speed * grid.elements / float(top_at(moving.winch, [0.0, moving.duration]).length.max())
        words = f"at {gains[1]:g} m/s the loop feels waves above {band:.0f} rad/s, which this grid damps and a cable "
        yield Notice("control.law.slope_gain", words + "would send back: judge stability by `umbilical margins`")

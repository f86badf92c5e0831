"""What the linearised sampled loop is worth at one length: stability, margins, modes, reflection.

>>> import umbilical
>>> found = margins_at(umbilical.load("paper"), 450.0)
>>> found.stable, 1.0 < found.margins.gain_high.size < 4.0
(True, True)
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from umbilical.errors import Problem, ScenarioError, expect
from umbilical.library.admit import admit
from umbilical.plant import signals
from umbilical.plant.top import top_at
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.text import literal
from umbilical.stability.impedance import FixedLengthCable, hanging_cable
from umbilical.stability.limits import Margins, find_limits
from umbilical.stability.nyquist import Stability, Sweep, near_poles, stability, sweep_loop
from umbilical.stability.sampled import SampledLoop, loop_response, sampled_loop

MODES = 5
"""Modes that are listed."""
POINTS = 400
"""Frequencies of the reflection."""
USUAL_SLOPE = 0.01
"""Slope at the ROV whose pull stands in as the operating thrust where no steady force acts."""
DAMPERS = (1.0, 0.3, 0.1)
"""Shares of the cable's impedance that are tried as a damper at the ROV."""
INSTANTS = 1001
"""Instants of a run at which a mean force and the lengths are taken."""


class Mode(NamedTuple):
    """A mode of the cable in closed loop: frequency, rad/s; decay, 1/s; damping ratio."""

    frequency: float
    decay: float
    damping_ratio: float


@dataclass(frozen=True)
class Judgement:
    """The loop at one length.

    Attributes:
        length: m.
        stability: how many poles are unstable, and which motion grows fastest.
        margins: None where the loop is unstable and has none.
        modes: the first modes of the cable in closed loop.
        frequency: rad/s, of the reflection.
        reflection: \\|R\\| of the controlled ROV, share of a displacement that it sends back.
        sweep: the opened loop over frequency.
    """

    length: float
    stability: Stability
    margins: Margins | None
    modes: tuple[Mode, ...]
    frequency: np.ndarray
    reflection: np.ndarray
    sweep: Sweep

    @property
    def stable(self) -> bool:
        """Whether no pole is outside the unit circle."""
        return self.stability.unstable == 0


def margins_at(scenario: Scenario, length: float, operating_thrust: float | None = None) -> Judgement:
    """Stability, margins, modes and reflection of a scenario's loop, the winch standing at a length.

    Args:
        scenario: its cable, ROV, motors, sensors and controller are used.
        length: m.
        operating_thrust: steady thrust at which the motors are linearised, N; if left out, that of
            :func:`usual_thrust`.

    Raises:
        ScenarioError: there is no loop, or one that cannot be linearised.
    """
    check_loop(scenario)
    thrust = usual_thrust(scenario) if operating_thrust is None else operating_thrust
    return margins_of(hanging_cable(scenario, length), sampled_loop(scenario, thrust))


def margins_of(cable: FixedLengthCable, loop: SampledLoop) -> Judgement:
    """The same from cable and loop."""
    swept = sweep_loop(cable, loop)
    found = stability(swept)
    frequency = np.geomspace(swept.w[0], swept.w[-1], POINTS)
    response = loop_response(cable, loop, 1j * frequency)
    limits = find_limits(swept) if found.unstable == 0 else None
    poles = [_polished(swept, p) for p in near_poles(swept, MODES)]
    modes = tuple(Mode(abs(p.imag), -p.real, -p.real / abs(p)) for p in poles if np.isfinite(p))
    return Judgement(cable.length, found, limits, modes, frequency, np.abs(response.reflection()), swept)


def _polished(s: Sweep, p: complex, steps: int = 30) -> complex:
    """The zero of 1 - echo R next to p, 1/s; NaN where the search leaves its neighbourhood."""
    start, size = p, 1e-6
    for _ in range(steps):
        r = loop_response(s.cable, s.loop, np.array([p, p + 1j * size]))
        here, beside = 1.0 - r.echo * r.reflection()
        move = -here * 1j * size / (beside - here)
        p += move
        if abs(p - start) > 2.0 * np.pi / s.cable.round_trip or p.imag <= 0.0:
            return complex(np.nan)
        if abs(move) < 1e-10 * abs(p):
            break
    return p


def usual_thrust(scenario: Scenario) -> float:
    """Thrust at which the motors are linearised, N: the mean force on the ROV, at least the pull of a small slope.

    At no thrust at all a propeller has none to first order, and the linearised loop would be open.
    """
    force = signals.evaluate(scenario.environment.payload_force, np.linspace(0.0, scenario.duration, INSTANTS))
    pull = USUAL_SLOPE * hanging_cable(scenario, 1.0).tip_tension
    return max(abs(float(np.mean(force))), pull)


def usual_lengths(scenario: Scenario) -> tuple[float, ...]:
    """Shortest, middle and longest length of the run, m; one where the winch stands still."""
    lengths = top_at(scenario.winch, np.linspace(0.0, scenario.duration, INSTANTS)).length
    low, high = float(np.min(lengths)), float(np.max(lengths))
    return (low,) if high - low < 1e-9 * high else (low, 0.5 * (low + high), high)


def check_loop(scenario: Scenario) -> None:
    """Refuse a law of the scenario's own that has no margins.

    Raises:
        ScenarioError: no controller, or rates of the slope that an ideal thruster makes jump at every sample.
    """
    expect(scenario, "Scenario", "load")
    law = scenario.control.law
    if not law.closes_loop:
        wanted, reason = "a law that closes a loop", "margins say what a loop survives"
        problem = Problem("control.law.kind", law.kind, wanted, reason, law_that_works(scenario))
        raise ScenarioError([problem], scenario.name)
    if scenario.ideal_thruster and law.reads_rates and law.boundary_gains:
        reason = "with an ideal thruster the rate of the slope jumps at every sample, which has no linear response"
        fix = "rates = 'observer', or ideal_thruster = false"
        problem = Problem("control.law.rates", "sensor", "observer, or motors in the loop", reason, fix)
        raise ScenarioError([problem], scenario.name)


def law_that_works(scenario: Scenario) -> str:
    """A damper that is stable at the lengths of the run, as keys of a scenario file; where none is, where to look."""
    impedance, period = hanging_cable(scenario, usual_lengths(scenario)[0]).tip_impedance, scenario.control.period
    for share in DAMPERS:
        law = {"kind": "pd", "position_gain": 0.0, "velocity_gain": float(f"{share * impedance:.2g}")}
        observer = {"time_constant": 5.0 * period, "damping": 2.0}
        changes = {"control.law": law, "control.velocity_observer": observer}
        with suppress(ScenarioError):
            new = scenario.replace(changes)
            admit(new)
            if all(margins_at(new, length).stable for length in usual_lengths(scenario)):
                return f"{' with '.join(f'{key} = {literal(value)}' for key, value in changes.items())}; tried, stable"
    return (
        "a law with gains, as in `umbilical presets --copy paper`; `umbilical design` chooses those of the boundary law"
    )

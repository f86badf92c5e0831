"""Whether the thrusters gave what was commanded: metrics and notices of a run, from its tally.

A drive at its voltage limit, or a command far beyond what the thrusters can give, opens the loop: margins, certificates
and the law's own estimates are about a loop in which the command is delivered.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from umbilical.engine.recording import root_mean_square
from umbilical.plant.checks.steps import reachable_speed
from umbilical.scenario.findings import Notice
from umbilical.scenario.scenario import Scenario

SATURATED = 0.01
"""Share of the control samples from which on a drive at its limit is told."""
RUNAWAY = 10.0
"""A command so many times what the thrusters give at their voltage limits is told."""
UNDELIVERED = 3.0
"""Without limits: what is missing of the command, so many times what was delivered, is told (both RMS).

A motor stuck for good leaves 1.7 in the presets; noise of 1 mm on the ROV's position, which their observers turn into
600 N of chatter, leaves 3.9.
"""


def saturation(scenario: Scenario, tally: Any) -> dict[str, float]:
    """The metrics ``saturated_share`` and ``thrust_gap``, each where there is something to measure.

    ``saturated_share`` counts the control samples of the motors with a voltage limit; ``thrust_gap``, N, is the root
    mean square of commanded minus delivered thrust. Both need motors, the gap a commanded thrust too.
    """
    if scenario.ideal_thruster or not scenario.motors:
        return {}
    found, count, gap = {}, max(int(tally.measures[0].samples), 1), tally.measures[0].gap
    limited = np.isfinite(tally.motors["voltage_limit"])
    if limited.any():
        found["saturated_share"] = float(np.mean(tally.motors["samples_at_limit"][limited])) / count
    if not np.isnan(gap.squares):
        found["thrust_gap"] = root_mean_square(tally, gap)
    return found


def saturation_notices(scenario: Scenario, tally: Any) -> tuple[Notice, ...]:
    """What a user should know of a run whose thrusters did not give what was commanded."""
    if scenario.ideal_thruster or not scenario.motors:
        return ()
    return (*_saturated(tally), *_runaway(scenario, tally))


def thrust_capability(scenario: Scenario) -> float:
    """Steady thrust of all healthy motors at their voltage limits, N; infinite if one has no limit.

    >>> import umbilical
    >>> limits = {"motors.1.voltage_limit": 8.0, "motors.2.voltage_limit": 8.0}
    >>> round(thrust_capability(umbilical.load("paper", limits)))
    246
    """
    if any(motor.voltage_limit is None for motor in scenario.motors):
        return float("inf")
    return sum(abs(motor.thrust_coefficient) * reachable_speed(motor) ** 2 for motor in scenario.motors)


def _saturated(tally: Any) -> Iterator[Notice]:
    for number, motor in enumerate(tally.motors, start=1):
        limit, share = motor.voltage_limit, motor.samples_at_limit / max(tally.measures[0].samples, 1)
        if share > SATURATED:
            yield Notice(
                f"motors.{number}.voltage_limit",
                f"the drive was at its limit of {limit:g} V in {100.0 * share:.3g} % of the control samples: it did "
                "not follow the law there, and margins and certificates are about a law that is followed",
            )


def _runaway(scenario: Scenario, tally: Any) -> Iterator[Notice]:
    capability, peak = thrust_capability(scenario), float(tally.measures[0].command.peak)
    found = tally.measures[0]
    gap, commanded, delivered = (root_mean_square(tally, m) for m in (found.gap, found.command, found.thrust))
    if peak > RUNAWAY * capability:
        given = f"of thrusters that give {capability:.3g} N steadily at their voltage limits"
        yield Notice("control", f"a thrust of up to {peak:.3g} N was commanded {given}")
    elif gap > UNDELIVERED * delivered:
        yield Notice(
            "control",
            f"{commanded:.3g} N (RMS) were commanded and {delivered:.3g} N delivered: "
            "the thrusters do not follow the command",
        )

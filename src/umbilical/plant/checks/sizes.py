"""Checks of what a run takes: memory, disk, and the number of instants at which something jumps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from umbilical import machine
from umbilical.errors import Problem, ScenarioError
from umbilical.plant import signals
from umbilical.plant.checks.timeline import MOST_JUMPS, of_environment, of_motors
from umbilical.scenario import Scenario
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Motor
from umbilical.scenario.rope import Rope

LARGE = 2e8
"""Bytes of a result from which its size is told."""
_ALONG, _OTHERS, _EACH_MOTOR = 3, 50, 10
"""Numbers of a sample: fields along the cable, channels of time alone, channels of a motor."""
_ALONG_ROPE = 7
"""Of the rope: place in three directions, tension, and what the string has."""
_COPIES = 3.5
"""Of every stored number, while a result is made and written: log, channels, file."""


def result_size(scenario: Scenario) -> float:
    """Bytes of a run's result file, to a few per cent.

    >>> import umbilical
    >>> round(result_size(umbilical.load("paper")) / 1e6, 1)
    6.7
    """
    along, grid = (_ALONG_ROPE, scenario.rope or Rope()) if scenario.model == "rope" else (_ALONG, scenario.grid)
    numbers = along * (4 * grid.elements + 1) + _OTHERS + _EACH_MOTOR * len(scenario.motors)
    return 8.0 * numbers * (scenario.duration / scenario.output.interval + 1.0)


def memory_of(scenario: Scenario) -> float:
    """Bytes of memory a run takes until its result is written, at the most."""
    return _COPIES * result_size(scenario)


def large_result(scenario: Scenario) -> Iterator[Finding]:
    """A large result is announced."""
    size = result_size(scenario)
    if size >= LARGE:
        memory = machine.in_words(memory_of(scenario))
        yield Notice("output.interval", f"the result takes {machine.in_words(size)} on disk, {memory} of memory")


def check_memory(scenario: Scenario) -> None:
    """Refuse a run whose samples this machine could not hold.

    Raises:
        ScenarioError: with what it needs and what there is.
    """
    need, there = memory_of(scenario), machine.memory()
    if need > there:
        interval, section = scenario.output.interval, "rope" if scenario.model == "rope" else "grid"
        bound = f"{machine.in_words(there)} of memory on this machine, not {machine.in_words(need)}"
        fix = f"an interval above {interval * need / there:.3g} s, or fewer {section}.elements"
        reason = "every stored sample is in memory until the result is written"
        raise ScenarioError([Problem("output.interval", amount(interval, "s"), bound, reason, fix)], scenario.name)


def stored_instants(environment: Environment, motors: Sequence[Motor]) -> Iterator[Finding]:
    """A step of the plant ends wherever a signal jumps or has a kink, and their number can be simulated."""
    for key, signal in (*of_environment(environment), *of_motors(motors)):
        count = len(signals.jumps(signal))
        if count > MOST_JUMPS:
            yield Problem(key, f"{count} jumps and kinks", f"at most {MOST_JUMPS:g}",
                          "a step of the plant ends at each",
                          'fewer terms, or tables with interpolation = "smooth"')  # fmt: skip

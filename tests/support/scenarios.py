"""Small scenarios to start tests from, and the one line that runs them."""

from __future__ import annotations

from typing import Any

import umbilical
from umbilical import Run, Scenario, Status

QUIET = {"environment.payload_force": []}
UNDAMPED = {"cable.damping": 0.0, "payload.damping": 0.0}
STEADY_TENSION = {"cable.wet_line_density": 0.0}


def open_loop(**overrides: Any) -> Scenario:
    """Cable and ROV alone: no control, no load, 500 m. Overrides with ``__`` for the dot of a key."""
    return umbilical.load("crosscheck-none", QUIET | dotted(overrides))


def small(preset: str, **overrides: Any) -> Scenario:
    """A preset on 4 elements for 0.1 s, small enough to run without the compiler."""
    return umbilical.load(preset, {"grid.elements": 4, "duration": 0.1, "output.interval": 0.01} | dotted(overrides))


def dotted(overrides: dict[str, Any]) -> dict[str, Any]:
    """``cable__damping`` -> ``cable.damping``."""
    return {key.replace("__", "."): value for key, value in overrides.items()}


def run(scenario: Scenario, controller: Any = None) -> Run:
    """A run that came to its end."""
    result = umbilical.simulate(scenario, controller)
    assert result.status is Status.COMPLETED, result.reason
    return result


def sine(amplitude: float, frequency: float, phase: float = 0.0) -> dict[str, Any]:
    """One term of a signal."""
    return {"kind": "sine", "amplitude": amplitude, "frequency": frequency, "phase": phase}


def constant(value: float) -> dict[str, Any]:
    """One term of a signal."""
    return {"kind": "constant", "value": value}

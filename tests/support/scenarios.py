"""Small scenarios to start tests from, and the one line that runs them."""

from __future__ import annotations

from typing import Any

import umbilical
from umbilical import Run, Scenario, Status
from umbilical.verify.engine import STEADY_TENSION, UNDAMPED, constant, dotted, open_loop, sine
from umbilical.verify.invariance import small

__all__ = ["STEADY_TENSION", "UNDAMPED", "constant", "dotted", "open_loop", "run", "sine", "small"]


def run(scenario: Scenario, controller: Any = None) -> Run:
    """A run that came to its end."""
    result = umbilical.simulate(scenario, controller)
    assert result.status is Status.COMPLETED, result.reason
    return result

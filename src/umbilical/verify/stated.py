"""The orders this version states, in the size of an element and in the step; `docs/theory.md` derives them."""

from __future__ import annotations

DISPLACEMENT_ORDER = 6
VELOCITY_ORDER = 5
TIP_ORDER = 7
"""Of displacement and velocity at the ROV, where waves leave through the upwind flux."""
TIME_ORDER = 3
BALANCE_ORDER = 4
"""Of the power balance in the size of an element."""
BALANCE_TIME_ORDER = 2
"""Of the power balance in the step: works are integrated by the trapezoidal rule."""
PERIOD_ORDER = 1
"""Of the sampled controller towards the continuous law, in the period."""

"""The orders this version states, in the size of an element and in the step; `docs/theory.md` derives them."""

from __future__ import annotations

DISPLACEMENT_ORDER = 5
VELOCITY_ORDER = 4
TIME_ORDER = 2
BALANCE_ORDER = 4
"""Of the power balance in the size of an element."""
PERIOD_ORDER = 1
"""Of the sampled controller towards the continuous law, in the period."""

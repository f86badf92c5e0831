"""The orders this version states, in the size of an element and in the step; `docs/theory.md` has their reasons."""

from __future__ import annotations

VELOCITY_ORDER = 5
DISPLACEMENT_ORDER = 6
TIP_ORDER = 7
"""Twice the degree is 8 in theory; on grids that round-off allows, 7.2 to 8 is seen."""
TIME_ORDER = 3
BALANCE_ORDER = 6
"""Of the power balance in the size of an element."""
BALANCE_TIME_ORDER = 2
"""Of the power balance in the step: powers are integrated by the trapezoidal rule."""
ROPE_ORDER = 4.75
"""Of the rope's r_x and Dr/Dt on up to 32 elements, where 4.85 is seen and rises: 4.9 on 64, and 5 in theory."""
PERIOD_ORDER = 1
"""Of the sampled controller towards the continuous law, in the period."""

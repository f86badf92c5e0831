"""Command filter: a speed reference with two derivatives from a demand that has none.

The root of the demand, softened at 0, passes a third-order filter with a triple pole at w_c::

    f''' = w_c^3 (root - f) - 3 w_c^2 f' - 3 w_c f'',   w_d = f
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.control.linear import held_input_form
from umbilical.frames import Frame, real
from umbilical.relations.formulas import soft_signed_root


class Reference(Frame):
    """The filtered speed reference of a motor, with its derivatives: w_d, w_d', w_d''."""

    speed_reference = real()
    speed_reference_rate = real()
    speed_reference_curvature = real()


class CommandFilter(NamedTuple):
    """Exact step ``reference <- form [reference, root]``, shape (3, 4); ``width`` softens the root, rad2/s2."""

    form: np.ndarray
    width: float


def make_command_filter(frequency: float, width: float, period: float) -> CommandFilter:
    """Discrete form for one period, s, of the filter with poles at ``frequency``, rad/s."""
    w = frequency
    companion = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-(w**3), -3.0 * w**2, -3.0 * w]])
    return CommandFilter(held_input_form(companion, np.array([0.0, 0.0, w**3]), period), width)


@kernel
def advance_filter(command_filter: CommandFilter, reference: Reference, demand: float) -> None:
    """Advance one period."""
    f = command_filter.form
    root = soft_signed_root(demand, command_filter.width)
    w0, w1, w2 = reference.speed_reference, reference.speed_reference_rate, reference.speed_reference_curvature
    reference.speed_reference = f[0, 0] * w0 + f[0, 1] * w1 + f[0, 2] * w2 + f[0, 3] * root
    reference.speed_reference_rate = f[1, 0] * w0 + f[1, 1] * w1 + f[1, 2] * w2 + f[1, 3] * root
    reference.speed_reference_curvature = f[2, 0] * w0 + f[2, 1] * w1 + f[2, 2] * w2 + f[2, 3] * root

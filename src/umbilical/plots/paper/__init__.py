"""Figures for reading in a paper: one column wide, each drawn from the dataset that is stored beside it.

Whatever a figure shows is in its dataset, with units and names; so a figure can be drawn again from its file.
"""

from umbilical.plots.paper.adaptation import draw_adaptation, draw_gain
from umbilical.plots.paper.beyond import draw_energy, draw_kappa, draw_lyapunov, draw_spacetime
from umbilical.plots.paper.displacement import draw_midpoint, draw_positions
from umbilical.plots.paper.estimates import draw_absorption, draw_disturbances, draw_states
from umbilical.plots.paper.faults import draw_boundary, draw_speeds, draw_voltages
from umbilical.plots.paper.maps import draw_map

__all__ = [
    "draw_absorption",
    "draw_adaptation",
    "draw_boundary",
    "draw_disturbances",
    "draw_energy",
    "draw_gain",
    "draw_kappa",
    "draw_lyapunov",
    "draw_map",
    "draw_midpoint",
    "draw_positions",
    "draw_spacetime",
    "draw_speeds",
    "draw_states",
    "draw_voltages",
]

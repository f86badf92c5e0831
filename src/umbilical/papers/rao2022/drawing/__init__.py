"""Figures for reading in a paper: one column wide, each drawn from the dataset that is stored beside it.

Whatever a figure shows is in its dataset, with units and names; so a figure can be drawn again from its file.
"""

from umbilical.papers.rao2022.drawing.adaptation import draw_adaptation, draw_gain
from umbilical.papers.rao2022.drawing.beyond import draw_energy, draw_kappa, draw_lyapunov, draw_spacetime
from umbilical.papers.rao2022.drawing.displacement import draw_midpoint, draw_positions
from umbilical.papers.rao2022.drawing.estimates import draw_absorption, draw_disturbances, draw_states
from umbilical.papers.rao2022.drawing.faults import draw_boundary, draw_speeds, draw_voltages
from umbilical.papers.rao2022.drawing.maps import draw_map

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

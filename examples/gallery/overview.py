"""
A run on one page
=================

What a first look should show, and nothing the run does not have.
"""

import umbilical

run = umbilical.simulate(umbilical.load("paper", {"duration": 20.0}))
figure = umbilical.plot_overview(run)

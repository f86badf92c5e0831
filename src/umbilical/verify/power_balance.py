"""The power balance closes on a moving domain, with everything that does work at work, the vessel included.

Energy and work are the engine's own; what is verified is that they agree, with what the grid takes booked as well.
Hauling in feeds energy in at the vessel without any load, so the balance must count that end; a test that energy
never grows would be wrong.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, orders_reached, small
from umbilical.verify.engine import from_rest, open_loop, sine

CASES = Cases()
BALANCE_ORDER = 6
"""Stated of the power balance in the size of an element."""
BALANCE_TIME_ORDER = 2
"""Stated of the power balance in the step: powers are integrated by the trapezoidal rule."""
WAYS = {"paying out": (100.0, 130.0), "hauling in": (130.0, 100.0)}
IN_WATER = {"payload.wet_weight": 2500.0, "cable.wet_line_density": 0.6}
"""Half of the ROV's weight in air, and less than a third of the cable's."""
OPEN = "|E - start - work| over energy and work"
WHY = "16 elements; the smallest term left out opens it a hundred times further"
REFERENCE = ("dE/dt term by term, with e(t)", "exact for (6)-(8); docs/theory.md", WAYS)


def moved(way: tuple[float, float], elements: int, step: float, **more: Any) -> Run:
    """Ten seconds with load, force, dampers, vessel and winch all at work."""
    scenario = open_loop(
        duration=10.0, grid={"elements": elements, "step": step}, control__period=step, output__interval=0.1,
        winch={"law": "quintic", "start_length": way[0], "end_length": way[1], "duration": 10.0},
        environment__vessel_motion=[sine(0.5, 1.1)], environment__vessel_ramp=4.0,
        environment__payload_force=[sine(100.0, 0.9)],
        environment__cable_load=[{"profile": {"shape": "sine", "half_waves": 2}, "signal": [sine(0.5, 0.7)]}],
        cable__damping=0.05, payload__damping=10.0,
    )  # fmt: skip
    return engine.finished(scenario.replace(more))


def _residual(run: Run) -> float:
    """What the balance leaves open, over energy and gross work, as every run reports it."""
    return run.metrics["energy_balance_residual"]


@CASES.add("power balance, {}", *REFERENCE)
def _in_air(way: tuple[float, float]) -> Checks:
    yield small(OPEN, _residual(moved(way, 16, 1e-3)), 1e-4, WHY)


@CASES.add("power balance, {}, in water", *REFERENCE)
def _in_water(way: tuple[float, float]) -> Checks:
    """The water bears weight and no inertia: only a part of the tension follows the winch's acceleration."""
    yield small(OPEN, _residual(moved(way, 16, 1e-3, **IN_WATER)), 1e-4, WHY)


@CASES.add("power balance, {}, controlled", *REFERENCE)
def _controlled(way: tuple[float, float]) -> Checks:
    """The paper's loop, motors included, while the winch starts and stops with jumps of its acceleration."""
    ends = {"start_length": way[0], "end_length": way[1], "top_speed": 4.0, "acceleration": 2.0}
    found = _residual(engine.finished(load("paper", {
        "duration": 12.0, "output.interval": 0.1, "winch": {"law": "trapezoid", **ends},
        "environment.payload_force": from_rest(100.0, 0.9), "environment.vessel_motion": from_rest(0.2, 1.1),
    })))  # fmt: skip
    yield small(OPEN, found, 1e-6, "nothing is rough here; a work of the thrust of the wrong sign opens it by 1")


@CASES.add("power balance, {}, refined", *REFERENCE, quick=False)
def _refined(way: tuple[float, float]) -> Checks:
    """How it closes when grid and step are refined."""
    steps = (2e-3, 1e-3, 5e-4, 2.5e-4)
    found = [[_residual(moved(way, 16, step))] for step in steps]
    yield from orders_reached({"the power balance": BALANCE_TIME_ORDER}, "the step, s", steps, found)
    grids = (4, 5, 6)  # on 8 the steps show, however short they are
    found = [[_residual(moved(way, n, 3.125e-5))] for n in grids]
    sizes = [float(np.mean(way)) / n for n in grids]
    why = "stated, as the least; on grids as coarse as these faster terms count too"
    yield from orders_reached({"the power balance": BALANCE_ORDER}, "the element, m", sizes, found, why)

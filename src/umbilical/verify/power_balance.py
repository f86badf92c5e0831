"""The power balance closes on a moving domain, with everything that does work at work, the vessel included.

Energy and work are the engine's own; what is verified is that they agree, with what the grid takes booked as well.
Hauling in feeds energy in at the vessel without any load, so the balance must count that end; a test that energy
never grows would be wrong.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from umbilical.analysis.convergence import Curve
from umbilical.library import load
from umbilical.run import Run
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, order_reached, small
from umbilical.verify.engine import constant, open_loop, sine
from umbilical.verify.orders import BALANCE_ORDER, BALANCE_TIME_ORDER

WAYS = {"paying out": (100.0, 130.0), "hauling in": (130.0, 100.0)}
IN_WATER = {"payload.wet_weight": 2500.0, "cable.wet_line_density": 0.6}
"""Half of the ROV's weight in air, and less than a third of the cable's."""
OPEN, RESIDUAL = "|E - start - work| over energy and work", 1e-4
WHY = "16 elements; the smallest term left out opens it a hundred times further"


def moved(way: tuple[float, float], elements: int, step: float, **more: object) -> Run:
    """Ten seconds with load, force, dampers, vessel and winch all at work."""
    scenario = open_loop(
        duration=10.0, grid={"elements": elements, "step": step}, control__period=step, output__interval=0.1,
        winch={"law": "quintic", "start_length": way[0], "end_length": way[1], "duration": 10.0},
        environment__vessel_motion=[sine(0.5, 1.1)], environment__vessel_ramp=4.0,
        environment__payload_force=[sine(100.0, 0.9)],
        environment__cable_load=[{"profile": {"shape": "sine", "half_waves": 2}, "signal": [sine(0.5, 0.7)]}],
        cable__damping=0.05, payload__damping=10.0,
    )  # fmt: skip
    return engine.completed(scenario.replace(more))


def _residual(way: tuple[float, float], elements: int, step: float, **more: object) -> float:
    """What the balance leaves open, over energy and gross work."""
    return moved(way, elements, step, **more).metrics["energy_balance_residual"]


def _size(way: tuple[float, float], **more: object) -> Iterator[Check]:
    """The balance as every run reports it."""
    yield small(OPEN, _residual(way, 16, 1e-3, **more), RESIDUAL, WHY)


def _in_water(way: tuple[float, float]) -> Iterator[Check]:
    """The water bears weight and no inertia: only a part of the tension follows the winch's acceleration."""
    return _size(way, **IN_WATER)


def _rates(way: tuple[float, float]) -> Iterator[Check]:
    """How it closes when grid and step are refined."""
    steps = (2e-3, 1e-3, 5e-4, 2.5e-4)
    found = tuple(_residual(way, 16, step) for step in steps)
    yield order_reached(Curve("the power balance", "the step, s", steps, found, BALANCE_TIME_ORDER), "stated")
    grids = (4, 5, 6)  # on 8 the steps show, however short they are
    found = tuple(_residual(way, n, 3.125e-5) for n in grids)
    sizes = tuple(float(np.mean(way)) / n for n in grids)
    why = "stated, as the least; on grids as coarse as these faster terms count too"
    yield order_reached(Curve("the power balance", "the element, m", sizes, found, BALANCE_ORDER), why)


def _controlled(way: tuple[float, float]) -> Iterator[Check]:
    """The paper's loop, motors included, while the winch starts and stops with jumps of its acceleration."""
    ends = {"start_length": way[0], "end_length": way[1]}
    changes = {
        "duration": 12.0, "output.interval": 0.1,
        "winch": {"law": "trapezoid", **ends, "top_speed": 4.0, "acceleration": 2.0},
        "environment.payload_force": [constant(100.0), sine(-100.0, 0.9, np.pi / 2.0)],
        "environment.vessel_motion": [constant(0.2), sine(-0.2, 1.1, np.pi / 2.0)],
    }  # fmt: skip
    found = engine.completed(load("paper", changes)).metrics["energy_balance_residual"]
    why = "nothing is rough here; a work of the thrust of the wrong sign opens it by 1"
    yield small(OPEN, found, 1e-6, why)


REFERENCE, SOURCE = "dE/dt term by term, with e(t)", "exact for (6)-(8); docs/theory.md"
FINDS = {"": _size, ", in water": _in_water, ", controlled": _controlled, ", refined": _rates}
CASES = tuple(
    Case(f"power balance, {name}{more}", REFERENCE, SOURCE, partial(find, way), quick=find is not _rates)
    for name, way in WAYS.items()
    for more, find in FINDS.items()
)

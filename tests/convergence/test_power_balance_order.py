"""The power balance closes: order 2 in the step, over 6 in the element size, with everything that does work at work.

Evaluated by a quadrature that the scheme does not use. Its smallness alone would prove little: the balance
counts the vessel's end, where hauling in feeds energy in without any load.
"""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.orders import orders
from tests.support.scenarios import open_loop, run, sine
from umbilical import Run

WAYS = pytest.mark.parametrize("way", [(100.0, 130.0), (130.0, 100.0)], ids=["paying out", "hauling in"])


def moved(way: tuple[float, float], elements: int, step: float) -> Run:
    return run(
        open_loop(
            duration=10.0,
            grid={"elements": elements, "step": step},
            control__period=step,
            output__interval=0.1,
            winch={"law": "quintic", "start_length": way[0], "end_length": way[1], "duration": 10.0},
            environment__vessel_motion=[sine(0.5, 1.1)],
            environment__vessel_ramp=4.0,
            environment__payload_force=[sine(100.0, 0.9)],
            environment__cable_load=[{"profile": {"shape": "sine", "half_waves": 2}, "signal": [sine(0.5, 0.7)]}],
            cable__damping=0.05,
            payload__damping=10.0,
        )
    )


def residual(way: tuple[float, float], elements: int, step: float) -> float:
    return moved(way, elements, step).metrics["energy_balance_residual"]


@WAYS
def test_order_in_the_step(way: tuple[float, float]) -> None:
    observed = orders([residual(way, 16, step) for step in (1e-3, 5e-4)])
    assert observed[-1] == pytest.approx(2.0, abs=0.15)


@WAYS
def test_order_in_the_element_size(way: tuple[float, float]) -> None:
    coarse, fine = (residual(way, n, 1.25e-4) for n in (4, 6))
    assert np.log(coarse / fine) / np.log(6 / 4) > 6.0


@WAYS
def test_what_the_grid_takes_vanishes_with_the_element_size(way: tuple[float, float]) -> None:
    lost = [moved(way, n, 1e-3).metrics["grid_loss"] for n in (4, 8, 16)]
    assert orders(lost).min() > 3.9
    assert lost[-1] < 1e-9


@WAYS
def test_every_term_is_needed(way: tuple[float, float]) -> None:
    """Left out, any term of the balance opens it by at least a hundred times the residual."""
    result = moved(way, 16, 1e-3)
    energy, closed = result["energy"].values, result.metrics["energy_balance_residual"]
    works = {str(name): result[str(name)].values for name in result.data if str(name).startswith("work_")}
    assert len(works) == 8
    total = np.sum(list(works.values()), axis=0)
    scale = max(energy.max(), np.abs(np.diff(total)).sum())
    for name, work in works.items():
        opened = np.abs(energy - energy[0] - (total - work)).max() / scale
        assert opened > 100.0 * closed or name in ("work_thrust", "work_grid"), name
    assert not works["work_thrust"].any()

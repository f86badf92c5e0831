"""The power balance closes at the stated orders, and every term of it is needed."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.orders import orders
from tests.support.verdicts import assert_holds, each
from umbilical.verify import power_balance
from umbilical.verify.cases import Case
from umbilical.verify.power_balance import WAYS, moved


@each(power_balance.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
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


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_what_the_grid_takes_vanishes_with_the_element_size(way: tuple[float, float]) -> None:
    lost = [moved(way, n, 1e-3).metrics["grid_loss"] for n in (4, 8, 16)]
    assert orders(lost).min() > 3.9
    assert lost[-1] < 1e-9

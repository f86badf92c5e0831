"""Shifted in time under control, in other units, with a winch that does not move: the same physics."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import open_loop, run
from umbilical.verify.invariance import hung, pulsed

LAW: dict[str, Any] = {"control__law": {"kind": "boundary", "damping_gain": 1e4, "slope_gain": 0.01}}


def test_a_later_load_gives_the_same_response_later() -> None:
    early, late = pulsed(1.0, **LAW), pulsed(3.0, **LAW)
    assert np.abs(early[: late.size] - late).max() < 1e-11 * np.abs(early).max()


@pytest.mark.parametrize(("length", "time", "force"), [(4.0, 2.0, 1.0), (1.0, 1.0, 8.0), (0.5, 0.25, 2.0)])
def test_units_do_not_matter(length: float, time: float, force: float) -> None:
    one, other = hung(1.0, 1.0, 1.0), hung(length, time, force)
    for name, unit in (("displacement", length), ("velocity", length / time), ("energy", force * length)):
        scale = np.abs(one[name].values).max()
        assert np.abs(other[name].values / unit - one[name].values).max() < 1e-10 * scale, name


@pytest.mark.nojit
@pytest.mark.bounds
@pytest.mark.parametrize(
    "winch",
    [
        {"law": "speed", "start_length": 400.0, "speed": 0.0},
        {"law": "quintic", "start_length": 400.0, "end_length": 400.0, "duration": 3.0},
        {"law": "table", "times": [0.0, 1.0, 2.0, 3.0], "lengths": [400.0] * 4},
    ],
    ids=lambda winch: winch["law"],
)
def test_a_winch_that_does_not_move_is_a_fixed_length(winch: dict[str, Any]) -> None:
    shape = {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5}
    moving, fixed = (
        run(open_loop(winch=law, initial=shape, duration=0.1, grid__elements=4))
        for law in (winch, {"law": "constant", "length": 400.0})
    )
    np.testing.assert_allclose(moving["displacement"].values, fixed["displacement"].values, rtol=0.0, atol=1e-14)

"""Shifted in time, in other units, at no hanging weight, with a winch that does not move: the same physics."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import constant, open_loop, run, sine
from umbilical import Run


def pulsed(preset_overrides: dict[str, Any], begin: float) -> np.ndarray:
    pulse = [{"kind": "pulse", "value": 100.0, "start": begin, "end": begin + 0.5}]
    result = run(
        open_loop(
            duration=6.0, grid__elements=8, output__interval=0.01, environment__payload_force=pulse, **preset_overrides
        )
    )
    tip = result["tip_displacement"].values
    assert not tip[result["time"].values <= begin].any()
    return tip[result["time"].values >= begin - 1e-9]


LAW = {"control__law": {"kind": "boundary", "damping_gain": 1e4, "slope_gain": 0.01}}


@pytest.mark.parametrize("control", [{}, LAW], ids=["open loop", "closed loop"])
def test_a_later_load_gives_the_same_response_later(control: dict[str, Any]) -> None:
    early, late = pulsed(control, 1.0), pulsed(control, 3.0)
    assert np.abs(early[: late.size] - late).max() < 1e-11 * np.abs(early).max()


def hung(length: float, time: float, force: float) -> Run:
    """The same cable in units of ``length`` m, ``time`` s and ``force`` N; g = 10 m/s2 in each."""
    mass = force * time**2 / length
    return run(
        open_loop(
            environment__gravity=10.0 * length / time**2,
            cable={"line_density": 2.0 * mass / length, "damping": 0.1 * mass / length / time},
            payload={"mass": 100.0 * mass, "damping": 5.0 * mass / time},
            winch={
                "law": "quintic",
                "start_length": 80.0 * length,
                "end_length": 90.0 * length,
                "duration": 4.0 * time,
            },
            initial={"shape": "sine", "amplitude": 0.5 * length},
            environment__payload_force=[constant(50.0 * force), sine(20.0 * force, 2.0 / time)],
            environment__cable_load=[{"profile": {"shape": "uniform"}, "signal": [sine(force / length, 1.0 / time)]}],
            duration=4.0 * time,
            control__period=1e-3 * time,
            grid={"elements": 8, "step": 1e-3 * time},
            output__interval=0.1 * time,
        )
    )


@pytest.mark.parametrize(
    ("length", "time", "force"), [(4.0, 2.0, 1.0), (1.0, 1.0, 8.0), (0.5, 0.25, 2.0), (3.0, 1.7, 0.3)]
)
def test_units_do_not_matter(length: float, time: float, force: float) -> None:
    one, other = hung(1.0, 1.0, 1.0), hung(length, time, force)
    for name, unit in (("displacement", length), ("velocity", length / time), ("energy", force * length)):
        scale = np.abs(one[name].values).max()
        assert np.abs(other[name].values / unit - one[name].values).max() < 1e-10 * scale, name


def test_vanishing_hanging_weight_is_constant_tension() -> None:
    """T = (m + rho_wet (l - x)) (g - a): the distance to the cable of constant tension falls with rho_wet."""

    def tip(wet: float) -> np.ndarray:
        start = {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5}
        return run(open_loop(duration=20.0, cable__wet_line_density=wet, grid__elements=8, initial=start))[
            "displacement"
        ].values

    limit = tip(0.0)
    far, near = (np.abs(tip(wet) - limit).max() for wet in (1e-2, 1e-4))
    assert near < 1e-3
    assert far / near == pytest.approx(100.0, rel=0.05)


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

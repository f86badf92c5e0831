"""Nothing that happens between two steps is stepped over: pulses, faults and jumps take effect at their instant."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import open_loop, run, small
from umbilical import Run

STEP = 1e-3
TIP_MASS = 500.0
"""The ROV, kg. The cable takes ``Z t/(2 m)`` of its momentum within t, Z = 100 N s/m: 5e-4 after 5 ms."""


def pushed(force: list[dict[str, Any]], step: float = STEP) -> Run:
    return run(
        open_loop(
            duration=0.08, grid={"elements": 4, "step": step}, output__interval=STEP, environment__payload_force=force
        )
    )


def pulse(start: float, end: float, value: float = 1e4) -> list[dict[str, Any]]:
    return [{"kind": "pulse", "value": value, "start": start, "end": end}]


@pytest.mark.nojit
@pytest.mark.bounds
@pytest.mark.parametrize(
    ("start", "width"), [(0.05, 1e-3), (0.05003, 1e-4), (0.0505, 1e-6), (0.0499, 2e-4), (0.0, 1e-4), (0.05, 1e-7)]
)
def test_a_pulse_shorter_than_a_step_leaves_its_momentum(start: float, width: float) -> None:
    result = pushed(pulse(start, start + width, value=1.0 / width))
    after = int(np.ceil((start + width) / STEP - 1e-9))
    velocity = result["tip_velocity"].values
    assert velocity[after] == pytest.approx(1.0 / TIP_MASS, rel=1e-3)
    before = int(np.floor(start / STEP + 1e-9))
    assert not velocity[: before + 1].any()


@pytest.mark.nojit
@pytest.mark.parametrize("offset", [0.0, 1e-4, 5e-4, 9.99e-4])
def test_a_jump_inside_a_step_is_as_good_as_a_fine_step(offset: float) -> None:
    force = [{"kind": "step", "value": 1000.0, "time": 0.05 + offset}]
    coarse, fine = pushed(force), pushed(force, step=STEP / 10)
    np.testing.assert_allclose(
        coarse["tip_displacement"].values, fine["tip_displacement"].values, atol=1e-6 * coarse.metrics["tip_peak"]
    )


def stuck(start: float, **more: Any) -> Run:
    """Two motors without drive or disturbance, the second stuck at 100 rad2/s2 from ``start``: 80 N."""
    quiet = {f"motors__{k}__{name}_disturbance": [] for k in (1, 2) for name in ("torque", "voltage")}
    fault = {"kind": "stuck", "motor": 2, "start": start, "value": 100.0} | more
    law = {"control__law": {"kind": "none"}, "environment__payload_force": [], "output__interval": STEP}
    return run(small("paper", faults=[fault], **quiet, **law))


JUST = 1e-4
MOMENTUM = 1e-3
"""Tolerance of the momentum a fault has given 5 ms later."""
CASES = {
    "before": 0.05 - JUST,
    "a hair before": np.nextafter(0.05, 0.0),
    "on": 0.05,
    "a hair after": np.nextafter(0.05, 1.0),
}


@pytest.mark.nojit
@pytest.mark.bounds
@pytest.mark.parametrize("start", [*CASES.values(), 0.05 + JUST], ids=[*CASES, "after"])
def test_a_fault_starts_at_its_instant(start: float) -> None:
    result = stuck(float(start))
    first = 51 if start > 0.05 + 1e-6 else 50
    thrust, effectiveness = result["thrust"].values, result["effectiveness"].values[:, 1]
    assert not thrust[:first].any()
    assert (thrust[first:] == 80.0).all()
    assert (effectiveness[:first] == 1.0).all()
    assert not effectiveness[first:].any()


@pytest.mark.nojit
@pytest.mark.parametrize("start", [*CASES.values(), 0.05 + JUST], ids=[*CASES, "after"])
def test_a_fault_acts_from_its_instant(start: float) -> None:
    """5 ms later the ROV has the momentum of exactly the time since: a tenth of a step late would show."""
    velocity = stuck(
        float(start),
    )["tip_velocity"].values[55]
    assert velocity == pytest.approx(80.0 * (0.055 - start) / TIP_MASS, rel=MOMENTUM)


@pytest.mark.nojit
def test_a_fault_from_the_start_and_one_at_the_end() -> None:
    assert (stuck(0.0)["thrust"].values == 80.0).all()
    assert not stuck(0.1)["displacement"].values.any()


@pytest.mark.nojit
def test_recovery() -> None:
    result = stuck(0.02, end=0.0405)
    assert (result["thrust"].values[20:41] == 80.0).all()
    assert not result["thrust"].values[41:].any()
    momentum = 80.0 * (0.0405 - 0.02) / TIP_MASS
    assert result["tip_velocity"].values[45] == pytest.approx(momentum, rel=5e-3)


@pytest.mark.nojit
def test_a_fault_is_measured_from_its_first_sample() -> None:
    result = stuck(0.05)
    tip = np.abs(result["tip_displacement"].values)
    assert result.metrics["tip_peak_after_fault"] == tip[50:].max() == result.metrics["tip_peak"]
    assert "tip_peak_after_fault" not in run(small("paper")).metrics


@pytest.mark.nojit
@pytest.mark.parametrize("lengths", [(100.0, 101.0), (101.0, 100.0)], ids=["paying out", "hauling in"])
def test_a_jump_of_the_winch_acceleration_is_booked(lengths: tuple[float, float]) -> None:
    """The tension jumps with g - a, and the energy with it; the works say so at the same instant."""
    winch = {
        "law": "trapezoid", "start_length": lengths[0], "end_length": lengths[1], "top_speed": 1.0,
        "acceleration": 2.0, "start": 0.0203,
    }  # fmt: skip
    result = run(
        open_loop(
            winch=winch, initial={"shape": "sine", "amplitude": 2.0}, duration=0.1, output__interval=STEP,
            grid__elements=4,
        )
    )  # fmt: skip
    energy = result["energy"].values
    jump = energy[21] - energy[20]
    assert jump / energy[20] == pytest.approx(-0.2 * np.sign(lengths[1] - lengths[0]), abs=0.01)
    assert np.abs(result["energy_residual"].values).max() < 1e-3 * abs(jump)


@pytest.mark.nojit
def test_the_sample_on_which_a_fault_falls_counts_as_after_it() -> None:
    """The ROV swings back from its greatest displacement, so the first sample after the fault is the largest."""
    shape = {"initial": {"shape": "static", "force": 200.0}, "environment__payload_force": []}
    for start, first in ((0.05, 50), (0.0500001, 51), (0.1 + 0.2 - 0.25, 50)):
        result = run(
            small("paper", faults=[{"kind": "dead", "motor": 1, "start": start}], output__interval=STEP, **shape)
        )
        tip = np.abs(result["tip_displacement"].values)
        assert (np.diff(tip) < 0.0).all()
        assert result.metrics["tip_peak_after_fault"] == tip[first]


@pytest.mark.nojit
@pytest.mark.parametrize("gap", [0.0, 5e-17, -5e-17])
def test_faults_that_meet_but_for_round_off_meet(gap: float) -> None:
    """0.1 + 0.2 is above 0.3: an end and a start that differ so are one instant, at which both sides are clean."""
    meet = 0.05
    first = {"kind": "stuck", "motor": 2, "start": 0.02, "end": meet + 4.0 * gap, "value": 100.0}
    second = {"kind": "stuck", "motor": 2, "start": meet, "value": 100.0}
    quiet = {f"motors__{k}__{name}_disturbance": [] for k in (1, 2) for name in ("torque", "voltage")}
    law = {"control__law": {"kind": "none"}, "environment__payload_force": [], "output__interval": STEP}
    result = run(small("paper", faults=[first, second], **quiet, **law))
    assert (result["thrust"].values[20:] == 80.0).all()
    assert result["tip_velocity"].values[70] == pytest.approx(stuck(0.02)["tip_velocity"].values[70], rel=1e-9)

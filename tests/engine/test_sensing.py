"""What the controller gets to see: perfect, or with latency, bias, noise, resolution and drop-outs, in this order."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.support.controllers import Recorder
from tests.support.scenarios import run, small
from umbilical import Command

pytestmark = pytest.mark.nojit


def readings(name: str, duration: float = 0.1, **sensors: Any) -> np.ndarray:
    """One channel as a controller sees it, while the ROV and the motors are driven steadily."""
    recorder = Recorder(Command(voltage=np.array([8.0, -5.0])))
    run(small("paper", duration=duration, **{f"sensors__{key}": value for key, value in sensors.items()}), recorder)
    return np.array([getattr(m, name) for m in recorder.seen], dtype=float)


def truth(name: str, duration: float = 0.1) -> np.ndarray:
    return readings(name, duration)


def test_perfect_readings_are_the_truth() -> None:
    recorder = Recorder(Command(thrust=0.0))
    scenario = small("paper", output__interval=1e-3, sensors__ideal_velocity=True)
    result = run(scenario, recorder)
    for name in ("tip_displacement", "tip_slope", "tip_velocity", "tip_slope_rate", "length", "payout_speed",
                 "payout_acceleration", "motor_speed", "motor_current"):  # fmt: skip
        np.testing.assert_array_equal([getattr(m, name) for m in recorder.seen], result[name].values, name)


def test_what_is_not_measured_is_none() -> None:
    recorder = Recorder(Command(thrust=0.0))
    run(small("paper"), recorder)
    assert {(m.tip_velocity, m.tip_slope_rate) for m in recorder.seen} == {(None, None)}


def test_latency_shows_an_older_sample() -> None:
    late = readings("tip_displacement", tip_displacement__latency=0.004)
    np.testing.assert_array_equal(late[4:], truth("tip_displacement")[:-4])
    assert (late[:4] == late[4]).all(), "before that, the first sample there is"


def test_bias() -> None:
    np.testing.assert_array_equal(readings("tip_slope", tip_slope__bias=0.01), truth("tip_slope") + 0.01)


def test_resolution() -> None:
    steps = readings("motor_speed", motor_speed__resolution=0.25) / 0.25
    np.testing.assert_array_equal(steps, np.rint(truth("motor_speed") / 0.25))
    assert np.abs(steps).max() > 10


def test_noise_has_its_size_and_no_mean() -> None:
    noise = readings("motor_current", 1.0, motor_current__noise=0.5) - truth("motor_current", 1.0)
    assert noise.std() == pytest.approx(0.5, rel=0.1)
    assert abs(noise.mean()) < 0.05
    assert abs(np.corrcoef(noise[:, 0], noise[:, 1])[0, 1]) < 0.1, "each motor has its own"
    assert abs(np.corrcoef(noise[1:, 0], noise[:-1, 0])[0, 1]) < 0.1, "each sample has its own"


def test_a_lost_reading_is_the_last_one_held() -> None:
    perfect = truth("motor_speed")
    found = readings("motor_speed", motor_speed__dropout=0.4)
    for motor in range(2):
        fresh = found[:, motor] == perfect[:, motor]
        assert fresh[0]
        assert 0.4 < fresh.mean() < 0.8
        for k in np.flatnonzero(~fresh):
            assert found[k, motor] == found[k - 1, motor]


def test_errors_come_in_their_order() -> None:
    """Latency, bias, resolution: the old sample is shifted, then rounded."""
    found = readings(
        "tip_displacement",
        tip_displacement__latency=0.002,
        tip_displacement__bias=3e-6,
        tip_displacement__resolution=1e-6,
    )
    exact = np.rint((truth("tip_displacement")[:-2] + 3e-6) / 1e-6) * 1e-6
    np.testing.assert_array_equal(found[2:], exact)


def test_errors_of_one_sensor_leave_the_others_alone() -> None:
    noisy = {"tip_displacement__noise": 0.1, "motor_current__dropout": 0.5}
    np.testing.assert_array_equal(readings("motor_speed", **noisy), truth("motor_speed"))


def test_the_seed_is_the_noise() -> None:
    a, b, c = (readings("tip_slope", tip_slope__noise=1e-3) for _ in range(3))
    np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(a, c)
    recorder = Recorder(Command(voltage=np.array([8.0, -5.0])))
    run(small("paper", seed=7, sensors__tip_slope__noise=1e-3), recorder)
    assert (np.array([m.tip_slope for m in recorder.seen]) != a).all()


@pytest.mark.parametrize("seed", range(5))
def test_the_first_reading_is_never_lost(seed: int) -> None:
    """There is nothing to hold before it; the first of a later stretch may be lost."""
    recorder = Recorder(Command(voltage=np.zeros(2)))
    shape = {"shape": "static", "force": 100.0}
    run(small("paper", seed=seed, initial=shape, sensors__tip_displacement__dropout=0.99), recorder)
    assert recorder.seen[0].tip_displacement == pytest.approx(truth_at_rest(shape), rel=1e-12)
    assert len({m.tip_displacement for m in recorder.seen}) < 10


def truth_at_rest(shape: dict[str, Any]) -> float:
    return run(small("paper", initial=shape))["tip_displacement"].values[0]

"""y -> -y: everything sideways mirrored, the response is the mirror image, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.scenarios import run, sine, small
from umbilical.verify.invariance import mirrored

EVEN = {
    "time", "length", "payout_speed", "payout_acceleration", "energy", "energy_residual", "effectiveness",
    "work_thrust", "work_payload_force", "work_payload_damping", "work_cable_damping", "work_cable_load", "work_vessel",
    "work_tension", "work_grid",
}  # fmt: skip


@pytest.mark.nojit
@pytest.mark.parametrize("preset", ["paper-none", "paper", "paper-adaptive", "paper-pd", "haul-in"])
def test_mirror_image(preset: str) -> None:
    right, left = mirrored(1.0, preset), mirrored(-1.0, preset)
    assert np.abs(right["displacement"].values).max() > 0.1
    for name in map(str, right.data.data_vars):
        if name in EVEN or (name.startswith("metric_") and name != "metric_tip_end"):
            np.testing.assert_array_equal(left[name].values, right[name].values, name)
        elif name == "kappa":  # kappa_0 multiplies the command and is even, the others are added to it
            np.testing.assert_array_equal(left[name].values[:, 0], right[name].values[:, 0], name)
            np.testing.assert_array_equal(left[name].values[:, 1:], -right[name].values[:, 1:], name)
        else:
            np.testing.assert_array_equal(left[name].values, -right[name].values, name)


@pytest.mark.nojit
@pytest.mark.parametrize("preset", ["paper", "paper-adaptive"])
def test_a_motor_mounted_the_other_way_round(preset: str) -> None:
    """K_T of the other sign, disturbances mirrored: the motor runs backwards and the ROV does not notice."""
    turned = {
        "motors__2__thrust_coefficient": -0.8,
        "motors__2__torque_disturbance": [sine(-1.0, 20.0)],
        "motors__2__voltage_disturbance": [sine(-0.2, 20.0)],
    }
    straight = {
        "motors__2__torque_disturbance": [sine(1.0, 20.0)],
        "motors__2__voltage_disturbance": [sine(0.2, 20.0)],
    }
    a, b = run(small(preset, **straight)), run(small(preset, **turned))
    for name in ("displacement", "thrust", "kappa"):
        np.testing.assert_array_equal(a[name].values, b[name].values, name)
    for name in ("motor_speed", "motor_current", "motor_voltage", "demand"):
        np.testing.assert_array_equal(a[name].values[:, 1], -b[name].values[:, 1], name)
        np.testing.assert_array_equal(a[name].values[:, 0], b[name].values[:, 0], name)

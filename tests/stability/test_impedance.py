"""The exact cable against classical results; source: verification.md items 1 to 4."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import identity
from scipy.sparse.linalg import spsolve

from tests.support.spectra import tip_response
from umbilical.engine.linear import linearise_plant
from umbilical.plant.forces import table
from umbilical.plant.forces.force import Force
from umbilical.stability.impedance import (
    FixedLengthCable,
    cable_wave_number,
    hanging_cable,
    payload_stiffness,
    upward_asymptote,
    waves_at_rov,
)
from umbilical.verify.water import string

PAPER = FixedLengthCable(2.0, 0.0, 500.0, 0.0, 5000.0, 20.0, 500.0)
CONSTANT = FixedLengthCable(2.0, 0.0, 500.0, 0.0, 5000.0, 0.0, 400.0)


def mobility(cable: FixedLengthCable, p: np.ndarray) -> np.ndarray:
    """What rings: zero at the frequencies of the cable with a free ROV."""
    w = waves_at_rov(cable, p)
    stiffness = payload_stiffness(cable, p)
    return (stiffness - w.up + w.echo * (stiffness - w.down)) / (stiffness - w.up)


@pytest.mark.parametrize(
    "frequency", [0.1536771590334, 0.483646205031, 0.8881725784718, 1.30776502146, 1.731946215684, 2.158067989623]
)
def test_it_rings_at_the_bessel_frequencies(frequency):
    assert abs(mobility(PAPER, np.array([1j * frequency]))[0]) < 1e-10
    assert abs(mobility(PAPER, np.array([1.001j * frequency]))[0]) > 1e-4


def test_static_stiffness():
    """P/y = rho g / ln((m + rho l)/m)."""
    displacement, slope = tip_response(PAPER, np.array([1e-5j]))
    assert displacement[0] == pytest.approx(np.log(3.0) / 20.0, rel=1e-6)
    assert slope[0] == pytest.approx(1.0 / 5000.0, rel=1e-6)


def test_a_force_that_holds_the_rov_is_a_spring_beside_the_cable(monkeypatch: pytest.MonkeyPatch) -> None:
    """At rest displacement per force is 1/(k + the cable's own stiffness)."""
    spring = Force("work_payload_force", "payload", stiffness=lambda scenario, at: 40.0)
    free = hanging_cable(string(400.0), 400.0)
    monkeypatch.setattr(table, "FORCES", (*table.FORCES, spring))
    held = hanging_cable(string(400.0), 400.0)
    alone, both = (tip_response(cable, np.array([1e-5j]))[0][0].real for cable in (free, held))
    assert 1.0 / both == pytest.approx(1.0 / alone + 40.0, rel=1e-6)


def test_constant_tension_with_a_mass():
    """cot b = (m/(rho l)) b with b = w l/c."""
    for b in (0.8603335890194, 3.4256184594817):  # of cot b = b: m = rho l
        cable = FixedLengthCable(2.0, 0.0, 800.0, 0.0, 5000.0, 0.0, 400.0)
        assert abs(mobility(cable, np.array([1j * b * 50.0 / 400.0]))[0]) < 1e-9


def test_a_light_cable_tends_to_constant_tension():
    p = np.array([0.3j, 2.0j])
    nearly = FixedLengthCable(2.0, 0.01, 500.0, 3.0, 5000.0, 1e-6, 400.0)
    constant = FixedLengthCable(2.0, 0.01, 500.0, 3.0, 5000.0, 0.0, 400.0)
    for one, other in zip(tip_response(nearly, p), tip_response(constant, p), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-5)


def test_reflection_of_mass_and_damper():
    """R = (Z - k - i w m)/(Z + k + i w m), the velocity's sign included."""
    cable = FixedLengthCable(2.0, 0.0, 500.0, 30.0, 5000.0, 0.0, 400.0)
    p = 1j * np.array([0.01, 0.2, 3.0])
    w = waves_at_rov(cable, p)
    stiffness = payload_stiffness(cable, p)
    expected = (100.0 - 30.0 - p * 500.0) / (100.0 + 30.0 + p * 500.0)
    np.testing.assert_allclose(-(stiffness - w.down) / (stiffness - w.up), expected, rtol=1e-12)


def test_damping_takes_its_share_of_every_round_trip():
    damped = FixedLengthCable(2.0, 0.001, 500.0, 0.0, 5000.0, 20.0, 500.0)
    echo = np.abs(waves_at_rov(damped, 1j * np.array([5.0, 50.0, 500.0])).echo)
    np.testing.assert_allclose(echo, np.exp(-0.001 / 4.0 * damped.round_trip), rtol=1e-5)


def test_the_asymptote_of_an_endless_cable_is_of_second_order():
    p = 1j * np.array([20.0, 200.0])
    miss = np.abs(upward_asymptote(PAPER, p) / waves_at_rov(PAPER, p).up - 1.0)
    assert miss[0] < 1e-5
    assert miss[0] / miss[1] == pytest.approx(100.0, rel=0.01)
    bare = np.abs(-PAPER.tip_tension * cable_wave_number(PAPER, p) / waves_at_rov(PAPER, p).up - 1.0)
    assert (bare > 50.0 * miss).all()  # the taper of the tension is needed


def test_round_trip_is_the_slope_of_the_echo():
    p = 1j * np.array([100.0, 100.001])
    echo = waves_at_rov(PAPER, p).echo
    assert PAPER.round_trip / 2.0 == pytest.approx(7.32, abs=0.001)
    assert -np.angle(echo[1] / echo[0]) / 0.001 == pytest.approx(PAPER.round_trip, rel=1e-6)


def test_pieces_of_the_same_damping_are_one_cable():
    p = np.array([1e-3 + 0.05j, 0.3j, 2.0 + 5.0j])
    whole = FixedLengthCable(2.0, 0.8, 500.0, 3.0, 5000.0, 20.0, 500.0)
    cut = FixedLengthCable(2.0, 0.8, 500.0, 3.0, 5000.0, 20.0, 500.0, pieces=((100.0, 0.8), (250.0, 0.8), (150.0, 0.8)))
    for one, other in zip(waves_at_rov(whole, p), waves_at_rov(cut, p), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-10, atol=1e-15)


def test_a_sheared_current_damps_along_the_cable_as_the_engine_has_it():
    """One even damping in its place misses the slope per force by two thirds."""
    current = {"depths": [0.0, 1000.0], "speeds": [0.5, 0.1]}
    scenario = string(1000.0, environment__water__current=current, grid__elements=32)
    plant = linearise_plant(scenario)
    p = np.array([0.01, 0.1, 1.0]) * 1j + 1e-4
    matrices = (q * identity(plant.a.shape[0], format="csc") - plant.a for q in p)
    grid = np.array([(plant.c @ spsolve(matrix.tocsc(), plant.b[:, 0].astype(complex)))[:2] for matrix in matrices]).T
    np.testing.assert_allclose(tip_response(hanging_cable(scenario, 1000.0), p), grid, rtol=5e-3)

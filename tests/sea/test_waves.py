"""Spectra, components, orbital motion, the closed-form vessel."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.sea import BoxVessel, Spectrum, discretise, heave_of_point, orbital_velocity, wave_number

SEA = Spectrum(2.5, 8.0, 3.3)


def test_periods_are_told_apart() -> None:
    assert SEA.period("peak") == 8.0
    assert SEA.period("mean") == pytest.approx(0.83434 * 8.0, rel=1e-4)
    assert SEA.period("zero_crossing") == pytest.approx(0.77741 * 8.0, rel=1e-4)


@pytest.mark.parametrize("order", [-1, 4])
def test_a_moment_that_does_not_exist_is_refused(order: int) -> None:
    with pytest.raises(ValueError, match="0 to 3 exist"):
        SEA.moment(order)


@pytest.mark.parametrize(("count", "repeats"), [(100, 1100.0), (200, 2200.0)])
def test_components_hold_the_energy_and_say_when_they_repeat(count: int, repeats: float) -> None:
    waves = discretise(SEA, count, seed=3)
    assert (waves.amplitude**2).sum() / 2.0 == pytest.approx(2.5**2 / 16.0, rel=1e-12)
    assert np.all(np.diff(waves.omega) > 0.0)
    assert waves.repeat_period == pytest.approx(repeats, rel=0.3)


def test_bins_below_the_tail_are_narrow() -> None:
    waves = discretise(SEA, 100)
    assert np.diff(waves.omega[1:-1]).max() < 0.06


def test_phases_hang_on_seed_and_number_alone() -> None:
    few, many = discretise(SEA, 50, seed=1), discretise(SEA, 200, seed=1)
    assert np.array_equal(few.phase, many.phase[: few.phase.size])
    assert not np.array_equal(few.phase, discretise(SEA, 50, seed=2).phase)
    assert not np.array_equal(few.phase, discretise(SEA, 50, seed=1, system=1).phase)


def test_random_amplitudes_have_the_energy_on_average() -> None:
    heights = [(discretise(SEA, 100, seed=k, rayleigh=True).amplitude ** 2).sum() / 2.0 for k in range(200)]
    assert np.mean(heights) == pytest.approx(2.5**2 / 16.0, rel=0.03)
    assert 0.05 < np.std(heights) / np.mean(heights) < 0.2


def test_too_few_components_are_refused() -> None:
    with pytest.raises(ValueError, match="20 or more"):
        discretise(SEA, 5)


def test_elevation_has_the_standard_deviation_of_the_sea() -> None:
    waves = discretise(SEA, 100, seed=1)
    elevation = waves.elevation(np.arange(0.0, 3600.0, 0.5))
    assert elevation.std() == pytest.approx(2.5 / 4.0, rel=0.05)


def test_dispersion_in_shallow_water_is_met() -> None:
    omega = np.array([0.3, 0.8, 2.0])
    k = wave_number(omega, water_depth=25.0)
    assert np.allclose(9.81 * k * np.tanh(25.0 * k), omega**2, rtol=1e-10)
    assert np.allclose(wave_number(omega, water_depth=1e4), omega**2 / 9.81, rtol=1e-10)


@pytest.mark.parametrize(("height", "share"), [(-20.0, 0.284), (-50.0, 0.043)])
def test_orbital_motion_fades_with_depth(height: float, share: float) -> None:
    omega = 2.0 * np.pi / 8.0
    assert orbital_velocity(omega, height) / omega == pytest.approx(share, abs=5e-4)
    assert orbital_velocity(omega, height, water_depth=2e3) == pytest.approx(orbital_velocity(omega, height), rel=1e-6)


def test_the_vessel_of_the_preset_moves_as_computed_elsewhere() -> None:
    """Sheave 10 m off midship, Hs 2.5 m, Tp 8 s, bow quarter: heave, its speed and its acceleration."""
    omega = np.linspace(0.05, 6.0, 20001)
    ship = BoxVessel(93.0, 20.0, 6.6, 0.75)
    heave = abs(heave_of_point(ship, omega, np.radians(135.0), 10.0, 0.0)) ** 2 * SEA.density(omega)
    found = [np.sqrt(np.trapezoid(heave * omega ** (2 * n), omega)) for n in range(3)]
    assert found == pytest.approx([0.333, 0.249, 0.191], rel=2e-3)


@pytest.mark.parametrize("heading", [0.3, 1.5, 2.5])
def test_a_heading_and_its_mirror_and_a_full_turn_are_alike(heading: float) -> None:
    omega, ship = np.array([0.4, 0.8, 1.2]), BoxVessel(93.0, 20.0, 6.6, 0.75)
    here = heave_of_point(ship, omega, heading, 10.0, 0.0)
    assert np.allclose(here, heave_of_point(ship, omega, -heading, 10.0, 0.0))
    assert np.allclose(here, heave_of_point(ship, omega, heading + 2.0 * np.pi, 10.0, 0.0))

"""Exact spectrum of the ideal loop: closed forms, a count of its roots, and certified rates below it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import umbilical
from tests.support.certificates import fixed
from umbilical.certificate.conditions import (
    boundary_weight,
    decay_rates,
    extent,
    largest_cross,
    rate_limit,
)
from umbilical.certificate.ideal_loop import (
    cable_modes,
    characteristic,
    energy_rate,
    highest_modes_real_part,
    law_modes,
)
from umbilical.certificate.search import best_weights
from umbilical.certificate.setting import Loop, Payout, ideal_constants

RANDOM_LOOPS = 200
PAPER = ideal_constants(fixed(5.0))


def held(length: float, gravity: float) -> Payout:
    zero = np.zeros((1, 1))
    return Payout(zero, np.full((1, 1), length), zero, zero, zero + gravity, zero)


def certified(loop: Loop, length: float) -> float:
    """Best rate, 1/s; minus infinity where there is none."""
    motion = held(length, loop.g)
    found = best_weights(loop, motion)
    return -np.inf if found is None else min(float(decay_rates(loop, motion, *found).min()), rate_limit(loop))


def random_loops(count: int) -> Iterator[tuple[Loop, float, float]]:
    """Gains, cables, ROVs and lengths over decades with their certified rate; those without one are passed over."""
    dice, water = np.random.default_rng(7), np.random.default_rng(8)
    while count:
        rho, m, length = dice.uniform(0.5, 5.0), 10.0 ** dice.uniform(1.5, 3.5), dice.uniform(50.0, 2000.0)
        beta = np.sqrt(m * 9.81 / rho) * 10.0 ** dice.uniform(-3.0, 1.0)
        c, k_a, k_s, vs = 10.0 ** dice.uniform([-4.0, -1.0, -1.0, -1.0], [-0.5, 2.0, 1.5, 1.0])
        wet, weight = rho * dice.uniform(0.0, 1.0), m * 9.81 * water.uniform(0.1, 1.0)
        loop = Loop(rho, m, 9.81, wet, weight, c, beta, m * k_a, k_s, vs)
        rate = certified(loop, length)
        if rate > 0.0:
            count -= 1
            yield loop, length, rate


def test_constant_tension_in_closed_form() -> None:
    """``lam = ln|R|/(2 tau) + i k pi/tau``, ``R = (beta - c_l)/(beta + c_l)``, without damping."""
    loop = PAPER._replace(wet=0.0, c=0.0, beta=10.0)
    modes = cable_modes(loop, 500.0)
    travel = 500.0 / 50.0
    np.testing.assert_allclose(modes.real, np.log(40.0 / 60.0) / (2.0 * travel), rtol=1e-9)
    np.testing.assert_allclose(np.sort(modes.imag), np.arange(modes.size) * np.pi / travel, rtol=1e-9, atol=1e-9)


def test_a_heavy_payload_is_the_limit_of_constant_tension() -> None:
    """Bessel functions of huge arguments, which nearly cancel, against hyperbolic ones."""
    heavy = PAPER._replace(m=1e7, k_a=1e9)
    assert energy_rate(heavy, 500.0) == pytest.approx(energy_rate(heavy._replace(wet=0.0), 500.0), rel=1e-3)


def test_gain_of_the_wave_speed_leaves_no_mode_at_constant_tension() -> None:
    loop = PAPER._replace(wet=0.0, c=0.0, beta=50.0)
    assert highest_modes_real_part(loop, 500.0) == -np.inf


@pytest.mark.parametrize("slope_gain", [0.01, 5.0, 20.0, 60.0, 300.0])
def test_no_mode_is_missed(slope_gain: float) -> None:
    """Turns of the characteristic function around a box count the roots in it: those found, and no others."""
    loop, length = PAPER._replace(beta=slope_gain, c=0.05), 500.0
    found = cable_modes(loop, length)
    upper = 0.5 * (np.sort(found.imag)[3] + np.sort(found.imag)[4])
    corners = [-1.0 - 0.02j, 0.1 - 0.02j, 0.1 + 1j * upper, -1.0 + 1j * upper]
    path = np.concatenate([np.linspace(a, b, 1500) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)])
    values = np.array([characteristic(loop, length, complex(point)) for point in path])
    turns = np.diff(np.unwrap(np.angle(values))).sum() / (2.0 * np.pi)
    inside = (found.imag < upper) & (found.real > -1.0)
    assert inside.sum() >= 4
    assert round(turns) == inside.sum()


def test_the_highest_modes_tend_to_their_limit() -> None:
    loop = PAPER._replace(beta=20.0)
    modes = cable_modes(loop, 500.0)
    highest = modes[np.argmax(modes.imag)]
    assert highest.real == pytest.approx(highest_modes_real_part(loop, 500.0), rel=0.02)


def test_the_laws_own_modes() -> None:
    """``(m lam + k_a)(lam + k_s) + k_s vs = 0``."""
    for mode in law_modes(PAPER):
        residue = (PAPER.m * mode + PAPER.k_a) * (mode + 5.0) + 5.0 * PAPER.vs
        assert abs(residue) < 1e-9 * PAPER.m * abs(mode) ** 2
    lone = law_modes(PAPER._replace(k_s=None, k_a=PAPER.k_a / 2.0))
    assert lone == pytest.approx([-PAPER.k_a / PAPER.m])


@pytest.mark.parametrize("slope_gain", [0.01, 0.1, 1.0, 5.0, 10.0, 20.0, 50.0])
def test_certified_is_within_a_factor_of_five(slope_gain: float) -> None:
    """The preset's cable with c = 0.001."""
    loop = PAPER._replace(beta=slope_gain)
    assert certified(loop, 500.0) <= energy_rate(loop, 500.0) <= 5.0 * certified(loop, 500.0)


def test_certified_never_exceeds_the_exact_decay() -> None:
    ratios = [rate / energy_rate(loop, length) for loop, length, rate in random_loops(RANDOM_LOOPS)]
    assert len(ratios) == RANDOM_LOOPS
    assert max(ratios) <= 1.0
    assert max(ratios) > 0.5, "some come near"


def test_without_its_conditions_it_would() -> None:
    """Negative control: twice what K1 and K2 allow promises more than the loop does, on many of the same loops."""
    broken = 0
    for loop, length, _ in random_loops(20):
        motion = held(length, loop.g)
        room = extent(loop, motion)
        cross = 4.0 * largest_cross(motion, room, 0.0)
        broken += min(float(decay_rates(loop, motion, cross, 0.0).min()), rate_limit(loop)) > energy_rate(loop, length)
    assert broken >= 3


def test_boundary_weight_carries_its_rate() -> None:
    """K6 at equality less its slack."""
    motion, rate = held(500.0, PAPER.g), 0.01
    eta = boundary_weight(PAPER, motion, rate)
    assert 2.0 * (eta * PAPER.k_a - 5000.0 / (2.0 * PAPER.beta)) / (eta * PAPER.m) >= rate


def test_a_simulation_decays_at_the_exact_rate() -> None:
    """Ideal loop, beta = 10, the last half of two minutes."""
    from umbilical.studies.audit import ideal_loop, lyapunov_of_run

    scenario = umbilical.load("ringdown", {"control.law.slope_gain": 10.0, "duration": 120.0})
    certificate = umbilical.certify(scenario)
    time, value = lyapunov_of_run(umbilical.simulate(ideal_loop(scenario)), certificate)
    late = time > 40.0
    slope = -np.polyfit(time[late], np.log(value[late]), 1)[0]
    assert slope == pytest.approx(certificate.exact_rate, rel=0.05)

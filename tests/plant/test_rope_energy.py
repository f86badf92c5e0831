"""Interfaces and ends of the rope only take energy, with the length moving; where a pendulum has too much tension."""

from __future__ import annotations

import os

import numpy as np
import pytest

from umbilical.plant.rope.energy import rope_energy
from umbilical.plant.rope.model import BodyData, CableData, RopeModel, fixed
from umbilical.plant.rope.rates import evaluate_rope
from umbilical.plant.rope.records import GRID
from umbilical.plant.rope.statics import node_positions

pytestmark = pytest.mark.nojit
N, LENGTH = 4, 100.0


def model_at(seed: int, *, vertical: bool, slack: float) -> RopeModel:
    """A dry rope in a state with jumps at every face: cubics in each element, a share of these slack."""
    model = RopeModel(CableData(1e6, 2.0, 15.0), BodyData(300.0, 2500.0), fixed(LENGTH), elements=N)
    dice = np.random.default_rng(seed)
    powers = (2.0 * (node_positions(1)[:, 0]) - 1.0)[:, None] ** np.arange(4)
    fields = np.einsum("jk,kie->jie", powers, dice.normal(size=(4, 6, N)))
    strain = np.where(dice.random(N) < slack, -0.2, 0.02) + 0.002 * fields[:, 2]
    place = np.stack([0.3 * fields[:, 0], 0.3 * fields[:, 1], -np.ones((5, N))], axis=1)
    place = np.stack([np.zeros((5, N)), np.zeros((5, N)), -np.ones((5, N))], axis=1) if vertical else place
    place = place / np.sqrt((place**2).sum(axis=1, keepdims=True))
    velocity = fields[:, 3:] * (np.array([0.0, 0.0, 1.0])[:, None] if vertical else 1.0)
    model.state.now[:] = np.concatenate([LENGTH * (1.0 + strain)[:, None] * place, velocity], axis=1).reshape(5, 6 * N)
    model.state.body[0] = (0.0, 0.0, 0.4) if vertical else (0.3, -0.2, 0.4)
    return model


def balance(model: RopeModel, speed: float) -> tuple[float, np.ndarray]:
    """dE/dt by differences along the rates, W, and the powers that are booked, W."""
    state, outside = model.state, model.state.outside[0]
    outside.payout_speed = speed
    outside.vessel_speed[:] = (0.0, 0.0, 0.1)
    evaluate_rope(model.rope, state, outside, np.zeros(0), model.water, 0, True)
    ends, h = [], 1e-8
    for sign in (h, -h):
        now, body = state.now + sign * state.rate, state.body[0] + sign * state.body[2]
        ends.append(rope_energy(model.rope, now[None], body[None], np.array([LENGTH + sign * speed]))[0])
    return (ends[0] - ends[1]) / (2.0 * h), state.power.copy()


@pytest.mark.parametrize("slack", [0.0, 0.5])
@pytest.mark.parametrize("speed", [0.0, 3.0, -3.0])
@pytest.mark.parametrize("seed", range(5))
def test_no_term_is_missing_for_a_moving_length(seed: int, speed: float, slack: float) -> None:
    """Up to degree 7 the weights integrate what slides through the grid exactly; then the balance is an identity."""
    rate, powers = balance(model_at(seed, vertical=True, slack=slack), speed)
    assert rate == pytest.approx(powers.sum(), abs=1e-6 * np.abs(powers).sum())
    assert powers[GRID] < 0.0


@pytest.mark.parametrize("slack", [0.0, 0.5])
@pytest.mark.parametrize("seed", range(5))
def test_waves_across_only_lose_at_interfaces(seed: int, slack: float) -> None:
    rate, powers = balance(model_at(seed, vertical=False, slack=slack), 0.0)
    assert rate == pytest.approx(powers.sum(), abs=1e-6 * np.abs(powers).sum())
    assert powers[GRID] < 0.0


@pytest.mark.parametrize("speed", [3.0, -3.0])
@pytest.mark.parametrize("seed", range(5))
def test_what_slides_through_the_grid_only_loses_at_interfaces(seed: int, speed: float) -> None:
    _, powers = balance(model_at(seed, vertical=False, slack=0.5), speed)
    assert powers[GRID] < 0.0


def swing(density: float) -> np.ndarray:
    """Excess of a pendulum's tension over its closed form, let go straight at 60 degrees, every 2 ms to the bottom."""
    mass, angle, length = 500.0, np.pi / 3.0, 50.0
    body = BodyData(mass, mass * 9.81)
    model = RopeModel(
        CableData(2e8, density, density * 9.81), body, fixed(length), elements=4,
        force=(mass * 9.81 * np.tan(angle), 0.0, 0.0),
    )  # fmt: skip
    stretch = 1.0 + mass * 9.81 * np.cos(angle) / 2e8
    straight = length * stretch * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    model.state.now[:, :12] = np.repeat(straight, 4)
    excess = []
    model.step(0.002, force=(0.0, 0.0, 0.0))
    while model.body_position[0] > 0.0:
        place = model.body_position
        exact = mass * 9.81 * (-3.0 * place[2] / np.linalg.norm(place) - 2.0 * np.cos(angle))
        excess.append(float(np.linalg.norm(model.end_pull)) / exact - 1.0)
        model.step(0.002)
    return np.array(excess)


@pytest.mark.slow
@pytest.mark.skipif(os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="a run takes an hour as plain Python")
def test_the_excess_of_a_pendulum_is_the_vibration_of_its_cable() -> None:
    """Ten times lighter, it vibrates past the body's own frequency and is less than a tenth; its mean is right."""
    light, heavy = swing(5e-4), swing(5e-3)
    assert 4e-3 < np.abs(heavy).max() < 7e-3
    assert np.abs(light).max() < 0.1 * np.abs(heavy).max()
    assert abs(heavy.mean()) < 1e-4

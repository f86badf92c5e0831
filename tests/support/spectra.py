"""Poles of the engine's step, and what the ROV answers: what tests ask of a linearised plant and of the exact cable."""

from __future__ import annotations

from typing import Any

import numpy as np

from umbilical import Scenario
from umbilical.engine.linear import linearise_plant
from umbilical.plant.multistep import EXPLICIT
from umbilical.stability.impedance import FixedLengthCable, payload_stiffness, waves_at_rov


def step_poles(scenario: Scenario, time: float = 0.0) -> Any:
    """Poles of cable and ROV as the engine's step has them, 1/s, shape (10 n + 1,), by increasing imaginary part.

    A mode that changes by the factor z in a step stands for the pole ``log(z)/step``. Waves too short for the grid
    decay fast. Arguments as for :func:`linearise_plant`.
    """
    plant = linearise_plant(scenario, time)
    products = plant.step * np.linalg.eigvals(plant.a.toarray())
    poles = np.log(np.array([_principal_root(q) for q in products])) / plant.step
    return poles[np.argsort(poles.imag)]


def _principal_root(product: complex) -> complex:
    """The factor z of a step that stands for ``exp(product)``; the other two of the method decay within steps."""
    roots = np.roots(np.append(1.0, -product * EXPLICIT[2]) - np.array([0.0, 1.0, 0.0, 0.0]))
    return roots[np.argmin(np.abs(roots - np.exp(product)))]


def tip_response(cable: FixedLengthCable, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and slope at the ROV per force on it, m/N and 1/N, at complex frequencies p."""
    echo, down, up = waves_at_rov(cable, p)
    stiffness = payload_stiffness(cable, p)
    wave = 1.0 / (stiffness - up + echo * (stiffness - down))
    return (1.0 + echo) * wave, -(up + echo * down) * wave / cable.tip_tension

"""The cable in space by other means: closed forms, shooting, elliptic integrals, characteristics, masses on springs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import ellipk

from umbilical.verify.references import integrated, roots

GRAVITY = 9.81
SEA_WATER = 1025.0


def elastic_catenary(
    length: float, weight: float, end_weight: float, pull: float, stiffness: float
) -> tuple[float, float, float]:
    """Horizontal reach and depth of the end under a horizontal ``pull`` there, m, and the tension at the top, N.

    Source: Irvine, *Cable Structures*, 2.
    """
    top = end_weight + weight * length
    reach = pull / weight * (np.arcsinh(top / pull) - np.arcsinh(end_weight / pull)) + pull * length / stiffness
    depth = (np.hypot(pull, top) - np.hypot(pull, end_weight)) / weight
    depth += (end_weight * length + 0.5 * weight * length**2) / stiffness
    return float(reach), float(depth), float(np.hypot(pull, top))


def transverse_modes(count: int, length: float, density: float, mass: float, stiffness: float) -> np.ndarray:
    """Angular frequencies of a hanging elastic cable with a free end mass, rad/s, by shooting from the top."""
    ends = np.array([0.0, length])

    def miss(omega: float) -> float:
        def slope(x: float, y: np.ndarray) -> list[float]:
            pull = (mass + density * (length - x)) * GRAVITY
            return [y[1] * (1.0 / pull + 1.0 / stiffness), -density * omega**2 * y[0]]

        place, force = integrated(slope, [0.0, 1.0], ends, method="DOP853", rtol=1e-11, atol=1e-13)[:, -1]
        return float(force - mass * omega**2 * place)

    return roots(miss, np.linspace(0.05, 0.6 * (count + 1), 40 * (count + 1)), count)


def axial_modes(count: int, length: float, density: float, mass: float, stiffness: float) -> np.ndarray:
    """Angular frequencies up and down, rad/s: ``b tan b = rho l/m``, b = w l/c."""
    ratio = density * length / mass
    found = roots(lambda b: b * np.sin(b) - ratio * np.cos(b), np.linspace(1e-6, 4.0 * count, 400), count)
    return found * np.sqrt(stiffness / density) / length


def pendulum_period(length: float, angle: float) -> float:
    """Period of a pendulum released at an angle, s, by the complete elliptic integral."""
    return float(4.0 * np.sqrt(length / GRAVITY) * ellipk(np.sin(angle / 2.0) ** 2))


def shape_in_current(
    cable: Any, body: Any, length: float, current: Callable[[float], np.ndarray]
) -> tuple[np.ndarray, float]:
    """Place of the end relative to the top, m, and the tension at the top, N, in a current that depends on the height.

    Integrated from the end upwards in the Cartesian pull; the depth of the end is a fixed point. The water that slides
    along the bent cable presses outwards, ``rho_a w^2`` times its curvature. ``cable`` has stiffness, weight, diameter,
    normal_drag, tangential_drag and added_mass, ``body`` weight and drag.
    """
    half = 0.5 * SEA_WATER * cable.diameter
    added = cable.added_mass * SEA_WATER * np.pi / 4.0 * cable.diameter**2

    def slope(_: float, y: np.ndarray) -> np.ndarray:
        size = np.linalg.norm(y[:3])
        t, u = y[:3] / size, current(float(y[5]))
        along, stretch = float(u @ t), 1.0 + size / cable.stiffness
        across = u - along * t
        load = half * cable.normal_drag * np.linalg.norm(across) * across - np.array([0.0, 0.0, cable.weight])
        load = load + half * np.pi * cable.tangential_drag * abs(along) * along * t
        sideways = load - (load @ t) * t
        load = (load @ t) * t + sideways / (1.0 - added * along**2 / (stretch * size))
        return np.concatenate([load, -stretch * t])

    height, end = -length, np.zeros(6)
    for _ in range(60):
        u = current(height)
        pull = np.array(body.drag) * np.abs(u) * u - np.array([0.0, 0.0, body.weight])
        start = np.concatenate([pull, [0.0, 0.0, height]])
        end = integrated(slope, start, np.array([0.0, length]), rtol=1e-11, atol=1e-9)[:, -1]
        if abs(end[5]) < 1e-9:
            break
        height -= end[5]
    return np.array([-end[3], -end[4], height]), float(np.linalg.norm(end[:3]))


def thrown_body(impedance: float, mass: float, travel: float, speed: float, t: np.ndarray) -> tuple[np.ndarray, ...]:
    """Tension above the preload at the body and at the fixed top, N, of a body that starts downwards; t < 4 travel.

    Characteristics: the body sends ``out = in + Z V``, the top sends all of it back, and m V' = -(2 in + Z V).
    """
    rate = impedance / mass

    def out(tau: np.ndarray) -> np.ndarray:
        late = tau - 2.0 * travel
        first = impedance * speed * np.exp(-rate * tau)
        again = impedance * speed * np.exp(-rate * late) * (np.exp(-2.0 * rate * travel) + 1.0 - 2.0 * rate * late)
        return np.where(tau < 0.0, 0.0, np.where(late < 0.0, first, again))

    body = out(t) + out(t - 2.0 * travel)
    return body, 2.0 * out(t - travel)


def wave_on_body(impedance: float, mass: float, speed: float, omega: float, tau: np.ndarray) -> np.ndarray:
    """Tension above the preload at a body that a heave velocity ``speed cos(w tau)`` reaches at tau = 0, N.

    ``m V' = T``, ``T = 2 Z v - Z V`` upwards, before any echo.
    """
    rate = impedance / mass
    cosine, sine, share = np.cos(omega * tau), np.sin(omega * tau), 2.0 * rate / (rate**2 + omega**2)
    velocity = speed * share * (rate * cosine + omega * sine - rate * np.exp(-rate * tau))
    return np.where(tau < 0.0, 0.0, 2.0 * impedance * speed * cosine - impedance * velocity)


def heaved_masses(
    cable: Any, body: Any, length: float, heave: Callable[[Any], Any], times: np.ndarray, masses: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tension at the top, N, height of the body, m, and the tension at the body, N, of masses on springs without push.

    ``heave`` gives the place of the sheave, m; ``cable`` has stiffness, density, weight, diameter and tangential_drag,
    ``body`` mass, added_mass, weight and drag.
    """
    step, inertia = length / masses, body.mass + body.added_mass

    def lumped(line: float, end: float) -> np.ndarray:
        return np.append(np.full(masses - 1, line * step), 0.5 * line * step + end)

    mass, load = lumped(cable.density, inertia), lumped(cable.weight, body.weight)
    drag = lumped(0.5 * SEA_WATER * np.pi * cable.diameter * cable.tangential_drag, body.drag)

    def pulls(t: Any, z: np.ndarray) -> np.ndarray:
        return cable.stiffness * np.maximum(-np.diff(z, prepend=heave(t)[..., None]) / step - 1.0, 0.0)

    def slope(t: Any, y: np.ndarray) -> np.ndarray:
        z, v = np.split(y.T, 2, axis=-1)
        net = -np.diff(pulls(t, z), append=0.0) - load - drag * np.abs(v) * v
        return np.concatenate([v, net / mass], axis=-1).T

    start = -np.cumsum(step * (1.0 + np.cumsum(load[::-1])[::-1] / cable.stiffness))
    found = integrated(slope, np.append(start, np.zeros(masses)), times, method="RK45", rtol=1e-6, atol=1e-7)
    at_top = pulls(times, found[:masses].T)[:, 0] + 0.5 * step * cable.weight
    at_body = inertia * slope(times, found)[-1] + body.weight + body.drag * np.abs(found[-1]) * found[-1]
    return at_top, found[masses - 1], at_body

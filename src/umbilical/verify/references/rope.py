"""The cable in space by other means: closed forms, shooting, elliptic integrals, characteristics, masses on springs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipk

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


def transverse_modes(count: int, length: float, density: float, mass: float, stiffness: float = np.inf) -> list[float]:
    """Angular frequencies of a hanging elastic cable with a free end mass, rad/s, by shooting from the top."""

    def miss(omega: float) -> float:
        def slope(x: float, y: np.ndarray) -> list[float]:
            pull = (mass + density * (length - x)) * GRAVITY
            return [y[1] * (1.0 / pull + 1.0 / stiffness), -density * omega**2 * y[0]]

        end = solve_ivp(slope, (0.0, length), [0.0, 1.0], method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
        return float(end[1] - mass * omega**2 * end[0])

    return _roots(miss, np.linspace(0.05, 0.6 * (count + 1), 40 * (count + 1)), count)


def axial_modes(count: int, length: float, density: float, mass: float, stiffness: float) -> list[float]:
    """Angular frequencies up and down, rad/s: ``b tan b = rho l/m``, b = w l/c."""
    speed = np.sqrt(stiffness / density)
    ratio = density * length / mass
    found = _roots(lambda b: float(b * np.sin(b) - ratio * np.cos(b)), np.linspace(1e-6, 4.0 * count, 400), count)
    return [float(b * speed / length) for b in found]


def _roots(function: Callable[[float], float], grid: np.ndarray, count: int) -> list[float]:
    values = np.array([function(float(x)) for x in grid])
    places = np.flatnonzero(values[1:] * values[:-1] < 0.0)[:count]
    roots: list[Any] = [brentq(function, float(grid[k]), float(grid[k + 1]), xtol=1e-14) for k in places]
    return [float(root) for root in roots]


def pendulum_period(length: float, angle: float) -> float:
    """Period of a pendulum released at an angle, s, by the complete elliptic integral."""
    return float(4.0 * np.sqrt(length / GRAVITY) * ellipk(np.sin(angle / 2.0) ** 2))


class Towed(NamedTuple):
    """A cable in a current that depends on the height; SI units."""

    stiffness: float
    weight: float
    diameter: float
    normal: float
    tangential: float
    added_mass: float
    length: float
    end_weight: float
    end_drag: tuple[float, float, float]


def shape_in_current(cable: Towed, current: Callable[[float], np.ndarray]) -> tuple[np.ndarray, float]:
    """Place of the end relative to the top, m, and the tension at the top, N.

    Integrated from the end upwards in the Cartesian pull; the depth of the end is a fixed point. The water that slides
    along the bent cable presses outwards, ``rho_a w^2`` times its curvature.
    """
    half = 0.5 * SEA_WATER * cable.diameter
    added = cable.added_mass * SEA_WATER * np.pi / 4.0 * cable.diameter**2

    def slope(s: float, y: np.ndarray) -> np.ndarray:
        size = np.linalg.norm(y[:3])
        t, u = y[:3] / size, current(float(y[5]))
        along, stretch = float(u @ t), 1.0 + size / cable.stiffness
        across = u - along * t
        load = half * cable.normal * np.linalg.norm(across) * across
        load = load + half * np.pi * cable.tangential * abs(along) * along * t - np.array([0.0, 0.0, cable.weight])
        sideways = load - (load @ t) * t
        load = (load @ t) * t + sideways / (1.0 - added * along**2 / (stretch * size))
        return np.concatenate([load, -stretch * t])

    height, end = -cable.length, np.zeros(6)
    for _ in range(60):
        u = current(height)
        pull = np.array(cable.end_drag) * np.abs(u) * u - np.array([0.0, 0.0, cable.end_weight])
        start = np.concatenate([pull, [0.0, 0.0, height]])
        end = solve_ivp(slope, (0.0, cable.length), start, rtol=1e-11, atol=1e-9).y[:, -1]
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
    cosine, sine = np.cos(omega * tau), np.sin(omega * tau)
    share = 2.0 * rate / (rate**2 + omega**2)
    velocity = speed * share * (rate * cosine + omega * sine - rate * np.exp(-rate * tau))
    return np.where(tau < 0.0, 0.0, 2.0 * impedance * speed * cosine - impedance * velocity)


class Heaved(NamedTuple):
    """A vertical cable with a body in water, for :func:`heaved_masses`; SI units."""

    stiffness: float
    density: float
    weight: float
    tangential: float
    length: float
    inertia: float
    end_weight: float
    end_drag: float


def heaved_masses(
    cable: Heaved, heave: Callable[[float], tuple[float, float]], times: np.ndarray, masses: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tension at the top, N, height of the body, m, and the tension at the body, N, of masses on springs without push.

    ``heave`` gives place and velocity of the sheave, m and m/s; ``tangential`` is the drag per metre over the square.
    """
    step = cable.length / masses
    mass = np.full(masses, cable.density * step)
    mass[-1] = 0.5 * cable.density * step + cable.inertia
    load = np.full(masses, cable.weight * step)
    load[-1] = 0.5 * cable.weight * step + cable.end_weight
    drag = np.full(masses, cable.tangential * step)
    drag[-1] = 0.5 * cable.tangential * step + cable.end_drag

    def pulls(z: np.ndarray, top: float) -> np.ndarray:
        gaps = np.concatenate([[top], z[:-1]]) - z
        return cable.stiffness * np.maximum(gaps / step - 1.0, 0.0)

    def slope(t: float, y: np.ndarray) -> np.ndarray:
        z, v = y[:masses], y[masses:]
        pull = pulls(z, heave(t)[0])
        net = pull - np.append(pull[1:], 0.0) - load - drag * np.abs(v) * v
        return np.concatenate([v, net / mass])

    below = np.cumsum(load[::-1])[::-1]
    start = -np.cumsum(step * (1.0 + below / cable.stiffness))
    state = np.concatenate([start, np.zeros(masses)])
    options: dict[str, Any] = {"method": "RK45", "rtol": 1e-6, "atol": 1e-7}
    found = solve_ivp(slope, (0.0, float(times[-1])), state, t_eval=times, **options).y
    every = np.array([pulls(found[:masses, k], heave(float(t))[0]) for k, t in enumerate(times)])
    rates = [slope(float(t), found[:, k])[2 * masses - 1] for k, t in enumerate(times)]
    at_top = every[:, 0] + 0.5 * step * cable.weight
    speed = found[-1]
    at_body = cable.inertia * np.array(rates) + cable.end_weight + cable.end_drag * np.abs(speed) * speed
    return at_top, found[masses - 1], at_body

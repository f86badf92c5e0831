"""Waves, vessel and heaving cable by other means: quadrature to many digits, masses on springs, iteration."""

from __future__ import annotations

from typing import Any, NamedTuple

import mpmath
import numpy as np

GRAVITY = 9.81
Array = np.ndarray


def _jonswap(gamma: float, order: int) -> Any:
    """Moment of the shape for Hs = wp = 1 without A, to 20 digits."""

    def integrand(x: Any) -> Any:
        width = mpmath.mpf("0.07") if x <= 1 else mpmath.mpf("0.09")
        peak = mpmath.exp(-(((x - 1) / width) ** 2) / 2)
        return mpmath.mpf(5) / 16 * x ** (order - 5) * mpmath.exp(-mpmath.mpf(5) / 4 / x**4) * mpmath.mpf(gamma) ** peak

    return mpmath.quad(integrand, [0.1, 0.5, 0.8, 1.0, 1.2, 1.5, 3.0, mpmath.inf])


def peakedness_factor(gamma: float) -> float:
    """A of JONSWAP: 1/16 over the integral of the shape for Hs = wp = 1, to 20 digits."""
    with mpmath.workdps(20):
        return float(1 / (16 * _jonswap(gamma, 0)))


def pierson_moskowitz_ratios() -> tuple[float, float]:
    """T1/Tp and Tz/Tp of Pierson-Moskowitz by Gamma functions."""
    mean = 1.0 / (mpmath.mpf(5) / 4) ** 0.25 / mpmath.gamma(0.75)
    crossing = 1.0 / mpmath.sqrt(mpmath.sqrt(mpmath.mpf(5) / 4) * mpmath.gamma(0.5))
    return float(mean), float(crossing)


def jonswap_ratios(gamma: float) -> tuple[float, float]:
    """T1/Tp and Tz/Tp of JONSWAP."""
    with mpmath.workdps(20):
        zeroth, first, second = (_jonswap(gamma, order) for order in range(3))
        return float(zeroth / first), float(mpmath.sqrt(zeroth / second))


class SpringMasses(NamedTuple):
    """A cable as masses on springs with a body at its end; SI units."""

    stiffness: float
    line_density: float
    mass: float
    length: float
    masses: int = 2000


WORK_CLASS = SpringMasses(2.6e7, 5.412, 17000.0, 3000.0, 600)
"""The work-class umbilical with its body, added mass included."""


def heave_of_masses(cable: SpringMasses, damping: float, omega: Array) -> tuple[Array, Array, Array]:
    """Heave of the body, tension at the body and at the sheave per metre of heave, by a march from the body upwards."""
    step = cable.length / cable.masses
    spring, each = cable.stiffness / step, cable.line_density * step
    place = np.ones_like(omega) + 0j
    pull = place * (omega**2 * (cable.mass + each / 2.0) - 1j * omega * damping)
    end = pull - omega**2 * each / 2.0
    for number in range(cable.masses):
        place = place - pull / spring
        if number < cable.masses - 1:
            pull = pull + omega**2 * each * place
    return 1.0 / place, end / place, (pull + omega**2 * each / 2.0 * place) / place


def heave_with_drag(cable: SpringMasses, drag: float, omega: Array, variance: Array) -> tuple[Array, Array, Array]:
    """The same with quadratic drag, linearised for a heave of that ``variance`` at each frequency, m2, by iteration."""
    velocity = 0.5
    for _ in range(200):
        found = heave_of_masses(cable, drag * np.sqrt(8.0 / np.pi) * velocity, omega)
        last, velocity = velocity, float(np.sqrt(np.sum(variance * abs(omega * found[0]) ** 2)))
        if abs(velocity - last) < 1e-9:
            break
        velocity = 0.5 * (velocity + last)
    return found


def ship_heave(omega: Array, heading: float, forward: float) -> Array:
    """Size of the sheave's heave of the work-class vessel: heave and pitch of the closed form are in quadrature."""
    length, wide, draught = 93.0, 15.0, 6.6
    k = omega * omega / GRAVITY
    ke = k * abs(np.cos(heading))
    wave = 2.0 * np.sin(k * wide / 2.0) * np.exp(-k * draught)
    radiation = wave**2 / (k * wide)
    common = np.exp(-ke * draught) * np.sqrt((1.0 - k * draught) ** 2 + radiation**2)
    common = common / np.sqrt((1.0 - 2.0 * k * draught) ** 2 + radiation**2)
    x = ke * length / 2.0
    heave = common * np.sin(x) / x
    pitch = common * 6.0 / (length * x) * (np.sin(x) / x - np.cos(x))
    return np.sqrt(heave**2 + (forward * pitch) ** 2)


CONVENTIONS: dict[str, dict[str, Any]] = {
    "lag, y to port": {"phase": "lag", "axes": "port_up", "waves": "towards"},
    "lead, y to starboard, from": {"phase": "lead", "axes": "starboard_down", "waves": "from"},
    "per slope, origin and point elsewhere": {
        "phase": "lead", "axes": "port_up", "waves": "towards", "rotations": "per_slope",
        "phase_origin": (30.0, 5.0), "motion_point": (-12.0, 3.0, 4.0),
    },
}  # fmt: skip
"""What makers of tables declare: how a row is to be read."""


def rao_rows(ship: Any, convention: dict[str, Any]) -> dict[str, Any]:
    """Rows of a table that says in a convention what ``ship.motions`` says; headings 0 to 180 degrees, 25 to 2.4 s."""
    down, slope = convention["axes"] == "starboard_down", convention.get("rotations") == "per_slope"
    x, y, z = convention.get("motion_point", (0.0, 0.0, 0.0))
    ahead, aside = convention.get("phase_origin", (0.0, 0.0))
    omega = np.array([0.25, 0.32, 0.4, 0.5, 0.6, 0.7, 0.85, 1.1, 1.5, 2.0, 2.6])
    number, rows = omega**2 / GRAVITY, {}
    for towards in np.radians(np.arange(0, 181, 15)):
        surge, sway, heave, roll, pitch, yaw = ship.motions(omega, towards)
        there = {"surge": surge + pitch * z - yaw * y, "sway": sway + yaw * x - roll * z,
                 "heave": heave + roll * y - pitch * x, "roll": roll, "pitch": pitch, "yaw": yaw}  # fmt: skip
        crest = np.exp(-1j * number * (ahead * np.cos(towards) + aside * np.sin(towards)))
        heading = towards - np.pi if convention["waves"] == "from" else towards
        columns = {"heading": np.full(omega.size, -heading if down else heading), "frequency": omega}
        for name, value in there.items():
            turned = -value if down and name in ("sway", "heave", "pitch", "yaw") else value
            turned = turned / crest / (number if slope and name in ("roll", "pitch", "yaw") else 1.0)
            phase = np.angle(turned if convention["phase"] == "lead" else np.conj(turned))
            columns |= {name: np.abs(turned), f"{name}_phase": phase}
        for name, values in columns.items():
            rows[name] = (*rows.get(name, ()), *values.tolist())
    return {"kind": "rao", **convention, **rows}


def work_class_statistics(height: float, depth: float, heading: float) -> dict[str, float]:
    """Rms of tension and body, and the probability of slack in three hours, Tp 8 s; drag by fixed-point iteration."""
    omega, peak = np.arange(0.2, 4.0, 0.002), 2.0 * np.pi / 8.0
    width = np.where(omega <= peak, 0.07, 0.09)
    gain = 3.3 ** np.exp(-(((omega - peak) / (width * peak)) ** 2) / 2.0)
    sea = 5.0 / 16.0 * height**2 * peak**4 / omega**5 * np.exp(-1.25 * (peak / omega) ** 4) * gain
    heave = sea * peakedness_factor(3.3) * ship_heave(omega, heading, 10.0) ** 2 * 0.002
    answers = heave_with_drag(WORK_CLASS._replace(length=depth), 4500.0, omega, heave)
    body, end, top = (float(np.sqrt(np.sum(heave * abs(answer) ** 2))) for answer in answers)
    rate = np.sqrt(np.sum(heave * abs(answers[1] * omega) ** 2)) / end / (2.0 * np.pi)
    slack = -np.expm1(-10800.0 * rate * np.exp(-(35e3**2) / (2.0 * end**2)))
    return {"body": body, "end": end, "top": top, "slack": float(slack)}


def masses_in_waves(
    cable: SpringMasses, drag: float, omega: Array, waves: Array, window: tuple[float, float], masses: int = 40
) -> Array:
    """Rms of the tension at top and body, N, and of the body's heave, m, between two instants; leapfrog.

    Quadratic drag. The sheave heaves by the real part of ``sum(waves exp(i omega t))``, m, faded in over a minute.
    """
    step, dt, block = cable.length / masses, 0.02, 5000
    spring, mass = cable.stiffness / step, np.full(masses, cable.line_density * step)
    half = 0.5 * cable.line_density * step
    mass[-1] = half + cable.mass
    place, speed, rows = np.zeros(masses), np.zeros(masses), []
    for begin in range(0, round(window[1] / dt), block):
        t = dt * (begin + np.arange(block))
        q = np.clip(t / 60.0, 0.0, 1.0)
        turning = waves * np.exp(1j * np.outer(t, omega))
        top, lift = q * q * (3.0 - 2.0 * q) * np.real(turning.sum(axis=1)), -np.real(turning @ omega**2)
        for i in range(block):
            pull = spring * (np.concatenate([top[i : i + 1], place[:-1]]) - place)
            net = pull.copy()
            net[:-1] -= pull[1:]
            net[-1] -= drag * abs(speed[-1]) * speed[-1]
            rate = net / mass
            speed += dt * rate
            place += dt * speed
            if i % 10 == 0 and t[i] >= window[0]:
                rows.append((pull[0] + half * lift[i], pull[-1] - half * rate[-1], place[-1]))
    return np.std(rows, axis=0)

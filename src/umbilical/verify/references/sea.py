"""Waves, vessel and heaving cable by other means: quadrature to many digits, masses on springs, iteration."""

from __future__ import annotations

from typing import Any, NamedTuple

import mpmath
import numpy as np

GRAVITY = 9.81


def peakedness_factor(gamma: float) -> float:
    """A of JONSWAP: 1/16 over the integral of the shape for Hs = wp = 1, to 20 digits."""

    def integrand(x: Any) -> Any:
        width = mpmath.mpf("0.07") if x <= 1 else mpmath.mpf("0.09")
        peak = mpmath.exp(-(((x - 1) / width) ** 2) / 2)
        return mpmath.mpf(5) / 16 / x**5 * mpmath.exp(-mpmath.mpf(5) / 4 / x**4) * mpmath.mpf(gamma) ** peak

    with mpmath.workdps(20):
        energy: Any = mpmath.quad(integrand, [0.1, 0.5, 0.8, 1.0, 1.2, 1.5, 3.0, mpmath.inf])
        return float(1 / (16 * energy))


def pierson_moskowitz_ratios() -> tuple[float, float]:
    """T1/Tp and Tz/Tp of Pierson-Moskowitz by Gamma functions."""
    mean = 1.0 / (mpmath.mpf(5) / 4) ** 0.25 / mpmath.gamma(0.75)
    crossing = 1.0 / mpmath.sqrt(mpmath.sqrt(mpmath.mpf(5) / 4) * mpmath.gamma(0.5))
    return float(mean), float(crossing)


def jonswap_ratios(gamma: float) -> tuple[float, float]:
    """T1/Tp and Tz/Tp of JONSWAP by a fine trapezoidal rule in log(w/wp), and the tail's closed form."""
    log = np.linspace(np.log(0.2), np.log(50.0), 2_000_001)
    x = np.exp(log)
    width = np.where(x <= 1.0, 0.07, 0.09)
    shape = x**-5 * np.exp(-1.25 * x**-4) * gamma ** np.exp(-(((x - 1.0) / width) ** 2) / 2.0)
    moment = [np.trapezoid(shape * x ** (n + 1), log) + 50.0 ** (n - 4) / (4 - n) for n in range(3)]
    return float(moment[0] / moment[1]), float(np.sqrt(moment[0] / moment[2]))


class SpringMasses(NamedTuple):
    """A cable as masses on springs with a body at its end; SI units."""

    stiffness: float
    line_density: float
    mass: float
    length: float
    masses: int = 2000


WORK_CLASS = SpringMasses(2.6e7, 5.412, 17000.0, 3000.0, 600)
"""The work-class umbilical with its body, added mass included."""


def heave_of_masses(
    cable: SpringMasses, damping: float, omega: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
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


def heave_with_drag(
    cable: SpringMasses, drag: float, omega: np.ndarray, amplitude: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The same with quadratic drag, linearised for sines of the sheave, m, by fixed-point iteration."""
    velocity = 0.5
    for _ in range(200):
        found = heave_of_masses(cable, drag * np.sqrt(8.0 / np.pi) * velocity, omega)
        moving = np.sqrt(np.sum(abs(omega * found[0] * amplitude) ** 2) / 2.0)
        velocity = 0.5 * (velocity + float(moving))
    return found


def ship_heave(omega: np.ndarray, heading: float, forward: float) -> np.ndarray:
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
    rows: dict[str, list[float]] = {name: [] for name in ("heading", "frequency")}
    for degrees in range(0, 181, 15):
        for omega in [0.25, 0.32, 0.4, 0.5, 0.6, 0.7, 0.85, 1.1, 1.5, 2.0, 2.6]:
            towards = degrees * np.pi / 180.0
            surge, sway, heave, roll, pitch, yaw = (part[0] for part in ship.motions(np.array([omega]), towards))
            x, y, z = convention.get("motion_point", (0.0, 0.0, 0.0))
            there = {"surge": surge + pitch * z - yaw * y, "sway": sway + yaw * x - roll * z,
                     "heave": heave + roll * y - pitch * x, "roll": roll, "pitch": pitch, "yaw": yaw}  # fmt: skip
            number = omega**2 / GRAVITY
            ahead, aside = convention.get("phase_origin", (0.0, 0.0))
            crest = np.exp(-1j * number * (ahead * np.cos(towards) + aside * np.sin(towards)))
            heading = towards - np.pi if convention["waves"] == "from" else towards
            rows["heading"].append(-heading if down else heading)
            rows["frequency"].append(omega)
            for name, value in there.items():
                turned = -value if down and name in ("sway", "heave", "pitch", "yaw") else value
                turned = turned / crest / (number if slope and name in ("roll", "pitch", "yaw") else 1.0)
                ahead_of_crest = float(np.angle(turned))
                rows.setdefault(name, []).append(float(abs(turned)))
                phase = ahead_of_crest if convention["phase"] == "lead" else -ahead_of_crest
                rows.setdefault(f"{name}_phase", []).append(phase)
    return {"kind": "rao", **convention, **{name: tuple(values) for name, values in rows.items()}}


def work_class_statistics(height: float, depth: float, heading: float) -> dict[str, float]:
    """Rms of tension and body, and the probability of slack in three hours, Tp 8 s; drag by fixed-point iteration."""
    omega = np.arange(0.2, 4.0, 0.002)
    peak = 2.0 * np.pi / 8.0
    width = np.where(omega <= peak, 0.07, 0.09)
    gain = 3.3 ** np.exp(-(((omega - peak) / (width * peak)) ** 2) / 2.0)
    sea = 5.0 / 16.0 * height**2 * peak**4 / omega**5 * np.exp(-1.25 * (peak / omega) ** 4) * gain
    heave = sea * peakedness_factor(3.3) * ship_heave(omega, heading, 10.0) ** 2 * 0.002
    cable, velocity = WORK_CLASS._replace(length=depth), 0.5
    for _ in range(100):
        body, end, top = heave_of_masses(cable, 4500.0 * np.sqrt(8.0 / np.pi) * velocity, omega)
        last, velocity = velocity, float(np.sqrt(np.sum(heave * abs(omega * body) ** 2)))
        if abs(velocity - last) < 1e-9:
            break
        velocity = 0.5 * (velocity + last)
    zeroth, second = (float(np.sum(heave * abs(end) ** 2 * omega**n)) for n in (0, 2))
    events = 10800.0 * np.sqrt(second / zeroth) / (2.0 * np.pi) * np.exp(-(35e3**2) / (2.0 * zeroth))
    return {
        "body": float(np.sqrt(np.sum(heave * abs(body) ** 2))),
        "top": float(np.sqrt(np.sum(heave * abs(top) ** 2))),
        "end": float(np.sqrt(zeroth)),
        "slack": float(-np.expm1(-events)),
    }


def masses_in_waves(
    cable: SpringMasses,
    drag: float,
    omega: np.ndarray,
    waves: np.ndarray,
    window: tuple[float, float],
    masses: int = 40,
) -> np.ndarray:
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

"""The rope at rest and in small motions against closed forms, shooting and integration along the cable."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.linalg import norm
from numpy.polynomial import Polynomial
from scipy.integrate import simpson

from umbilical.library import load
from umbilical.plant.layout import WEIGHTS
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, SteadyCurrent, fixed
from umbilical.plant.rope.statics import put_shape
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Check, Checks, close, small
from umbilical.verify.references import rope as reference
from umbilical.verify.references.sea import SpringMasses, heave_of_masses
from umbilical.verify.whole_loop import CODES, PEAKS

CASES = Cases()
G = 9.81
COMPUTED = "computed with the case"
Law = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Of arrays of time: a length or a place, and its rate."""


def recorded(model: RopeModel, dt: float, count: int, read: Callable[[], Any]) -> np.ndarray:
    """What ``read`` says after each of ``count`` steps of a model, s."""
    rows = []
    for _ in range(count):
        model.step(dt)
        rows.append(read())
    return np.array(rows)


def left_over(model: RopeModel, before: float) -> float:
    """Energy less what it was and less all work since, J."""
    return model.energy - before - sum(model.works.values())


def steady(length: float) -> Law:
    """A winch that stands still."""
    return fixed(length).length


def quintic_winch(start: float, end: float, duration: float) -> Law:
    """A winch law without jerks at its ends."""
    out = start + (end - start) * Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])

    def law(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        q = np.clip(t / duration, 0.0, 1.0)
        return out(q), out.deriv()(q) / duration

    return law


def waving(waves: dict[int, tuple[float, float]], ramp: float) -> Law:
    """Place and velocity of the sheave: amplitude, m, and frequency, rad/s, along some axes, faded in over it, s."""

    def motion(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        t = np.asarray(t, dtype=float)
        q = np.clip(t / ramp, 0.0, 1.0)
        fade, fade_rate = q * q * (3.0 - 2.0 * q), 6.0 * q * (1.0 - q) / ramp
        place, speed = np.zeros((2, *t.shape, 3))
        for axis, (amplitude, omega) in waves.items():
            sine, cosine = amplitude * np.sin(omega * t), amplitude * omega * np.cos(omega * t)
            place[..., axis], speed[..., axis] = fade * sine, fade * cosine + fade_rate * sine
        return place, speed

    return motion


@CASES.add("rope, crosscheck", "two codes of the string", CODES[1])
def _crosscheck() -> Checks:
    """The peak that two codes of the string agree on, of the rope with all its motion in space."""
    run = engine.finished(load("crosscheck-none", {"model": "rope", "cable.axial_stiffness": 5e8}))
    exact = PEAKS["crosscheck-none"]
    yield close("peak of |y(l,t)|, m", run.metrics["tip_peak"], exact, 1e-3, "EA 5e8, printed digits")


@CASES.add("rope, free flight over slack", "closed form", "Newton")
def _flight() -> Checks:
    """A body is thrown up, its cable goes slack, and it is pushed down: a slack cable neither pulls nor brakes."""
    model = RopeModel(CableData(2e7, 3.0, 3.0 * G), BodyData(500.0, 500.0 * G), fixed(100.0))
    start = model.body_position[2]
    model.state.body[0] = (0.0, 0.0, 2.0)
    model.step(0.1)
    model.step(0.1, force=(0.0, 0.0, -12e3))
    yield close("velocity after 0.2 s, m/s", model.body_velocity[2], 2.0 - 0.2 * G - 2.4, 1e-9, "free flight")
    height = 0.4 - 0.02 * G - 0.12
    yield close("height after 0.2 s, m", model.body_position[2] - start, height, 1e-9, "free flight")


@CASES.add("rope, elastic catenary", "closed form", "Irvine, Cable Structures, 2")
def _catenary() -> Checks:
    """An elastic catenary under a horizontal force on the body."""
    model = RopeModel(CableData(2e7, 3.0, 20.0), BodyData(400.0, 3000.0), fixed(500.0), force=(4000.0, 0.0, 0.0))
    (reach, _, height), exact = model.body_position, reference.elastic_catenary(500.0, 20.0, 3000.0, 4000.0, 2e7)
    names = ("reach of the body, m", "depth of the body, m", "tension at the top, N")
    for name, ours, theirs in zip(names, (reach, -height, model.tension[0]), exact, strict=True):
        yield close(name, ours, theirs, 1e-6, "the state of the grid that keeps still")


@CASES.add("rope, modes of the hanging cable", "shooting; b tan b = rho l/m", COMPUTED)
def _modes() -> Checks:
    """Frequencies of the hanging cable, of the engine's own rates, each in two planes."""
    model = RopeModel(CableData(2e7, 2.0, 2.0 * G), BodyData(500.0, 500.0 * G), fixed(500.0), elements=8)
    found = model.modes()
    undamped = np.imag(found[np.abs(np.real(found)) < 1e-3 * np.abs(found)])
    exact = np.repeat(reference.transverse_modes(4, 500.0, 2.0, 500.0, 2e7), 2)
    yield close("four transverse modes, twice, rad/s", undamped[:8], exact, 1e-6, "8 elements")
    axial = reference.axial_modes(2, 500.0, 2.0, 500.0, 2e7)
    nearest = [undamped[np.argmin(np.abs(undamped - omega))] for omega in axial]
    yield close("two axial modes, rad/s", nearest, axial, 2e-4, "8 elements, static stretch left out")


@CASES.add("rope, pendulum of 60 degrees", "elliptic integral", "textbook")
def _pendulum() -> Checks:
    """A heavy body on a light cable let go at 60 degrees: its period, and its tension down to the bottom.

    It starts in the shape in which it swings: straight, it would vibrate across, and the stretch of that beats in the
    tension (docs/rope.md).
    """
    angle, mass, length = np.pi / 3.0, 500.0, 50.0
    model, rows = _bent_pendulum(angle, mass, 5e-3, length), [np.ones(3)]
    while rows[-1][1] > 0.0:
        x, _, z = recorded(model, 0.01, 1, lambda: model.body_position)[0]
        exact = mass * G * (-3.0 * z / norm(model.body_position) - 2.0 * np.cos(angle))
        rows.append(np.array([model.time, x, norm(model.end_pull) / exact - 1.0]))
    times, places, excess = np.transpose(rows[1:])
    crossing = times[-2] + 0.01 * places[-2] / (places[-2] - places[-1])
    yield close("period, s", 4.0 * crossing, reference.pendulum_period(length, angle), 5e-4, "EA 2e8 for no stretch")
    what = "largest excess of the tension over m g (3 cos - 2 cos 60)"
    yield small(what, np.abs(excess).max(), 5e-4, "the cable's own mass")


def _bent_pendulum(angle: float, mass: float, density: float, length: float) -> RopeModel:
    """At rest, bent as the cable's own weight bends it while the body falls round the sheave."""
    cable, body = CableData(2e8, density, density * G), BodyData(mass, mass * G)
    model = RopeModel(cable, body, fixed(length), elements=4, force=(mass * G * np.tan(angle), 0.0, 0.0))
    towards, across = (np.array([np.sin(a), 0.0, -np.cos(a)]) for a in (angle, angle - np.pi / 2.0))
    pull = mass * G * np.cos(angle) + density * G * np.cos(angle) * length * model.rope.above
    r = length * (1.0 - model.rope.above)
    bent = density / mass * np.tan(angle) * (length / 3.0 - r + r * r / (2.0 * length))
    direction = np.sqrt(1.0 - bent**2)[..., None] * towards + bent[..., None] * across
    put_shape(model.state, (1.0 + pull / 2e8)[..., None] * direction, length)
    model.step(1e-4, force=0.0)
    return model


@CASES.add("rope, heave of 3000 m", "2000 masses on springs", COMPUTED)
def _heave() -> Checks:
    """A damped body on 3000 m in regular heave."""
    body, count = BodyData(8000.0, 8000.0 * G, damping=1.2e4), 200
    for omega in (0.5, 0.9, 1.2):
        motion = Motion(steady(3000.0), waving({2: (0.3, omega)}, 20.0))
        model = RopeModel(CableData(2e7, 5.0, 5.0 * G), body, motion)
        model.step(100.0)
        turn = 2.0 * np.pi / omega
        rows = recorded(model, turn / count, count, lambda m=model: (m.body_position[2], norm(m.top_pull)))
        found = np.abs(np.fft.rfft(rows, axis=0)[1]) * 2.0 / count / 0.3
        place, _, top = heave_of_masses(SpringMasses(2e7, 5.0, 8000.0, 3000.0), 1.2e4, np.array([omega]))
        exact = np.abs([place[0], top[0]])
        yield close(f"body and tension at the top at {omega:g} rad/s", found, exact, 4e-3, "first harmonic")


@CASES.add("rope, sheared current", "integration along the cable", COMPUTED)
def _sheared_current() -> Checks:
    """A cable of 1000 m with a body in a current that turns with depth."""
    cable = CableData(1.5e7, 3.2, 22.0, 0.03, 1.2, 0.01)
    body = BodyData(4000.0, 15000.0, (2000.0, 2000.0, 3000.0), drag=(1800.0, 1800.0, 3000.0))
    shear = SteadyCurrent((0.0, -200.0, -1000.0), ((0.8, 0.1, 0.0), (0.5, 0.2, 0.0), (0.2, -0.1, 0.0)))
    model = RopeModel(cable, body, fixed(1000.0), shear)
    levels, speeds = np.array(shear.heights[::-1]), np.array(shear.velocities[::-1])

    def current(z: float) -> np.ndarray:
        return np.array([np.interp(z, levels, speeds[:, k]) for k in range(3)])

    place, top = reference.shape_in_current(cable, body, 1000.0, current)
    yield close("place of the body, m", model.body_position, place, 1e-4, "kinks of the profile in an element")
    yield close("tension at the top, N", model.tension[0], top, 1e-4, "likewise")


@CASES.add("rope, tow", "integration along the cable; Galilei", COMPUTED)
def _tow() -> Checks:
    """600 m towed at 1.5 m/s, in a current, and by a moving vessel in still water."""
    cable = CableData(1e7, 1.2, 8.0, 0.0173, 1.5, 0.02)
    body = BodyData(300.0, 1500.0, (100.0, 200.0, 200.0), drag=(200.0, 200.0, 300.0))
    flow, why = np.array([1.5, 0.0, 0.0]), "the grid at rest"
    model = RopeModel(cable, body, fixed(600.0), SteadyCurrent((0.0,), ((1.5, 0.0, 0.0),)))
    place, top = reference.shape_in_current(cable, body, 600.0, lambda z: flow)
    yield close("reach behind the vessel, m", model.body_position[0], place[0], 1e-6, why)
    yield close("depth, m", -model.body_position[2], -place[2], 1e-6, why)
    yield close("tension at the top, N", model.tension[0], top, 1e-6, why)

    def away(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.multiply.outer(t, -flow), np.broadcast_to(-flow, (*np.shape(t), 3))

    moving = RopeModel(cable, body, Motion(steady(600.0), away))
    n = moving.elements
    moving.state.now[:] = model.state.now
    moving.state.now[:, 3 * n : 4 * n] -= 1.5
    moving.state.body[0] = -flow
    moving.step(20.0)
    off = moving.body_position + 20.0 * flow - model.body_position
    yield small("vessel moves instead of the water: place after 20 s, m", np.abs(off).max(), 1e-6, "Galilei")


def _balanced(model: RopeModel, before: float, tolerance: float) -> Check:
    residual = left_over(model, before) / abs(model.works["work_weight"])
    return small("power balance, what is left over the work of the weight", residual, tolerance, "time integration")


@CASES.add("rope, {}", "(m + rho l)(g - a)", "axial balance",
           {"paying out": (450.0, 500.0), "hauling in": (500.0, 450.0)})  # fmt: skip
def _winch(ends: tuple[float, float]) -> Checks:
    """Paying out or hauling in: the tension at the top follows (m + rho l)(g - a)."""
    start, end = ends
    body, motion = BodyData(500.0, 500.0 * G), Motion(quintic_winch(start, end, 50.0))
    model = RopeModel(CableData(2e8, 2.0, 2.0 * G), body, motion, booked=True)
    before = model.energy

    def miss() -> Any:
        q = min(model.time / 50.0, 1.0)
        sinking = (end - start) / 2500.0 * 60.0 * q * (1.0 - q) * (1.0 - 2.0 * q)
        return abs(norm(model.top_pull) / ((500.0 + 2.0 * model.length) * (G - sinking)) - 1.0)

    worst = recorded(model, 1.0, 60, miss).max()
    yield small("tension at the top, largest relative error", worst, 2e-4, "inextensible reference, EA 2e8")
    stretched = end + (500.0 * G * end + 0.5 * 2.0 * G * end**2) / 2e8
    yield close("depth in the end, m", -model.body_position[2], stretched, 1e-6, "static stretch")
    yield _balanced(model, before, 1e-9)


@CASES.add("rope, momentum, {}", "impulse", "Newton", {"paying out": 460.0, "hauling in": 340.0}, quick=False)
def _moving_vessel(end: float) -> Checks:
    """Paying out or hauling in under a vessel that moves in space: momentum against impulse."""
    waves = waving({0: (0.7, 0.5), 1: (1.0, 0.7), 2: (0.5, 0.9)}, 8.0)
    cable, body, dt = CableData(2e7, 3.0, 3.0 * G), BodyData(800.0, 800.0 * G), 0.005
    model = RopeModel(cable, body, Motion(quintic_winch(400.0, end, 40.0), waves), booked=True)
    n, rope, outside = model.elements, model.rope, model.state.outside

    def momentum() -> np.ndarray:
        parts = model.state.now[:, 3 * n :].reshape(5, 3, n)
        along = np.einsum("j,jie->i", WEIGHTS / 2.0, parts) / n * model.length
        return rope.density * along + rope.inertia * model.body_velocity

    def force() -> np.ndarray:
        """On cable and body, and the momentum that comes in with cable: the velocity is that of what passes."""
        speed = float(outside[0].payout_speed)
        passing = model.state.ends[0].top_velocity if speed > 0.0 else model.state.now[0, [3 * n, 4 * n, 5 * n]]
        weight = np.array([0.0, 0.0, rope.body_weight + rope.weight * model.length])
        return -model.top_pull + speed * rope.density * passing - weight

    start, before = momentum(), model.energy
    f = np.array([force(), *recorded(model, dt, 8000, force)])
    misfit = np.abs(momentum() - start - simpson(f, dx=dt, axis=0)).max() / (800.0 * G)
    yield small("change of momentum less impulse, over m g s", misfit, 1e-5, "Simpson's rule over 5 ms")
    yield _balanced(model, before, 1e-8)

"""The rope at rest and in small motions against closed forms, shooting and integration along the cable."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from umbilical.library import load
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, SteadyCurrent, fixed
from umbilical.plant.rope.statics import put_shape
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, each, each_close, small
from umbilical.verify.crosscheck import PEAKS, SOURCE
from umbilical.verify.references import rope as reference
from umbilical.verify.references.sea import SpringMasses, heave_of_masses

G = 9.81
HUNG = "Irvine, Cable Structures, 2"
COMPUTED = "computed with the case"
BALANCE = "power balance, what is left over the work of the weight"


def recorded(model: RopeModel, dt: float, count: int, read: Callable[[], Any]) -> np.ndarray:
    """What ``read`` says after each of ``count`` steps of a model, s."""
    rows = []
    for _ in range(count):
        model.step(dt)
        rows.append(read())
    return np.array(rows)


def norm(vector: np.ndarray) -> float:
    """Size of a vector."""
    return float(np.linalg.norm(vector))


def left_over(model: RopeModel, before: float) -> float:
    """Energy less what it was and less all work since, J."""
    return model.energy - before - sum(model.works.values())


def steady(length: float) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """A winch that stands still."""
    return lambda t: (np.full(np.shape(t), length), np.zeros(np.shape(t)))


def quintic_winch(start: float, end: float, duration: float) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """A winch law without jerks at its ends."""

    def law(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        q = np.clip(t / duration, 0.0, 1.0)
        length = start + (end - start) * q**3 * (10.0 - 15.0 * q + 6.0 * q * q)
        return length, (end - start) / duration * 30.0 * q * q * (1.0 - q) ** 2

    return law


def waving(waves: dict[int, tuple[float, float]], ramp: float) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """Place and velocity of the sheave: amplitude, m, and frequency, rad/s, along some axes, faded in over it, s."""

    def motion(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        t = np.asarray(t, dtype=float)
        q = np.clip(t / ramp, 0.0, 1.0)
        fade, fade_rate = q * q * (3.0 - 2.0 * q), 6.0 * q * (1.0 - q) / ramp
        place, speed = np.zeros((*t.shape, 3)), np.zeros((*t.shape, 3))
        for axis, (amplitude, omega) in waves.items():
            sine, cosine = amplitude * np.sin(omega * t), amplitude * omega * np.cos(omega * t)
            place[..., axis], speed[..., axis] = fade * sine, fade * cosine + fade_rate * sine
        return place, speed

    return motion


def _catenary() -> Iterator[Check]:
    """An elastic catenary under a horizontal force on the body."""
    model = RopeModel(CableData(2e7, 3.0, 20.0), BodyData(400.0, 3000.0), fixed(500.0), force=(4000.0, 0.0, 0.0))
    reach, depth, top = reference.elastic_catenary(500.0, 20.0, 3000.0, 4000.0, 2e7)
    why = "the state of the grid that keeps still"
    yield close("reach of the body, m", model.body_position[0], reach, 1e-6, why)
    yield close("depth of the body, m", -model.body_position[2], depth, 1e-6, why)
    yield close("tension at the top, N", model.tension[0], top, 1e-6, why)


def _modes() -> Iterator[Check]:
    """Frequencies of the hanging cable, of the engine's own rates, each in two planes."""
    model = RopeModel(CableData(2e7, 2.0, 2.0 * G), BodyData(500.0, 500.0 * G), fixed(500.0), elements=8)
    found = model.modes()
    undamped = np.imag(found[np.abs(np.real(found)) < 1e-3 * np.abs(found)])
    exact = np.repeat(reference.transverse_modes(4, 500.0, 2.0, 500.0, 2e7), 2)
    yield each_close("four transverse modes, twice, rad/s", undamped[:8], exact, 1e-6, "8 elements")
    axial = reference.axial_modes(2, 500.0, 2.0, 500.0, 2e7)
    nearest = [float(undamped[np.argmin(np.abs(undamped - omega))]) for omega in axial]
    yield each_close("two axial modes, rad/s", nearest, axial, 2e-4, "8 elements, static stretch left out")


def _pendulum() -> Iterator[Check]:
    """A heavy body on a light cable let go at 60 degrees: its period, and its tension down to the bottom.

    It starts in the shape in which it swings: straight, it would vibrate across, and the stretch of that beats in the
    tension (docs/rope.md).
    """
    angle, mass, length = np.pi / 3.0, 500.0, 50.0
    model = _bent_pendulum(angle, mass, 5e-3, length)
    times, places, excess = [], [], []
    while model.body_position[0] > 0.0:
        model.step(0.01)
        place = model.body_position
        times.append(model.time)
        places.append(place[0])
        exact = mass * G * (-3.0 * place[2] / np.linalg.norm(place) - 2.0 * np.cos(angle))
        excess.append(norm(model.end_pull) / exact - 1.0)
    crossing = times[-2] + 0.01 * places[-2] / (places[-2] - places[-1])
    yield close("period, s", 4.0 * crossing, reference.pendulum_period(length, angle), 5e-4, "EA 2e8 for no stretch")
    largest = float(np.abs(excess).max())
    yield small("largest excess of the tension over m g (3 cos - 2 cos 60)", largest, 5e-4, "the cable's own mass")


def _bent_pendulum(angle: float, mass: float, density: float, length: float) -> RopeModel:
    """At rest, bent as the cable's own weight bends it while the body falls round the sheave."""
    force = (mass * G * np.tan(angle), 0.0, 0.0)
    cable, body = CableData(2e8, density, density * G), BodyData(mass, mass * G)
    model = RopeModel(cable, body, fixed(length), elements=4, force=force)
    towards, across = (np.array([np.sin(a), 0.0, -np.cos(a)]) for a in (angle, angle - np.pi / 2.0))
    pull = mass * G * np.cos(angle) + density * G * np.cos(angle) * length * model.rope.above
    r = length * (1.0 - model.rope.above)
    bent = density / mass * np.tan(angle) * (length / 3.0 - r + r * r / (2.0 * length))
    direction = np.sqrt(1.0 - bent**2)[..., None] * towards + bent[..., None] * across
    put_shape(model.state, (1.0 + pull / 2e8)[..., None] * direction, length)
    model.step(1e-4, force=0.0)
    return model


def _heave() -> Iterator[Check]:
    """A damped body on 3000 m in regular heave."""
    for omega in (0.5, 0.9, 1.2):
        motion = Motion(steady(3000.0), waving({2: (0.3, omega)}, 20.0))
        body = BodyData(8000.0, 8000.0 * G, damping=1.2e4)
        model = RopeModel(CableData(2e7, 5.0, 5.0 * G), body, motion)
        model.step(100.0)
        count, both = 200, partial(_place_and_pull, model)
        rows = recorded(model, 2.0 * np.pi / omega / count, count, both)
        found = np.abs(np.fft.rfft(rows, axis=0)[1]) * 2.0 / count / 0.3
        place, _, top = heave_of_masses(SpringMasses(2e7, 5.0, 8000.0, 3000.0), 1.2e4, np.array([omega]))
        exact = [abs(place[0]), abs(top[0])]
        yield each_close(f"body and tension at the top at {omega:g} rad/s", found, exact, 4e-3, "first harmonic")


def _place_and_pull(model: RopeModel) -> tuple[float, float]:
    return model.body_position[2], norm(model.top_pull)


SHEAR = SteadyCurrent((0.0, -200.0, -1000.0), ((0.8, 0.1, 0.0), (0.5, 0.2, 0.0), (0.2, -0.1, 0.0)))


def _sheared_current() -> Iterator[Check]:
    """A cable of 1000 m with a body in a current that turns with depth."""
    cable = CableData(1.5e7, 3.2, 22.0, 0.03, 1.2, 0.01)
    drag = (1800.0, 1800.0, 3000.0)
    body = BodyData(4000.0, 15000.0, (2000.0, 2000.0, 3000.0), drag=drag)
    model = RopeModel(cable, body, fixed(1000.0), SHEAR)
    levels, speeds = np.array(SHEAR.heights[::-1]), np.array(SHEAR.velocities[::-1])

    def current(z: float) -> np.ndarray:
        return np.array([np.interp(z, levels, speeds[:, k]) for k in range(3)])

    hung = reference.Towed(1.5e7, 22.0, 0.03, 1.2, 0.01, 1.0, 1000.0, 15000.0, drag)
    place, top = reference.shape_in_current(hung, current)
    yield each_close("place of the body, m", model.body_position, place, 1e-4, "kinks of the profile in an element")
    yield close("tension at the top, N", model.tension[0], top, 1e-4, "likewise")


TOWED = CableData(1e7, 1.2, 8.0, 0.0173, 1.5, 0.02)
TOWED_BODY = BodyData(300.0, 1500.0, (100.0, 200.0, 200.0), drag=(200.0, 200.0, 300.0))


def _tow() -> Iterator[Check]:
    """600 m towed at 1.5 m/s, in a current, and by a moving vessel in still water."""
    flow = SteadyCurrent((0.0,), ((1.5, 0.0, 0.0),))
    model = RopeModel(TOWED, TOWED_BODY, fixed(600.0), flow)
    towed = reference.Towed(1e7, 8.0, 0.0173, 1.5, 0.02, 1.0, 600.0, 1500.0, (200.0, 200.0, 300.0))
    place, top = reference.shape_in_current(towed, lambda z: np.array([1.5, 0.0, 0.0]))
    yield close("reach behind the vessel, m", model.body_position[0], place[0], 1e-6, "the grid at rest")
    yield close("depth, m", -model.body_position[2], -place[2], 1e-6, "the grid at rest")
    yield close("tension at the top, N", model.tension[0], top, 1e-6, "the grid at rest")

    def away(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        direction = np.array([-1.5, 0.0, 0.0])
        return np.multiply.outer(t, direction), np.broadcast_to(direction, (*np.shape(t), 3))

    moving = RopeModel(TOWED, TOWED_BODY, Motion(steady(600.0), away))
    n = moving.elements
    moving.state.now[:] = model.state.now
    moving.state.now[:, 3 * n : 4 * n] -= 1.5
    moving.state.body[0] = (-1.5, 0.0, 0.0)
    moving.step(20.0)
    off = moving.body_position + np.array([30.0, 0.0, 0.0]) - model.body_position
    yield small("vessel moves instead of the water: place after 20 s, m", np.abs(off).max(), 1e-6, "Galilei")


def _winch(ends: tuple[float, float]) -> Iterator[Check]:
    """Paying out or hauling in: the tension at the top follows (m + rho l)(g - a)."""
    start, end = ends
    law = quintic_winch(start, end, 50.0)
    model = RopeModel(CableData(2e8, 2.0, 2.0 * G), BodyData(500.0, 500.0 * G), Motion(law), booked=True)
    before = model.energy

    def miss() -> float:
        q = min(model.time / 50.0, 1.0)
        sinking = (end - start) / 2500.0 * 60.0 * q * (1.0 - q) * (1.0 - 2.0 * q)
        return abs(norm(model.top_pull) / ((500.0 + 2.0 * model.length) * (G - sinking)) - 1.0)

    worst = recorded(model, 1.0, 60, miss).max()
    yield small("tension at the top, largest relative error", worst, 2e-4, "inextensible reference, EA 2e8")
    stretched = end + (500.0 * G * end + 0.5 * 2.0 * G * end**2) / 2e8
    yield close("depth in the end, m", -model.body_position[2], stretched, 1e-6, "static stretch")
    residual = left_over(model, before) / abs(model.works["work_weight"])
    yield small(BALANCE, residual, 1e-9, "time integration")


def _moving_vessel(end: float) -> Iterator[Check]:
    """Paying out or hauling in under a vessel that moves in space: momentum against impulse."""
    waves = {0: (0.7, 0.5), 1: (1.0, 0.7), 2: (0.5, 0.9)}
    cable, body = CableData(2e7, 3.0, 3.0 * G), BodyData(800.0, 800.0 * G)
    motion = Motion(quintic_winch(400.0, end, 40.0), waving(waves, 8.0))
    model = RopeModel(cable, body, motion, booked=True)
    start, before, dt = _momentum(model), model.energy, 0.005
    f = np.array([_force(model), *recorded(model, dt, 8000, partial(_force, model))])
    impulse = dt / 3.0 * (f[0] + f[-1] + 4.0 * f[1:-1:2].sum(axis=0) + 2.0 * f[2:-1:2].sum(axis=0))
    misfit = np.abs(_momentum(model) - start - impulse).max() / (800.0 * G)
    yield small("change of momentum less impulse, over m g s", misfit, 1e-5, "Simpson's rule over 5 ms")
    residual = left_over(model, before) / abs(model.works["work_weight"])
    yield small(BALANCE, residual, 1e-8, "time integration")


def _momentum(model: RopeModel) -> np.ndarray:
    weights = np.array([1 / 10, 49 / 90, 32 / 45, 49 / 90, 1 / 10]) / 2.0
    n = model.elements
    parts = model.state.now[:, 3 * n :].reshape(5, 3, n)
    along = np.einsum("j,jie->i", weights, parts) / n * model.length
    return model.rope.density * along + model.rope.inertia * model.body_velocity


def _force(model: RopeModel) -> np.ndarray:
    """Force on cable and body, and the momentum that comes in with cable: the velocity is that of what passes."""
    n, speed = model.elements, float(model.state.outside[0].payout_speed)
    entering = model.state.ends[0].top_velocity
    passing = entering if speed > 0.0 else model.state.now[0, [3 * n, 4 * n, 5 * n]]
    weight = model.rope.body_weight + model.rope.weight * model.length
    return -model.top_pull + speed * model.rope.density * passing - np.array([0.0, 0.0, weight])


def _flight() -> Iterator[Check]:
    """A body is thrown up, its cable goes slack, and it is pushed down: a slack cable neither pulls nor brakes."""
    model = RopeModel(CableData(2e7, 3.0, 3.0 * G), BodyData(500.0, 500.0 * G), fixed(100.0))
    start = float(model.body_position[2])
    model.state.body[0] = (0.0, 0.0, 2.0)
    model.step(0.1)
    model.step(0.1, force=(0.0, 0.0, -12e3))
    yield close("velocity after 0.2 s, m/s", model.body_velocity[2], 2.0 - 0.2 * G - 2.4, 1e-9, "free flight")
    height = 0.4 - 0.02 * G - 0.12
    yield close("height after 0.2 s, m", float(model.body_position[2]) - start, height, 1e-9, "free flight")


def _crosscheck() -> Iterator[Check]:
    """The peak that two codes of the string agree on, of the rope with all its motion in space."""
    run = engine.completed(load("crosscheck-none", {"model": "rope", "cable.axial_stiffness": 5e8}))
    found, exact = run.metrics["tip_peak"], PEAKS["crosscheck-none"]
    yield close("peak of |y(l,t)|, m", found, exact, 1e-3, "EA 5e8, printed digits")


CASES = (
    Case("rope, crosscheck", "two codes of the string", SOURCE, _crosscheck),
    Case("rope, free flight over slack", "closed form", "Newton", _flight),
    Case("rope, elastic catenary", "closed form", HUNG, _catenary),
    Case("rope, modes of the hanging cable", "shooting; b tan b = rho l/m", COMPUTED, _modes),
    Case("rope, pendulum of 60 degrees", "elliptic integral", "textbook", _pendulum),
    Case("rope, heave of 3000 m", "2000 masses on springs", COMPUTED, _heave),
    Case("rope, sheared current", "integration along the cable", COMPUTED, _sheared_current),
    Case("rope, tow", "integration along the cable; Galilei", COMPUTED, _tow),
    *each(
        "rope, {}",
        "(m + rho l)(g - a)",
        "axial balance",
        _winch,
        {"paying out": (450.0, 500.0), "hauling in": (500.0, 450.0)},
    ),
    *each(
        "rope, momentum, {}",
        "impulse",
        "Newton",
        _moving_vessel,
        {"paying out": 460.0, "hauling in": 340.0},
        quick=False,
    ),
)

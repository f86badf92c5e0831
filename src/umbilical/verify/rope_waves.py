"""Fronts, snaps and a real sea on the rope against characteristics, masses on springs and linearisation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.linalg import norm

from umbilical.library import load
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, fixed
from umbilical.plant.rope.step import largest_step
from umbilical.plant.seaway import sheave
from umbilical.scenario.signals import Waves
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Check, Checks, close, small
from umbilical.verify.references import rope as reference
from umbilical.verify.references.sea import WORK_CLASS, masses_in_waves, work_class_statistics
from umbilical.verify.rope import COMPUTED, G, left_over, recorded, steady, waving

CASES = Cases()
WINDOW = 0.025
"""s; peaks behind a front are those of the mean over it: at the front itself any grid rings."""
FINE = 2.5e-4
"""s; a step at which the grid's own error is left."""
CHARACTERISTICS = ("characteristics", COMPUTED)


def _longest(model: RopeModel) -> float:
    return largest_step(model.rope, model.length, 0.0, model.elements)


def _follow(model: RopeModel, duration: float, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Times, s, and tension at body and top above what they were at the start, N, shape (2, samples)."""
    start = [model.rope.body_weight if model.body_velocity.any() else model.tension[-1], model.tension[0]]
    rows = recorded(model, dt, round(duration / dt), lambda: (norm(model.end_pull), norm(model.top_pull)))
    return dt * np.arange(1, len(rows) + 1), (rows - start).T


def _mean_peak(where: str, ours: np.ndarray, theirs: np.ndarray, tolerance: float, elements: int) -> Check:
    """The largest mean over :data:`WINDOW`."""
    count = round(WINDOW / FINE)
    peak, exact = (np.convolve(values, np.full(count, 1.0 / count), mode="valid").max() for values in (ours, theirs))
    why = f"first order: {elements} elements"
    return close(f"peak of the {1e3 * WINDOW:g} ms mean {where}, N", peak, exact, tolerance, why)


def _read_peak(where: str, ours: np.ndarray, exact: float, tolerance: float, elements: int) -> Check:
    """The largest sample; the longest step takes from the front's ringing what the grid gives (docs/rope.md)."""
    why = f"first order: {elements} elements at the longest step"
    return close(f"peak {where} as read, N", ours.max(), exact, tolerance / elements, why)


@CASES.add("rope, front, {} elements", *CHARACTERISTICS, (20, 40), quick=False)
@CASES.add("rope, front, {} elements", *CHARACTERISTICS, (10,))
def _front(elements: int) -> Checks:
    """A heave velocity that sets in at once runs down 1000 m to a body."""
    omega, speed, impedance = 2.0 * np.pi / 0.4, 0.157, float(np.sqrt(3.0 * 2e7))
    travel, up = 1000.0 / np.sqrt(2e7 / 3.0), np.array([0.0, 0.0, speed])

    def vessel(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.multiply.outer(np.sin(omega * t) / omega, up), np.multiply.outer(np.cos(omega * t), up)

    def model() -> RopeModel:
        cable, body = CableData(2e7, 3.0, 0.0), BodyData(2000.0, 2000.0 * G)
        return RopeModel(cable, body, Motion(steady(1000.0), vessel), elements=elements)

    times, (found, _) = _follow(model(), 0.43, FINE)
    exact = reference.wave_on_body(impedance, 2000.0, speed, omega, times - travel)
    half = times[np.flatnonzero(found > 0.5 * exact.max())[0]]
    yield close("arrival at the body, s", half, travel, 5e-3, f"{elements} elements, half of the front")
    yield _mean_peak("at the body", found, exact, 0.8 / elements, elements)
    longest = _follow(model(), 0.43, _longest(model()))[1][0]
    yield _read_peak("at the body", longest, 2.0 * impedance * speed, 1.2, elements)


@CASES.add("rope, impact, {} elements", *CHARACTERISTICS, (20, 40), quick=False)
@CASES.add("rope, impact, {} elements", *CHARACTERISTICS, (10,))
def _impact(elements: int) -> Checks:
    """A body starts at 1 m/s downwards on a taut cable: the peaks are twice v sqrt(K M) and more."""

    def model() -> RopeModel:
        thrown = RopeModel(CableData(2e7, 5.0, 0.0), BodyData(5000.0, 30e3), fixed(1000.0), elements=elements)
        thrown.state.body[0] = (0.0, 0.0, -1.0)
        return thrown

    def exact(times: Any) -> tuple[np.ndarray, ...]:
        return reference.thrown_body(1e4, 5000.0, 0.5, 1.0, np.asarray(times))

    times, (body, top) = _follow(model(), 1.98, FINE)
    early = times < 1.4
    yield _mean_peak("at the body", body[early], exact(times[early])[0], min(0.05, 0.8 / elements), elements)
    yield _mean_peak("at the top", top, exact(times)[1], min(0.05, 0.8 / elements), elements)
    step = _longest(model())
    body, top = _follow(model(), 1.98, step)[1]
    yield _read_peak("at the body", body[: round(1.4 / step)], float(exact(1.0)[0]), 0.8, elements)
    yield _read_peak("at the top", top, float(exact(1.5)[1]), 1.4, elements)


HEAVED = CableData(2e7, 5.0, 3.5 * G, 0.04, 1.2, 0.01)
HEAVED_BODY = BodyData(8000.0, 30e3, 9000.0, drag=4000.0)


def _heaved(amplitude: float, elements: int, duration: float) -> tuple[np.ndarray, RopeModel]:
    """Tension at top and body, height of the body over the last periods, shape (samples, 3)."""
    motion = Motion(steady(1000.0), waving({2: (amplitude, 2.0 * np.pi / 8.0)}, 20.0))
    model = RopeModel(HEAVED, HEAVED_BODY, motion, elements=elements, booked=True)
    model.step(60.0)
    rows = recorded(model, 0.01, round(duration / 0.01),
                    lambda: (norm(model.top_pull), model.body_position[2], norm(model.end_pull)))  # fmt: skip
    return rows, model


def _masses(amplitude: float, masses: int, duration: float) -> np.ndarray:
    """The same of masses on springs."""
    heave = waving({2: (amplitude, 2.0 * np.pi / 8.0)}, 20.0)
    times = np.concatenate([[0.0], 60.0 + 0.02 * np.arange(1, round(duration / 0.02) + 1)])
    found = reference.heaved_masses(HEAVED, HEAVED_BODY, 1000.0, lambda t: heave(t)[0][..., 2], times, masses)
    return np.stack(found, axis=1)[1:]


def _said(rows: np.ndarray) -> np.ndarray:
    """Largest and smallest tension at the top, N, and half the swing of the body, m."""
    return np.array([rows[:, 0].max(), rows[:, 0].min(), 0.5 * np.ptp(rows[:, 1])])


def _balance(model: RopeModel, tolerance: float, why: str) -> Check:
    """What the balance leaves open since the start from rest."""
    still = RopeModel(HEAVED, HEAVED_BODY, fixed(1000.0), elements=model.elements)
    gross = sum(abs(work) for work in model.works.values())
    return small("power balance, what is left over gross work", left_over(model, still.energy) / gross, tolerance, why)


@CASES.add("rope, taut heave", "masses on springs", COMPUTED, quick=False)
def _taut_heave() -> Checks:
    """A work-class body on 1000 m in 0.8 m of heave, 8 s, with drag."""
    rows, model = _heaved(0.8, 10, 40.0)
    coarse, fine = (_said(_masses(0.8, count, 40.0)) for count in (40, 80))
    found, exact = _said(rows), fine + (fine - coarse) / 3.0
    why = "masses on 40 and 80 springs, second order taken out"
    yield close("tension at the top, largest and smallest, N", found[:2], exact[:2], 1e-3, why)
    yield close("half the swing of the body, m", found[2], exact[2], 1e-3, why)
    yield _balance(model, 1e-6, "time integration")


@CASES.add("rope, irregular sea", "masses on springs; stochastic linearisation", COMPUTED, quick=False)
def _irregular() -> Checks:
    """An hour of irregular sea on 3000 m, bow quarter, Hs 2.5 m, against masses on springs in the same sea.

    Drag across the cable stays: without any the vessel's sway and the swing of the tension build up metres of
    transverse motion in an hour, which raises the tension by 6 % (docs/rope.md).
    """
    scenario = load("work-class-3000m", {
        "cable.water.tangential_drag": 0.0, "environment.water.current": None, "duration": 3800.0,
        "control.period": 0.05, "grid.step": 0.05, "output.interval": 0.25,
    })  # fmt: skip
    late = engine.finished(scenario).data.sel(time=slice(200.0, None))
    body = late["body_position"].isel(axis=2)
    found = [float(part.std()) for part in (late["top_tension"], late["end_tension"], body)]
    (up,) = sheave(scenario.environment).up
    assert isinstance(up, Waves)
    waves = np.array(up.amplitudes) * np.exp(1j * np.array(up.phases))
    exact = masses_in_waves(WORK_CLASS, 4500.0, np.array(up.frequencies), waves, (200.0, 3800.0))
    why = "40 masses in the same sea, which moves them up and down only"
    yield close("rms of the tension at top and end, N", found[:2], exact[:2], 0.01, why)
    yield close("rms of the body's heave, m", found[2], exact[2], 0.01, why)
    linear = work_class_statistics(2.5, 3000.0, np.radians(135.0))
    why = "linearised drag is 4 % low over 40 seeds of such masses, one hour scatters by 1 %"
    rms = [linear[name] for name in ("top", "end", "body")]
    yield close("rms of tensions, N, and heave, m, against stochastic linearisation", found, rms, 0.08, why)


@CASES.add("rope, snaps", "masses on springs without push", COMPUTED, quick=False)
def _snapping() -> Checks:
    """2 m of heave: slack and snaps, on three grids, against masses on springs."""
    lumped = _masses(2.0, 60, 80.0)
    (highest, _, swing), share = _said(lumped), np.mean(lumped[:, 2] < 1.0)
    for elements in (4, 8, 16):
        rows, model = _heaved(2.0, elements, 80.0)
        (top, _, found), why = _said(rows), f"{elements} elements, 60 masses"
        yield close("half the swing of the body, m", found, swing, 5e-3, why)
        yield small("share of time with slack at the body, off by", np.mean(rows[:, 2] < 1.0) - share, 1e-2, why)
        yield close("largest tension at the top, N", top, highest, 0.05, why)
        yield _balance(model, 2e-3, "steps through snaps")

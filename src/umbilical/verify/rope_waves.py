"""Fronts, snaps and a real sea on the rope against characteristics, masses on springs and linearisation."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from umbilical.library import load
from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, fixed
from umbilical.plant.rope.step import largest_step
from umbilical.plant.seaway import sheave
from umbilical.scenario.signals import Waves
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, each_close, small
from umbilical.verify.references import rope as reference
from umbilical.verify.references.sea import WORK_CLASS, masses_in_waves, work_class_statistics
from umbilical.verify.rope import COMPUTED, G, left_over, norm, recorded, steady, waving

WINDOW = 0.025
"""s; peaks behind a front are those of the mean over it: at the front itself any grid rings."""
FINE = 2.5e-4
"""s; a step at which the grid's own error is left."""


def _front(elements: int, tolerance: float) -> Iterator[Check]:
    """A heave velocity that sets in at once runs down 1000 m to a body."""
    omega, speed, impedance = 2.0 * np.pi / 0.4, 0.157, float(np.sqrt(3.0 * 2e7))

    def vessel(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        zero = np.zeros(np.shape(t))
        up, rate = speed / omega * np.sin(omega * t), speed * np.cos(omega * t)
        return np.stack([zero, zero, up], axis=-1), np.stack([zero, zero, rate], axis=-1)

    def model() -> RopeModel:
        cable, body = CableData(2e7, 3.0, 0.0), BodyData(2000.0, 2000.0 * G)
        return RopeModel(cable, body, Motion(steady(1000.0), vessel), elements=elements)

    times, found = _follow(model(), 0.43, FINE)
    travel = 1000.0 / np.sqrt(2e7 / 3.0)
    exact = reference.wave_on_body(impedance, 2000.0, speed, omega, times - travel)
    half = times[np.flatnonzero(found[:, 0] > 0.5 * exact.max())[0]]
    yield close("arrival at the body, s", float(half), float(travel), 5e-3, f"{elements} elements, half of the front")
    yield _mean_peak("at the body", times, found[:, 0], exact, tolerance, elements)
    longest = _follow(model(), 0.43, _longest(model()))[1]
    yield _read_peak("at the body", longest[:, 0], 2.0 * impedance * speed, 1.2 / elements, elements)


def _impact(elements: int, tolerance: float) -> Iterator[Check]:
    """A body starts at 1 m/s downwards on a taut cable: the peaks are twice v sqrt(K M) and more."""

    def model() -> RopeModel:
        thrown = RopeModel(CableData(2e7, 5.0, 0.0), BodyData(5000.0, 30e3), fixed(1000.0), elements=elements)
        thrown.state.body[0] = (0.0, 0.0, -1.0)
        return thrown

    times, found = _follow(model(), 1.98, FINE)
    exact = reference.thrown_body(1e4, 5000.0, 0.5, 1.0, times)
    early = times < 1.4
    yield _mean_peak("at the body", times[early], found[early, 0], exact[0][early], tolerance, elements)
    yield _mean_peak("at the top", times, found[:, 1], exact[1], tolerance, elements)
    step = _longest(model())
    longest = _follow(model(), 1.98, step)[1]
    peaks = reference.thrown_body(1e4, 5000.0, 0.5, 1.0, np.array([1.0, 1.5]))
    body = longest[: round(1.4 / step), 0]
    yield _read_peak("at the body", body, float(peaks[0][0]), 0.8 / elements, elements)
    yield _read_peak("at the top", longest[:, 1], float(peaks[1][1]), 1.4 / elements, elements)


def _mean_peak(
    where: str, times: np.ndarray, ours: np.ndarray, theirs: np.ndarray, tolerance: float, elements: int
) -> Check:
    peak, should, why = _peak(times, ours), _peak(times, theirs), f"first order: {elements} elements"
    return close(f"peak of the {1e3 * WINDOW:g} ms mean {where}, N", peak, should, tolerance, why)


def _read_peak(where: str, ours: np.ndarray, exact: float, tolerance: float, elements: int) -> Check:
    """The largest sample; the longest step takes from the front's ringing what the grid gives (docs/rope.md)."""
    why = f"first order: {elements} elements at the longest step"
    return close(f"peak {where} as read, N", float(ours.max()), exact, tolerance, why)


def _longest(model: RopeModel) -> float:
    return largest_step(model.rope, model.length, 0.0, model.elements)


def _follow(model: RopeModel, duration: float, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Times, s, and tension at body and top above what they were at the start, N, shape (samples, 2)."""
    start = np.array([model.tension[-1], model.tension[0]])
    if model.body_velocity.any():
        start[0] = model.rope.body_weight
    rows = recorded(model, dt, round(duration / dt), lambda: (norm(model.end_pull), norm(model.top_pull)))
    return dt * np.arange(1, len(rows) + 1), rows - start


def _peak(times: np.ndarray, values: np.ndarray) -> float:
    """Largest mean over :data:`WINDOW`."""
    count = round(WINDOW / (times[1] - times[0]))
    return float(np.convolve(values, np.full(count, 1.0 / count), mode="valid").max())


HEAVED = CableData(2e7, 5.0, 3.5 * G, 0.04, 1.2, 0.01)
HEAVED_BODY = BodyData(8000.0, 30e3, 9000.0, drag=4000.0)


def _heaved(amplitude: float, elements: int, duration: float) -> tuple[np.ndarray, RopeModel]:
    """Tension at top and body, height of the body over the last periods, shape (samples, 3)."""
    motion = Motion(steady(1000.0), waving({2: (amplitude, 2.0 * np.pi / 8.0)}, 20.0))
    model = RopeModel(HEAVED, HEAVED_BODY, motion, elements=elements, booked=True)
    model.step(60.0)

    def read() -> tuple[float, float, float]:
        return norm(model.top_pull), model.body_position[2], norm(model.end_pull)

    return recorded(model, 0.01, round(duration / 0.01), read), model


def _masses(amplitude: float, masses: int, duration: float) -> np.ndarray:
    """The same of masses on springs."""
    heave = waving({2: (amplitude, 2.0 * np.pi / 8.0)}, 20.0)

    def at(t: float) -> tuple[float, float]:
        place, speed = heave(np.array(t))
        return float(place[2]), float(speed[2])

    tangential = 0.5 * 1025.0 * np.pi * 0.04 * 0.01
    cable = reference.Heaved(2e7, 5.0, 3.5 * G, tangential, 1000.0, 17000.0, 30e3, 4000.0)
    times = np.concatenate([[0.0], 60.0 + 0.02 * np.arange(1, round(duration / 0.02) + 1)])
    return np.stack(reference.heaved_masses(cable, at, times, masses), axis=1)[1:]


def _said(rows: np.ndarray) -> np.ndarray:
    """Largest and smallest tension at the top, N, and half the swing of the body, m."""
    return np.array([rows[:, 0].max(), rows[:, 0].min(), 0.5 * np.ptp(rows[:, 1])])


def _taut_heave() -> Iterator[Check]:
    """A work-class body on 1000 m in 0.8 m of heave, 8 s, with drag."""
    found, model = _heaved(0.8, 10, 40.0)
    coarse, fine = (_said(_masses(0.8, count, 40.0)) for count in (40, 80))
    exact = fine + (fine - coarse) / 3.0
    why = "masses on 40 and 80 springs, second order taken out"
    yield each_close("tension at the top, largest and smallest, N", _said(found)[:2], exact[:2], 1e-3, why)
    yield close("half the swing of the body, m", float(_said(found)[2]), float(exact[2]), 1e-3, why)
    yield _balance(model, 1e-6, "time integration")


def _balance(model: RopeModel, tolerance: float, why: str) -> Check:
    """What the balance leaves open since the start from rest."""
    still = RopeModel(HEAVED, HEAVED_BODY, fixed(1000.0), elements=model.elements)
    gross = sum(abs(work) for work in model.works.values())
    return small("power balance, what is left over gross work", left_over(model, still.energy) / gross, tolerance, why)


def _snapping() -> Iterator[Check]:
    """2 m of heave: slack and snaps, on three grids, against masses on springs."""
    lumped = _masses(2.0, 60, 80.0)
    share = float(np.mean(lumped[:, 2] < 1.0))
    for elements in (4, 8, 16):
        rows, model = _heaved(2.0, elements, 80.0)
        why = f"{elements} elements, 60 masses"
        yield close("half the swing of the body, m", float(_said(rows)[2]), float(_said(lumped)[2]), 5e-3, why)
        yield small("share of time with slack at the body, off by", float(np.mean(rows[:, 2] < 1.0)) - share, 1e-2, why)
        yield close("largest tension at the top, N", float(rows[:, 0].max()), float(lumped[:, 0].max()), 0.05, why)
        yield _balance(model, 2e-3, "steps through snaps")


def _irregular() -> Iterator[Check]:
    """An hour of irregular sea on 3000 m, bow quarter, Hs 2.5 m, against masses on springs in the same sea.

    Drag across the cable stays: without any the vessel's sway and the swing of the tension build up metres of
    transverse motion in an hour, which raises the tension by 6 % (docs/rope.md).
    """
    still = {"cable.water.tangential_drag": 0.0, "environment.water.current": None}
    coarse = {"control.period": 0.05, "grid.step": 0.05, "output.interval": 0.25, "duration": 3800.0}
    scenario = load("work-class-3000m", still | coarse)
    late = engine.completed(scenario).data.sel(time=slice(200.0, None))
    body = late["body_position"].isel(axis=2)
    found = np.array([float(part.std()) for part in (late["top_tension"], late["end_tension"], body)])
    (up,) = sheave(scenario.environment).up
    assert isinstance(up, Waves)
    waves = np.array(up.amplitudes) * np.exp(1j * np.array(up.phases))
    exact = masses_in_waves(WORK_CLASS, 4500.0, np.array(up.frequencies), waves, (200.0, 3800.0))
    why = "40 masses in the same sea, which moves them up and down only"
    yield each_close("rms of the tension at top and end, N", found[:2], exact[:2], 0.01, why)
    yield close("rms of the body's heave, m", found[2], exact[2], 0.01, why)
    linear = work_class_statistics(2.5, 3000.0, np.radians(135.0))
    why = "linearised drag is 4 % low over 40 seeds of such masses, one hour scatters by 1 %"
    rms = [linear[name] for name in ("top", "end", "body")]
    yield each_close("rms of tensions, N, and heave, m, against stochastic linearisation", found, rms, 0.08, why)


FRONTS, IMPACTS = {10: 0.08, 20: 0.04, 40: 0.02}, {10: 0.05, 20: 0.04, 40: 0.02}
"""Tolerances of both on so many elements."""
CASES = (
    *(
        Case(f"rope, {name}, {n} elements", "characteristics", COMPUTED, partial(find, n, tolerance), quick=n < 20)
        for name, find, grids in (("front", _front, FRONTS), ("impact", _impact, IMPACTS))
        for n, tolerance in grids.items()
    ),
    Case("rope, taut heave", "masses on springs", COMPUTED, _taut_heave, quick=False),
    Case("rope, irregular sea", "masses on springs; stochastic linearisation", COMPUTED, _irregular, quick=False),
    Case("rope, snaps", "masses on springs without push", COMPUTED, _snapping, quick=False),
)

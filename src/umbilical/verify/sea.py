"""Waves, vessel, the heaving cable and the limits that follow from them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.relations.axial import Bar, heave_transfer
from umbilical.scenario.ship import RaoShip
from umbilical.screening import load_operation, operate, respond
from umbilical.screening.criteria import Criterion
from umbilical.screening.operation import HeaveCompensation
from umbilical.screening.response import residual_heave
from umbilical.sea import BoxVessel, Spectrum, discretise, heave_of_point, motion_of_point, vessel_of
from umbilical.sea.rao_checks import table_problems
from umbilical.sea.spectrum import normalisation
from umbilical.verify.cases import Case, Check, close, each_close, small
from umbilical.verify.engine import completed, open_loop, sine
from umbilical.verify.references import sea as reference

BOW_QUARTER = np.radians(135.0)
DEPTHS = np.array([500.0, 1500.0, 3000.0])
PRINTED = np.array([4.18, 1.64, 2.59])
"""Limiting Hs of two earlier programs, m, for a probability of slack of 1e-2 in three hours, Tp 8 s."""


def _spectra() -> Iterator[Check]:
    """Periods and normalisation of Pierson-Moskowitz and JONSWAP, and the waves that stand for them."""
    why = "quadrature on both sides"
    for gamma, exact in ((1.0, reference.pierson_moskowitz_ratios()), (3.3, reference.jonswap_ratios(3.3))):
        sea = Spectrum(2.5, 8.0, gamma)
        found = (sea.period("mean") / 8.0, sea.period("zero_crossing") / 8.0)
        yield each_close(f"T1/Tp and Tz/Tp, gamma = {gamma:g}", found, exact, 1e-8, why)
    gammas = (2.0, 3.3, 5.0)
    exact = [reference.peakedness_factor(gamma) for gamma in gammas]
    yield each_close("A(gamma), gamma = 2, 3.3, 5", [normalisation(g) for g in gammas], exact, 1e-7, why)
    omega = np.geomspace(0.1, 60.0, 20001)
    sea = Spectrum(2.5, 8.0)
    energy = np.trapezoid(sea.density(omega), omega)
    yield close("m0 of the density, m2", float(energy), 2.5**2 / 16.0, 1e-5, "what the trapezoidal rule leaves")
    waves = discretise(sea, 100, seed=1)
    yield close("sum a^2/2 of 100 bins, m2", (waves.amplitude**2).sum() / 2.0, 2.5**2 / 16.0, 1e-12, "exact by design")
    velocity = np.sqrt((waves.amplitude**2 * waves.omega**2).sum() / 2.0)
    yield close("rms of the vertical velocity, m/s", velocity, np.sqrt(sea.moment(2)), 0.01, "wide bins in the tail")


def _long_waves() -> Iterator[Check]:
    """A ship follows waves much longer than itself."""
    ship, omega = BoxVessel(93.0, 20.0, 6.6, 0.75), np.array([2.0 * np.pi / 60.0])
    k = omega**2 / 9.81
    why = "what is left at a period of 60 s"
    for degrees in (0.0, 45.0, 135.0, 180.0):
        heading = np.radians(degrees)
        for name, (forward, port) in {"midship": (0.0, 0.0), "40 m forward": (40.0, 0.0)}.items():
            deck = np.exp(-1j * k * (forward * np.cos(heading) + port * np.sin(heading)))
            found = heave_of_point(ship, omega, heading, forward, port)
            yield small(f"heave less elevation, {name}, {degrees:g} deg", abs(found - deck)[0], 5e-3, why)


def _response_tables() -> Iterator[Check]:
    """The closed-form vessel through tables of RAOs in several conventions, and tables that must be refused."""
    ship, omega = BoxVessel(93.0, 20.0, 6.6, 0.75), np.array([0.4, 0.7, 1.1])
    why, point = "round-off", (10.0, -4.0, 8.0)
    for name, convention in reference.CONVENTIONS.items():
        table = RaoShip(**reference.rao_rows(ship, convention))
        yield small(f"problems of the table, {name}", float(len([*table_problems(table)])), 0.0, "it is as declared")
        for degrees in (0.0, 60.0, 225.0):
            heading = np.radians(degrees)
            found = motion_of_point(vessel_of(table, 9.81).motions(omega, heading), point)
            exact = motion_of_point(ship.motions(omega, heading), point)
            yield small(f"motion of a point, {name}, {degrees:g} deg, m/m", abs(found - exact).max(), 1e-8, why)
    sound = reference.rao_rows(ship, reference.CONVENTIONS["lag, y to port"])
    pitch = np.degrees(sound["pitch"]).tolist()
    slips = {"lead for lag": {"phase": "lead"}, "from for towards": {"waves": "from"},
             "z down for z up": {"axes": "starboard_down"}, "degrees for radians": {"pitch": tuple(pitch)}}  # fmt: skip
    for name, slip in slips.items():
        count = len([*table_problems(RaoShip(**sound | slip))])
        yield close(f"refused, {name}", float(count > 0), 1.0, 0.0, "a slip that long waves show")


def _heaving_cable() -> Iterator[Check]:
    """Body and tension of an elastic cable in heave against 2000 masses on springs."""
    omega = np.array([0.5, 0.7, 0.9, 1.2])
    ours = heave_transfer(Bar(2e7, 5.0, 8000.0, 3000.0), np.array([1.2e4]), omega)
    exact = reference.heave_of_masses(reference.SpringMasses(2e7, 5.0, 8000.0, 3000.0), 1.2e4, omega)
    why = "the masses' own error"
    for name, found, expected in zip(("body, m/m", "end, N/m", "top, N/m"), ours[:3], exact, strict=True):
        yield each_close(f"heave at 0.5, 0.7, 0.9, 1.2 rad/s: {name}", abs(found[0]), abs(expected), 1e-5, why)


def _heave_in_the_tension() -> Iterator[Check]:
    """Tension of the string under a heaving sheave, near the axial resonance, against 2000 masses on springs."""
    omega, amplitude, phase = np.array([0.5, 1.2]), np.array([0.3, 0.1]), np.array([0.4, -1.0])
    waves = zip(amplitude.tolist(), omega.tolist(), (phase + np.pi / 2.0).tolist(), strict=True)
    scenario = open_loop(winch={"law": "constant", "length": 3000.0}, duration=20.0, grid={"elements": 4, "step": 0.05})
    run = completed(scenario.replace({
        "cable.axial_stiffness": 2e7, "cable.line_density": 5.0, "environment.gravity": 9.81,
        "payload": {"mass": 8000.0, "damping": 0.0, "water": {"vertical_drag": 4500.0}, "wet_weight": 70e3},
        "environment.water": {}, "environment.vessel_heave": [sine(*wave) for wave in waves],
    }))  # fmt: skip
    answer = reference.heave_with_drag(reference.SpringMasses(2e7, 5.0, 8000.0, 3000.0), 4500.0, omega, amplitude)
    turning = amplitude * np.exp(1j * (np.outer(run["time"].values, omega) + phase))
    for name, found, static in (("end", 1, 70e3), ("top", 2, 70e3 + 5.0 * 9.81 * 3000.0)):
        exact = static - np.real(turning @ answer[found])
        gap = abs(run[f"{name}_tension"].values - exact).max() / abs(exact - static).max()
        yield small(f"{name} tension, share of its largest swing", gap, 1e-4, "the masses' own error")


def _screening() -> Iterator[Check]:
    """Statistics and limits of a work-class ROV in its TMS in bow quartering seas."""
    operation, why = load_operation("work-class"), "the reference lets short waves move the ship"
    for depth in DEPTHS.tolist():
        found = respond(operation, Spectrum(2.5, 8.0), depth=depth, heading=BOW_QUARTER)
        exact = reference.work_class_statistics(2.5, depth, BOW_QUARTER)
        ours = (found.body.rms, found.end.rms, found.top.rms)
        expected = (exact["body"], exact["end"], exact["top"])
        yield each_close(f"rms of body, end, top at {depth:g} m", ours, expected, 3e-3, why)
        yield close(f"P of slack in three hours, Hs 2.5 m, {depth:g} m", found.slack_probability(10800.0),
                    exact["slack"], 0.2, "1e-3 of sigma is 14 % of it at 500 m")  # fmt: skip
    deepest = respond(operation, Spectrum(2.5, 8.0), depth=3000.0, heading=BOW_QUARTER)
    yield close("rms of the top tension at 3000 m, kN", float(deepest.top.rms) / 1e3, 9.16, 5e-3, "printed to 10 N")
    criterion = Criterion("slack", 0.0, 1e-2, 3 * 3600.0)
    limits = operate(operation, [criterion], depth=DEPTHS, period=np.array([8.0]), heading=np.array([BOW_QUARTER]))
    yield each_close("limiting Hs at 500, 1500, 3000 m, m", limits.limit[:, 0, 0], PRINTED, 5e-3, "printed to 1 cm")
    for depth, height in zip(DEPTHS.tolist(), limits.limit[:, 0, 0].tolist(), strict=True):
        there = reference.work_class_statistics(height, depth, BOW_QUARTER)["slack"]
        yield close(f"probability of slack at the limit, {depth:g} m", there, 1e-2, 0.05, "1e-3 of sigma is 2 % of it")


def _compensation() -> Iterator[Check]:
    """A drive of 6 rad/s with a delay of 0.05 s, and what is left of the tension at 3000 m."""
    drive = HeaveCompensation(lag=0.05, bandwidth=6.0)
    found = abs(residual_heave(drive, 2.0 * np.pi / np.array([8.0, 6.0])))
    yield each_close("residual heave at 8 and 6 s", found, [0.2232, 0.2981], 5e-4, "printed to four digits")
    pure = abs(residual_heave(HeaveCompensation(lag=0.15, bandwidth=1e3, damping=0.7), 2.0 * np.pi / np.array([8.0])))
    exact = 2.0 * np.sin(np.pi / 8.0 * 0.15)
    yield close("residual of a delay of 0.15 s, 8 s", pure[0], exact, 0.02, "a drive of 1000 rad/s")
    operation = load_operation("work-class", {"compensation": {"lag": 0.05, "bandwidth": 6.0}})
    left = respond(operation, Spectrum(2.5, 8.0), depth=3000.0, heading=BOW_QUARTER)
    yield close("rms of the top tension, kN", float(left.top.rms) / 1e3, 2.97, 5e-3, "printed to 10 N")


TEXTBOOK = "textbook form"
CASES = (
    Case("sea, wave spectra", "closed forms and quadrature to 20 digits", "Pierson-Moskowitz, JONSWAP", _spectra),
    Case(
        "sea, vessel in long waves",
        "the elevation at the same point",
        "a floating body follows long waves",
        _long_waves,
    ),
    Case("sea, tables of RAOs", "the closed form that the table was written from", TEXTBOOK, _response_tables),
    Case("sea, cable in heave", "2000 masses on springs", TEXTBOOK, _heaving_cable),
    Case("sea, heave in the string's tension", "2000 masses on springs", TEXTBOOK, _heave_in_the_tension),
    Case("sea, screening", "600 masses, fixed-point iteration", "two earlier programs", _screening),
    Case("sea, heave compensation", "closed forms", TEXTBOOK, _compensation),
)  # fmt: skip

"""Waves, vessel, the heaving cable and the limits that follow from them."""

from __future__ import annotations

from typing import Any

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
from umbilical.verify.cases import Cases, Checks, close, small
from umbilical.verify.engine import finished, open_loop, sine
from umbilical.verify.references import sea as reference

CASES = Cases()
TEXTBOOK = "textbook form"
SPRINGS = ("2000 masses on springs", TEXTBOOK)
SHIP = BoxVessel(93.0, 20.0, 6.6, 0.75)
BOW_QUARTER = np.radians(135.0)
MASSES = reference.SpringMasses(2e7, 5.0, 8000.0, 3000.0)
DEPTHS = np.array([500.0, 1500.0, 3000.0])
PRINTED = np.array([4.18, 1.64, 2.59])
"""Limiting Hs of two earlier programs, m, for a probability of slack of 1e-2 in three hours, Tp 8 s."""


@CASES.add("sea, wave spectra", "closed forms and quadrature to 20 digits", "Pierson-Moskowitz, JONSWAP")
def _spectra() -> Checks:
    """Periods and normalisation of Pierson-Moskowitz and JONSWAP, and the waves that stand for them."""
    why, gammas, sea, m0 = "quadrature on both sides", (2.0, 3.3, 5.0), Spectrum(2.5, 8.0), 2.5**2 / 16.0
    for gamma, exact in ((1.0, reference.pierson_moskowitz_ratios()), (3.3, reference.jonswap_ratios(3.3))):
        found = [Spectrum(2.5, 8.0, gamma).period(kind) / 8.0 for kind in ("mean", "zero_crossing")]
        yield close(f"T1/Tp and Tz/Tp, gamma = {gamma:g}", found, exact, 1e-8, why)
    exact = [reference.peakedness_factor(gamma) for gamma in gammas]
    yield close("A(gamma), gamma = 2, 3.3, 5", [normalisation(gamma) for gamma in gammas], exact, 1e-7, why)
    omega = np.geomspace(0.1, 60.0, 20001)
    energy = np.trapezoid(sea.density(omega), omega)
    yield close("m0 of the density, m2", energy, m0, 1e-5, "what the trapezoidal rule leaves")
    waves = discretise(sea, 100, seed=1)
    yield close("sum a^2/2 of 100 bins, m2", (waves.amplitude**2).sum() / 2.0, m0, 1e-12, "exact by design")
    velocity = np.sqrt((waves.amplitude**2 * waves.omega**2).sum() / 2.0)
    yield close("rms of the vertical velocity, m/s", velocity, np.sqrt(sea.moment(2)), 0.01, "wide bins in the tail")


@CASES.add("sea, vessel in long waves", "the elevation at the same point", "a floating body follows long waves")
def _long_waves() -> Checks:
    """A ship follows waves much longer than itself."""
    omega = np.array([2.0 * np.pi / 60.0])
    for degrees in (0.0, 45.0, 135.0, 180.0):
        heading = np.radians(degrees)
        for name, forward in {"midship": 0.0, "40 m forward": 40.0}.items():
            deck = np.exp(-1j * omega**2 / 9.81 * forward * np.cos(heading))
            off = abs(heave_of_point(SHIP, omega, heading, forward, 0.0) - deck)[0]
            yield small(f"heave less elevation, {name}, {degrees:g} deg", off, 5e-3, "what is left at a period of 60 s")


@CASES.add("sea, tables of RAOs", "the closed form that the table was written from", TEXTBOOK)
def _response_tables() -> Checks:
    """The closed-form vessel through tables of RAOs in several conventions, and tables that must be refused."""
    omega, point = np.array([0.4, 0.7, 1.1]), (10.0, -4.0, 8.0)

    def problems(rows: dict[str, Any]) -> int:
        return len([*table_problems(RaoShip(**rows))])

    for name, convention in reference.CONVENTIONS.items():
        rows = reference.rao_rows(SHIP, convention)
        yield small(f"problems of the table, {name}", problems(rows), 0.0, "it is as declared")
        for degrees in (0.0, 60.0, 225.0):
            vessels = (vessel_of(RaoShip(**rows), 9.81), SHIP)
            found, exact = (motion_of_point(ship.motions(omega, np.radians(degrees)), point) for ship in vessels)
            yield small(f"motion of a point, {name}, {degrees:g} deg, m/m", abs(found - exact).max(), 1e-8, "round-off")
    sound = reference.rao_rows(SHIP, reference.CONVENTIONS["lag, y to port"])
    slips = {
        "lead for lag": {"phase": "lead"}, "from for towards": {"waves": "from"},
        "z down for z up": {"axes": "starboard_down"},
        "degrees for radians": {"pitch": tuple(np.degrees(sound["pitch"]).tolist())},
    }  # fmt: skip
    for name, slip in slips.items():
        yield close(f"refused, {name}", problems(sound | slip) > 0, 1.0, 0.0, "a slip that long waves show")


@CASES.add("sea, cable in heave", *SPRINGS)
def _heaving_cable() -> Checks:
    """Body and tension of an elastic cable in heave against 2000 masses on springs."""
    omega = np.array([0.5, 0.7, 0.9, 1.2])
    ours = heave_transfer(Bar(2e7, 5.0, 8000.0, 3000.0), np.array([1.2e4]), omega)
    exact = reference.heave_of_masses(MASSES, 1.2e4, omega)
    for name, found, expected in zip(("body, m/m", "end, N/m", "top, N/m"), ours[:3], exact, strict=True):
        what = f"heave at 0.5, 0.7, 0.9, 1.2 rad/s: {name}"
        yield close(what, abs(found[0]), abs(expected), 1e-5, "the masses' own error")


@CASES.add("sea, heave in the string's tension", *SPRINGS)
def _heave_in_the_tension() -> Checks:
    """Tension of the string under a heaving sheave, near the axial resonance, against 2000 masses on springs."""
    omega, amplitude, phase = np.array([0.5, 1.2]), np.array([0.3, 0.1]), np.array([0.4, -1.0])
    waves = zip(amplitude.tolist(), omega.tolist(), (phase + np.pi / 2.0).tolist(), strict=True)
    run = finished(open_loop(
        winch={"law": "constant", "length": 3000.0}, duration=20.0, grid={"elements": 4, "step": 0.05},
        cable__axial_stiffness=2e7, cable__line_density=5.0, environment__gravity=9.81, environment__water={},
        payload={"mass": 8000.0, "damping": 0.0, "water": {"vertical_drag": 4500.0}, "wet_weight": 70e3},
        environment__vessel_heave=[sine(*wave) for wave in waves],
    ))  # fmt: skip
    answer = reference.heave_with_drag(MASSES, 4500.0, omega, amplitude**2 / 2.0)
    turning = amplitude * np.exp(1j * (np.outer(run["time"].values, omega) + phase))
    for name, found, static in (("end", 1, 70e3), ("top", 2, 70e3 + 5.0 * 9.81 * 3000.0)):
        swing = np.real(turning @ answer[found])
        gap = abs(run[f"{name}_tension"].values - static + swing).max() / abs(swing).max()
        yield small(f"{name} tension, share of its largest swing", gap, 1e-4, "the masses' own error")


@CASES.add("sea, screening", "600 masses, fixed-point iteration", "two earlier programs")
def _screening() -> Checks:
    """Statistics and limits of a work-class ROV in its TMS in bow quartering seas."""
    operation, sea = load_operation("work-class"), Spectrum(2.5, 8.0)
    why = "the reference lets short waves move the ship"
    for depth in DEPTHS.tolist():
        found = respond(operation, sea, depth=depth, heading=BOW_QUARTER)
        exact = reference.work_class_statistics(2.5, depth, BOW_QUARTER)
        ours, theirs = zip(*((getattr(found, part).rms, exact[part]) for part in ("body", "end", "top")), strict=True)
        yield close(f"rms of body, end, top at {depth:g} m", ours, theirs, 3e-3, why)
        yield close(f"P of slack in three hours, Hs 2.5 m, {depth:g} m", found.slack_probability(10800.0),
                    exact["slack"], 0.2, "1e-3 of sigma is 14 % of it at 500 m")  # fmt: skip
    yield close("rms of the top tension at 3000 m, kN", found.top.rms / 1e3, 9.16, 5e-3, "printed to 10 N")
    criterion = Criterion("slack", 0.0, 1e-2, 3 * 3600.0)
    found = operate(operation, [criterion], depth=DEPTHS, period=np.array([8.0]), heading=np.array([BOW_QUARTER]))
    limits = found.limit[:, 0, 0]
    yield close("limiting Hs at 500, 1500, 3000 m, m", limits, PRINTED, 5e-3, "printed to 1 cm")
    for depth, height in zip(DEPTHS.tolist(), limits.tolist(), strict=True):
        there = reference.work_class_statistics(height, depth, BOW_QUARTER)["slack"]
        yield close(f"probability of slack at the limit, {depth:g} m", there, 1e-2, 0.05, "1e-3 of sigma is 2 % of it")


@CASES.add("sea, heave compensation", "closed forms", TEXTBOOK)
def _compensation() -> Checks:
    """A drive of 6 rad/s with a delay of 0.05 s, and what is left of the tension at 3000 m."""
    omega = 2.0 * np.pi / np.array([8.0, 6.0])
    found = abs(residual_heave(HeaveCompensation(lag=0.05, bandwidth=6.0), omega))
    yield close("residual heave at 8 and 6 s", found, [0.2232, 0.2981], 5e-4, "printed to four digits")
    pure = abs(residual_heave(HeaveCompensation(lag=0.15, bandwidth=1e3, damping=0.7), omega))
    exact = 2.0 * np.sin(np.pi / 8.0 * 0.15)
    yield close("residual of a delay of 0.15 s, 8 s", pure[0], exact, 0.02, "a drive of 1000 rad/s")
    operation = load_operation("work-class", {"compensation": {"lag": 0.05, "bandwidth": 6.0}})
    left = respond(operation, Spectrum(2.5, 8.0), depth=3000.0, heading=BOW_QUARTER)
    yield close("rms of the top tension, kN", left.top.rms / 1e3, 2.97, 5e-3, "printed to 10 N")

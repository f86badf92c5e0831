"""Checks of a table of RAOs: its rows, its long waves, and what of a sea it covers.

A body much shorter than the waves follows the water: heave is 1 without a lag, surge and sway follow the orbits a
quarter of a period behind the crest (in following waves), pitch and roll the slope. A table that says otherwise has
another convention than is declared. Lead for lag and headings *from* for *towards* look alike there: both turn surge,
sway, roll and pitch.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.errors import Problem
from umbilical.scenario.ship import MOTIONS, RaoShip
from umbilical.sea.rao import RaoVessel, grid_of, vessel_of
from umbilical.sea.spectrum import Spectrum

LONG = 20.0
"""s; waves from here on are long for any ship: 625 m."""
LEAST_COVERED = 0.99
"""Share of the energy of a sea that must lie within the table."""
_NEAR = 0.25
_CLEAR = 0.3


def table_problems(ship: RaoShip, key: str = "vessel", gravity: float = 9.81) -> Iterator[Problem]:
    """Everything that is wrong with a table by itself."""
    counts = {name: len(getattr(ship, name)) for name in ("heading", "frequency", *_lists(ship))}
    if len(set(counts.values())) > 1:
        assumed_of_table = ", ".join(f"{name} {count}" for name, count in counts.items())
        yield Problem(key, assumed_of_table, "equally many rows", "a row has one of each", "complete the columns")
        return
    if min(ship.frequency) <= 0.0 or not np.isfinite(ship.frequency).all():
        yield Problem(
            f"{key}.frequency", f"{min(ship.frequency):g} rad/s", "above 0", "a wave has a period", "leave it out"
        )
        return
    try:
        _, omega, _ = grid_of(ship)
    except ValueError as error:
        reason = "the table is a grid: every heading has every frequency, once"
        yield Problem(f"{key}.heading", str(error), "a full grid", reason, "complete it, or leave rows out")
        return
    longest = float(2.0 * np.pi / omega[0])
    if longest < LONG:
        reason = "where a table ends in short waves nothing shows whether its conventions are as declared"
        yield Problem(
            f"{key}.frequency", f"periods up to {longest:.4g} s", f"{LONG:g} s or more", reason,
            "extend it; heave is 1 there",
        )  # fmt: skip
        return
    vessel = vessel_of(ship, gravity)
    assert isinstance(vessel, RaoVessel)
    yield from _long_waves(vessel, key, gravity)


def assumed_of_table(ship: RaoShip) -> Iterator[str]:
    """What a table leaves open, in words."""
    missing = [name for name in MOTIONS if not getattr(ship, name)]
    if missing:
        yield f"the RAO table has no {', '.join(missing)}: taken as 0"
    if ship.outside != "refuse":
        shortest, longest = 2.0 * np.pi / max(ship.frequency), 2.0 * np.pi / min(ship.frequency)
        taken = "those of its last row" if ship.outside == "hold" else "none"
        yield f"outside the {shortest:.3g} to {longest:.3g} s of the RAO table the motions are {taken}, as declared"
    if not set(MOTIONS[:2]) - set(missing) and "pitch" not in missing:
        return
    if {"surge", "sway", "roll", "pitch"} <= set(missing):
        yield f"heave alone does not show the sign of its phase: {ship.phase} is taken as declared"


def covered(vessel: RaoVessel, spectrum: Spectrum) -> float:
    """Share of a sea's energy within the frequencies of a table."""
    inside = np.linspace(vessel.omega[0], vessel.omega[-1], 4001)
    return float(np.trapezoid(spectrum.density(inside), inside) / spectrum.moment(0))


def sea_problems(vessel: RaoVessel, spectrum: Spectrum, heading: float, key: str = "vessel") -> Iterator[Problem]:
    """Whether a table knows what it is asked: the frequencies of a sea, and its heading."""
    share = covered(vessel, spectrum)
    if share < LEAST_COVERED and vessel.outside == "refuse":
        low, high = 2.0 * np.pi / vessel.omega[-1], 2.0 * np.pi / vessel.omega[0]
        yield Problem(
            f"{key}.frequency", f"periods from {low:.4g} to {high:.4g} s hold {share:.1%} of the energy of a sea of Tp "
            f"{spectrum.peak_period:.4g} s", f"{LEAST_COVERED:.0%} or more",
            "on a short cable resonance makes small motions in short waves count",
            f'extend the table, or say {key}.outside = "hold" (the motions of its last row) or "zero"',
        )  # fmt: skip
    if not vessel.knows(heading):
        known = ", ".join(f"{angle:.4g}" for angle in np.degrees(vessel.heading))
        yield Problem(
            f"{key}.heading", f"waves towards {np.degrees(heading):.4g} deg", f"near {known} deg",
            "no heading is interpolated between two more than 46 deg apart", "more headings",
        )  # fmt: skip


def _lists(ship: RaoShip) -> list[str]:
    used = [name for name in MOTIONS if getattr(ship, name) or getattr(ship, f"{name}_phase")]
    return [part for name in used for part in (name, f"{name}_phase")]


def _long_waves(vessel: RaoVessel, key: str, gravity: float) -> Iterator[Problem]:
    """Motions in the longest waves of the table against those of the water."""
    k = vessel.omega[0] ** 2 / gravity
    long = vessel.amplitudes[:, :, 0]
    cos, sin = np.cos(vessel.heading), np.sin(vessel.heading)
    expected = np.array([-1j * cos, -1j * sin, np.ones_like(cos) + 0j, -1j * k * sin, 1j * k * cos])
    worst = int(np.argmax(abs(abs(long[2]) - 1.0)))
    if abs(abs(long[2, worst]) - 1.0) > _NEAR:
        yield _misfit(f"{key}.heave", f"{abs(long[2, worst]):.4g} m/m", "1 within a quarter", "it follows long waves",
                      "check the unit and the motion point")  # fmt: skip
        return
    if (long[2].real < 0.0).any():
        yield _misfit(f"{key}.axes", "heave against the wave", "heave with it", "long waves lift a ship",
                      "the other axes, or another phase origin")  # fmt: skip
        return
    turned = [name for name, found, wanted in _signs(long, expected) if found < -_CLEAR * wanted]
    if "pitch" in turned and not {"surge", "sway", "roll"} & set(turned):
        yield _misfit(f"{key}.axes", "pitch against the slope", "pitch with it", "long waves turn a ship with it",
                      "the other axes: is pitch positive bow up?")  # fmt: skip
    elif turned:
        yield _misfit(f"{key}.phase", f"{', '.join(turned)} against the water",
                      "with it", "long waves carry a ship along; surge, sway, pitch and roll tell lead from lag",
                      "lead/lag swapped? or headings from for towards?")  # fmt: skip
    yield from _rotations(long, expected, key)


def _signs(long: np.ndarray, expected: np.ndarray) -> Iterator[tuple[str, float, float]]:
    """Of each motion but heave: how far it agrees with the water, and how far it should."""
    for row, name in enumerate(MOTIONS[:5]):
        if name != "heave":
            yield name, float(np.sum(long[row] * np.conj(expected[row])).real), float(np.sum(abs(expected[row]) ** 2))


def _rotations(long: np.ndarray, expected: np.ndarray, key: str) -> Iterator[Problem]:
    """Pitch as large as the slope of the water: a slip of degrees for radians is a factor of 57."""
    size, slope = np.sqrt(np.mean(abs(long[4]) ** 2)), np.sqrt(np.mean(abs(expected[4]) ** 2))
    if size > 0.0 and slope > 0.1 * abs(expected[4]).max() and not 0.3 < size / slope < 3.0:
        yield _misfit(f"{key}.pitch", f"{size / slope:.3g} times the slope of long waves", "once", "a ship follows it",
                      "deg/m or rad/m? rotations per metre or per slope?")  # fmt: skip


def _misfit(key: str, value: str, bound: str, reason: str, fix: str) -> Problem:
    return Problem(key, f"in the longest waves of the table: {value}", bound, reason, fix)

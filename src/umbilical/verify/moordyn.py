"""The fixed-length cable under a moving vessel: ours and MoorDyn's, each against the exact sum of modes.

MoorDyn cuts the cable into straight segments with the mass at their ends; its distance to the exact answer falls at
second order in their length. It is no reference for paying out: it rescales all segments.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial

import numpy as np

from umbilical.analysis.convergence import Curve
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, history_close, order_reached, small
from umbilical.verify.engine import sine
from umbilical.verify.hanging_string import hung
from umbilical.verify.references import lumped_mass
from umbilical.verify.references.hanging_string import HangingString, carried_tip

IN_AIR, IN_WATER = HangingString(), HangingString(weight_left=0.6, line_weight_left=0.5)
AMPLITUDE, FREQUENCY, RAMP, UNTIL = 0.05, 0.8, 10.0, 50.0
SEGMENTS = (20, 50, 100)
TOLERANCE = 1e-4
WHY = "four digits, as for the frequencies; MoorDyn at 100 segments misses by 4e-3"


def sampled_instants() -> np.ndarray:
    """Instants of the comparison, s."""
    return np.arange(round(UNTIL / lumped_mass.STEP) + 1) * lumped_mass.STEP


def faded_sine(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """e and its two derivatives: a sine that is faded in by ``10 q^3 - 15 q^4 + 6 q^5``."""
    q = np.clip(t / RAMP, 0.0, 1.0)
    fade = 10.0 * q**3 - 15.0 * q**4 + 6.0 * q**5
    fade1 = (30.0 * q**2 - 60.0 * q**3 + 30.0 * q**4) / RAMP
    fade2 = (60.0 * q - 180.0 * q**2 + 120.0 * q**3) / RAMP**2
    s, c, w = AMPLITUDE * np.sin(FREQUENCY * t), AMPLITUDE * np.cos(FREQUENCY * t), FREQUENCY
    return s * fade, w * c * fade + s * fade1, -w * w * s * fade + 2.0 * w * c * fade1 + s * fade2


@cache
def _exact(string: HangingString) -> np.ndarray:
    """y(l,t), m, as the sum of 60 modes: six digits."""
    t = sampled_instants()
    return faded_sine(t)[0] + carried_tip(string, lambda u: faded_sine(u)[2], t)


def _tip_of_run(string: HangingString) -> np.ndarray:
    """y(l,t), m, of the engine at the default grid."""
    scenario = hung(
        string, duration=UNTIL, output__interval=lumped_mass.STEP,
        environment__vessel_motion=[sine(AMPLITUDE, FREQUENCY)], environment__vessel_ramp=RAMP,
    )  # fmt: skip
    return engine.completed(scenario)["tip_displacement"].values


@cache
def _other(string: HangingString, segments: int) -> np.ndarray:
    """y(l,t), m, of MoorDyn."""
    e, velocity, _ = faded_sine(sampled_instants())
    return lumped_mass.tip(string, segments, e, velocity)


def _carried(string: HangingString) -> Iterator[Check]:
    """Ours alone."""
    yield history_close("y(l,t) over 50 s, m", _tip_of_run(string), _exact(string), TOLERANCE, WHY)


def _side_by_side(string: HangingString) -> Iterator[Check]:
    """Both distances; ours must be far the smaller."""
    peak = np.abs(_exact(string)).max()
    off = [float(np.abs(_other(string, n) - _exact(string)).max() / peak) for n in SEGMENTS]
    for n, distance in zip(SEGMENTS, off, strict=True):
        what = f"MoorDyn's y(l,t), {n} segments, distance over peak"
        yield small(what, distance, 60.0 / n**2, "second order: 60/n^2")
    mine = float(np.abs(_tip_of_run(string) - _exact(string)).max() / peak)
    yield small("our distance over that of MoorDyn at 100 segments", mine / off[-1], 0.01, "far smaller: a hundredth")
    sizes = tuple(string.length / n for n in SEGMENTS[1:])
    yield order_reached(Curve("MoorDyn's y(l,t)", "its segments, m", sizes, tuple(off[1:]), 2.0), "lumped masses")


MODES = "e + sum of 60 Bessel modes"
BESIDE = "moordyn, in {}, EA 1e8 N, RK4, cfl 0.1"
CASES = (
    Case("vessel in motion, l = 500 m", MODES, "forced hanging string", partial(_carried, IN_AIR)),
    *(
        Case(f"vessel in motion, beside MoorDyn{where}", MODES, BESIDE.format("water" if where else "vacuum"),
             partial(_side_by_side, string), quick=False, needs="moordyn")
        for where, string in (("", IN_AIR), (", in water", IN_WATER))
    ),
)  # fmt: skip

"""The fixed-length cable under a moving vessel: ours and MoorDyn's, each against the exact sum of modes.

MoorDyn cuts the cable into straight segments with the mass at their ends; its distance to the exact answer falls at
second order in their length. It is no reference for paying out: it rescales all segments.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.polynomial import Polynomial

from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, orders_reached, same_history, small
from umbilical.verify.engine import sine
from umbilical.verify.hanging_string import hung
from umbilical.verify.references import lumped_mass
from umbilical.verify.references.hanging_string import HangingString, carried_tip

CASES = Cases()
IN_AIR, IN_WATER = HangingString(), HangingString(weight_left=0.6, line_weight_left=0.5)
AMPLITUDE, FREQUENCY, RAMP, UNTIL = 0.05, 0.8, 10.0, 50.0
SEGMENTS = (20, 50, 100)


def sampled_instants() -> np.ndarray:
    """Instants of the comparison, s."""
    return np.arange(round(UNTIL / lumped_mass.STEP) + 1) * lumped_mass.STEP


def faded_sine(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """e and its two derivatives: a sine that is faded in by ``10 q^3 - 15 q^4 + 6 q^5``."""
    q, ramp = np.clip(t / RAMP, 0.0, 1.0), Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    fade, fade1, fade2 = (ramp.deriv(n)(q) / RAMP**n for n in range(3))
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
    return engine.finished(scenario)["tip_displacement"].values


MODES = "e + sum of 60 Bessel modes"


@CASES.add("vessel in motion, l = 500 m", MODES, "forced hanging string")
def _carried() -> Checks:
    """Ours alone."""
    why = "four digits, as for the frequencies; MoorDyn at 100 segments misses by 4e-3"
    yield same_history("y(l,t) over 50 s, m", _tip_of_run(IN_AIR), _exact(IN_AIR), 1e-4, why)


@CASES.add("vessel in motion, beside MoorDyn, in water", MODES, "moordyn, in water, EA 1e8 N, RK4, cfl 0.1", [IN_WATER],
           quick=False, needs="moordyn")  # fmt: skip
@CASES.add("vessel in motion, beside MoorDyn", MODES, "moordyn, in vacuum, EA 1e8 N, RK4, cfl 0.1", [IN_AIR],
           quick=False, needs="moordyn")  # fmt: skip
def _side_by_side(string: HangingString) -> Checks:
    """Both distances; ours must be far the smaller."""
    (e, velocity, _), exact = faded_sine(sampled_instants()), _exact(string)
    found = [lumped_mass.tip(string, n, e, velocity) for n in SEGMENTS]
    *off, mine = (float(np.abs(y - exact).max() / np.abs(exact).max()) for y in (*found, _tip_of_run(string)))
    for n, distance in zip(SEGMENTS, off, strict=True):
        what = f"MoorDyn's y(l,t), {n} segments, distance over peak"
        yield small(what, distance, 60.0 / n**2, "second order: 60/n^2")
    yield small("our distance over that of MoorDyn at 100 segments", mine / off[-1], 0.01, "far smaller: a hundredth")
    sizes = [string.length / n for n in SEGMENTS[1:]]
    yield from orders_reached({"MoorDyn's y(l,t)": 2.0}, "its segments, m", sizes, np.c_[off[1:]], "lumped masses")

"""Deflection under a steady force P on the ROV, and what follows when the force is gone."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, history_close
from umbilical.verify.engine import UNDAMPED, constant, open_loop
from umbilical.verify.references.hanging_string import HangingString, released_tip, static_shape

FORCE, STRING = 100.0, HangingString()
TOLERANCE = 1e-4
WHY = "four digits; half the ROV's inertia moves the release by 1"
LOGARITHM = "P/(rho g) ln((m + rho l)/(m + rho (l - x)))"
SOURCE = "statics of the hanging string"


def _stays() -> Iterator[Check]:
    """The cable starts in its static shape and nothing happens."""
    start, push = {"shape": "static", "force": FORCE}, [constant(FORCE)]
    y = engine.completed(open_loop(initial=start, duration=40.0, environment__payload_force=push))["displacement"]
    exact = static_shape(STRING, FORCE, y["sigma"].values)
    why = "four digits; a load a per cent too large moves it by 1e-2"
    yield history_close("y at the start, m", y.values[0], exact, TOLERANCE, "interpolation on the grid")
    yield history_close("y over 40 s, m", y.values, np.broadcast_to(exact, y.shape), TOLERANCE, why)


def _settles() -> Iterator[Check]:
    """Proportional damping takes 0.15 1/s out of every mode: after 120 s nothing else is left."""
    damped = open_loop(duration=120.0, cable__damping=0.6, payload__damping=150.0)
    y = engine.completed(damped.replace({"environment.payload_force": [constant(FORCE)]}))["displacement"]
    exact = static_shape(STRING, FORCE, y["sigma"].values)
    yield history_close("y after 120 s, m", y.values[-1], exact, TOLERANCE, "exp(-0.15 x 120) is 1.5e-8")
    yield close("stiffness at the ROV, N/m", FORCE / y.values[-1, -1], FORCE / exact[-1], TOLERANCE, "the same")


def _released() -> Iterator[Check]:
    """Undamped release from the static shape."""
    scenario = open_loop(initial={"shape": "static", "force": FORCE}, duration=60.0).replace(UNDAMPED)
    tip = engine.completed(scenario)["tip_displacement"]
    exact = released_tip(STRING, FORCE, tip["time"].values)
    yield history_close("y(l,t) over 60 s, m", tip.values, exact, TOLERANCE, WHY)


CASES = (
    Case("static shape stays", LOGARITHM, SOURCE, _stays),
    Case("cable settles in the static shape", LOGARITHM, SOURCE, _settles),
    Case("release from the static shape", "sum of 80 Bessel modes", SOURCE, _released),
)

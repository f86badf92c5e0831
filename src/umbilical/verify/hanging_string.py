"""Natural frequencies of the hanging cable with a free ROV, from the Jacobian of the engine's own step."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.plant.layout import positions
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, each, each_close, history_close, small
from umbilical.verify.engine import STEADY_TENSION, UNDAMPED, open_loop
from umbilical.verify.references import hanging_string as reference
from umbilical.verify.references.hanging_string import HangingString

TOLERANCE = 1e-4
WHY = "asked for; half the ROV's inertia moves them by 1e-2"
BESSEL = "J0(z1) Y2(z0) - Y0(z1) J2(z0) = 0, roots to 30 digits"
SOURCE = "Frequencies of a hanging chain supporting an end mass"


def hung(string: HangingString, **overrides: object) -> Scenario:
    """The string as a scenario, undamped."""
    return open_loop(
        winch__length=string.length, payload__mass=string.mass, cable__line_density=string.line_density,
        environment__gravity=string.gravity, payload__wet_weight=string.weight,
        cable__wet_line_density=string.line_weight / string.gravity, **overrides,
    ).replace(UNDAMPED)  # fmt: skip


def _compared(string: HangingString, **overrides: object) -> Iterator[Check]:
    """The first six frequencies and shapes, and that nothing decays or grows by itself."""
    scenario = hung(string, **overrides)
    found, shapes = engine.modes(scenario, 6)
    exact = reference.frequencies(string, 6)
    yield each_close("w1 ... w6, rad/s, the worst", np.imag(found), exact, TOLERANCE, WHY)
    above = string.length * (1.0 - positions(scenario.grid.elements))
    wanted = np.array([reference.mode_shape(string, w, above) for w in exact])
    yield history_close("their shapes, 1 at the ROV", shapes, wanted, TOLERANCE, "four digits, as for the frequencies")
    decay = float(np.abs(np.real(found) / np.imag(found)).max())
    yield small("largest |decay|/w of the six", decay, 1e-6, "what the scheme takes must not show in a run")


def _steady_tension() -> Iterator[Check]:
    """The limit rho -> 0 in the tension only."""
    found = engine.poles(hung(HangingString()).replace(STEADY_TENSION), 6)
    exact = reference.steady_tension_frequencies(HangingString(), 6)
    yield each_close("w1 ... w6, rad/s, the worst", np.imag(found), exact, TOLERANCE, WHY)


def _pendulum() -> Iterator[Check]:
    """A cable that weighs nothing beside its ROV: the first mode is a pendulum, the others are those of a fixed end."""
    string = HangingString(line_density=2.0, mass=2e6)
    found = np.imag(engine.poles(hung(string, grid__elements=16, grid__step=2e-4, control__period=2e-4), 4))
    share = string.line_density * string.length / string.mass
    yield close("w1, rad/s", found[0], np.sqrt(string.gravity / string.length), share, "the cable's share of the mass")
    speed = np.sqrt(string.mass * string.gravity / string.line_density)
    exact = np.arange(1, 4) * np.pi * speed / string.length
    yield each_close("w2 ... w4, rad/s, the worst", found[1:], exact, share, "the cable's share of the mass")


CASES = (
    *each("hanging cable, l = {:g} m", BESSEL, SOURCE, lambda length: _compared(HangingString(length=length)),
          (500.0, 400.0, 300.0)),
    *each("hanging cable, m = {:g} kg", BESSEL, SOURCE, lambda mass: _compared(HangingString(mass=mass)),
          (50.0, 5000.0)),
    Case("hanging cable, in water", "the same with T = W + q s", SOURCE,
         lambda: _compared(HangingString(weight_left=0.3, line_weight_left=0.6))),
    Case("hanging cable, constant tension", "cot b = (m/(rho l)) b, b = w l/c", "textbook: string with a mass",
         _steady_tension),
    Case("hanging cable, rho l/m -> 0", "sqrt(g/l) and n pi c/l", "textbook: pendulum, fixed string", _pendulum),
)  # fmt: skip

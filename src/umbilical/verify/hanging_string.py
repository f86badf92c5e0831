"""The hanging cable with a free ROV: frequencies, damped poles, reflection, static deflection and release.

Frequencies and poles are those of the Jacobian of the engine's own step.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from xarray import DataArray

from umbilical.plant.layout import positions
from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Cases, Checks, close, same_history, small
from umbilical.verify.engine import STEADY_TENSION, UNDAMPED, constant, open_loop, sine
from umbilical.verify.references import hanging_string as reference
from umbilical.verify.references.hanging_string import HangingString

CASES, DAMPING = Cases(), Cases()
DIGITS = 1e-4
WHY = "asked for; half the ROV's inertia moves them by 1e-2"
BESSEL = "J0(z1) Y2(z0) - Y0(z1) J2(z0) = 0, roots to 30 digits"
CHAIN = "Frequencies of a hanging chain supporting an end mass"
WORST = "w1 ... w6, rad/s, the worst"
FORCE, STRING, DAMPED = 100.0, HangingString(), HangingString(length=400.0)


def hung(string: HangingString, **overrides: Any) -> Scenario:
    """The string as a scenario, undamped."""
    return open_loop(
        winch__length=string.length, payload__mass=string.mass, cable__line_density=string.line_density,
        environment__gravity=string.gravity, payload__wet_weight=string.weight,
        cable__wet_line_density=string.line_weight / string.gravity, **overrides,
    ).replace(UNDAMPED)  # fmt: skip


@CASES.add("hanging cable, l = {:g} m", BESSEL, CHAIN, {x: HangingString(length=x) for x in (500.0, 400.0, 300.0)})
@CASES.add("hanging cable, m = {:g} kg", BESSEL, CHAIN, {m: HangingString(mass=m) for m in (50.0, 5000.0)})
@CASES.add("hanging cable, {}", "the same with T = W + q s", CHAIN,
           {"in water": HangingString(weight_left=0.3, line_weight_left=0.6)})  # fmt: skip
def _modes(string: HangingString) -> Checks:
    """The first six frequencies and shapes, and that nothing decays or grows by itself."""
    scenario = hung(string)
    found, shapes = engine.modes(scenario, 6)
    exact = reference.frequencies(string, 6)
    yield close(WORST, np.imag(found), exact, DIGITS, WHY)
    above = string.length * (1.0 - positions(scenario.grid.elements))
    wanted = np.array([reference.mode_shape(string, w, above) for w in exact])
    yield same_history("their shapes, 1 at the ROV", shapes, wanted, DIGITS, "four digits, as for the frequencies")
    decay = float(np.abs(np.real(found) / np.imag(found)).max())
    yield small("largest |decay|/w of the six", decay, 1e-6, "what the scheme takes must not show in a run")


@CASES.add("hanging cable, constant tension", "cot b = (m/(rho l)) b, b = w l/c", "textbook: string with a mass")
def _steady_tension() -> Checks:
    """The limit rho -> 0 in the tension only."""
    found = engine.modes(hung(STRING).replace(STEADY_TENSION), 6)[0]
    yield close(WORST, np.imag(found), reference.steady_tension_frequencies(STRING, 6), DIGITS, WHY)


@CASES.add("hanging cable, rho l/m -> 0", "sqrt(g/l) and n pi c/l", "textbook: pendulum, fixed string")
def _pendulum() -> Checks:
    """A cable that weighs nothing beside its ROV: the first mode is a pendulum, the others are those of a fixed end."""
    string = HangingString(line_density=2.0, mass=2e6)
    scenario = hung(string, grid__elements=16, grid__step=2e-4, control__period=2e-4)
    found = np.imag(engine.modes(scenario, 4)[0])
    share, why = string.line_density * string.length / string.mass, "the cable's share of the mass"
    yield close("w1, rad/s", found[0], np.sqrt(string.gravity / string.length), share, why)
    speed = np.sqrt(string.mass * string.gravity / string.line_density)
    yield close("w2 ... w4, rad/s, the worst", found[1:], np.arange(1, 4) * np.pi * speed / string.length, share, why)


LOGARITHM, STATICS = "P/(rho g) ln((m + rho l)/(m + rho (l - x)))", "statics of the hanging string"


@CASES.add("static shape stays", LOGARITHM, STATICS)
def _stays() -> Checks:
    """The cable starts in its static shape and nothing happens."""
    start, push = {"shape": "static", "force": FORCE}, [constant(FORCE)]
    y = engine.finished(open_loop(initial=start, duration=40.0, environment__payload_force=push))["displacement"]
    exact = reference.static_shape(STRING, FORCE, y["sigma"].values)
    yield same_history("y at the start, m", y.values[0], exact, DIGITS, "interpolation on the grid")
    why = "four digits; a load a per cent too large moves it by 1e-2"
    yield same_history("y over 40 s, m", y.values, np.broadcast_to(exact, y.shape), DIGITS, why)


@CASES.add("cable settles in the static shape", LOGARITHM, STATICS)
def _settles() -> Checks:
    """Proportional damping takes 0.15 1/s out of every mode: after 120 s nothing else is left."""
    push = [constant(FORCE)]
    damped = open_loop(duration=120.0, cable__damping=0.6, payload__damping=150.0, environment__payload_force=push)
    y = engine.finished(damped)["displacement"]
    exact = reference.static_shape(STRING, FORCE, y["sigma"].values)
    yield same_history("y after 120 s, m", y.values[-1], exact, DIGITS, "exp(-0.15 x 120) is 1.5e-8")
    yield close("stiffness at the ROV, N/m", FORCE / y.values[-1, -1], FORCE / exact[-1], DIGITS, "the same")


@CASES.add("release from the static shape", "sum of 80 Bessel modes", STATICS)
def _released() -> Checks:
    """Undamped release from the static shape."""
    scenario = open_loop(initial={"shape": "static", "force": FORCE}, duration=60.0).replace(UNDAMPED)
    tip = engine.finished(scenario)["tip_displacement"]
    exact = reference.released_tip(STRING, FORCE, tip["time"].values)
    why = "four digits; half the ROV's inertia moves the release by 1"
    yield same_history("y(l,t) over 60 s, m", tip.values, exact, DIGITS, why)


LIGHT_LENGTH, LIGHT_SPEED, PULSE_AT, PULSE_WIDTH = 100.0, 1.25, 30.0, 8.0
GRAMS = (1e-2, "what the 31 g of its ROV do; a damper off by two misses by 3e-1")
STRING_Z = "impedance of a string, Z = sqrt(rho T)"


@DAMPING.add("damper that swallows everything", "y = 0 after 2 l/c", "impedance of a string, k = Z")
def _swallowed() -> Checks:
    """A damper of k = Z without mass: whatever comes in stays, and after 2 l/c nothing moves any more."""
    late = _pulse_returned(1.0, 2.0 * LIGHT_LENGTH / LIGHT_SPEED)
    yield small("largest |y| after 2 l/c, m", float(np.abs(late.values).max()), *GRAMS)


@DAMPING.add("pulse back from a damper", "(Z - k)/(Z + k)", STRING_Z)
def _returned() -> Checks:
    """A pulse of half a metre on its way back from dampers below and above Z."""
    for share in (0.5, 3.0):
        back = _pulse_returned(share, 48.0).isel(time=0)
        above = LIGHT_LENGTH * (1.0 - back["sigma"].values)
        way = above - (LIGHT_SPEED * 48.0 - PULSE_AT)
        exact = 0.5 * (1.0 - share) / (1.0 + share) * np.exp(-((way / PULSE_WIDTH) ** 2))
        low = above < 60.0
        yield same_history(f"y of the pulse, m, k = {share:g} Z", back.values[low], exact[low], *GRAMS)


def _pulse_returned(share: float, since: float) -> DataArray:
    """y from ``since`` on: T = 3.125 N, Z = 2.5 N s/m, a damper of ``share`` Z, a pulse let go near the ROV."""
    scenario = open_loop(
        winch__length=LIGHT_LENGTH, payload={"mass": 0.03125, "damping": 2.5 * share}, environment__gravity=100.0,
        cable__damping=0.0, duration=since + 20.0, output__interval=1.0, grid__step=5e-4,
        initial={"shape": "gaussian", "amplitude": 1.0, "distance": PULSE_AT, "width": PULSE_WIDTH},
    )  # fmt: skip
    return engine.finished(scenario.replace(STEADY_TENSION))["displacement"].sel(time=slice(since - 1e-6, None))


@DAMPING.add("damping in proportion to the mass", "-c/(2 rho) +- i sqrt(w^2 - (c/2 rho)^2)", "Rayleigh damping")
def _proportional() -> Checks:
    """With c_tip = c m/rho every mode decays alike."""
    rate = 0.04 / (2.0 * DAMPED.line_density)
    exact = -rate + 1j * np.sqrt(reference.frequencies(DAMPED, 6) ** 2 - rate**2)
    return _same_poles("six", 0.04, 0.04 * DAMPED.mass / DAMPED.line_density, exact)


@DAMPING.add("damper of {:g} N s/m at the ROV", "(m s^2 + c_tip s) Y + T Y_x = 0, Bessel functions",
             "boundary condition (8)", (40.0, 400.0))  # fmt: skip
def _at_the_payload(damping: float) -> Checks:
    """Roots of the damped frequency equation."""
    return _same_poles("five", 0.0, damping, reference.damped_poles(DAMPED, damping, 5))


def _same_poles(count: str, cable: float, payload: float, exact: np.ndarray) -> Checks:
    """Of the 400 m cable with dampers, N s/m2 and N s/m."""
    scenario = open_loop(winch__length=DAMPED.length, grid__elements=24, cable__damping=cable, payload__damping=payload)
    found = engine.modes(scenario, exact.size)[0]
    yield close(f"{count} poles, 1/s, the worst", found, exact, DIGITS, "as for the frequencies")
    why = "decay is a small part of a pole, so it gets a digit less"
    yield close("their decay, 1/s, the worst", np.real(found), np.real(exact), 1e-3, why)


@DAMPING.add("reflection at the ROV, damper {:g} N s/m", "(Z - k - i w m)/(Z + k + i w m)", STRING_Z, (40.0, 100.0))
def _reflection(damping: float) -> Checks:
    """Amplitude and phase that come back from the ROV, from a cable shaken at the vessel until nothing else is left.

    Constant tension: T = 5000 N, c = 50 m/s, Z = 100 N s/m. Up to down, ``R = (Z - k - i w m)/(Z + k + i w m)``.
    """
    impedance, mass, speed, length, frequency = 100.0, 500.0, 50.0, 100.0, 0.3
    scenario = open_loop(
        winch__length=length, grid__elements=8, payload__damping=damping, cable__damping=0.0, duration=400.0,
        environment__vessel_motion=[sine(1.0, frequency)], environment__vessel_ramp=20.0,
    )  # fmt: skip
    late = engine.finished(scenario.replace(STEADY_TENSION))["displacement"].sel(time=slice(360.0 + 1e-6, None))
    t, above = late["time"].values[:, None], length * (1.0 - late["sigma"].values)
    down, up = np.exp(1j * frequency * (t + above / speed)), np.exp(1j * frequency * (t - above / speed))
    # y = Re(down D + up U), with D arriving at the ROV and U leaving it.
    columns = np.stack([q.ravel() for wave in (down, up) for q in (np.real(wave), -np.imag(wave))], axis=1)
    d_re, d_im, u_re, u_im = np.linalg.lstsq(columns, late.values.ravel(), rcond=None)[0]
    found = complex(u_re, u_im) / complex(d_re, d_im)
    load = damping + 1j * frequency * mass
    exact = (impedance - load) / (impedance + load)
    yield close("|R|", abs(found), abs(exact), 1e-3, "eight elements; half the ROV's inertia moves it by 1e-1")
    yield close("arg R, rad", np.angle(found), np.angle(exact), 1e-3, "the same")

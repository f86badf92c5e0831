"""Damping: a damper at the ROV, damping in proportion to the mass everywhere, and what the ROV reflects."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from xarray import DataArray

from umbilical.scenario.scenario import Scenario
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, close, each, each_close, history_close, small
from umbilical.verify.engine import STEADY_TENSION, open_loop, sine
from umbilical.verify.references.hanging_string import HangingString, damped_poles, frequencies

STRING = HangingString(length=400.0)
TOLERANCE = 1e-4
WHY = "as for the frequencies"
REAL = 1e-3
WHY_REAL = "decay is a small part of a pole, so it gets a digit less"


def _damped(cable: float, payload: float) -> Scenario:
    """The 400 m cable with dampers, N s/m2 and N s/m."""
    scenario = open_loop(winch__length=STRING.length, grid__elements=24)
    return scenario.replace({"cable.damping": cable, "payload.damping": payload})


def _proportional() -> Iterator[Check]:
    """With c_tip = c m/rho every mode decays alike."""
    rate = 0.04 / (2.0 * STRING.line_density)
    exact = -rate + 1j * np.sqrt(frequencies(STRING, 6) ** 2 - rate**2)
    return _poles_close("six", _damped(0.04, 0.04 * STRING.mass / STRING.line_density), exact)


def _at_the_payload(damping: float) -> Iterator[Check]:
    """Roots of the damped frequency equation."""
    return _poles_close("five", _damped(0.0, damping), damped_poles(STRING, damping, 5))


def _poles_close(count: str, scenario: Scenario, exact: np.ndarray) -> Iterator[Check]:
    found = engine.poles(scenario, exact.size)
    yield each_close(f"{count} poles, 1/s, the worst", found, exact, TOLERANCE, WHY)
    yield each_close("their decay, 1/s, the worst", np.real(found), np.real(exact), REAL, WHY_REAL)


def _reflection(damping: float, frequency: float = 0.3) -> Iterator[Check]:
    """Amplitude and phase that come back from the ROV, from a cable shaken at the vessel until nothing else is left.

    Constant tension: T = 5000 N, c = 50 m/s, Z = 100 N s/m. Up to down, ``R = (Z - k - i w m)/(Z + k + i w m)``.
    """
    impedance, mass, speed, length = 100.0, 500.0, 50.0, 100.0
    scenario = open_loop(
        winch__length=length, grid__elements=8, payload__damping=damping, cable__damping=0.0, duration=400.0,
        environment__vessel_motion=[sine(1.0, frequency)], environment__vessel_ramp=20.0,
    )  # fmt: skip
    run = engine.completed(scenario.replace(STEADY_TENSION))
    late = run["time"].values > 360.0
    t, above = run["time"].values[late, None], length * (1.0 - run["sigma"].values)
    down, up = np.exp(1j * frequency * (t + above / speed)), np.exp(1j * frequency * (t - above / speed))
    # y = Re(down D + up U), with D arriving at the ROV and U leaving it.
    columns = np.stack([q.ravel() for wave in (down, up) for q in (np.real(wave), -np.imag(wave))], axis=1)
    d_re, d_im, u_re, u_im = np.linalg.lstsq(columns, run["displacement"].values[late].ravel(), rcond=None)[0]
    found = complex(u_re, u_im) / complex(d_re, d_im)
    load = damping + 1j * frequency * mass
    exact = (impedance - load) / (impedance + load)
    yield close("|R|", abs(found), abs(exact), REAL, "eight elements; half the ROV's inertia moves it by 1e-1")
    yield close("arg R, rad", np.angle(found), np.angle(exact), REAL, "the same")


def _swallowed() -> Iterator[Check]:
    """A damper of k = Z without mass: whatever comes in stays, and after 2 l/c nothing moves any more."""
    late = _pulse_returned(1.0, 2.0 * LIGHT_LENGTH / LIGHT_SPEED)
    yield small("largest |y| after 2 l/c, m", float(np.abs(late.values).max()), GRAMS, WHY_GRAMS)


def _returned() -> Iterator[Check]:
    """A pulse of half a metre on its way back from dampers below and above Z."""
    for share in (0.5, 3.0):
        back = _pulse_returned(share, 48.0).isel(time=0)
        above = LIGHT_LENGTH * (1.0 - back["sigma"].values)
        way = above - (LIGHT_SPEED * 48.0 - PULSE_AT)
        exact = 0.5 * (1.0 - share) / (1.0 + share) * np.exp(-((way / PULSE_WIDTH) ** 2))
        low = above < 60.0
        yield history_close(f"y of the pulse, m, k = {share:g} Z", back.values[low], exact[low], GRAMS, WHY_GRAMS)


LIGHT_LENGTH, LIGHT_SPEED, PULSE_AT, PULSE_WIDTH = 100.0, 1.25, 30.0, 8.0
GRAMS = 1e-2
WHY_GRAMS = "what the 31 g of its ROV do; a damper off by two misses by 3e-1"


def _pulse_returned(share: float, since: float) -> DataArray:
    """y from ``since`` on: T = 3.125 N, Z = 2.5 N s/m, a damper of ``share`` Z, a pulse let go near the ROV."""
    scenario = open_loop(
        winch__length=LIGHT_LENGTH, payload={"mass": 0.03125, "damping": 2.5 * share}, environment__gravity=100.0,
        cable__damping=0.0, duration=since + 20.0, output__interval=1.0, grid__step=5e-4,
        initial={"shape": "gaussian", "amplitude": 1.0, "distance": PULSE_AT, "width": PULSE_WIDTH},
    )  # fmt: skip
    return engine.completed(scenario.replace(STEADY_TENSION))["displacement"].sel(time=slice(since - 1e-6, None))


ZERO = "(m s^2 + c_tip s) Y + T Y_x = 0, Bessel functions"
STRING_Z = "impedance of a string, Z = sqrt(rho T)"
CASES = (
    Case("damper that swallows everything", "y = 0 after 2 l/c", "impedance of a string, k = Z", _swallowed),
    Case("pulse back from a damper", "(Z - k)/(Z + k)", STRING_Z, _returned),
    Case("damping in proportion to the mass", "-c/(2 rho) +- i sqrt(w^2 - (c/2 rho)^2)", "Rayleigh damping",
         _proportional),
    *each("damper of {:g} N s/m at the ROV", ZERO, "boundary condition (8)", _at_the_payload, (40.0, 400.0)),
    *each("reflection at the ROV, damper {:g} N s/m", "(Z - k - i w m)/(Z + k + i w m)", STRING_Z, _reflection,
          (40.0, 100.0)),
)  # fmt: skip

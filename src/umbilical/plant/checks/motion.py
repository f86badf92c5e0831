"""Checks of the moving cable over the whole run: length, tension, wave speed, and the vessel's end."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.errors import Problem
from umbilical.plant import signals
from umbilical.plant.checks import seas
from umbilical.plant.checks.moving import LONGEST, SHORTEST, MovingCable, possible, sampled_winch, wave_terms
from umbilical.plant.checks.timeline import (
    TEARS,
    numbered,
    refuses,
    signals_of_the_environment,
    vessel_does_not_jump,
)
from umbilical.plant.seaway import heaving
from umbilical.plant.top import Top, top_at, vessel_at
from umbilical.relations.tension import slack_acceleration
from umbilical.relations.tension import tension as tension_at
from umbilical.scenario.environment import Environment, GaussianShape, InitialShape, TableShape
from umbilical.scenario.findings import Finding, amount
from umbilical.scenario.signals import Table
from umbilical.scenario.winch import Winch

_FASTEST, _HARDEST, _LARGEST_RMS = 5.0, 9.81, 10.0

# The key a user turns to mend the motion of each law: how fast it goes, and how hard it speeds up.
_SPEED_KEY = {"speed": "winch.speed", "quintic": "winch.duration", "trapezoid": "winch.top_speed",
              "cosine": "winch.frequency", "table": "winch.lengths"}  # fmt: skip
_ACCELERATION_KEY = {**_SPEED_KEY, "trapezoid": "winch.acceleration"}
_LENGTH_KEY = {**_SPEED_KEY, "constant": "winch.length", "cosine": "winch.amplitude"}


def length(winch: Winch, duration: float) -> Iterator[Finding]:
    """The cable stays a cable."""
    if not (sampled := sampled_winch(winch, duration)):
        return
    t, motion = sampled
    for worst, bound in ((int(np.argmin(motion.length)), SHORTEST), (int(np.argmax(motion.length)), LONGEST)):
        found = float(motion.length[worst])
        if not SHORTEST <= found <= LONGEST:
            reason = "a cable under 1 m is no string in transverse vibration, one over 20 km is a slip of the unit"
            yield Problem(_LENGTH_KEY[winch.law], f"a length of {amount(found, 'm')} at {t[worst]:.6g} s",
                          f"from {SHORTEST:g} m to {LONGEST:g} m throughout the run", reason,
                          f"a winch law that stays on the right side of {bound:g} m")  # fmt: skip


def tension_above_zero(moving: MovingCable) -> Iterator[Finding]:
    """The tension stays above 0 all along the cable: the winch never outruns the fall of what hangs on it."""
    if not (sampled := moving.sampled()):
        return
    (t, motion), gravity = sampled, moving.environment.gravity
    bound = slack_acceleration(possible(motion.length), gravity, moving.sunk(motion))
    worst = int(np.argmax(motion.sink_acceleration - bound))
    found, most = motion.sink_acceleration[worst], bound[worst]
    if found < most:
        return
    if heaving(moving.environment) and _stays_taut(moving):
        yield _slack(t, motion, moving)
        return
    wet = moving.environment.water
    drags = f", sinking at {motion.sink_speed[worst]:.4g} m/s" if wet else ""
    yield Problem(_ACCELERATION_KEY.get(moving.winch.law, "winch"),
                  f"an acceleration of {amount(found, 'm/s2')} at {t[worst]:.6g} s{drags}",
                  f"below {'gravity, ' if most == gravity else ''}{most:.6g} m/s2",
                  "the tension, the weight below a point less its mass times the acceleration"
                  f"{' and less its drag' if wet else ''}, must stay above 0: a cable cannot push",
                  f"pay out more {'slowly: by itself it sinks no faster' if most < 0.0 else 'gently'}")  # fmt: skip


def _slack(t: np.ndarray, motion: Top, moving: MovingCable) -> Problem:
    """The least tension that heave leaves, where it is and when."""
    net, hung = motion.net_gravity(moving.environment.gravity), moving.sunk(motion)
    lengths = {"at the ROV": np.zeros(t.size), "at the sheave": possible(motion.length)}
    where, pull = min(((name, tension_at(s, net, hung)) for name, s in lengths.items()), key=lambda end: end[1].min())
    worst = int(np.argmin(pull))
    return Problem("environment.vessel_heave" if moving.environment.vessel_heave else "environment.sea",
                   f"a tension of {amount(float(pull[worst]), 'N')} {where} at {t[worst]:.6g} s",
                   "above 0 all along the cable", "a cable cannot push: it goes slack, and no string follows",
                   'a calmer sea, or model = "rope", which knows a slack cable')  # fmt: skip


def _stays_taut(moving: MovingCable) -> bool:
    """Whether the winch alone, without the heave, keeps the cable taut."""
    calm = moving.environment.model_copy(update={"vessel_heave": None, "sea": None})
    return not any(tension_above_zero(moving._replace(environment=calm)))


def wave_speed(moving: MovingCable) -> Iterator[Finding]:
    """The winch stays slower than the waves, which are slowest where the tension is smallest."""
    if not (sampled := moving.sampled()):
        return
    (t, motion), waves = sampled, wave_terms(moving, sampled[1])
    ratio = np.maximum(np.abs(waves.at_payload), np.abs(waves.at_vessel)) - waves.slowest
    worst = int(np.argmax(ratio))
    if ratio[worst] >= 0.0 and waves.slowest[worst] > 0.0:
        yield Problem(_SPEED_KEY.get(moving.winch.law, "winch"),
                      f"a speed of {amount(motion.speed[worst], 'm/s')} at {t[worst]:.6g} s",
                      f"slower than the waves, {waves.slowest[worst]:.6g} m/s where the tension is smallest",
                      "waves travel at sqrt(T/rho); a cable that moves faster can tell its ends nothing",
                      "a slower winch")  # fmt: skip


def vessel_is_continuous(environment: Environment) -> Iterator[Finding]:
    """A ship does not jump."""
    key, motion = "environment.vessel_motion", environment.vessel_motion
    yield from vessel_does_not_jump(key, motion)
    for instant in signals.table_jumps(motion):
        yield Problem(key, f"two places at {instant:.6g} s", "one place at each instant", TEARS, "a smooth table")


def vessel_moves_like_one(environment: Environment, duration: float) -> Iterator[Finding]:
    """A smooth table of the vessel's motion is one of a ship in metres: its size, its speed, its acceleration."""
    for key, term in numbered("environment.vessel_motion", environment.vessel_motion):
        sound = isinstance(term, Table) and len(term.times) == len(term.values) and (np.diff(term.times) > 0.0).all()
        if not (isinstance(term, Table) and sound and term.interpolation == "smooth"):
            continue
        curve, times = signals.spline(term.times, term.values), np.array(term.times)
        knots = times[(times >= 0.0) & (times <= duration)]
        for order, most, unit, what in ((1, _FASTEST, "m/s", "speed"), (2, _HARDEST, "m/s2", "acceleration")):
            found = abs(curve(knots, order))
            if found.size and found.max() > most:
                at = f"{amount(float(found.max()), unit)} at {knots[int(np.argmax(found))]:.6g} s"
                fix = "look at the values there; millimetres need their unit in the header of the file"
                yield Problem(f"{key}.values", at, f"at most {most:g} {unit}, the {what} of no ship",
                              "a slip of the unit, a wrong sample or noise that the curve follows", fix)  # fmt: skip
        stated = term.file is not None and term.file.unit is not None
        if (size := float(np.std(term.values))) > _LARGEST_RMS and not stated:
            fix = 'the unit in the header as it is, e.g. [mm]; drift = "mean"; or file.unit = "m" if it is meant'
            yield Problem(f"{key}.values", f"a standard deviation of {amount(size, 'm')}",
                          f"at most {_LARGEST_RMS:g} m", "no vessel on station moves so far; millimetres do",
                          fix)  # fmt: skip


def vessel_at_the_start(
    environment: Environment, initial: InitialShape, winch: Winch, duration: float
) -> Iterator[Finding]:
    """The cable hangs on the vessel at t = 0 and is at rest there."""
    broken = refuses(signals_of_the_environment(environment, duration)) or not seas.sound(environment)
    if broken or not sampled_winch(winch, duration):
        return
    displacement, velocity = (part.item() for part in vessel_at(environment, 0.0))
    end, size = _upper_end(initial, top_at(winch, 0.0).length.item())
    key = "environment.vessel_motion"
    fix = "fade the vessel in with environment.vessel_ramp, or choose its phase and the initial shape to fit"
    if abs(displacement - end) > 1e-6 * max(size, 1.0):
        yield Problem(key, f"e(0) = {amount(displacement, 'm')}", f"the initial shape at the vessel, {end:.6g} m",
                      "the cable hangs on the vessel", fix)  # fmt: skip
    if abs(velocity) > 1e-9:
        reason = "the cable starts at rest, its upper end too"
        yield Problem(key, f"e'(0) = {amount(velocity, 'm/s')}", "0 m/s", reason, fix)


def _upper_end(initial: InitialShape, length: float) -> tuple[float, float]:
    """Displacement of an initial shape at the vessel, m, and its size, m."""
    if isinstance(initial, TableShape):
        return initial.displacements[0], max(map(abs, initial.displacements))
    if isinstance(initial, GaussianShape):
        share = np.exp(-(((length - initial.distance) / initial.width) ** 2)).item()
        return initial.amplitude * share, abs(initial.amplitude)
    return 0.0, 1.0

"""Checks of the moving cable over the whole run: length, tension, wave speed, and the vessel's end."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.errors import Problem
from umbilical.plant import signals
from umbilical.plant import winch as laws
from umbilical.plant.checks import seas
from umbilical.plant.checks.timeline import signals_of_the_environment, tables_of_the_winch
from umbilical.plant.seaway import heaving
from umbilical.plant.signals import table_jumps
from umbilical.plant.stretching import Stretching, stretching
from umbilical.plant.top import Top, top_at, top_on_both_sides, vessel_at
from umbilical.relations.tension import (
    Hanging,
    across,
    axial_drag_of,
    hanging_of,
    largest_tension,
    sinking,
    slack_acceleration,
    smallest_tension,
    stretched,
)
from umbilical.relations.tension import tension as tension_at
from umbilical.relations.water import in_water
from umbilical.scenario.environment import Environment, GaussianShape, InitialShape, TableShape
from umbilical.scenario.findings import Finding, amount
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.signals import Bell, Pulse, Sine, Step, Table, Waves
from umbilical.scenario.winch import Cosine, Winch

_SHORTEST, _LONGEST = 1.0, 2e4
_FASTEST, _HARDEST, _LARGEST_RMS = 5.0, 9.81, 10.0
_EVEN_SAMPLES, _SAMPLES_PER_PIECE, _SAMPLES_PER_TURN, _MOST_SAMPLES = 4001, 17, 64, 400_001

# The key a user turns to mend the motion of each law: how fast it goes, and how hard it speeds up.
_SPEED_KEY = {"speed": "winch.speed", "quintic": "winch.duration", "trapezoid": "winch.top_speed",
              "cosine": "winch.frequency", "table": "winch.lengths"}  # fmt: skip
_ACCELERATION_KEY = {**_SPEED_KEY, "trapezoid": "winch.acceleration"}
_LENGTH_KEY = {**_SPEED_KEY, "constant": "winch.length", "cosine": "winch.amplitude"}


def sampled_winch(winch: Winch, duration: float) -> tuple[np.ndarray, Top] | None:
    """Instants, s, and motion at them, dense and on both sides of every jump; None if the law is no function yet.

    The winch alone: whoever asks for the tension asks :func:`sampled_top`.
    """
    return _sampled_top(_hashed(winch), None, duration)


def sampled_top(
    winch: Winch, environment: Environment, duration: float, cable: Cable | None = None, payload: Payload | None = None
) -> tuple[np.ndarray, Top] | None:
    """The same with the heave of the sheave; None also where that is no smooth function yet.

    With ``cable`` and ``payload`` also with what the cable's stretch makes of the tension.
    """
    if any(isinstance(finding, Problem) for finding in seas.systems(environment)):
        return None
    if not heaving(environment):
        return _sampled_top(_hashed(winch), None, duration)
    if not sampled_winch(winch, duration):
        return None
    rough = any(isinstance(term, Step | Pulse | Bell) for term in heaving(environment))
    if rough or any(isinstance(f, Problem) for f in signals_of_the_environment(environment, duration)):
        return None
    elastic = stretching(winch, environment, cable, payload, duration) if cable and payload else None
    return _sampled_top(_hashed(winch), _hashed(environment), duration, elastic)


def _hashed(record: Any) -> Any:
    """Frozen records have a hash, which type checkers cannot see."""
    return record


@lru_cache(maxsize=16)
def _sampled_top(
    winch: Winch, environment: Environment | None, duration: float, elastic: Stretching | None = None
) -> tuple[np.ndarray, Top] | None:
    if any(True for _ in tables_of_the_winch(winch, duration)):
        return None
    marks = [0.0, duration, *laws.jumps(winch)]
    if isinstance(winch, Cosine):
        marks += list(np.arange(5) * np.pi / (2.0 * winch.frequency))  # all its extremes, however fast it is
    pieces = np.unique(np.clip(marks, 0.0, duration))
    t = np.unique(np.concatenate([np.linspace(0.0, duration, _samples(environment, duration)), _refined(pieces)]))
    return np.tile(t, 2), top_on_both_sides(winch, t, environment, elastic)


def _samples(environment: Environment | None, duration: float) -> int:
    """Even samples of a run: enough for each turn of the heave."""
    terms = heaving(environment) if environment else ()
    regular = [max(term.frequencies) for term in terms if isinstance(term, Waves)]
    fastest = max([term.frequency for term in terms if isinstance(term, Sine)] + regular, default=0.0)
    turns = fastest * duration / (2.0 * np.pi)
    return int(max(_EVEN_SAMPLES, min(_SAMPLES_PER_TURN * turns, _MOST_SAMPLES)))


def length(winch: Winch, duration: float) -> Iterator[Finding]:
    """The cable stays a cable."""
    if not (sampled := sampled_winch(winch, duration)):
        return
    t, motion = sampled
    for worst, bound in ((int(np.argmin(motion.length)), _SHORTEST), (int(np.argmax(motion.length)), _LONGEST)):
        found = float(motion.length[worst])
        if not _SHORTEST <= found <= _LONGEST:
            yield Problem(
                _LENGTH_KEY[winch.law],
                f"a length of {amount(found, 'm')} at {t[worst]:.6g} s",
                f"from {_SHORTEST:g} m to {_LONGEST:g} m throughout the run",
                "a cable under 1 m is no string in transverse vibration, one over 20 km is a slip of the unit",
                f"a winch law that stays on the right side of {bound:g} m",
            )


def tension_above_zero(
    winch: Winch, duration: float, environment: Environment, cable: Cable, payload: Payload
) -> Iterator[Finding]:
    """The tension stays above 0 all along the cable: the winch never outruns the fall of what hangs on it."""
    if not (sampled := sampled_top(winch, environment, duration, cable, payload)):
        return
    t, motion = sampled
    hung = sunk(motion, cable, payload, environment)
    bound = slack_acceleration(_possible(motion.length), environment.gravity, hung)
    worst = int(np.argmax(motion.sink_acceleration - bound))
    if not motion.sink_acceleration[worst] < bound[worst]:
        if heaving(environment) and _stays_taut(winch, duration, environment, cable, payload):
            yield _slack(t, motion, cable, payload, environment)
            return
        drags = f", sinking at {motion.sink_speed[worst]:.4g} m/s" if environment.water else ""
        yield Problem(
            _ACCELERATION_KEY.get(winch.law, "winch"),
            f"an acceleration of {amount(motion.sink_acceleration[worst], 'm/s2')} at {t[worst]:.6g} s{drags}",
            f"below {'gravity, ' if bound[worst] == environment.gravity else ''}{bound[worst]:.6g} m/s2",
            "the tension, the weight below a point less its mass times the acceleration"
            f"{' and less its drag' if drags else ''}, must stay above 0: a cable cannot push",
            "pay out more slowly: by itself it sinks no faster" if bound[worst] < 0.0 else "pay out more gently",
        )


def _slack(t: np.ndarray, motion: Top, cable: Cable, payload: Payload, environment: Environment) -> Problem:
    """The least tension that heave leaves, where it is and when."""
    net, hung = motion.net_gravity(environment.gravity), sunk(motion, cable, payload, environment)
    lengths = {"at the ROV": np.zeros(t.size), "at the sheave": _possible(motion.length)}
    where, pull = min(((name, tension_at(s, net, hung)) for name, s in lengths.items()), key=lambda end: end[1].min())
    worst = int(np.argmin(pull))
    return Problem(
        _heave_key(environment), f"a tension of {amount(float(pull[worst]), 'N')} {where} at {t[worst]:.6g} s",
        "above 0 all along the cable", "a cable cannot push: it goes slack, and no string follows",
        'a calmer sea, or model = "rope", which knows a slack cable',
    )  # fmt: skip


def _heave_key(environment: Environment) -> str:
    return "environment.vessel_heave" if environment.vessel_heave else "environment.sea"


def _stays_taut(winch: Winch, duration: float, environment: Environment, cable: Cable, payload: Payload) -> bool:
    """Whether the winch alone, without the heave, keeps the cable taut."""
    calm = environment.model_copy(update={"vessel_heave": None, "sea": None})
    return not any(tension_above_zero(winch, duration, calm, cable, payload))


def sunk(motion: Top, cable: Cable, payload: Payload, environment: Environment) -> Hanging:
    """What hangs on the cable at each instant while it sinks as the top end says."""
    hung = hanging_of(cable, payload, environment)
    carried = sinking(hung, axial_drag_of(cable, payload, environment), motion.sink_speed)
    return stretched(carried, motion.elastic_tension, motion.elastic_gradient)


class CableWaves(NamedTuple):
    """Waves at each instant: slowest and fastest speed on the cable, and of what carries them at body and vessel."""

    slowest: np.ndarray
    fastest: np.ndarray
    at_payload: np.ndarray
    at_vessel: np.ndarray


def wave_terms(motion: Top, cable: Cable, payload: Payload, environment: Environment) -> CableWaves:
    """``sqrt(Tt/M)`` and the two ends of the transport tau = vb - v sigma, m/s, by the motion of the top end."""
    added, density = in_water(cable, payload, environment).added, cable.line_density
    inertia = density + added
    net, hung = motion.net_gravity(environment.gravity), sunk(motion, cable, payload, environment)
    pulls = across(hung, density * added / inertia, motion.sink_speed)
    length, slip = _possible(motion.length), added * motion.sink_speed / inertia
    slowest, fastest = smallest_tension(length, net, pulls), largest_tension(length, net, pulls)
    return CableWaves(
        np.sqrt(np.maximum(slowest, 0.0) / inertia),
        np.sqrt(np.maximum(fastest, 0.0) / inertia),
        -slip,
        motion.speed - slip,
    )


def wave_speed(
    winch: Winch, duration: float, environment: Environment, cable: Cable, payload: Payload
) -> Iterator[Finding]:
    """The winch stays slower than the waves, which are slowest where the tension is smallest."""
    if not (sampled := sampled_top(winch, environment, duration, cable, payload)):
        return
    t, motion = sampled
    waves = wave_terms(motion, cable, payload, environment)
    carried = np.maximum(np.abs(waves.at_payload), np.abs(waves.at_vessel))
    ratio = carried - waves.slowest
    worst = int(np.argmax(ratio))
    if ratio[worst] >= 0.0 and waves.slowest[worst] > 0.0:
        yield Problem(
            _SPEED_KEY.get(winch.law, "winch"),
            f"a speed of {amount(motion.speed[worst], 'm/s')} at {t[worst]:.6g} s",
            f"slower than the waves, {waves.slowest[worst]:.6g} m/s where the tension is smallest",
            "waves travel at sqrt(T/rho); a cable that moves faster can tell its ends nothing",
            "a slower winch",
        )


def _possible(length: np.ndarray) -> np.ndarray:
    """Lengths within their own bounds: one beyond them has its own problem."""
    return np.clip(length, _SHORTEST, _LONGEST)


def vessel_is_continuous(environment: Environment) -> Iterator[Finding]:
    """A ship does not jump."""
    for number, term in enumerate(environment.vessel_motion, start=1):
        if isinstance(term, Step | Pulse):
            yield Problem(
                f"environment.vessel_motion.{number}.kind",
                f'"{term.kind}"',
                "constant, sine, bell or table",
                "a jump of the vessel would tear the cable's end to another place at once",
                "a table of the motion, or a bell",
            )
    for instant in table_jumps(environment.vessel_motion):
        yield Problem(
            "environment.vessel_motion",
            f"two places at {instant:.6g} s",
            "one place at each instant",
            "a jump of the vessel would tear the cable's end to another place at once",
            "a smooth table",
        )


def vessel_moves_like_one(environment: Environment, duration: float) -> Iterator[Finding]:
    """A smooth table of the vessel's motion is one of a ship in metres: its size, its speed, its acceleration."""
    for number, term in enumerate(environment.vessel_motion, start=1):
        key = f"environment.vessel_motion.{number}"
        sound = isinstance(term, Table) and len(term.times) == len(term.values) and (np.diff(term.times) > 0.0).all()
        if not (isinstance(term, Table) and sound and term.interpolation == "smooth"):
            continue
        curve, times = signals.spline(term.times, term.values), np.array(term.times)
        knots = times[(times >= 0.0) & (times <= duration)]
        for order, (most, unit) in enumerate(((_FASTEST, "m/s"), (_HARDEST, "m/s2")), start=1):
            found = abs(curve(knots, order))
            if found.size and found.max() > most:
                yield Problem(
                    f"{key}.values",
                    f"{amount(float(found.max()), unit)} at {knots[int(np.argmax(found))]:.6g} s",
                    f"at most {most:g} {unit}, the {'speed' if order == 1 else 'acceleration'} of no ship",
                    "a slip of the unit, a wrong sample or noise that the curve follows",
                    "look at the values there; millimetres need their unit in the header of the file",
                )
        stated = term.file is not None and term.file.unit is not None
        if (size := float(np.std(term.values))) > _LARGEST_RMS and not stated:
            yield Problem(
                f"{key}.values",
                f"a standard deviation of {amount(size, 'm')}",
                f"at most {_LARGEST_RMS:g} m",
                "no vessel on station moves so far; millimetres do",
                'the unit in the header as it is, e.g. [mm]; drift = "mean"; or file.unit = "m" if it is meant',
            )


def vessel_at_the_start(
    environment: Environment, initial: InitialShape, winch: Winch, duration: float
) -> Iterator[Finding]:
    """The cable hangs on the vessel at t = 0 and is at rest there."""
    if any(True for _ in signals_of_the_environment(environment, duration)) or not sampled_winch(winch, duration):
        return
    if any(isinstance(finding, Problem) for finding in seas.systems(environment)):
        return
    displacement, velocity = (part.item() for part in vessel_at(environment, 0.0))
    end, size = _upper_end(initial, top_at(winch, 0.0).length.item())
    fix = "fade the vessel in with environment.vessel_ramp, or choose its phase and the initial shape to fit"
    if abs(displacement - end) > 1e-6 * max(size, 1.0):
        yield Problem(
            "environment.vessel_motion",
            f"e(0) = {amount(displacement, 'm')}",
            f"the initial shape at the vessel, {end:.6g} m",
            "the cable hangs on the vessel",
            fix,
        )
    if abs(velocity) > 1e-9:
        yield Problem(
            "environment.vessel_motion",
            f"e'(0) = {amount(velocity, 'm/s')}",
            "0 m/s",
            "the cable starts at rest, its upper end too",
            fix,
        )


def _upper_end(initial: InitialShape, length: float) -> tuple[float, float]:
    """Displacement of an initial shape at the vessel, m, and its size, m."""
    if isinstance(initial, TableShape):
        return initial.displacements[0], max(map(abs, initial.displacements))
    if isinstance(initial, GaussianShape):
        share = np.exp(-(((length - initial.distance) / initial.width) ** 2)).item()
        return initial.amplitude * share, abs(initial.amplitude)
    return 0.0, 1.0


def _refined(pieces: np.ndarray) -> np.ndarray:
    """Points within each piece, its ends included."""
    return np.linspace(pieces[:-1], pieces[1:], _SAMPLES_PER_PIECE).ravel()

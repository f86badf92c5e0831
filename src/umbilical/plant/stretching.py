"""What the cable's stretch makes of heave in the string's tension: the linear axial transfer of every wave.

The string's tension is that of a cable that does not stretch (``relations/tension.py``). Where waves come nearer than
:data:`NEAR` to the first axial period T1 of cable and body that errs by ``1/(1 - (T1/T)^2)``. The tension is then the
sum over the waves of the answer of an elastic bar (``relations/axial.py``), the ROV's drag linearised for the sea and
the winch's speed::

    T(s, t) = W + w s - (m + A_z + rho s) a - D E[|u| u] - c s v_z |v_z| - Re sum a_j E U'_j(s) e^{i w_j t}

at both ends of the cable; between them the line through both. What is computed here is the difference to the
quasi-static tension (inertia and drag of heave), which everything else that depends on heave keeps; it is faded in with
the vessel. The transfer follows length and speed of the
winch; it is worked out every :data:`_EVERY` s and linear between.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.plant import regular, signals
from umbilical.plant.seaway import heaving
from umbilical.plant.top import top_at
from umbilical.relations.axial import Bar, HeaveTransfer, axial_period, heave_transfer, linearised_damping, mean_drag
from umbilical.relations.tension import axial_drag_of, hanging_of
from umbilical.scenario.environment import Environment
from umbilical.scenario.hardware import Cable, Payload
from umbilical.scenario.signals import Sine, Waves
from umbilical.scenario.winch import Winch

NEAR = 2.5
"""Periods of waves over T1 from which on a cable may be taken not to stretch."""
SHORT = 0.01
"""Share of the acceleration's energy that the shortest waves may hold before they count."""
_STEPS, _KEPT, _INSTANTS = 128, 1024, 2001
_EVERY = _STEPS * regular.STEP
_FOOT, _GRADIENT = range(2)
_BINOMIAL = np.arange(4.0)


class Elastic(NamedTuple):
    """What stretch adds to the tension at the ROV, N, and per metre above it, N/m, and their rates, 1/s."""

    tension: np.ndarray
    gradient: np.ndarray
    tension_rate: np.ndarray
    gradient_rate: np.ndarray


class Difference(NamedTuple):
    """Root mean square of the dynamic tension at ROV and sheave on the longest cable, N, either way.

    Attributes:
        length: m; period: T1, s; shortest: period of the shortest waves that count, s.
        end, top: with stretch; rigid_end, rigid_top: as of a cable that does not stretch.
        middle: what the line between the ends leaves out half way.
    """

    length: float
    period: float
    shortest: float
    end: float
    top: float
    rigid_end: float
    rigid_top: float
    middle: float


class _Answer(NamedTuple):
    """What stretch adds at the ROV and per metre above it, of every wave, and the mean drag that waves add, N."""

    amplitude: np.ndarray
    drag: float


def stretching(
    law: Winch, environment: Environment, cable: Cable, payload: Payload, duration: float
) -> Stretching | None:
    """What stretch makes of the heave of a scenario; None where the cable may be taken not to stretch, or is not known.

    ``law`` and the heave's signals must be sound.
    """
    known: Any = (law, environment, cable, payload, duration)  # frozen records have a hash
    found = _stretching(*known)
    return found if found and found.shortest <= NEAR * found.period else None


def difference(
    law: Winch, environment: Environment, cable: Cable, payload: Payload, duration: float
) -> Difference | None:
    """How far both ways are apart; None where the stiffness is not known or no regular wave heaves."""
    known: Any = (law, environment, cable, payload, duration)
    found = _stretching(*known)
    return found.difference() if found else None


@lru_cache(maxsize=8)
def _stretching(
    law: Winch, environment: Environment, cable: Cable, payload: Payload, duration: float
) -> Stretching | None:
    if cable.axial_stiffness is None or not heaving(environment):
        return None
    found = Stretching(law, environment, cable, payload, duration)
    return found if found.omega.size else None


class Stretching:
    """The axial transfer along a run."""

    def __init__(self, law: Winch, environment: Environment, cable: Cable, payload: Payload, duration: float) -> None:
        self._law, self._ramp, self._duration = law, environment.vessel_ramp, duration
        self._hung = hanging_of(cable, payload, environment)
        self._drag = axial_drag_of(cable, payload, environment).body
        self._stiffness = float(cable.axial_stiffness or 0.0)
        self.omega, self._heave = _regular(environment)
        turns = np.outer(np.arange(_STEPS + 1) * regular.STEP, self.omega)
        self._turns = np.concatenate([np.cos(turns), -np.sin(turns)], axis=1)
        self.longest = float(top_at(law, np.linspace(0.0, duration, _INSTANTS)).length.max())
        self._answers: dict[tuple[float, float], _Answer] = {}
        self._block = lru_cache(_KEPT)(self._tabulate)

    @property
    def period(self) -> float:
        """T1 on the longest cable of the run, s."""
        return axial_period(self._bar(self.longest))

    @property
    def shortest(self) -> float:
        """Period of the shortest waves that count, s."""
        order = np.argsort(-self.omega)
        energy = np.cumsum(abs(self._heave[order]) ** 2 * self.omega[order] ** 4)
        return float(2.0 * np.pi / self.omega[order][np.searchsorted(energy, SHORT * energy[-1])])

    def at(self, t: np.ndarray, speed: np.ndarray, sinks: np.ndarray, side: signals.Side) -> Elastic:
        """What stretch adds at instants, s.

        Args:
            t: instants, any shape.
            speed, sinks: speed and acceleration of the winch, and those at which the cable sinks, shape (2, ...).
            side: the limit to take at a jump.
        """
        parts = self._tables(np.asarray(t, dtype=float))
        if self._ramp > 0.0:
            fade = signals.fade(np.asarray(t, dtype=float), self._ramp, side)
            parts = np.array([fade[0] * parts[0], fade[0] * parts[1] + fade[1] * parts[0]])
        drag = self._drag * (abs(sinks[0]) * sinks[0] - abs(speed[0]) * speed[0])
        drag_rate = 2.0 * self._drag * (abs(sinks[0]) * sinks[1] - abs(speed[0]) * speed[1])
        return Elastic(
            parts[0, _FOOT] + drag, parts[0, _GRADIENT], parts[1, _FOOT] + drag_rate, parts[1, _GRADIENT]
        )  # fmt: skip

    def difference(self) -> Difference:
        """How far this tension is from the quasi-static one on the longest cable, hanging still."""
        answer, size = self._transfer(self.longest, 0.0)[0], abs(self._heave)
        inertia = self.omega**2
        whole = self._hung.mass + self._hung.line_density * self.longest

        def rms(gain: np.ndarray) -> float:
            return float(np.sqrt(np.sum((abs(gain) * size) ** 2) / 2.0))

        half = answer.tension_at(self.longest / 2.0)[0] - (answer.top[0] + answer.end[0]) / 2.0
        return Difference(
            self.longest, self.period, self.shortest, rms(answer.end[0]), rms(answer.top[0]),
            rms(inertia * self._hung.mass), rms(inertia * whole), rms(half),
        )  # fmt: skip

    def _bar(self, length: float) -> Bar:
        return Bar(self._stiffness, self._hung.line_density, self._hung.mass, length)

    def _transfer(self, length: float, speed: float) -> tuple[HeaveTransfer, float]:
        """The bar's answer, and the rms of the ROV's velocity, m/s."""
        bar, size = self._bar(length), abs(self._heave) * self.omega

        def moving(damping: float) -> float:
            body = heave_transfer(bar, np.array([damping]), self.omega).body[0]
            return float(np.sqrt(np.sum((abs(body) * size) ** 2) / 2.0))

        damping = linearised_damping(self._drag, speed, moving)
        return heave_transfer(bar, np.array([damping]), self.omega), moving(damping)

    def _answer(self, t: float) -> _Answer:
        """Amplitudes of shape (2, waves), as the winch is at an instant."""
        motion = top_at(self._law, min(t, self._duration))
        length, speed = float(motion.length), float(motion.speed)
        if (length, speed) not in self._answers:
            found, moving = self._transfer(length, speed)
            end = (found.end[0] - self._hung.mass * self.omega**2) * self._heave
            along = ((found.top[0] - found.end[0]) / length - self._hung.line_density * self.omega**2) * self._heave
            more = mean_drag(self._drag, speed, moving) - self._drag * abs(speed) * speed
            self._answers[length, speed] = _Answer(-np.array([end, along]), more)
        return self._answers[length, speed]

    def _tables(self, t: np.ndarray) -> np.ndarray:
        """What stretch adds at the ROV and per metre, and the rates, shape (2, 2, ...), without the ramp."""
        place = np.floor(t.ravel() / regular.STEP).astype(np.int64)
        share, number = t.ravel() / regular.STEP - place, place // _STEPS
        known, which = np.unique(number, return_inverse=True)
        rows, step = np.array([self._block(int(k)) for k in known]), place - number * _STEPS
        left, right = rows[which, step], rows[which, step + 1]
        ends = [(left[:, part, n : n + 3], right[:, part, n : n + 3]) for n in range(2) for part in range(2)]
        return np.reshape([regular.quintic(*pair, share) for pair in ends], (2, 2, *t.shape))

    def _tabulate(self, number: int) -> np.ndarray:
        """``(c0 + q (c1 - c0)) e^{i w t}``, q from 0 to 1 along the block, less mean drag, with three derivatives.

        At the instants of a block, shape (instants, 2, 4).
        """
        start = number * _EVERY
        before, after = self._answer(start), self._answer(start + _EVERY)
        turned = np.exp(1j * self.omega * start)
        fixed = self._sums(before.amplitude * turned)
        if after is before:
            fixed[:, _FOOT, 0] -= before.drag
            return fixed
        grows = self._sums((after.amplitude - before.amplitude) * turned / _EVERY)
        past = np.arange(_STEPS + 1.0) * regular.STEP
        fixed += past[:, None, None] * grows
        fixed[:, :, 1:] += _BINOMIAL[1:] * grows[:, :, :-1]
        fixed[:, _FOOT, 0] -= before.drag + (after.drag - before.drag) * past / _EVERY
        fixed[:, _FOOT, 1] -= (after.drag - before.drag) / _EVERY
        return fixed

    def _sums(self, amplitude: np.ndarray) -> np.ndarray:
        """Sums over the waves of amplitudes (2, waves), and their derivatives, shape (instants, 2, 4)."""
        orders = (amplitude[:, None, :] * (1j * self.omega) ** _BINOMIAL[:, None]).reshape(8, -1).T
        return (self._turns @ np.concatenate([orders.real, orders.imag])).reshape(-1, 2, 4)


def _regular(environment: Environment) -> tuple[np.ndarray, np.ndarray]:
    """Angular frequencies, rad/s, and complex amplitudes, m, of the heave's regular waves, shape (waves,) each."""
    omega, amplitude = [np.zeros(0)], [np.zeros(0, dtype=complex)]
    for term in heaving(environment):
        if isinstance(term, Sine):
            omega.append(np.array([term.frequency]))
            amplitude.append(np.array([term.amplitude * np.exp(1j * (term.phase - 0.5 * np.pi))]))
        elif isinstance(term, Waves):
            omega.append(np.array(term.frequencies))
            amplitude.append(np.array(term.amplitudes) * np.exp(1j * np.array(term.phases)))
    frequencies, sizes = np.concatenate(omega), np.concatenate(amplitude)
    moves = (frequencies > 0.0) & (abs(sizes) > 0.0)
    return frequencies[moves], sizes[moves]

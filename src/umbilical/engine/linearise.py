"""Linear systems in samples, ``x+ = A x + B u, y = C x + D u``, found by differences of the very step they stand for.

Whatever runs can be linearised: the plant's rates, a kernel of the controller, an update written in Python. There is
no second description of any of them that could differ from the one that runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from umbilical.control.linear import held_input_form

Step = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""From state and inputs to the state after a step and the outputs, one array each."""

SIZE = 2.0**-20
"""Half of a difference, in units of what is changed or in shares of it where it is larger than 1. A power of two: what
is linear comes out to the last bit, and a quadratic drag at rest counts for a millionth."""


class Names(NamedTuple):
    """What states, inputs and outputs are, in their order."""

    states: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()


UNNAMED = Names()


class LinearisationPoint(NamedTuple):
    """Where a step is linearised: its state, its inputs and what they are called."""

    state: np.ndarray
    inputs: np.ndarray
    names: Names = UNNAMED


@dataclass(frozen=True)
class Linear:
    """A linear system from sample to sample.

    Attributes:
        a: shape (n, n).
        b: shape (n, inputs).
        c: shape (outputs, n).
        d: shape (outputs, inputs).
        names: of states, inputs and outputs, where they have been given some.
    """

    a: Any
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    names: Names = UNNAMED

    def poles(self) -> np.ndarray:
        """Eigenvalues of A."""
        return np.linalg.eigvals(self.a)

    def response(self, z: np.ndarray) -> np.ndarray:
        """Transfer ``C (z - A)^-1 B + D`` at every z; shape (len(z), outputs, inputs)."""
        shifted = z[:, None, None] * np.eye(self.a.shape[0]) - self.a
        return self.c @ np.linalg.solve(shifted, np.broadcast_to(self.b, (z.size, *self.b.shape))) + self.d


def linearise(step: Step, at: LinearisationPoint) -> Linear:
    """Linearise a step or an update by central differences about an operating point.

    Args:
        step: what is linearised; it must not change its arguments.
        at: the operating point.

    >>> system = linearise(lambda x, u: (0.5 * x + u, x**2), LinearisationPoint(np.array([3.0]), np.array([0.0])))
    >>> system.a.item(), system.b.item(), system.c.item(), system.d.item()
    (0.5, 1.0, 6.0, 0.0)
    """
    n = at.state.size
    start = np.concatenate([at.state, at.inputs])
    columns = differences(lambda x: np.concatenate(step(x[:n], x[n:])), start, ([k] for k in range(start.size)))
    matrix = np.stack(list(columns), axis=1)
    return Linear(matrix[:n, :n], matrix[:n, n:], matrix[n:, :n], matrix[n:, n:], at.names)


def differences(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, directions: Iterable[Any]
) -> Iterable[np.ndarray]:
    """Derivatives of a function of a vector, one for each place (or array of places that are changed together)."""
    for places in directions:
        half = SIZE * float(np.exp2(np.ceil(np.log2(np.abs(at[places]).max(initial=1.0)))))
        change = np.zeros(at.size)
        change[places] = half
        yield (function(at + change) - function(at - change)) / (2.0 * half)


def hold_input(a: np.ndarray, b: np.ndarray, period: float) -> tuple[np.ndarray, np.ndarray]:
    """Exact step of ``x' = a x + b u`` under a held input, ``b`` of shape (n, inputs)."""
    form = held_input_form(a, b, period)
    return form[:, : len(a)], form[:, len(a) :]


def delayed(system: Linear, ages: tuple[int, ...]) -> Linear:
    """The same system when its input ``i`` comes ``ages[i]`` samples late."""
    for place, age in enumerate(ages):
        for _ in range(age):
            system = _one_later(system, place)
    return system


def _one_later(system: Linear, place: int) -> Linear:
    """One more state: the input's last sample, which the system now reads in its place."""
    n, inputs = system.b.shape
    now = np.ones(inputs)
    now[place] = 0.0
    a = np.block([[system.a, system.b[:, [place]]], [np.zeros((1, n + 1))]])
    b = np.vstack([system.b * now, 1.0 - now])
    c = np.hstack([system.c, system.d[:, [place]]])
    return Linear(a, b, c, system.d * now)

"""Linear systems in samples: ``x+ = A x + B u, y = C x + D u``, and the two things asked of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Discrete:
    """A linear system from sample to sample.

    Attributes:
        a: shape (n, n).
        b: shape (n, inputs).
        c: shape (outputs, n).
        d: shape (outputs, inputs).
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray

    def poles(self) -> np.ndarray:
        """Eigenvalues of A."""
        return np.linalg.eigvals(self.a)

    def response(self, z: np.ndarray) -> np.ndarray:
        """Transfer ``C (z - A)^-1 B + D`` at every z; shape (len(z), outputs, inputs)."""
        shifted = z[:, None, None] * np.eye(self.a.shape[0]) - self.a
        return self.c @ np.linalg.solve(shifted, np.broadcast_to(self.b, (z.size, *self.b.shape))) + self.d


def held(a: np.ndarray, b: np.ndarray, period: float) -> tuple[np.ndarray, np.ndarray]:
    """Exact step of ``x' = a x + b u`` under a held input, ``b`` of shape (n, inputs) (Van Loan, 1978)."""
    from scipy.linalg import expm

    n, inputs = b.shape
    block = np.zeros((n + inputs, n + inputs))
    block[:n, :n], block[:n, n:] = a, b
    step = expm(block * period)
    return step[:n, :n], step[:n, n:]


def delayed(system: Discrete, ages: tuple[int, ...]) -> Discrete:
    """The same system when its input ``i`` comes ``ages[i]`` samples late."""
    for place, age in enumerate(ages):
        for _ in range(age):
            system = _one_later(system, place)
    return system


def _one_later(system: Discrete, place: int) -> Discrete:
    """One more state: the input's last sample, which the system now reads in its place."""
    n, inputs = system.b.shape
    now = np.ones(inputs)
    now[place] = 0.0
    a = np.block([[system.a, system.b[:, [place]]], [np.zeros((1, n + 1))]])
    b = np.vstack([system.b * now, 1.0 - now])
    c = np.hstack([system.c, system.d[:, [place]]])
    return Discrete(a, b, c, system.d * now)

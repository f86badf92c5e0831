"""How the nodes of the cable lie in memory, and back. No other file knows.

A block is an array of shape ``(5, 2 n)`` for n elements: row j holds node j of every element, the slopes
Y_sigma of all elements first, then their velocities Dy/Dt. A kernel walks along a row, so the compiler does
several elements at once. Neighbours keep a value each at the interface they share.

What a person reads, and what is stored, lies along the cable: 4 n + 1 nodes from vessel to ROV.
"""

from __future__ import annotations

from functools import lru_cache
from math import prod

import numpy as np

from umbilical.plant.elements import DEGREE, INTEGRAL, NODES, WEIGHTS, interpolation_row


def zeros(*shape: int) -> np.ndarray:
    """Zeros that begin where a line of the processor's cache does: what straddles two costs up to a tenth of a run.

    >>> zeros(3, 5).ctypes.data % 64
    0
    """
    count, line = prod(shape), 8
    room = np.zeros(count + line)
    begin = -(room.ctypes.data // room.itemsize) % line
    return room[begin : begin + count].reshape(shape)


def node_count(elements: int) -> int:
    """Number of nodes along the cable, both ends included."""
    return DEGREE * elements + 1


def to_elements(nodal: np.ndarray) -> np.ndarray:
    """Values along the cable, shape (..., 4 n + 1), node by element: (..., 5, n)."""
    elements = (nodal.shape[-1] - 1) // DEGREE
    return nodal[..., np.arange(DEGREE + 1)[:, None] + DEGREE * np.arange(elements)]


def to_nodal(inside: np.ndarray) -> np.ndarray:
    """Values (..., 5, n) along the cable, (..., 4 n + 1); an interface takes the mean of its two sides."""
    elements = inside.shape[-1]
    nodal = np.empty((*inside.shape[:-2], node_count(elements)))
    nodal[..., :-1].reshape(*inside.shape[:-2], elements, DEGREE)[:] = np.swapaxes(inside[..., :DEGREE, :], -1, -2)
    nodal[..., DEGREE:-1:DEGREE] = 0.5 * (inside[..., 0, 1:] + inside[..., DEGREE, :-1])
    nodal[..., -1] = inside[..., DEGREE, -1]
    return nodal


def integrate(slopes: np.ndarray) -> np.ndarray:
    """Integral of Y_sigma (..., 5, n) from the vessel to every node, m, shape (..., 4 n + 1).

    The integral of an element's polynomial is exact, so the displacement is continuous.
    """
    elements = slopes.shape[-1]
    nodal = np.zeros((*slopes.shape[:-2], node_count(elements)))
    within = np.einsum("jk,...ke->...ej", INTEGRAL / (2.0 * elements), slopes)
    starts = np.cumsum(within[..., -1], axis=-1)
    within[..., 1:, :] += starts[..., :-1, None]
    nodal[..., 1:] = within[..., 1:].reshape(*slopes.shape[:-2], DEGREE * elements)
    return nodal


def positions(elements: int) -> np.ndarray:
    """sigma = x/l of every node, from 0 (vessel) to 1 (ROV), shape (4 n + 1,)."""
    starts = np.arange(elements)[:, None]
    inside = (starts + (NODES[None, :DEGREE] + 1.0) / 2.0) / elements
    return np.append(inside.ravel(), 1.0)


def quadrature(elements: int) -> np.ndarray:
    """Weight of every node in the integral over sigma from 0 to 1, shape (4 n + 1,)."""
    weights = np.zeros(node_count(elements))
    for e in range(elements):
        weights[DEGREE * e : DEGREE * e + DEGREE + 1] += WEIGHTS / (2 * elements)
    return weights


@lru_cache(maxsize=64)
def probe(sigma: float, elements: int) -> tuple[int, np.ndarray]:
    """Element that holds ``sigma``, and the weights, shape (5,), of its slopes in the displacement gained in it."""
    element = min(int(sigma * elements), elements - 1)
    within = interpolation_row(2.0 * (sigma * elements - element) - 1.0)
    return element, within @ INTEGRAL / (2.0 * elements)

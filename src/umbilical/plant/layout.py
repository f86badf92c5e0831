"""How the nodes of the cable lie in memory, and back. No other file knows.

A nodal field is an array of shape ``(4, elements + 1)``: row k holds node k of every element, so that a
kernel walks along a row and the compiler does four elements at once. Node 4 of element e is node 0 of
element e + 1; the ROV is ``field[0, elements]``. The unused ends of rows 1 to 3 stay zero.
"""

from __future__ import annotations

import numpy as np

from umbilical.plant.elements import DEGREE, NODES, WEIGHTS, interpolation_row


def node_count(elements: int) -> int:
    """Number of nodes, both ends included."""
    return DEGREE * elements + 1


def empty_field(elements: int) -> np.ndarray:
    """A nodal field of zeros, shape (4, elements + 1)."""
    return np.zeros((DEGREE, elements + 1))


def to_field(nodal: np.ndarray) -> np.ndarray:
    """Arrange values ordered from vessel to ROV, shape (..., 4 n + 1), as a field (..., 4, n + 1)."""
    elements = (nodal.shape[-1] - 1) // DEGREE
    padded = np.zeros((*nodal.shape[:-1], DEGREE * (elements + 1)))
    padded[..., : nodal.shape[-1]] = nodal
    return np.ascontiguousarray(np.swapaxes(padded.reshape(*nodal.shape[:-1], elements + 1, DEGREE), -1, -2))


def to_nodal(field: np.ndarray) -> np.ndarray:
    """Values ordered from vessel to ROV, shape (..., 4 n + 1), of a field (..., 4, n + 1)."""
    count = node_count(field.shape[-1] - 1)
    flat = np.swapaxes(field, -1, -2).reshape(*field.shape[:-2], DEGREE * field.shape[-1])
    return np.ascontiguousarray(flat[..., :count])


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


def probe(sigma: float, elements: int) -> tuple[int, np.ndarray]:
    """Element that holds ``sigma`` and the weights, shape (5,), of its nodes in the value there."""
    element = min(int(sigma * elements), elements - 1)
    return element, interpolation_row(2.0 * (sigma * elements - element) - 1.0)

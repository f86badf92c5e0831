"""The reference element: Gauss-Lobatto-Legendre nodes of degree 4 on [-1, 1], their weights and derivative.

Nodes, weights W and derivative D satisfy the summation-by-parts identity ``W D + D^T W = B`` with
``B = diag(-1, 0, 0, 0, 1)``: integration by parts holds exactly on the grid, and with it the power
balance of the cable. A cable of ``n`` such elements has ``4 n + 1`` nodes.

Source: Canuto, Hussaini, Quarteroni, Zang, *Spectral Methods: Fundamentals in Single Domains*, 2.3.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

DEGREE = 4
NODES = np.array([-1.0, -sqrt(3 / 7), 0.0, sqrt(3 / 7), 1.0])
WEIGHTS = np.array([1 / 10, 49 / 90, 32 / 45, 49 / 90, 1 / 10])


def _derivative() -> np.ndarray:
    """D[i, j]: slope at node i of the polynomial that is 1 at node j and 0 at the others."""
    legendre = (35 * NODES**4 - 30 * NODES**2 + 3) / 8
    with np.errstate(divide="ignore", invalid="ignore"):
        matrix = legendre[:, None] / legendre[None, :] / (NODES[:, None] - NODES[None, :])
    np.fill_diagonal(matrix, 0.0)
    matrix[0, 0], matrix[-1, -1] = -DEGREE * (DEGREE + 1) / 4, DEGREE * (DEGREE + 1) / 4
    return matrix


DERIVATIVE = _derivative()
STIFFNESS = DERIVATIVE.T @ (WEIGHTS[:, None] * DERIVATIVE)

_root = np.sqrt(WEIGHTS)
LARGEST_EIGENVALUE = float(np.linalg.eigvalsh(STIFFNESS / np.outer(_root, _root))[-1])
"""Largest eigenvalue of ``STIFFNESS y = k W y``; no assembled cable of uniform tension exceeds it."""


def highest_frequency(wave_speed: float, element_length: float) -> float:
    """Bound on the angular frequency of any mode of the grid, rad/s.

    Args:
        wave_speed: largest sqrt(T/rho) on the cable, m/s.
        element_length: shortest element, m.
    """
    return wave_speed * sqrt(LARGEST_EIGENVALUE) * 2.0 / element_length


def interpolation_row(position: float) -> np.ndarray:
    """Weights, shape (5,), of the nodes' values in the value at ``position`` in [-1, 1]."""
    row = np.ones(DEGREE + 1)
    for j in range(DEGREE + 1):
        for k in range(DEGREE + 1):
            if k != j:
                row[j] *= (position - NODES[k]) / (NODES[j] - NODES[k])
    return row

"""The reference element: Gauss-Lobatto-Legendre nodes of degree 4 on [-1, 1], their weights and derivative.

Nodes, weights W and derivative D satisfy the summation-by-parts identity ``W D + D^T W = B`` with
``B = diag(-1, 0, 0, 0, 1)``: integration by parts holds exactly on the grid, and with it the power
balance of the cable inside each element. Neighbouring elements meet in an upwind flux.

Source: Canuto, Hussaini, Quarteroni, Zang, *Spectral Methods: Fundamentals in Single Domains*, 2.3; Hesthaven,
Warburton, *Nodal Discontinuous Galerkin Methods*, 4.8 for the spectrum of the upwind element.
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


def _integral() -> np.ndarray:
    """I[i, j]: integral from -1 to node i of the polynomial that is 1 at node j and 0 at the others."""
    powers = np.arange(DEGREE + 1)
    primitive = (NODES[:, None] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    return primitive @ np.linalg.inv(NODES[:, None] ** powers)


DERIVATIVE = _derivative()
INTEGRAL = _integral()
W0, W1, W2 = (float(w) for w in WEIGHTS[:3])


def upwind_spectrum(phases: int = 720) -> np.ndarray:
    """Eigenvalues of a wave of unit speed that runs through unit elements in one direction, shape (5 phases,).

    One Fourier phase from element to element at a time; both characteristics of the cable have this spectrum,
    scaled by the wave speed over the element's length.
    """
    rates = np.repeat(-2.0 * DERIVATIVE[None].astype(complex), phases, axis=0)
    rates[:, 0, 0] -= 2.0 / WEIGHTS[0]
    rates[:, 0, -1] += 2.0 / WEIGHTS[0] * np.exp(-2j * np.pi * np.arange(phases) / phases)
    return np.linalg.eigvals(rates).ravel()


def interpolation_row(position: float) -> np.ndarray:
    """Weights, shape (5,), of the nodes' values in the value at ``position`` in [-1, 1]."""
    row = np.ones(DEGREE + 1)
    for j in range(DEGREE + 1):
        for k in range(DEGREE + 1):
            if k != j:
                row[j] *= (position - NODES[k]) / (NODES[j] - NODES[k])
    return row

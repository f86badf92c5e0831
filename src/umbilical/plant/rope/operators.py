"""d/dsigma at the nodes, with the values that hold where elements meet; and what is gained along the cable."""

from __future__ import annotations

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.elements import DERIVATIVE, INTEGRAL, WEIGHTS

D = tuple(tuple(float(d) for d in row) for row in DERIVATIVE)
EVEN = tuple((0.5 * (r[0] + r[4]), 0.5 * (r[1] + r[3]), r[2]) for r in D)
"""Of the sums of opposite nodes: what the derivative makes of even functions; and likewise of odd ones."""
ODD = tuple((0.5 * (r[0] - r[4]), 0.5 * (r[1] - r[3])) for r in D)
I = tuple(tuple(0.5 * float(d) for d in row) for row in INTEGRAL)  # noqa: E741
W = tuple(float(w) for w in WEIGHTS)
LIFT = 1.0 / W[0]
E0, E1, O0, O1, O2 = EVEN[0], EVEN[1], ODD[0], ODD[1], ODD[2]


@kernel
def differentiate_columns(f: np.ndarray, out: np.ndarray, at: int, elements: int) -> None:
    """Derivative of all columns of ``f`` inside the elements into the columns of ``out`` from ``at`` on."""
    columns = f.shape[1]
    per_sigma = 2.0 * elements
    f0, f1, f2, f3, f4 = f[0], f[1], f[2], f[3], f[4]
    out0, out1, out2, out3, out4 = out[0, at:], out[1, at:], out[2, at:], out[3, at:], out[4, at:]
    for k in range(columns):
        ends, inner, middle = f0[k] + f4[k], f1[k] + f3[k], f2[k]
        end_step, inner_step = f0[k] - f4[k], f1[k] - f3[k]
        odd0 = E0[0] * ends + E0[1] * inner + E0[2] * middle
        odd1 = E1[0] * ends + E1[1] * inner + E1[2] * middle
        even0 = O0[0] * end_step + O0[1] * inner_step
        even1 = O1[0] * end_step + O1[1] * inner_step
        out0[k] = per_sigma * (even0 + odd0)
        out1[k] = per_sigma * (even1 + odd1)
        out2[k] = per_sigma * (O2[0] * end_step + O2[1] * inner_step)
        out3[k] = per_sigma * (even1 - odd1)
        out4[k] = per_sigma * (even0 - odd0)


@kernel
def lift(f: np.ndarray, star: np.ndarray, row: int, out: np.ndarray, at: int, elements: int) -> None:
    """Impose on the derivative of a component the value ``star[row]`` where elements meet; ``f``: its columns."""
    n = elements
    scale = 2.0 * n * LIFT
    left, right, values = out[0, at : at + n], out[4, at : at + n], star[row]
    first, last, after = f[0], f[4], values[1:]
    for e in range(n):
        left[e] += scale * (first[e] - values[e])
    for e in range(n):
        right[e] += scale * (after[e] - last[e])


@kernel
def add_up_positions(x: np.ndarray, joints: np.ndarray, start: np.ndarray, elements: int) -> None:
    """r where elements meet, from the vessel's ``start`` and l r_x in the first 3 n columns of ``x``."""
    n = elements
    half = 0.5 / n
    for i in range(3):
        q, out, total = x[:, i * n : (i + 1) * n], joints[i], start[i]
        out[0] = total
        for e in range(n):
            total += half * (W[0] * (q[0, e] + q[4, e]) + W[1] * (q[1, e] + q[3, e]) + W[2] * q[2, e])
            out[e + 1] = total


@kernel
def heights(x: np.ndarray, joints: np.ndarray, out: np.ndarray, elements: int) -> None:
    """z at the nodes, shape (5, n)."""
    n = elements
    scale = 1.0 / n
    q0, q1, q2, q3, q4 = (x[0, 2 * n :], x[1, 2 * n :], x[2, 2 * n :], x[3, 2 * n :], x[4, 2 * n :])
    for j in range(5):
        w, row, start = I[j], out[j], joints[2]
        for e in range(n):
            row[e] = start[e] + scale * (w[0] * q0[e] + w[1] * q1[e] + w[2] * q2[e] + w[3] * q3[e] + w[4] * q4[e])

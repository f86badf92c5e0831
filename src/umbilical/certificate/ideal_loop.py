"""Exact spectrum of the ideal loop with the winch stopped: what a certified rate can be held against.

Under ideal state feedback ``m u_a' = -k_a u_a + D~`` and ``D~' = -k_s (D~ + vs u_a)`` do not see the cable, so a mode
of the loop either belongs to them or has ``u_a = 0``: the hanging cable with ``lam Y + beta Y_x = 0`` at the ROV. Its
shape is ``I0(z) K0(z_top) - K0(z) I0(z_top)`` with ``z = 2 sqrt((rho lam^2 + c lam) T)/(dT/ds)``, s up from the ROV.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from umbilical.certificate.setting import Loop
from umbilical.relations.tension import net_gravity, tension, tension_gain

NODES = 60
"""Chebyshev points of the matrix whose eigenvalues Newton's method starts from."""
ITERATIONS, PRECISION = 30, 1e-13
POLISHED = 8
"""Slowest modes that are followed to the exact root."""


def energy_rate(loop: Loop, length: float) -> float:
    """Rate at which V of the ideal loop decays in the long run, 1/s: twice the decay of its slowest mode.

    Args:
        loop: constants of the ideal loop, :func:`umbilical.certificate.setting.ideal_constants`.
        length: of the cable, m, held; the winch does not accelerate.
    """
    slowest = np.max([mode.real for mode in (*cable_modes(loop, length), *law_modes(loop))])
    return -2.0 * float(max(slowest, highest_modes_real_part(loop, length)))


def law_modes(loop: Loop) -> NDArray[np.complex128]:
    """Eigenvalues of u_a and D~, 1/s."""
    k_s = 0.0 if loop.k_s is None else loop.k_s
    k_a = loop.k_a if loop.k_s is not None else 2.0 * loop.k_a
    modes = np.roots([loop.m, k_a + loop.m * k_s, k_s * (k_a + loop.vs)]).astype(complex)
    return modes if loop.k_s is not None else modes[np.abs(modes) > 0.0]


def highest_modes_real_part(loop: Loop, length: float) -> float:
    """Limit of the real part at high frequency, 1/s: ``ln|(c_l - beta)/(c_l + beta)|/(2 tau) - c/(2 rho)``.

    tau is the time a wave takes from end to end.
    """
    foot, travel = np.sqrt(_pull(loop, 0.0) / loop.rho), _travel(loop, length)
    with np.errstate(divide="ignore"):
        return float(np.log(abs((foot - loop.beta) / (foot + loop.beta))) / (2.0 * travel) - loop.c / (2.0 * loop.rho))


def cable_modes(loop: Loop, length: float) -> NDArray[np.complex128]:
    """The slowest eigenvalues with ``u_a = 0``, 1/s, from the exact equation; none below the real axis."""
    coarse = np.linalg.eigvals(_matrix(loop, length))
    top = 0.3 * NODES / _travel(loop, length)  # beyond it the matrix has too few points for a wave
    near = coarse[(coarse.imag > -1e-9) & (np.abs(coarse) < top)]
    near = near[np.argsort(-near.real)][:POLISHED]
    return np.array([_root(loop, length, complex(guess)) for guess in near])


def characteristic(loop: Loop, length: float, lam: complex) -> complex:
    """``lam Y + beta Y_x`` at the ROV for the shape Y that vanishes at the vessel: an entire function of lam."""
    from scipy.special import ive, kve

    foot, top = (_pull(loop, s) for s in (0.0, length))
    inertia = np.sqrt(loop.rho * lam * lam + loop.c * lam + 0j)
    rise, wave = tension_gain(1.0, net_gravity(loop.g), loop.hanging), inertia / np.sqrt(foot)  # Y_s = wave dY/dz
    if rise == 0.0:
        return complex(lam * np.sinh(wave * length) / wave + loop.beta * np.cosh(wave * length))
    z, z_top = (2.0 * inertia * np.sqrt(pull) / rise for pull in (foot, top))
    # The scaled functions leave out exp(|Re z|) of I and exp(-z) of K, which are huge; their products are not.
    up, down = np.exp(z.real - z_top), np.exp(z_top.real - z)
    shape = ive(0, z) * kve(0, z_top) * up - kve(0, z) * ive(0, z_top) * down
    slope = ive(1, z) * kve(0, z_top) * up + kve(1, z) * ive(0, z_top) * down
    return complex(lam * shape - loop.beta * wave * slope)


def _pull(loop: Loop, s: Any) -> Any:
    """The tension s above the ROV with the winch stopped, N."""
    return tension(s, net_gravity(loop.g), loop.hanging)


def _travel(loop: Loop, length: float) -> float:
    """Time of a wave along the cable, s: c^2 is a line of s."""
    foot, top = (np.sqrt(_pull(loop, s) / loop.rho) for s in (0.0, length))
    return float(2.0 * length / (foot + top))


def _root(loop: Loop, length: float, guess: complex) -> complex:
    """The secant method from a guess that is good to some digits; the guess itself if rounding leads it astray."""
    before, now = guess * (1.0 + 1e-6) + 1e-12, guess
    value_before, value = (characteristic(loop, length, lam) for lam in (before, now))
    for _ in range(ITERATIONS):
        if value == value_before or abs(now - before) <= PRECISION * abs(now):
            break
        before, now = now, now - value * (now - before) / (value - value_before)
        value_before, value = value, characteristic(loop, length, now)
    return now if abs(now - guess) < 0.1 * abs(guess) else guess


def _matrix(loop: Loop, length: float) -> np.ndarray:
    """Rates of y (all nodes but the vessel's) and Dy/Dt (inner nodes) by Chebyshev collocation in s."""
    points, derivative = _chebyshev(NODES)
    s, d = 0.5 * length * (1.0 + points), derivative * 2.0 / length  # s[0] = l at the vessel, s[-1] = 0
    pull = _pull(loop, s)
    strain = (d @ (pull[:, None] * d) / loop.rho)[1:-1, 1:]
    count = NODES - 1
    matrix = np.zeros((2 * count + 1, 2 * count + 1))
    matrix[:count, count + 1 :] = np.eye(count)
    matrix[count, : count + 1] = loop.beta * d[-1, 1:]
    matrix[count + 1 :, : count + 1] = strain
    matrix[count + 1 :, count + 1 :] = -loop.c / loop.rho * np.eye(count)
    return matrix


def _chebyshev(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points from 1 to -1 and the differentiation matrix, n + 1 of them."""
    points = np.cos(np.pi * np.arange(n + 1) / n)
    scale = np.where((np.arange(n + 1) == 0) | (np.arange(n + 1) == n), 2.0, 1.0) * (-1.0) ** np.arange(n + 1)
    matrix = np.outer(scale, 1.0 / scale) / (points[:, None] - points[None, :] + np.eye(n + 1))
    return points, matrix - np.diag(matrix.sum(axis=1))

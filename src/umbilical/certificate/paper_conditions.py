"""The paper's own conditions iota_1 ... iota_7 (Appendix B), as printed, with the signs that print has lost restored.

docs/certificates.md says what was restored and how. Young's constants (theta_1, delta_1, delta_2, sigma_1 ... sigma_4)
are free and the paper gives none; here each is set so that its term costs a quarter of the good term it stands
against. lam is the largest that iota_4 and iota_5 allow, or that of our search where they allow none; eta is twice
what iota_3 needs. The paper has x0 = 0.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.certificate.records import Inequality, Weights
from umbilical.certificate.setting import Loop, Payout
from umbilical.relations.tension import inertial_tension, tension, tension_gain

QUARTER = 0.25


def paper_conditions(loop: Loop, motion: Payout, weights: Weights, loaded: bool) -> tuple[Inequality, ...]:
    """The seven conditions ``0 <= iota``, each at the sample where it is smallest; ``loaded``: f is not zero."""
    found = _conditions(loop, motion, weights, loaded)
    return tuple(_smallest(f"iota_{k}", text, unit, motion, iota) for k, (text, unit, iota) in enumerate(found, 1))


def _conditions(
    loop: Loop, motion: Payout, weights: Weights, loaded: bool
) -> Iterator[tuple[str, str, np.ndarray | float]]:
    rho, beta, c, k_a, v, length = loop.rho, loop.beta, loop.c, loop.k_a, motion.v, motion.l
    x = np.stack([np.zeros_like(length), length])  # iota_2 is a line in x
    net, hung = motion.net, loop.hanging
    pull, foot = tension(length - x, net, hung), tension(0.0 * length, net, hung)
    lam = _largest_lambda(loop, motion, foot) or weights.cross
    eta = 2.0 * float(foot.max()) / (2.0 * beta * k_a * (1.0 - 2.0 * QUARTER))
    young = length.max() * c / (QUARTER * rho)  # 1/delta_2
    of_delta_2 = QUARTER * rho if c else 0.0
    yield (
        "gam c + lam/2 (rho - l c delta_2) - gam/(2 theta_1)", "N s/m2",
        c + 0.5 * lam * (rho - of_delta_2) - (QUARTER * 0.5 * lam * rho if loaded else 0.0),
    )  # fmt: skip
    yield (
        "lam/2 [T - l c/delta_2 - x T_x - l delta_1] - gam/2 DT/Dt", "N/s",
        0.5 * lam * (pull - length * c * young + tension_gain(x, net, hung) - (QUARTER * foot if loaded else 0.0))
        + 0.5 * inertial_tension(length - x, net, hung) * motion.relative_jerk,
    )  # fmt: skip
    yield (
        "eta [k_a - |c - k_a| sigma_1 - beta m sigma_2] - gam T_l/(2 beta)", "N s/m",
        eta * k_a * (1.0 - 2.0 * QUARTER) - foot / (2.0 * beta),
    )  # fmt: skip
    yield (
        "gam T_l/(2 beta) - gam rho v/2 - lam rho l", "N s/m",
        foot / (2.0 * beta) - 0.5 * rho * v - lam * rho * length,
    )  # fmt: skip
    yield (
        "gam T_l (beta - v)/2 - lam l/2 (T_l + rho v)", "W",
        0.5 * foot * (beta - v) - 0.5 * lam * length * (foot + rho * v),
    )  # fmt: skip
    sigma_1, sigma_4 = QUARTER * k_a / max(abs(c - k_a), 1e-300), 4.0 * loop.vs
    yield "eta [(c - k_a)/sigma_1 - sigma_4]", "N s/m", eta * ((c - k_a) / sigma_1 - sigma_4)
    yield "eta [1/vs - 1/(k_s vs sigma_3) - 1/sigma_4]", "m/(N s)", eta * (1.0 - 2.0 * QUARTER) / loop.vs


def _largest_lambda(loop: Loop, motion: Payout, foot: np.ndarray) -> float:
    """Largest lam/gam, 1/s, with iota_4 and iota_5 not negative; 0 if there is none."""
    of_4 = (foot / loop.beta - loop.rho * motion.v) / (2.0 * loop.rho * motion.l)
    of_5 = foot * (loop.beta - motion.v) / (motion.l * (foot + loop.rho * motion.v))
    return max(float(np.minimum(of_4, of_5).min()), 0.0)


def _smallest(name: str, text: str, unit: str, motion: Payout, iota: np.ndarray | float) -> Inequality:
    values = np.broadcast_to(iota, (2 if np.ndim(iota) == 3 else 1, *motion.t.shape))
    at = np.unravel_index(np.argmin(values), values.shape)
    x = float(motion.l[at[1:]]) * float(at[0]) if values.shape[0] == 2 else None
    return Inequality(name, f"0 <= {text}", 0.0, float(values[at]), unit, x, float(motion.t[at[1:]]))

"""V(t) along a run: the function of the paper's proof, (31) to (34), evaluated, not trusted.

V1 = gam/2 int(rho W^2 + T p^2) dx     V2 = lam rho int x p W dx
V3 = eta/2 m u_a^2 + eta/(2 k_s vs) (D - D^)^2          p = y_x,  W = Dy/Dt,  u_a = W(l) + beta p(l)
"""

from __future__ import annotations

import numpy as np

from umbilical.relations.formulas import tension
from umbilical.run import Run
from umbilical.scenario.control import BoundaryLaw

MARGIN = 2.0
"""By how much the constants keep clear of the conditions the proof sets them."""


def lyapunov(run: Run) -> dict[str, np.ndarray]:
    """The three parts of V and their sum over the stored samples, by name.

    Constants: gam = 1; lam is the largest that keeps V1 + V2 positive and the boundary terms negative,
    ``lam <= T_l/(beta rho l), lam <= beta/l``, and eta the least with ``eta k_a > T_l/(2 beta)``, both with a
    margin of two.

    Raises:
        ValueError: the run has no boundary law, or no disturbance observer.
    """
    scenario = run.scenario
    law, observer = scenario.control.law, scenario.control.disturbance_observer
    if not isinstance(law, BoundaryLaw) or observer is None or not law.slope_gain:
        raise ValueError(f"{scenario.name}: V is defined for the boundary law with its disturbance observer")
    rho, beta, mass = scenario.cable.line_density, law.slope_gain, scenario.payload.mass
    tip = float(mass * (scenario.environment.gravity - run["payout_acceleration"].values).max())
    longest = float(run["length"].max())
    lam = min(beta / longest, tip / (beta * rho * longest)) / MARGIN
    eta = MARGIN * tip / (2.0 * beta * law.damping_gain)
    kinetic, potential, crossed = _integrals(run)
    error = run["tip_velocity"].values + beta * run["tip_slope"].values
    lost = run["disturbance"].values - run["disturbance_estimate"].values
    parts = {
        "V_1": 0.5 * (kinetic + potential),
        "V_2": lam * crossed,
        "V_3": eta / 2 * mass * error**2 + eta / (2 * observer.gain * observer.coupling) * lost**2,
    }
    return {"V": sum(parts.values(), np.zeros_like(error)), **parts}


def _integrals(run: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """int rho W^2, int T p^2 and rho int x p W along the cable, by the midpoint rule between nodes."""
    scenario = run.scenario
    sigma = run["sigma"].values
    cells = np.diff(sigma) > 0.0
    length = run["length"].values[:, None]
    width = np.diff(sigma)[cells] * length
    middle = (0.5 * (sigma[1:] + sigma[:-1]))[cells] * length
    slope, speed = (
        (0.5 * (values[:, 1:] + values[:, :-1]))[:, cells] for values in (run["slope"].values, run["velocity"].values)
    )
    net = (scenario.environment.gravity - run["payout_acceleration"].values)[:, None]
    pull = tension(length - middle, net, scenario.payload.mass, scenario.cable.hanging_density)
    rho = scenario.cable.line_density
    return tuple((f * width).sum(axis=1) for f in (rho * speed**2, pull * slope**2, rho * middle * slope * speed))  # type: ignore[return-value]

"""V(t) along a run: the function of the paper's proof, (31) to (34), evaluated, not trusted.

V1 = gam/2 int(rho W^2 + T p^2) dx     V2 = lam rho int x p W dx
V3 = eta/2 m u_a^2 + eta/(2 k_s vs) (D - D^)^2          p = y_x,  W = Dy/Dt,  u_a = W(l) + beta p(l)
"""

from __future__ import annotations

import numpy as np

from umbilical import Run
from umbilical.certificate.lyapunov import boundary_function, cable_function
from umbilical.certificate.records import Weights
from umbilical.relations.tension import hanging_of, net_gravity, tension

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
    gains, observer = scenario.control.law.boundary_gains, scenario.control.disturbance_observer
    if not gains or observer is None or not gains[1]:
        raise ValueError(f"{scenario.name}: V is defined for the boundary law with its disturbance observer")
    rho, (k_a, beta) = scenario.cable.line_density, gains
    net = net_gravity(scenario.environment.gravity, run["payout_acceleration"].values)
    tip = float(tension(0.0, net, hanging_of(scenario.cable, scenario.payload, scenario.environment)).max())
    longest = float(run["length"].max())
    lam = min(beta / longest, tip / (beta * rho * longest)) / MARGIN
    eta = MARGIN * tip / (2.0 * beta * k_a)
    read = {str(name): values.values for name, values in {**run.data.data_vars, **run.data.coords}.items()}
    weights = Weights(cross=lam, vessel=0.0, boundary=eta)
    energy = cable_function(scenario, read, weights._replace(cross=0.0))
    total = cable_function(scenario, read, weights)
    boundary = boundary_function(scenario, read, weights)
    return {"V": total + boundary, "V_1": energy, "V_2": total - energy, "V_3": boundary}

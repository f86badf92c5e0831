"""What water does to cable and ROV, as the coefficients of Morison's formula.

With the displaced mass ``rho_w A_c`` of a metre of cable, ``A_c = pi d^2/4``, the added mass is ``C_a rho_w A_c``, the
drag across ``1/2 rho_w C_dn (1 + 2.1 A*) d |u_r| u_r`` and that along ``1/2 rho_w pi d C_dt |v| v``. The factor
``1 + 2.1 A*`` is an assumption about a cable that vibrates in its own vortices at A* diameters.
"""

from __future__ import annotations

from math import pi
from typing import Any, NamedTuple

STRUMMING = 2.1


class InWater(NamedTuple):
    """Coefficients, SI units; all zero without water.

    Attributes:
        displaced, added: mass of the displaced water and rho_a of a metre of cable, kg/m.
        normal, tangential: drag of a metre of cable over the square of the speed, N s2/m3.
        body_displaced, body_added, body_vertical: displaced mass, A_h and A_z of the ROV, kg.
        body_across: A_h of the ROV in the direction y, kg.
        body_linear: drag of the ROV over its speed, N s/m.
        body_quadratic, body_axial: drag of the ROV across and along the cable over the square of the speed, N s2/m2.
        body_quadratic_across: the former in the direction y.
    """

    displaced: float = 0.0
    added: float = 0.0
    normal: float = 0.0
    tangential: float = 0.0
    body_displaced: float = 0.0
    body_added: float = 0.0
    body_vertical: float = 0.0
    body_linear: float = 0.0
    body_quadratic: float = 0.0
    body_axial: float = 0.0
    body_across: float = 0.0
    body_quadratic_across: float = 0.0


def line_in_water(
    water_density: float, diameter: float, normal_drag: float, tangential_drag: float, added_mass: float,
    strumming: float = 0.0,
) -> InWater:  # fmt: skip
    """Coefficients of a metre of cable; SI units, the last four dimensionless."""
    displaced, dynamic = water_density * pi * diameter**2 / 4.0, 0.5 * water_density
    normal, tangential = dynamic * normal_drag * (1.0 + STRUMMING * strumming), dynamic * tangential_drag * pi
    return InWater(displaced, added_mass * displaced, normal * diameter, tangential * diameter)


def in_water(cable: Any, payload: Any, environment: Any) -> InWater:
    """Coefficients from these sections of a scenario; a section without ``water`` has none."""
    of_cable, of_body = getattr(cable, "water", None), getattr(payload, "water", None)
    water = getattr(environment, "water", None)
    found = InWater()
    if of_cable is not None and water is not None:
        found = line_in_water(
            water.density, of_cable.diameter, of_cable.normal_drag, of_cable.tangential_drag, of_cable.added_mass,
            of_cable.strumming,
        )  # fmt: skip
    if of_body is not None:
        b = of_body
        found = found._replace(
            body_displaced=b.displaced_mass, body_added=b.added_mass, body_vertical=b.vertical_added_mass,
            body_linear=b.linear_drag, body_quadratic=b.quadratic_drag, body_axial=b.vertical_drag,
            body_across=b.added_mass if b.across_added_mass is None else b.across_added_mass,
            body_quadratic_across=b.quadratic_drag if b.across_drag is None else b.across_drag,
        )  # fmt: skip
    return found


def line_inertia(cable: Any, payload: Any, environment: Any) -> float:
    """M = rho + rho_a of a metre of cable across, kg/m."""
    return cable.line_density + in_water(cable, payload, environment).added


def payload_inertia(payload: Any) -> float:
    """m + A_h of the ROV across, kg."""
    return payload.mass + in_water(None, payload, None).body_added

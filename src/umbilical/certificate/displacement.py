"""What a certificate says in metres, and its largest bounds over the run."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.certificate.bounds import bound
from umbilical.certificate.cable_bound import cable_bound, instants_of
from umbilical.certificate.records import Certificate


class Bounds(NamedTuple):
    """Largest and last bounds over the run from the scenario's own start: of V, J, and of |y|, m."""

    lyapunov_largest: float
    lyapunov_end: float
    middle_largest: float
    tip_largest: float
    middle_end: float
    tip_end: float


def largest_bounds(certificate: Certificate) -> Bounds | None:
    """Bounds over all instants of the run, as between those that are looked at none of them has a turning point.

    None where nothing is proved.
    """
    if not certificate.proof.holds:
        return None
    t = instants_of(certificate)
    of_cable = cable_bound(certificate, t)
    jumps = [instant for instant, _ in certificate.loads.force_jumps if instant <= t[-1]]
    of_v = bound(certificate, np.union1d(certificate.edges, jumps))
    largest, end = (displacement_bound(certificate, float(v)) for v in (of_cable.max(), of_cable[-1]))
    return Bounds(float(of_v.max()), float(of_v[-1]), *largest, *end)


def displacement_bound(certificate: Certificate, v_bound: float) -> tuple[float, float]:
    """Bound of |y| at the middle of the cable and at the ROV, m, where V, or V1 + V2, is at most ``v_bound``, J.

    The bound grows from the vessel to the ROV, so the second one holds for the whole cable.
    """
    middle, tip = (reach * float(np.sqrt(v_bound)) + certificate.loads.vessel for reach in certificate.reach)
    return middle, tip

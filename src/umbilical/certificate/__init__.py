"""Certificates: how fast the ideal loop is proved to calm down over a whole run, and with which margins.

The theory is docs/certificates.md. ``search.py`` finds numbers, ``proof.py`` verifies them without it.
"""

from umbilical.certificate.bounds import bound, lyapunov_of
from umbilical.certificate.cable_bound import cable_bound
from umbilical.certificate.certify import certify
from umbilical.certificate.displacement import Bounds, displacement_bound, largest_bounds
from umbilical.certificate.records import Certificate, Inequality, Proof, Start, Weights

__all__ = [
    "Bounds", "Certificate", "Inequality", "Proof", "Start", "Weights", "bound", "cable_bound", "certify",
    "displacement_bound", "largest_bounds", "lyapunov_of",
]  # fmt: skip

"""Observed orders of convergence."""

from umbilical.analysis.convergence import orders

__all__ = ["orders"]

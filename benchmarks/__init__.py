"""How fast string and rope run on this machine, and against what. Times are measured, never asserted."""

from benchmarks.measure import Bench, Row, measure_all

__all__ = ["Bench", "Row", "measure_all"]

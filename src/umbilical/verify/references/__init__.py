"""Solvers that share nothing with the engine: closed forms, characteristics, high-order integrations, MoorDyn.

numpy, scipy and mpmath only. They judge the simulator and are never used by it.
"""

"""Stability and margins of the linearised sampled loop: exact cable, Nyquist's count, the engine's grids."""

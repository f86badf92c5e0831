"""Formulas that both the plant and its controller use, in plain Python and inside kernels alike."""

"""Outer laws, one per file: from what is known at the ROV to the thrust that is wanted there."""

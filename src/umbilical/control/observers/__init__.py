"""Observers, one per file: each advances by its exact discrete form from one sample to the next."""

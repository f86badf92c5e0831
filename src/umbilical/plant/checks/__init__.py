"""Checks of what moves, beside it: cable, ROV, motors, loads and the instants at which they change."""

"""Admission: a scenario is loaded, checked field by field and field against field, and refused or let in."""

from umbilical.library.admit import Notice, admit
from umbilical.library.load import load, preset_names, preset_text

__all__ = ["Notice", "admit", "load", "preset_names", "preset_text"]

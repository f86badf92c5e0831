"""Records: everything a run depends on, frozen, and its text form."""

from umbilical.scenario.scenario import Scenario

__all__ = ["Scenario"]

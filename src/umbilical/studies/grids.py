"""One grid for all members of a study."""

from __future__ import annotations

from umbilical.engine.resolution import choose_grid
from umbilical.engine.simulate import measure
from umbilical.studies.engines import in_order
from umbilical.studies.members import Draws
from umbilical.studies.study import Study


def on_one_grid(study: Study) -> Study:
    """A study on one grid, where its scenario asks for one that is chosen by runs; itself where it names its grid.

    The arms are run before anything is drawn, under the laws of their scenarios, and the finest grid is taken.
    """
    asking = [scenario for scenario in Draws(study).undrawn() if scenario.grid.tolerance is not None]
    if not asking:
        return study
    found = in_order(lambda scenario: choose_grid(scenario, measure), asking)
    own = {key: value for key, value in study.changes.items() if not key.startswith("grid.")}
    grid = {"grid.elements": max(c.elements for c in found), "grid.step": min(c.step for c in found)}
    return study.replace({"scenario.grid.tolerance": None, "changes": own | grid})

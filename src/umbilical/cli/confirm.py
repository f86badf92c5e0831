"""``umbilical operate --confirm``: the limit held against the rope in the time domain."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical.cli.output import report
from umbilical.cli.progress import announce_compilation, bar

if TYPE_CHECKING:
    from umbilical.scenario import Scenario
    from umbilical.screening import Operability
    from umbilical.studies.confirm import Confirmation

LONGEST = 3.0 * 3600.0
"""Seconds of a seed that count at the most; a criterion of a longer time is extrapolated as one of a shorter is."""


def confirm_on_the_rope(found: Operability, height: float, seeds: int, jobs: int | None) -> Confirmation:
    """Run seeds of the sea of the lowest limit at a height, with news on stderr.

    Raises:
        ScenarioError: the operation cannot be put on the rope.
    """
    import numpy as np

    from umbilical.screening.on_the_rope import SETTLED, on_the_rope
    from umbilical.studies.confirm import confirm
    from umbilical.studies.engines import default_jobs

    d, p, h = found.worst
    depth, period, heading = found.depth[d], found.period[p], found.heading[h]
    lasts = min(max(criterion.duration for criterion in found.criteria), LONGEST)
    scenario = on_the_rope(
        found.operation, depth=float(depth), period=float(period), heading=float(heading), height=height, duration=lasts
    )
    workers = min(jobs or default_jobs(), seeds)
    where = f"{depth:.4g} m, Tp {period:.3g} s, heading {np.degrees(heading):.0f} deg, Hs {height:.3g} m"
    report(f"confirming at {where}: {seeds} seeds of {scenario.duration:.0f} s, {cost(scenario, seeds, workers)}")
    announce_compilation(scenario)
    with bar("seeds of the sea") as advance:
        return confirm(
            scenario, found.criteria, height, settled=SETTLED, seeds=seeds, workers=workers, progress=advance
        )


def cost(scenario: Scenario, runs: int, workers: int) -> str:
    """What runs of a rope will take, roughly: time by the number of its steps, memory by its samples."""
    from umbilical import machine
    from umbilical.plant.checks.rope import seconds_of
    from umbilical.plant.checks.sizes import memory_of

    seconds, memory = seconds_of(scenario) * runs / workers, memory_of(scenario) * workers
    lasting = f"{seconds:.0f} s" if seconds < 100.0 else f"{seconds / 60.0:.0f} min"
    return f"roughly {lasting} and {machine.in_words(memory)} on {workers} thread{'s' * (workers > 1)}"

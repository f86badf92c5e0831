"""A limit of the frequency domain held against the rope: seeds of the sea, each as long as the criterion's time.

Of each criterion the share of what it allows is followed: 1 is where it is passed. The largest shares of blocks of ten
minutes follow a Gumbel distribution in their squares, exactly so for a narrow-banded Gaussian process; what of it is
passed with the accepted probability within the accepted time, is 1 at a limit that is right.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.stats import CensoredData, binom, gumbel_r

from umbilical.analysis.paired import Estimate
from umbilical.engine.simulate import simulate
from umbilical.run import Run, Status
from umbilical.scenario.scenario import Scenario
from umbilical.studies.engines import in_order
from umbilical.studies.extremes import Gumbel, fit_gumbel

if TYPE_CHECKING:
    from umbilical.screening.criteria import Criterion

BLOCK = 600.0
"""Seconds of which the largest share counts once."""
_RESAMPLED = 200
_FEWEST = 3
"""Blocks of a run, however short it is."""


class Reached(NamedTuple):
    """What the runs say of one criterion.

    Attributes:
        share: of what is allowed, that is passed with the accepted probability within the accepted time.
        exceeded: runs in which it was exceeded.
        too_many: whether so many runs would pass it in one of forty cases at the most, were the limit right.
    """

    share: Estimate
    exceeded: int
    too_many: bool


@dataclass(frozen=True)
class Confirmation:
    """A limit held against runs of the rope.

    Attributes:
        scenario: what was run, its sea at the limit.
        criteria: what must hold.
        height: Hs of the sea, m.
        seeds: of the sea.
        completed: of each run.
        shares: largest share of what is allowed, shape (criteria, completed runs, blocks).
        reached: of each criterion.
    """

    scenario: Scenario
    criteria: tuple[Criterion, ...]
    height: float
    seeds: np.ndarray
    completed: np.ndarray
    shares: np.ndarray
    reached: tuple[Reached, ...]

    @property
    def worst(self) -> int:
        """Place of the criterion that is nearest to being passed."""
        return int(np.argmax([found.share.value for found in self.reached]))

    @property
    def confirmed_height(self) -> float:
        """Hs, m, at which every criterion is kept by its whole interval, if all shares are proportional to Hs."""
        return self.height / max(found.share.high for found in self.reached)


def confirm(
    scenario: Scenario, criteria: Sequence[Criterion], height: float, *, settled: float, seeds: int = 10,
    workers: Executor | int | None = None, progress: Callable[[float], None] | None = None,
) -> Confirmation:  # fmt: skip
    """Run seeds of a sea, and hold what they reach against what is allowed.

    Args:
        scenario: of the rope, hanging at rest at the start, as ``screening.on_the_rope`` makes it.
        criteria: what must hold, each with its accepted probability and time.
        height: Hs of the sea, m.
        settled: s from which on the run counts.
        seeds: how many, from 1 on; their numbers are 0, 1, ...
        workers: threads, or an executor; results do not depend on them. All cores by default.
        progress: called with the share that is done.

    Raises:
        ScenarioError: the scenario is refused.
    """
    chosen, kept = np.arange(seeds), tuple(criteria)
    changed = [scenario.replace({"environment.sea.seed": seed}) for seed in chosen.tolist()]
    found = in_order(partial(_look, criteria=kept, settled=settled), changed, progress, workers)
    completed = np.array([each is not None for each in found])
    if not completed.any():
        nothing = (Reached(Estimate(np.nan, np.nan, np.nan), 0, False),) * len(kept)
        return Confirmation(scenario, kept, height, chosen, completed, np.zeros((len(kept), 0, 0)), nothing)
    good = zip(*(each for each in found if each is not None), strict=True)
    shares, passed = (np.stack(part, axis=1) for part in good)
    ran, counts = scenario.duration - settled, passed.sum(axis=1).tolist()
    reached = tuple(_reached(*each, ran) for each in zip(shares, counts, kept, strict=True))
    return Confirmation(scenario, kept, height, chosen, completed, shares, reached)


def _look(scenario: Scenario, criteria: Sequence[Criterion], settled: float) -> tuple[np.ndarray, np.ndarray] | None:
    """Largest shares of the blocks of a run, shape (criteria, blocks), and which criteria it passed anywhere; None if
    it did not complete."""
    run = simulate(scenario)
    if run.status is not Status.COMPLETED:
        return None
    late = run["time"].values >= settled
    blocks = max(_FEWEST, round((scenario.duration - settled) / BLOCK))
    found = [_share_of(run, criterion) for criterion in criteria]
    return np.array([_peaks(share[late], blocks) for share, _ in found]), np.array([passed for _, passed in found])


def _share_of(run: Run, criterion: Criterion) -> tuple[np.ndarray, bool]:
    """Share of what a criterion allows, at each stored sample, against the cable at rest at the start; and whether it
    was passed, by every control sample where metrics have it, for a snap falls between stored ones."""
    match criterion.name:
        case "top_tension":
            top = run["top_tension"].values
            share = (top - top[0]) / max(criterion.level - top[0], np.finfo(float).tiny)
            return share, run.metrics["top_tension_peak"] > criterion.level
        case "body_heave":
            height = run["body_position"].values[:, 2]
            share = (height - height[0]) / max(criterion.level, np.finfo(float).tiny)
            return share, bool(share.max() > 1.0)
    tension = run["tension"].values
    return (1.0 - tension / tension[0]).max(axis=1), run.metrics["slack_share"] > 0.0


def _peaks(values: np.ndarray, blocks: int) -> np.ndarray:
    """Largest value of each block, of the parabola through three samples where it is inside."""
    left, here, right = values[:-2], values[1:-1], values[2:]
    bend = 2.0 * here - left - right
    top = (here >= left) & (here >= right) & (bend > 0.0)
    peaks = np.where(top, here + (right - left) ** 2 / (8.0 * np.where(top, bend, 1.0)), here)
    return np.array([part.max() for part in np.array_split(peaks, blocks)])


def _reached(shares: np.ndarray, passed: int, criterion: Criterion, ran: float) -> Reached:
    """Estimate for one criterion of runs that each count ``ran`` seconds; ``shares`` of shape (runs, blocks)."""
    runs, blocks = shares.shape
    allowed = 1.0 - (1.0 - criterion.probability) ** (ran / blocks / criterion.duration)
    in_a_run = 1.0 - (1.0 - criterion.probability) ** (ran / criterion.duration)
    limit = 1.0 if criterion.name == "slack" else np.inf
    squares = np.maximum(shares.ravel(), 0.0) ** 2
    too_many = bool(binom.sf(passed - 1, runs, in_a_run) < 0.025)
    if np.ptp(squares) == 0.0 or squares.size < _FEWEST:
        return Reached(Estimate(float(shares.max()), 0.0, np.inf), passed, too_many)

    def share(fit: Gumbel) -> float:
        return float(np.sqrt(max(gumbel_r.ppf(1.0 - allowed, *fit), 0.0)))

    _, used = fit_gumbel(squares, share, again=_RESAMPLED, seed=0, fit=partial(_fit, limit=limit))
    return Reached(used, passed, too_many)


def _fit(squares: np.ndarray, limit: float) -> Gumbel:
    """Location and scale by maximum likelihood; where the cable is slack a share is 1 or more."""
    beyond = squares >= limit
    if not beyond.any():
        return gumbel_r.fit(squares)
    data = CensoredData(uncensored=squares[~beyond], right=np.full(int(beyond.sum()), limit))
    return gumbel_r.fit(data)

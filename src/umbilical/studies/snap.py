"""How likely a rope in a sea goes slack, and how hard it snaps: many seeds of one scenario."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from math import sqrt
from typing import ClassVar

import numpy as np
from scipy.stats import gumbel_r

from umbilical.analysis.paired import Estimate, proportion
from umbilical.engine.simulate import simulate
from umbilical.errors import Problem, ScenarioError
from umbilical.plant.rope.assemble import body_data, stiffness, weights_of
from umbilical.plant.rope.records import vector_of
from umbilical.plant.top import top_at
from umbilical.result import ResultFaces
from umbilical.run import Status
from umbilical.scenario.scenario import Scenario
from umbilical.studies.engines import in_order
from umbilical.studies.extremes import fit_gumbel

_RESAMPLED = 400
_STORED = 0.5
"""Longest time between two samples from which speeds are read, s."""
_FEWEST = 5
"""Maxima below which no distribution is fitted."""


@dataclass(frozen=True)
class Extreme:
    """A Gumbel distribution fitted to the largest tensions of the seeds by maximum likelihood.

    Attributes:
        location, scale: N.
        exceeded: the tension that one run in a hundred exceeds, N, with its interval by the parametric bootstrap.
    """

    location: float
    scale: float
    exceeded: Estimate


@dataclass(frozen=True)
class SnapStudy(ResultFaces):
    """What many seeds of one scenario came to; arrays have the shape (seeds,).

    Attributes:
        scenario: what was run.
        seeds: of the runs.
        completed: whether a run came to its end; the others are in no statistic.
        reasons: why others did not, each once.
        largest_tension: at either end, N.
        snaps: how often the cable became taut after slack.
        largest_snap: N; 0 without a snap.
        static_tension: at the vessel, N.
        impact_speed: largest vertical speed of the body against the sheave, m/s.
        slack: probability that a run has slack, with its interval.
        extreme: of the largest tensions; None where too few runs completed.
    """

    shown_by: ClassVar[str] = "umbilical.faces.snap"
    drawn_by: ClassVar[str] = "plot_snaps"

    scenario: Scenario
    seeds: np.ndarray
    completed: np.ndarray
    reasons: tuple[str, ...]
    largest_tension: np.ndarray
    snaps: np.ndarray
    largest_snap: np.ndarray
    static_tension: float
    impact_speed: np.ndarray
    slack: Estimate
    extreme: Extreme | None

    @property
    def rule_of_thumb(self) -> float:
        """Static tension and v sqrt(K M), N: v the largest impact speed, K = EA/l, M = m + A. It knows no waves."""
        body = body_data(self.scenario)
        mass = body.mass + float(vector_of(body.added_mass)[2])
        rope = stiffness(self.scenario) / float(top_at(self.scenario.winch, 0.0).length)
        return self.static_tension + float(self.impact_speed.max()) * sqrt(rope * mass)


def snap(
    scenario: Scenario, seeds: int = 20, *, workers: Executor | int | None = None,
    progress: Callable[[float], None] | None = None,
) -> SnapStudy:  # fmt: skip
    """Run a rope with seeds of its own and of the next ones: each has another sea.

    Args:
        scenario: with ``model = "rope"``.
        seeds: how many.
        workers: threads, or an executor; results do not depend on them. All cores by default.
        progress: called with the share that is done.

    Raises:
        ScenarioError: the scenario is refused, is no rope, or its seeds change nothing.
    """
    check_seeds(scenario, seeds)
    sea, period = scenario.environment.sea, scenario.control.period
    chosen = (sea.seed if sea else 0) + np.arange(seeds)
    often = {"output.interval": period * max(1.0, _STORED // period)} if scenario.output.interval > _STORED else {}
    changed = [scenario.replace({"environment.sea.seed": seed, **often}) for seed in chosen.tolist()]
    rows = in_order(_run_seed, changed, progress, workers)
    completed, tension, snaps, largest, slack, speed = np.array([numbers for numbers, _ in rows]).T
    reasons = tuple(dict.fromkeys(reason for _, reason in rows if reason))
    good = completed > 0.0
    return SnapStudy(
        scenario, chosen, good, reasons, tension, snaps.astype(int), largest, weights_of(scenario)[1], speed,
        proportion(float(slack[good].sum()), int(good.sum())), _extreme(tension[good], int(chosen[0])),
    )  # fmt: skip


def check_seeds(scenario: Scenario, seeds: int) -> None:
    """Refuse what no seeds say anything of.

    Raises:
        ScenarioError: no rope, no sea, or no seeds.
    """
    still = "without a sea every seed gives the same motion of the vessel"
    wrong = {
        ("model", f'"{scenario.model}"', '"rope"', "a string never goes slack", 'set model = "rope"'):
            scenario.model != "rope",
        ("environment.sea", "left out", "a section", still, "systems of waves and a vessel"):
            scenario.environment.sea is None,
        ("seeds", str(seeds), "1 or more", "there is nothing to say of none", "20, or 100 for a tail"): seeds < 1,
    }  # fmt: skip
    if found := [Problem(*words) for words, is_so in wrong.items() if is_so]:
        raise ScenarioError(found, scenario.name)


def _run_seed(scenario: Scenario) -> tuple[tuple[float, ...], str]:
    """Whether it completed, largest tension, snaps, largest snap, whether it was slack, largest impact speed; and why
    it did not complete."""
    run = simulate(scenario)
    m, completed = run.metrics, run.status is Status.COMPLETED
    sheave = np.gradient(run["vessel_position"].values[:, 2], run["time"].values)
    impact = float(np.abs(run["body_velocity"].values[:, 2] - sheave).max())
    largest = max(m["top_tension_peak"], m["end_tension_peak"])
    numbers = (completed, largest, m["snaps"], m.get("largest_snap", 0.0), m["slack_share"] > 0.0, impact)
    return numbers, "" if completed else run.reason


def _extreme(tension: np.ndarray, seed: int) -> Extreme | None:
    """Fit by maximum likelihood; the interval from fits to samples drawn from the fit."""
    if tension.size < _FEWEST:
        return None
    fit, exceeded = fit_gumbel(tension, lambda fit: float(gumbel_r.ppf(0.99, *fit)), again=_RESAMPLED, seed=seed)
    return Extreme(*fit, exceeded)

"""How likely a rope in a sea goes slack, and how hard it snaps: many seeds of one scenario."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt
from typing import Any

import numpy as np
from scipy.stats import gumbel_r

from umbilical.analysis.paired import Estimate, share
from umbilical.engine.simulate import simulate
from umbilical.errors import Problem, ScenarioError
from umbilical.plant.rope.assemble import body_data, stiffness, weights_of
from umbilical.plant.rope.records import vector_of
from umbilical.plant.top import top_at
from umbilical.run import Status
from umbilical.scenario.scenario import Scenario
from umbilical.studies.engines import in_order

LEVEL = 0.95
"""Confidence of the intervals."""
_RESAMPLED = 400
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
class SnapStudy:
    """What many seeds of one scenario came to; arrays have the shape (seeds,).

    Attributes:
        scenario: what was run.
        seeds: of the runs.
        completed: whether a run came to its end; the others are in no statistic.
        largest_tension: at either end, N.
        snaps: how often the cable became taut after slack.
        largest_snap: N; 0 without a snap.
        static_tension: at the vessel, N.
        impact_speed: largest vertical speed of the body against the sheave, m/s.
        slack: probability that a run has slack, with its interval.
        extreme: of the largest tensions; None where too few runs completed.
    """

    scenario: Scenario
    seeds: np.ndarray
    completed: np.ndarray
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
        rope_length = float(top_at(self.scenario.winch, 0.0).length)
        body = body_data(self.scenario)
        mass = body.mass + float(vector_of(body.added_mass)[2])
        return self.static_tension + float(self.impact_speed.max()) * sqrt(
            stiffness(self.scenario) / rope_length * mass
        )

    def summary(self) -> str:
        """One line: probability of slack, largest snap."""
        runs = f"{int(self.completed.sum())} of {self.seeds.size} seeds completed"
        slack = f"slack in {self.slack.value:.3g} of the runs ({self.slack.low:.3g} to {self.slack.high:.3g})"
        largest = float(self.largest_snap.max())
        return f"{runs}; {slack}; " + (f"largest snap {largest:.4g} N" if largest else "no snap")

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        extreme = self.extreme
        return {
            "scenario": self.scenario.name,
            "seeds": self.seeds.tolist(),
            "completed": self.completed.tolist(),
            "largest_tension": self.largest_tension.tolist(),
            "snaps": self.snaps.tolist(),
            "largest_snap": self.largest_snap.tolist(),
            "static_tension": self.static_tension,
            "rule_of_thumb": self.rule_of_thumb,
            "slack": self.slack._asdict(),
            "gumbel": extreme
            and {
                "location": extreme.location,
                "scale": extreme.scale,
                "exceeded_by_1_in_100": extreme.exceeded._asdict(),
            },
        }


def snap(
    scenario: Scenario, seeds: int = 20, *, workers: int = 1, progress: Callable[[float], None] | None = None
) -> SnapStudy:
    """Run a rope with seeds of its own and of the next ones: each has another sea.

    Args:
        scenario: with ``model = "rope"``.
        seeds: how many.
        workers: threads; results do not depend on them.
        progress: called with the share that is done.

    Raises:
        ScenarioError: the scenario is refused, is no rope, or its seeds change nothing.
    """
    _check(scenario, seeds)
    sea = scenario.environment.sea
    chosen = (sea.seed if sea else 0) + np.arange(seeds)
    changed = [scenario.replace({"environment.sea.seed": seed}) for seed in chosen.tolist()]
    rows = in_order(_one, changed, progress, workers)
    completed, tension, snaps, largest, slack, speed = np.array(rows).T
    good = completed > 0.0
    return SnapStudy(
        scenario, chosen, good, tension, snaps.astype(int), largest, weights_of(scenario)[1], speed,
        share(float(slack[good].sum()), int(good.sum())), _extreme(tension[good], int(chosen[0])),
    )  # fmt: skip


def _check(scenario: Scenario, seeds: int) -> None:
    wrong = None
    if scenario.model != "rope":
        wrong = Problem("model", f'"{scenario.model}"', '"rope"', "a string never goes slack", 'set model = "rope"')
    elif scenario.environment.sea is None:
        reason = "without a sea every seed gives the same motion of the vessel"
        wrong = Problem("environment.sea", "left out", "a section", reason, "systems of waves and a vessel")
    elif seeds < 1:
        wrong = Problem("seeds", str(seeds), "1 or more", "there is nothing to say of none", "20, or 100 for a tail")
    if wrong:
        raise ScenarioError([wrong], scenario.name)


def _one(scenario: Scenario) -> tuple[float, ...]:
    """Whether it completed, largest tension, snaps, largest snap, whether it was slack, largest impact speed."""
    run = simulate(scenario)
    m = run.metrics
    sheave = np.gradient(run["vessel_position"].values[:, 2], run["time"].values)
    impact = float(np.abs(run["body_velocity"].values[:, 2] - sheave).max())
    largest = max(m["top_tension_peak"], m["end_tension_peak"])
    completed = run.status is Status.COMPLETED
    return completed, largest, m["snaps"], m.get("largest_snap", 0.0), m["slack_share"] > 0.0, impact


def _extreme(tension: np.ndarray, seed: int) -> Extreme | None:
    """Fit by maximum likelihood; the interval from fits to samples drawn from the fit."""
    if tension.size < _FEWEST:
        return None
    location, scale = gumbel_r.fit(tension)
    dice = np.random.default_rng(seed)
    drawn = np.asarray(gumbel_r.rvs(location, scale, size=(_RESAMPLED, tension.size), random_state=dice))
    again = [gumbel_r.ppf(0.99, *gumbel_r.fit(sample)) for sample in drawn]
    low, high = np.quantile(again, [(1.0 - LEVEL) / 2.0, (1.0 + LEVEL) / 2.0])
    value = float(gumbel_r.ppf(0.99, location, scale))
    return Extreme(float(location), float(scale), Estimate(value, float(low), float(high)))

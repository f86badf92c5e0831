"""What the proofs of Theorems 1 and 3 need, asked of our certificate and of the linearised sampled loop."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from umbilical import Scenario, certify, margins
from umbilical.certificate import largest_bounds
from umbilical.certificate.advice import best_rate
from umbilical.certificate.setting import ideal_constants, sampled, slab_edges

BETA = "control.law.slope_gain"
CERTIFIED = (0.1, 2.0)
"""m/s, slope gains between which the least one that can be certified lies."""
STABLE = (0.05, 0.8)
"""m/s, those between which the cascade becomes unstable."""
HALVINGS = (9, 5)
"""Of the two brackets: the first edge is then known to 0.6 per cent, the second to 9."""


class Proofs(NamedTuple):
    """What can be proved of the ideal loop, and whether the cascade is stable.

    Attributes:
        rate: best rate of V over the run at the paper's gains, 1/s; proved if it is positive.
        fixed_rate: proved rate with the winch stopped at its greatest length, 1/s; nan where none is.
        fixed_bound: bound of \\|y\\| that follows there, m.
        broken: names of iota_1 to iota_7 that are negative, as printed.
        certified: slope gain from which on a rate over the run is proved, m/s.
        stable: whether the linearised sampled loop is stable at the paper's gains and the shortest length.
        delay: extra delay it survives, s; nan where it is unstable.
        unstable_from: slope gain from which on it is unstable, m/s.
    """

    rate: float
    fixed_rate: float
    fixed_bound: float
    broken: tuple[str, ...]
    certified: float
    stable: bool
    delay: float
    unstable_from: float


def proofs_of(scenario: Scenario) -> Proofs:
    """Everything, for a scenario with the boundary law and a winch that moves."""
    winch = scenario.to_dict()["winch"]
    shortest, longest = sorted((winch["start_length"], winch["end_length"]))
    still = scenario.replace({"winch": {"law": "constant", "length": longest}})

    def stable(beta: float) -> bool:
        return margins(scenario.replace({BETA: beta}), [shortest]).stable

    ours, fixed = (certify(one, fix=False) for one in (scenario, still))
    bounds, cascade = largest_bounds(fixed), margins(scenario, [shortest])
    limits = cascade.judgements[0].margins
    return Proofs(
        rate=ours.rate,
        fixed_rate=fixed.rate if fixed.holds else float("nan"),
        fixed_bound=bounds.tip_largest if bounds else float("inf"),
        broken=tuple(condition.name for condition in ours.paper if not condition.holds),
        certified=least_certified(scenario),
        stable=cascade.stable,
        delay=limits.delay.size if limits else float("nan"),
        unstable_from=edge_between(stable, *STABLE, HALVINGS[1]),
    )


def least_certified(scenario: Scenario) -> float:
    """Slope gain from which on a positive rate of V is proved over the run of a scenario, m/s; nan if none is."""
    winch, loop = scenario.winch, ideal_constants(scenario)
    motion = sampled(winch, scenario.environment.gravity, slab_edges(winch, scenario.duration))

    def fails(beta: float) -> bool:
        return best_rate(loop._replace(beta=beta), motion, enough=0.0) <= 0.0

    found = edge_between(fails, *CERTIFIED, HALVINGS[0])
    proved = np.isfinite(found) and certify(scenario.replace({BETA: found}), fix=False).holds
    return found if proved else float("nan")


def edge_between(holds: Callable[[float], bool], low: float, high: float, halvings: int) -> float:
    """From where on something no longer holds, by halving on the scale of logarithms; nan if it is not between."""
    if not holds(low) or holds(high):
        return float("nan")
    for _ in range(halvings):
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if holds(middle) else (low, middle)
    return high

"""The optimiser, Optuna: a seed and what came of each trial decide on the next, so equal values bring equal trials;
a search is resumed by playing it again from its journal."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from operator import le
from typing import NamedTuple

from umbilical.errors import MissingPartnerError

Point = tuple[float, ...]


class TrialVerdict(NamedTuple):
    """What came of a trial: its objectives, to be small, and by how much it breaks each condition (0 and less: not)."""

    values: tuple[float, ...]
    violations: tuple[float, ...]

    @property
    def broken(self) -> float:
        """By how much all conditions together are broken."""
        return sum(max(violation, 0.0) for violation in self.violations)


Judge = Callable[[Point], TrialVerdict]
_WORSE = 1e9
"""Stands for what is worse than any number, which optimisers cannot take."""


def search(judge: Judge, dimensions: int, objectives: int, trials: int, seed: int) -> None:
    """Try points by tree-structured Parzen estimators (Bergstra 2011), for one objective or two, with conditions.

    Raises:
        MissingPartnerError: Optuna is not installed.
    """
    try:
        import optuna
    except ImportError as error:
        raise MissingPartnerError("tuning needs optuna; get it with `pip install umbilical[tune]`") from error

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.TPESampler(seed=seed % 2**32, multivariate=True)
    study = optuna.create_study(directions=[optuna.study.StudyDirection.MINIMIZE] * objectives, sampler=sampler)
    for _ in range(trials):
        trial = study.ask()
        found = judge(tuple(trial.suggest_float(str(k), 0.0, 1.0) for k in range(dimensions)))
        trial.set_constraint("broken", found.broken)
        study.tell(trial, [min(value, _WORSE) for value in found.values])


def front(verdicts: Sequence[TrialVerdict]) -> list[int]:
    """Places of those that keep every condition and that no other beats in every objective, by the first objective; of
    equals the first.

    >>> values = [((1.0, 3.0), ()), ((2.0, 2.0), ()), ((3.0, 3.0), ()), ((0.0, 0.0), (1.0,))]
    >>> front([TrialVerdict(*both) for both in values])
    [0, 1]
    """
    best: dict[int, tuple[float, ...]] = {}
    for values, place in sorted((v.values, k) for k, v in enumerate(verdicts) if not v.broken and max(v.values) < inf):
        if not any(all(map(le, better, values)) for better in best.values()):
            best[place] = values
    return list(best)

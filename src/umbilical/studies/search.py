"""The optimiser, Optuna: a seed and what came of each trial decide on the next, so equal values bring equal trials;
a search is resumed by playing it again from its journal."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from math import inf
from typing import Any, NamedTuple

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
    directions: Any = ["minimize"] * objectives
    study = optuna.create_study(directions=directions, sampler=_sampler(optuna, seed % 2**32))
    for _ in range(trials):
        trial = study.ask()
        found = judge(tuple(trial.suggest_float(str(k), 0.0, 1.0) for k in range(dimensions)))
        if _carries_conditions(optuna):
            trial.set_constraint("broken", found.broken)
        trial.set_user_attr("broken", found.broken)
        study.tell(trial, [min(value, _WORSE) for value in found.values])


def _carries_conditions(optuna: Any) -> bool:
    """Whether trials carry their conditions themselves, as from version 5 on."""
    return hasattr(optuna.trial.Trial, "set_constraint")


def _sampler(optuna: Any, seed: int) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", optuna.exceptions.ExperimentalWarning)
        if _carries_conditions(optuna):
            return optuna.samplers.TPESampler(seed=seed, multivariate=True)
        return optuna.samplers.TPESampler(
            seed=seed, multivariate=True, constraints_func=lambda trial: (trial.user_attrs["broken"],)
        )


def front(verdicts: Sequence[TrialVerdict]) -> list[int]:
    """Places of those that keep every condition and that no other beats in every objective, by the first objective.

    >>> values = [((1.0, 3.0), ()), ((2.0, 2.0), ()), ((3.0, 3.0), ()), ((0.0, 0.0), (1.0,))]
    >>> front([TrialVerdict(*both) for both in values])
    [0, 1]
    """
    sound = [k for k, v in enumerate(verdicts) if v.broken == 0.0 and all(value < inf for value in v.values)]
    best: list[int] = []
    for k in sorted(sound, key=lambda k: (verdicts[k].values, k)):
        if not any(_beats(verdicts[other], verdicts[k]) for other in best):
            best.append(k)
    return best


def _beats(one: TrialVerdict, other: TrialVerdict) -> bool:
    """Whether one is nowhere worse; of equals the first stays."""
    return all(a <= b for a, b in zip(one.values, other.values, strict=True))

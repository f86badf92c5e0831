"""Optimisers: Optuna where it is installed, else scipy. Both are told what to try from a seed and what came of it, so
the same trials come again when the same values do; a search is resumed by playing it again from its journal."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from math import inf, log
from typing import Any, NamedTuple

import numpy as np

from umbilical.errors import MissingPartnerError

Point = tuple[float, ...]


class Verdict(NamedTuple):
    """What came of a trial: its objectives, to be small, and by how much it breaks each condition (0 and less: not)."""

    values: tuple[float, ...]
    violations: tuple[float, ...]

    @property
    def broken(self) -> float:
        """By how much all conditions together are broken."""
        return sum(max(violation, 0.0) for violation in self.violations)


Judge = Callable[[Point], Verdict]
Search = Callable[[Judge, int, int, int, int], None]
_WORSE = 1e9
"""Stands for what is worse than any number, which optimisers cannot take."""
_WEIGHTS = (0.5, 0.0, 1.0, 0.25, 0.75)
"""Of the second objective, one search after the other: a single-objective method goes along the front in steps."""


def choose(name: str) -> tuple[str, Search]:
    """An optimiser by name, ``auto`` for the best there is.

    Raises:
        MissingPartnerError: Optuna was asked for and is not installed.
    """
    there = find_spec("optuna") is not None
    if name == "optuna" and not there:
        raise MissingPartnerError("optuna is not installed; get it with `pip install umbilical[tune]`, or use scipy")
    return ("optuna", by_optuna) if there and name != "scipy" else ("scipy", by_scipy)


def by_optuna(judge: Judge, dimensions: int, objectives: int, trials: int, seed: int) -> None:
    """Tree-structured Parzen estimators (Bergstra 2011), for one objective or two, with conditions."""
    import optuna

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


def by_scipy(judge: Judge, dimensions: int, objectives: int, trials: int, seed: int) -> None:
    """Differential evolution (Storn and Price 1997); of two objectives weighted sums of logarithms, one by one."""
    weights = _WEIGHTS[: max(1, min(len(_WEIGHTS), trials // 10))] if objectives == 2 else (0.0,)
    shares = [trials // len(weights) + (k < trials % len(weights)) for k in range(len(weights))]
    for weight, share in zip(weights, shares, strict=True):
        _evolve(lambda point, w=weight: _scalar(judge(point), w), dimensions, share, seed)


class _Enough(Exception):
    """All trials are used up."""


def _evolve(cost: Callable[[Point], float], dimensions: int, trials: int, seed: int) -> None:
    from scipy.optimize import differential_evolution

    left = [trials]

    def counted(x: np.ndarray) -> float:
        if left[0] == 0:
            raise _Enough
        left[0] -= 1
        return cost(tuple(float(value) for value in x))

    settings: dict[str, Any] = {"polish": False, "init": "sobol", "updating": "deferred", "tol": 0.0}
    try:
        differential_evolution(counted, [(0.0, 1.0)] * dimensions, maxiter=trials, popsize=5, rng=seed, **settings)
    except _Enough:
        return


def _scalar(found: Verdict, weight: float) -> float:
    """One number for all: the broken conditions first."""
    if found.broken > 0.0:
        return _WORSE * (1.0 + found.broken)
    weights = (1.0 - weight, weight)[: len(found.values)]
    return sum(w * log(min(max(value, 1e-300), _WORSE)) for w, value in zip(weights, found.values, strict=True) if w)


def front(verdicts: Sequence[Verdict]) -> list[int]:
    """Places of those that keep every condition and that no other beats in every objective, by the first objective.

    >>> front([Verdict((1.0, 3.0), ()), Verdict((2.0, 2.0), ()), Verdict((3.0, 3.0), ()), Verdict((0.0, 0.0), (1.0,))])
    [0, 1]
    """
    sound = [k for k, v in enumerate(verdicts) if v.broken == 0.0 and all(value < inf for value in v.values)]
    best: list[int] = []
    for k in sorted(sound, key=lambda k: (verdicts[k].values, k)):
        if not any(_beats(verdicts[other], verdicts[k]) for other in best):
            best.append(k)
    return best


def _beats(one: Verdict, other: Verdict) -> bool:
    """Whether one is nowhere worse; of equals the first stays."""
    return all(a <= b for a, b in zip(one.values, other.values, strict=True))

"""Search over gains against the distribution of a study, with conditions; the result is a change of the scenario."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass
from math import isnan
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import tomlkit

from umbilical.analysis.paired import quantile
from umbilical.errors import FileError, Problem, ScenarioError, expect
from umbilical.library import admit, load, preset_names
from umbilical.result import ResultFaces
from umbilical.scenario.document import extend
from umbilical.scenario.problems import nearest
from umbilical.scenario.scenario import validate
from umbilical.studies.constraints import CONSTRAINTS, Constraint
from umbilical.studies.journal import BEGIN_ANEW
from umbilical.studies.members import Draws
from umbilical.studies.prepare import prepare_study
from umbilical.studies.results import StudyResult
from umbilical.studies.search import Point, TrialVerdict, front, search
from umbilical.studies.store import open_store
from umbilical.studies.study import Arm, Objective, Study, Tuning
from umbilical.studies.sweep import in_memory, open_engine

Progress = Callable[[float], None]
_NO_ANSWER = 1e6
"""Stands for the violation of a condition that gave no number."""


@dataclass(frozen=True)
class TriedGains:
    """One set of gains, by dotted key, and what came of it."""

    gains: Mapping[str, float]
    verdict: TrialVerdict


@dataclass(frozen=True)
class Tuned(ResultFaces):
    """The result of a search.

    Attributes:
        study: what was tuned.
        conditions: names of the conditions, in the order of a verdict's violations.
        trials: everything tried, in order.
        front: the trials no other beats, by the first objective; one objective: the best alone.
    """

    shown_by: ClassVar[str] = "umbilical.faces.tuning"
    drawn_by: ClassVar[str] = "plot_tuning"

    study: Study
    conditions: tuple[str, ...]
    trials: tuple[TriedGains, ...]

    @property
    def gains(self) -> tuple[str, ...]:
        """Keys of what was chosen."""
        return tuple(gain.key for gain in self.study.gains)

    @property
    def objectives(self) -> tuple[str, ...]:
        """What was made small, in words."""
        return tuple(map(str, tuning_of(self.study).objectives))

    @property
    def front(self) -> tuple[TriedGains, ...]:
        """Trials that keep every condition and that no other beats in every objective."""
        return tuple(self.trials[k] for k in front([trial.verdict for trial in self.trials]))

    @property
    def broken(self) -> dict[str, int]:
        """How many trials broke each condition; the later ones are not asked once an earlier one is broken."""
        verdicts = [trial.verdict.violations for trial in self.trials]
        return {name: sum(v[k] > 0.0 for v in verdicts) for k, name in enumerate(self.conditions)}

    @property
    def files(self) -> tuple[str, ...]:
        """Name of the scenario of each trial of the front, in the folder of the search."""
        return tuple(f"tuned-{number}.toml" for number in range(1, len(self.front) + 1))

    def document(self) -> dict[str, Any]:
        """As plain data, the same for the same search."""
        best = self.front
        return {
            "study": self.study.name,
            "study_hash": self.study.hash,
            "optimiser": "optuna",
            "objectives": list(self.objectives),
            "conditions": list(self.conditions),
            "broken": self.broken,
            "front": [_plain(trial) for trial in best],
            "trials": [_plain(trial) for trial in self.trials],
        }

    def patch(self, trial: TriedGains) -> str:
        """TOML of a scenario with these gains: what the tuned arm and the gains change of the study's scenario."""
        return to_patch(self.study, trial.gains)


def tune(
    study: Study,
    folder: str | os.PathLike[str] | None = None,
    *,
    engine: Executor | None = None,
    constraints: Mapping[str, Constraint] | None = None,
    trust: bool = False,
    resume: bool = False,
    force: bool = False,
    progress: Progress = lambda share: None,
) -> Tuned:
    """Search for the gains with which a study's members do best.

    Args:
        study: with a section ``tuning``.
        folder: where trials are kept as they go, ``tuning.json`` and a scenario for each trial of the front,
            ``tuned-1.toml`` and so on, in the end; None keeps nothing.
        engine: who runs the members of a trial, as of :func:`~umbilical.studies.sweep.sweep`; all cores by default.
        constraints: conditions by name, beside those of :data:`~umbilical.studies.constraints.CONSTRAINTS`.
        trust: import the Python controllers that the study's arms name. That runs their code.
        resume: go on with what is in the folder, to the same bytes.
        force: begin anew.
        progress: called with the share done, 0 to 1.

    Raises:
        ScenarioError: the study has no section ``tuning``, a condition nobody knows, or a Python controller that is
            not trusted or does not work.
        MissingPartnerError: Optuna is not installed.
        OutputError, FileError: as :func:`~umbilical.studies.sweep.sweep`.

    >>> import umbilical
    >>> study = umbilical.load_study("gain-tuning", {"tuning.trials": 2, "members": 1, "scenario.duration": 0.5})
    >>> len(umbilical.tune(study).trials)
    2
    """
    expect(study, "Study", "load_study")
    tuning = tuning_of(study)
    known = {**CONSTRAINTS, **(constraints or {})}
    kept = {name: _known(known, name) for name in tuning.constraints}
    study = prepare_study(study, trust=trust)
    task = "tune optuna"
    opened = open_store(Path(folder), study, task, resume=resume, force=force) if folder is not None else nullcontext()
    with opened as store, open_engine(study, engine) as pool:
        lengths = (len(tuning.gains), len(tuning.objectives), len(kept) + 2)
        done = dict(_from_entry(entry, lengths) for entry in store.entries()) if store else {}
        trials: list[TriedGains] = []

        def judge(point: Point) -> TrialVerdict:
            gains = {gain.key: gain.at(share) for gain, share in zip(tuning.gains, point, strict=True)}
            if point not in done:
                done[point] = judge_gains(study, gains, kept, pool)
                if store:
                    store.journal.append([point, *done[point]])
            trials.append(TriedGains(gains, done[point]))
            progress(len(trials) / tuning.trials)
            return done[point]

        search(judge, len(tuning.gains), len(tuning.objectives), tuning.trials, study.seed)
        found = Tuned(study, ("admitted", *kept, "completes"), tuple(trials))
        if store:
            store.save((json.dumps(found.document(), indent=1) + "\n").encode(), "tuning.json")
            for name, trial in zip(found.files, found.front, strict=True):
                store.save(found.patch(trial).encode(), name)
    return found


def _from_entry(entry: Any, lengths: tuple[int, int, int]) -> tuple[Point, TrialVerdict]:
    """Point and verdict of a line of the journal.

    Raises:
        FileError: it holds something else.
    """
    try:
        point, values, violations = (tuple(map(float, numbers)) for numbers in entry)
    except (TypeError, ValueError):
        point, values, violations = (), (), ()
    if (len(point), len(values), len(violations)) != lengths:
        raise FileError(f"the journal holds a line that is no trial of this study; {BEGIN_ANEW}")
    return point, TrialVerdict(values, violations)


def judge_gains(
    study: Study, gains: Mapping[str, float], conditions: Mapping[str, Constraint], engine: Executor
) -> TrialVerdict:
    """Conditions first, since they are cheap; the members are run only when the scenario keeps them all."""
    tuning, tuned = tuning_of(study), _arm(study)
    nothing = (float("inf"),) * len(tuning.objectives)
    arm = tuned.model_copy(update={"changes": {**tuned.changes, **gains}})
    try:
        scenario = study.scenario_with(arm.changes)
        admit(scenario)
    except ScenarioError as error:
        return TrialVerdict(nothing, (float(len(error.problems)), *(0.0 for _ in conditions), 0.0))
    found = (float(condition(scenario)) for condition in conditions.values())
    violations = tuple(_NO_ANSWER if isnan(violation) else violation for violation in found)
    if any(violation > 0.0 for violation in violations):
        return TrialVerdict(nothing, (0.0, *violations, 0.0))
    result = in_memory(Draws(study.model_copy(update={"arms": (arm,)})), engine)
    lost = float(np.mean(result["status"].values != 0))
    return TrialVerdict(tuple(statistic(result, o) for o in tuning.objectives), (0.0, *violations, lost))


def statistic(result: StudyResult, objective: Objective) -> float:
    """A statistic of a metric over the members; infinite as soon as it depends on one that did not complete."""
    values = result.values(objective.metric, result.arms[0])
    values = values[~np.isnan(values)]
    if values.size == 0:
        return float("inf")
    if objective.statistic == "quantile":
        return quantile(values, objective.share).value
    return float(values.max() if objective.statistic == "worst" else values.mean())


def tuning_of(study: Study) -> Tuning:
    """The study's section ``tuning``.

    Raises:
        ScenarioError: it has none.
    """
    if study.tuning is None:
        reason = "tuning needs gains, objectives and an arm"
        fix = "add [tuning]; `umbilical presets gain-tuning` has one"
        raise ScenarioError([Problem("tuning", "missing", "required here", reason, fix)], study.name)
    return study.tuning


def to_patch(study: Study, gains: Mapping[str, float]) -> str:
    """TOML of the scenario that was tuned: the study's own changes, the tuned arm's and the gains; of a preset only
    what differs."""
    base, name = study.scenario, f"{study.scenario.name}-tuned"[:80]
    tuned = study.scenario_with({**_arm(study).changes, **gains}).replace({"name": name})
    if base.name not in preset_names() or load(base.name) != base:
        return tuned.to_toml()
    own = base.to_dict()
    patch = {"name": name, **_difference(own, {**tuned.to_dict(), "assumed": own.get("assumed")})}
    expressed = validate(extend(own, patch), name) == tuned  # a table may say what is there, not what is not
    return tomlkit.dumps({"extends": base.name, **patch}) if expressed else tuned.to_toml()


def _difference(old: Mapping[str, Any], new: Mapping[str, Any]) -> dict[str, Any]:
    """What of a document differs from another, tables as short as they may be when they are laid over it."""
    changed = {key: value for key, value in new.items() if value != old.get(key)}
    for key, value in changed.items():
        if isinstance(value, Mapping) and isinstance(old.get(key), Mapping):
            part = _difference(old[key], value)
            changed[key] = part if extend({key: old[key]}, {key: part}) == {key: value} else value
    return changed


def _plain(trial: TriedGains) -> dict[str, Any]:
    finite = [value if np.isfinite(value) else None for value in trial.verdict.values]
    return {"gains": dict(trial.gains), "values": finite, "violations": list(trial.verdict.violations)}


def _arm(study: Study) -> Arm:
    return next(arm for arm in study.arms if arm.name == tuning_of(study).arm)


def _known(known: Mapping[str, Constraint], name: str) -> Constraint:
    if name not in known:
        there = f"one of {', '.join(known)}" if known else "none in this version"
        fix = nearest(name, known) if known else "drop it"
        raise ScenarioError([Problem("tuning.constraints", f'"{name}"', there, "no such condition is known", fix)])
    return known[name]

"""Search over gains against the distribution of a study, with conditions; the result is a change of the scenario."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass
from math import isnan
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from umbilical.analysis.paired import quantile
from umbilical.errors import FileError, Problem, ScenarioError, expect
from umbilical.library import admit, load, preset_names
from umbilical.result import ResultFaces
from umbilical.scenario.document import extend, look_up, override
from umbilical.scenario.problems import nearest
from umbilical.scenario.scenario import validate
from umbilical.studies.constraints import CONSTRAINTS, Constraint
from umbilical.studies.controllers import check_controllers
from umbilical.studies.grids import on_one_grid
from umbilical.studies.journal import BEGIN_ANEW
from umbilical.studies.members import Draws, arm_data
from umbilical.studies.results import StudyResult
from umbilical.studies.room import check_study_memory
from umbilical.studies.search import Point, TrialVerdict, front, search
from umbilical.studies.store import Store, open_store
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
            "objectives": [name_of(o) for o in tuning_of(self.study).objectives],
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
    study = on_one_grid(study)
    check_study_memory(study)
    check_controllers(study, trust=trust)
    task = "tune optuna"
    opened = open_store(Path(folder), study, task, resume=resume, force=force) if folder is not None else nullcontext()
    with opened as store, open_engine(study, engine) as pool:
        trials = _Trials(study, kept, pool, store, progress)
        search(trials.judge, len(tuning.gains), len(tuning.objectives), tuning.trials, study.seed)
        found = Tuned(study, ("admitted", *kept, "completes"), tuple(trials.all))
        if store is not None:
            _keep(store, found)
    return found


class _Trials:
    """Judges points and remembers: what the journal knows is not run again."""

    def __init__(
        self,
        study: Study,
        conditions: Mapping[str, Constraint],
        engine: Executor,
        store: Store | None,
        progress: Progress,
    ) -> None:
        self.all: list[TriedGains] = []
        self._study, self._conditions, self._engine = study, conditions, engine
        self._store, self._progress = store, progress
        old = store.entries() if store else ()
        lengths = (len(tuning_of(study).gains), len(tuning_of(study).objectives), len(conditions) + 2)
        self._known: dict[Point, TrialVerdict] = dict(_from_entry(entry, lengths) for entry in old)

    def judge(self, point: Point) -> TrialVerdict:
        """What comes of a point of the unit cube."""
        gains = {g.key: g.at(share) for g, share in zip(tuning_of(self._study).gains, point, strict=True)}
        if (verdict := self._known.get(point)) is None:
            verdict = judge_gains(self._study, gains, self._conditions, self._engine)
            self._known[point] = verdict
            if self._store:
                self._store.journal.append([point, *verdict])
        self.all.append(TriedGains(gains, verdict))
        self._progress(len(self.all) / tuning_of(self._study).trials)
        return verdict


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
    tuning = tuning_of(study)
    nothing = tuple(float("inf") for _ in tuning.objectives)
    arm = Arm(name=tuning.arm, changes={**_arm(study).changes, **gains}, controller=_arm(study).controller)
    try:
        scenario = validate(arm_data(study, arm.changes), study.name)
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


def name_of(objective: Objective) -> str:
    """An objective in words."""
    share = f"{100 * objective.share:g} % quantile"
    return f"{share if objective.statistic == 'quantile' else objective.statistic} of {objective.metric}"


def to_patch(study: Study, gains: Mapping[str, float]) -> str:
    """TOML of the scenario that was tuned: the study's own changes, the tuned arm's and the gains; of a preset only
    what differs."""
    import tomlkit

    base, changes = study.scenario, {**study.changes, **_arm(study).changes, **gains}
    name = f"{base.name}-tuned"[:80]
    tuned = validate(override(arm_data(study, {**_arm(study).changes, **gains}), {"name": name}, name), name)
    if base.name not in preset_names() or load(base.name) != base:
        return tuned.to_toml()
    data, patch = tuned.to_dict(), {"extends": base.name, "name": name}
    for key in changes:
        _copy(data, patch, _up_to_a_list(key))
    expressed = validate(extend(base.to_dict(), {key: patch[key] for key in patch if key != "extends"}), name) == tuned
    return tomlkit.dumps(patch) if expressed else tuned.to_toml()  # a table may say what is there, not what is not


def _copy(data: Mapping[str, Any], patch: dict[str, Any], steps: Sequence[str]) -> None:
    """The value at a place of the data into the same place of a patch, if there is one."""
    *tables, last = steps
    try:
        value = look_up(data, ".".join(steps))
    except KeyError:
        return
    for step in tables:
        patch = patch.setdefault(step, {})
    patch[last] = value


def _up_to_a_list(key: str) -> list[str]:
    """Steps of a key; a list is always given whole."""
    steps = key.split(".")
    return steps[: next((k for k, step in enumerate(steps) if step.isdecimal()), len(steps))]


def _keep(store: Store, found: Tuned) -> None:
    store.save((json.dumps(found.document(), indent=1) + "\n").encode(), "tuning.json")
    for name, trial in zip(found.files, found.front, strict=True):
        store.save(found.patch(trial).encode(), name)


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

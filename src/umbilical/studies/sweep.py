"""Run a study: every member in every arm, kept as it goes, the result at the end."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path

import numpy as np

from umbilical.engine.simulate import simulate
from umbilical.errors import OutputError, expect
from umbilical.formats import to_netcdf
from umbilical.studies.engines import default_jobs, in_any_order, opened, processes
from umbilical.studies.members import Draws
from umbilical.studies.prepare import prepare_study
from umbilical.studies.results import StudyResult, assemble_study
from umbilical.studies.rows import Row, from_entry, run_member
from umbilical.studies.store import RUNS, STORED, Store, open_store
from umbilical.studies.study import Study

Progress = Callable[[float], None]
Report = Callable[[str], None]
Opener = Callable[[], AbstractContextManager[Executor]]


def sweep(
    study: Study,
    folder: str | os.PathLike[str] | None = None,
    *,
    engine: Executor | Opener | None = None,
    jobs: int | None = None,
    trust: bool = False,
    resume: bool = False,
    force: bool = False,
    progress: Progress = lambda share: None,
    report: Report = lambda text: None,
) -> StudyResult:
    """Run every member of a study in every arm.

    Args:
        study: what to run.
        folder: where the result (``study.nc``), the journal and complete runs go; None keeps the result in memory.
        engine: who works, an executor of :mod:`concurrent.futures` (threads and processes of
            :mod:`umbilical.studies.engines`, ``dask`` of :mod:`umbilical.studies.cluster`, or your own), which stays
            open; or a function that opens one, called once all is checked, and closed at the end; by default threads,
            or processes where an arm has a controller in Python. The result does not depend on it, bit for bit.
        jobs: how many work at once, for the default engine; all cores if left out.
        trust: import the Python controllers that the study's arms name. That runs their code.
        resume: go on with what is in the folder.
        force: begin anew, and remove what is in the folder.
        progress: called with the share done, 0 to 1.
        report: called with what is to be said before the start: the size of complete runs.

    Returns:
        The result. Members that diverged, were refused or failed are rows of it, with the reason.

    Raises:
        ScenarioError: an arm names a Python controller that is not trusted, or does not work; or there is not memory
            enough.
        OutputError: the folder cannot be written, is in use, full, or holds something already.
        FileError: the folder holds another study, or no cluster answers.
        MissingPartnerError: an optional package is needed.

    >>> from umbilical.studies.load import load_study
    >>> small = load_study("fault-map").replace({"scenario.duration": 0.2, "changes": {"grid.elements": 8}})
    >>> sweep(small).data.sizes["member"]
    96
    """
    expect(study, "Study", "load_study")
    study = prepare_study(study, trust=trust)
    draws = Draws(study)
    with open_engine(study, engine or jobs) as pool:
        if folder is None:
            return in_memory(draws, pool, progress)
        with open_store(Path(folder), study, "sweep", resume=resume, force=force) as store:
            return _into(store, draws, pool, progress, report)


def in_memory(draws: Draws, engine: Executor, progress: Progress = lambda share: None) -> StudyResult:
    """The result of a study whose controllers have been checked."""
    return assemble_study(draws.study, _rows(engine, draws, set(), progress))


def open_engine(study: Study, workers: Executor | Opener | int | None) -> AbstractContextManager[Executor]:
    """An executor that is given or opened; else so many threads, or processes where an arm's controller is written in
    Python and holds the GIL."""
    if callable(workers):
        return workers()
    if isinstance(workers, Executor) or not any(arm.controller for arm in study.arms):
        return opened(workers)
    return processes(workers or default_jobs())


def _rows(engine: Executor, draws: Draws, done: Collection[int], progress: Progress) -> Iterator[Row]:
    """Rows of the members that are not done, in any order."""
    members = (draws.member(number) for number in range(1, len(draws) + 1) if number not in done)
    progress(len(done) / len(draws))
    for count, row in enumerate(in_any_order(engine, partial(run_member, draws), members), start=len(done) + 1):
        yield row
        progress(count / len(draws))


def _into(store: Store, draws: Draws, engine: Executor, progress: Progress, report: Report) -> StudyResult:
    study, done = draws.study, {row.number for row in _stored_rows(store, draws)}
    if study.trajectories.keep != "none":
        _check_room(store, draws, report)
    for row in _rows(engine, draws, done, progress):
        _store_runs(store, row, range(len(study.arms)))
        store.journal.append(row[:2])
    result = assemble_study(study, _stored_rows(store, draws))
    store.save(to_netcdf(result.data), "study.nc")
    if study.trajectories.keep == "worst":
        _keep_the_worst(store, draws, engine, result)
    return result


def _stored_rows(store: Store, draws: Draws) -> Iterator[Row]:
    members, arms = len(draws), len(draws.study.arms)
    return (from_entry(entry, members, arms) for entry in store.entries())


def _store_runs(store: Store, row: Row, arms: Sequence[int]) -> None:
    """The complete runs of a row, in these arms; those that were refused or failed have none."""
    for arm, run in zip(arms, row.runs, strict=bool(row.runs)):
        if run is not None:
            store.save(run, run_name(row.number, arm))


def run_name(member: int, arm: int) -> str:
    """Name of a complete run in a study's folder; arms are numbered from 1 there."""
    return f"{RUNS}/member-{member:06d}-arm-{arm + 1}.nc"


def disk_needed(draws: Draws) -> int:
    """Bytes that the complete runs of a study will take: one of each arm, measured, times their number."""
    keep = draws.study.trajectories
    if keep.keep == "none":
        return 0
    count = min(keep.count, len(draws)) if keep.keep == "worst" else len(draws)
    return count * sum(len(to_netcdf(simulate(scenario).data)) for scenario in draws.undrawn())


def _check_room(store: Store, draws: Draws, report: Report) -> None:
    """Say what complete runs will take, and refuse what there is no room for; those that are there need none."""
    there = sum(file.stat().st_size for file in (store.folder / RUNS).glob(STORED))
    need, room = max(disk_needed(draws) - there, 0), shutil.disk_usage(store.folder).free
    keep = draws.study.trajectories.keep
    report(f"complete runs ({keep}): about {need / 1e6:.3g} MB will be stored beside the result")
    if need > room:
        raise OutputError(
            f"{store.folder}: complete runs would take {need / 1e9:.3g} GB, and {room / 1e9:.3g} GB are free; "
            "set trajectories.keep, a longer output.interval, or name another disk"
        )


def worst(result: StudyResult, metric: str, arm: str, count: int) -> list[int]:
    """Members with the largest values of a metric in an arm, the worst first; diverged ones lead, equals by number.

    Left out are members that were refused, which are no possible systems, and those that failed, which have no run.
    """
    values = result.values(metric, arm)
    order = np.argsort(-np.nan_to_num(values, nan=-np.inf, posinf=np.inf), kind="stable")
    return [int(place) + 1 for place in order if not np.isnan(values[place])][:count]


def _keep_the_worst(store: Store, draws: Draws, engine: Executor, result: StudyResult) -> None:
    """Run the worst members of each arm once more, completely: a member is the same whenever it is run."""
    keep = draws.study.trajectories
    for number, arm in enumerate(draws.study.arms):
        wanted = worst(result, keep.metric, arm.name, keep.count)
        lacking = [member for member in wanted if not (store.folder / run_name(member, number)).exists()]
        whole = keep.model_copy(update={"keep": "all"})
        alone = Draws(draws.study.model_copy(update={"arms": (arm,), "trajectories": whole}))
        for row in in_any_order(engine, partial(run_member, alone), map(draws.member, lacking)):
            _store_runs(store, row, [number])

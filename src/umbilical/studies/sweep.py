"""Run a study: every member in every arm, kept as it goes, the result at the end."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from umbilical.engine.simulate import simulate
from umbilical.errors import OutputError
from umbilical.formats import to_netcdf
from umbilical.studies.engines import Engine, default_jobs, in_pool, processes, threads
from umbilical.studies.members import Draws, Member
from umbilical.studies.results import StudyResult, assemble
from umbilical.studies.rows import Row, from_entry, make_controller
from umbilical.studies.store import RUNS, Store, open_store
from umbilical.studies.study import Study

Progress = Callable[[float], None]


def sweep(
    study: Study,
    folder: str | os.PathLike[str] | None = None,
    *,
    engine: Engine | None = None,
    jobs: int | None = None,
    resume: bool = False,
    force: bool = False,
    progress: Progress = lambda share: None,
) -> StudyResult:
    """Run every member of a study in every arm.

    Args:
        study: what to run.
        folder: where the result (``study.nc``), the journal and complete runs go; None keeps the result in memory.
        engine: who works (:mod:`umbilical.studies.engines`); by default threads, or processes where an arm has a
            controller in Python. The result does not depend on it, bit for bit.
        jobs: how many work at once, for the default engine; all cores if left out.
        resume: go on with what is in the folder.
        force: begin anew, and remove what is in the folder.
        progress: called with the share done, 0 to 1.

    Returns:
        The result. Members that diverged, were refused or failed are rows of it, with the reason.

    Raises:
        OutputError: the folder cannot be written, is in use, full, or holds something already.
        FileError: the folder holds another study, or no cluster answers.
        MissingPartnerError: an optional package is needed.

    >>> from umbilical.studies.load import load_study
    >>> small = load_study("fault-map").replace({"scenario.duration": 0.2, "changes": {"grid.elements": 8}})
    >>> sweep(small).data.sizes["member"]
    96
    """
    draws = Draws(study)
    engine = engine or default_engine(study, jobs or default_jobs())
    if folder is None:
        return assemble(study, _counted(engine(draws, _members(draws, set())), len(draws), 0, progress))
    with open_store(Path(folder), study, "sweep", resume=resume, force=force) as store:
        return _into(store, draws, engine, progress)


def default_engine(study: Study, jobs: int) -> Engine:
    """Threads, or processes where an arm's controller is written in Python and holds the GIL."""
    return (processes if any(arm.controller for arm in study.arms) else threads)(jobs)


def _into(store: Store, draws: Draws, engine: Engine, progress: Progress) -> StudyResult:
    study, done = draws.study, {number for number, _ in store.entries()}
    if study.trajectories.keep != "none":
        _check_room(store.folder, draws)
    found = engine(draws, _members(draws, done))
    for row in _counted(found, len(draws), len(done), progress):
        for cell, run in enumerate(row.runs):
            if run is not None:
                store.save(run, run_name(row.number, cell))
        store.journal.append(row[:2])
    result = assemble(study, map(from_entry, store.entries()))
    if study.trajectories.keep == "worst":
        _keep_the_worst(store, draws, result)
    store.save(to_netcdf(result.data), "study.nc")
    return result


def _members(draws: Draws, done: set[int]) -> Iterator[Member]:
    return (draws.member(number) for number in range(1, len(draws) + 1) if number not in done)


def _counted(rows: Iterator[Row], total: int, done: int, progress: Progress) -> Iterator[Row]:
    progress(done / total)
    for count, row in enumerate(rows, start=done + 1):
        yield row
        progress(count / total)


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


def _check_room(folder: Path, draws: Draws) -> None:
    need, room = disk_needed(draws), shutil.disk_usage(folder).free
    if need > room:
        raise OutputError(
            f"{folder}: complete runs would take {need / 1e9:.3g} GB, and {room / 1e9:.3g} GB are free; "
            "set trajectories.keep, a longer output.interval, or name another disk"
        )


def worst(result: StudyResult, metric: str, arm: str, count: int) -> list[int]:
    """Members with the largest values of a metric in an arm, the worst first; diverged ones lead, equals by number.

    Members that were refused are left out: they are no possible systems.
    """
    values = result.values(metric, arm)
    order = np.argsort(-np.nan_to_num(values, nan=-np.inf, posinf=np.inf), kind="stable")
    return [int(place) + 1 for place in order if not np.isnan(values[place])][:count]


def _keep_the_worst(store: Store, draws: Draws, result: StudyResult) -> None:
    """Run the worst members once more, completely: a member is the same whenever it is run."""
    from concurrent.futures import ThreadPoolExecutor

    keep = draws.study.trajectories
    wanted = [
        (number, arm) for arm, name in enumerate(result.arms) for number in worst(result, keep.metric, name, keep.count)
    ]

    def again(which: tuple[int, int]) -> tuple[str, bytes]:
        number, arm = which
        scenario = draws.scenario(draws.member(number), arm)
        run = simulate(scenario, make_controller(draws.study.arms[arm].controller, scenario))
        return run_name(number, arm), to_netcdf(run.data)

    with ThreadPoolExecutor(default_jobs()) as pool:
        for name, content in in_pool(pool, again, wanted, default_jobs()):
            store.save(content, name)

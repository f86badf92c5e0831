"""``umbilical sweep`` and ``member``."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, BadParameter, Option

from umbilical.cli.loading import load_changed_study
from umbilical.cli.options import Anew, Changes, Force, Jobs, Json, Resume, Trust, source
from umbilical.cli.output import conclude, print_result, report

if TYPE_CHECKING:
    from umbilical.studies.sweep import Opener


def sweep_command(
    study: Annotated[str, source("A study's name, a .toml file, or the .nc result of one to run again.", "studies")],
    changes: Changes = None,
    out: Annotated[Path | None, Option("--out", metavar="DIR", help="Folder; named as the study if left out.")] = None,
    jobs: Jobs = None,
    processes: Annotated[bool, Option("--processes", help="Processes instead of threads.")] = False,
    dask: Annotated[str | None, Option("--dask", metavar="ADDRESS|local", help="Workers of a Dask cluster.")] = None,
    trust: Trust = False,
    resume: Resume = False,
    force: Anew = False,
    as_json: Json = False,
) -> int:
    """Run a study: every member in every arm.

    \b
    examples
      umbilical sweep paper-robustness --out robust
      umbilical sweep paper-robustness --set members=100 --jobs 2 --json
      umbilical sweep my-study.toml --dask local --out far
      umbilical sweep my-study.toml --dask tcp://host:8786 --out far --resume

    Killed at any moment it loses at most the members under way; the same command with --resume completes to the same
    bytes. The result, DIR/study.nc, does not depend on how many worked, nor where. Where not one member of an arm
    completed, the exit code is 7. Controllers in Python that a study names are imported with --trust only, and never
    from a result.
    """
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.studies.sweep import sweep

    if dask and processes:
        raise BadParameter("--processes and --dask say two different things", param_hint="--dask")
    chosen = load_changed_study(study, changes)
    folder = out or Path(chosen.name)
    announce_compilation(chosen.scenario)
    engine, kept = _engine(jobs, processes, dask), {"trust": trust, "resume": resume, "force": force}
    try:
        with bar(f"running {chosen.name}") as advance:
            found = sweep(chosen, folder, engine=engine, jobs=jobs, progress=advance, report=report, **kept)
    except KeyboardInterrupt:
        report(f"interrupted; finished members are kept, `--out {folder} --resume` goes on")
        raise
    return conclude(found, files={"result": str(folder / "study.nc")}, as_json=as_json)


def _engine(jobs: int | None, processes: bool, dask: str | None) -> Opener | None:
    """Who works, opened once the study is checked; None leaves it to the study."""
    from umbilical.studies import engines

    count = jobs or engines.default_jobs()
    if dask:
        from umbilical.studies.cluster import dask as cluster

        return partial(cluster, dask, count)
    return partial(engines.processes, count) if processes else None


def member_command(
    study: Annotated[str, source("A study's name, a .toml file, or a .nc result.", "studies")],
    number: Annotated[int, Argument(help="The member, from 1.")],
    arm: Annotated[str | None, Option("--arm", metavar="NAME", help="An arm's name; the first if left out.")] = None,
    out: Annotated[Path | None, Option("--out", metavar="FILE.toml", help="Write it to a file.")] = None,
    changes: Annotated[
        list[str] | None, Option("--set", metavar="KEY=VALUE", help="The study's changes; may be repeated.")
    ] = None,
    force: Force = False,
) -> None:
    """Print the scenario of one member of a study, to run it alone.

    \b
    examples
      umbilical member robust/study.nc 731 --arm "proposed + fault control"
      umbilical member robust/study.nc 731 --out m731.toml
    """
    from umbilical import files
    from umbilical.studies.members import Draws

    chosen = load_changed_study(study, changes, runs=False)
    draws, arms = Draws(chosen), [a.name for a in chosen.arms]
    if not 1 <= number <= len(draws):
        raise BadParameter(f"there are members 1 to {len(draws)}", param_hint="NUMBER")
    if arm is not None and arm not in arms:
        raise BadParameter(f"there are the arms {', '.join(arms)}", param_hint="--arm")
    place = arms.index(arm) if arm else 0
    if own := chosen.arms[place].controller:
        report(f"arm '{arms[place]}' is decided by {own}: run the scenario with --controller {own}")
    text = draws.scenario(draws.member(number), place).to_toml()
    print_result(f"scenario: {files.write(out, text.encode(), force=force)}" if out else text)

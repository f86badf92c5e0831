"""``umbilical tune``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from typer import Option

from umbilical.cli.loading import load_changed_study
from umbilical.cli.options import Anew, Changes, Jobs, Json, Plot, Resume, Trust, source
from umbilical.cli.output import conclude, report
from umbilical.cli.targets import draw_files


def tune_command(
    study: Annotated[str, source("A study with a section [tuning]: its name or a .toml file.", "studies")],
    changes: Changes = None,
    out: Annotated[Path | None, Option("--out", metavar="DIR", help="Folder; NAME-tuned if left out.")] = None,
    jobs: Jobs = None,
    plot: Plot = None,
    trust: Trust = False,
    resume: Resume = False,
    force: Anew = False,
    as_json: Json = False,
) -> int:
    """Search for gains with which the members of a study do best.

    \b
    examples
      umbilical tune gain-tuning --out tuned
      umbilical tune gain-tuning --out tuned --resume --plot front.png
      umbilical run tuned/tuned-1.toml

    With two objectives the Pareto front is shown: the trials that no other beats in both. DIR/tuning.json has every
    trial, DIR/tuned-1.toml and so on are scenarios with the gains of the front, the best in the first objective first.
    Where no gains keep every condition, the exit code is 7.
    """
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.studies.sweep import open_engine
    from umbilical.studies.tune import tune

    chosen = load_changed_study(study, changes)
    folder = out or Path(f"{chosen.name}-tuned")
    announce_compilation()
    try:
        with open_engine(chosen, jobs) as engine, bar(f"tuning {chosen.name}") as advance:
            found = tune(chosen, folder, engine=engine, trust=trust, resume=resume, force=force, progress=advance)
    except KeyboardInterrupt:
        report(f"interrupted; finished trials are kept, `--out {folder} --resume` goes on")
        raise
    files = {"trials": str(folder / "tuning.json")}
    files |= {f"scenario {k}": str(folder / name) for k, name in enumerate(found.files, start=1)}
    if found.front:
        files |= draw_files(found.plot, plot, force=force or resume)
    return conclude(found, files=files if as_json else _shortened(files), as_json=as_json)


def _shortened(files: Mapping[str, str]) -> dict[str, str]:
    """Of many scenarios the first and the last."""
    scenarios = [role for role in files if role.startswith("scenario")]
    return {role: path for role, path in files.items() if role not in scenarios[1:-1]}

"""``umbilical tune``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from umbilical.cli.conclusion import conclude
from umbilical.cli.options import Anew, Changes, Jobs, Json, Resume, Trust
from umbilical.cli.output import report
from umbilical.cli.sweep import load_changed_study, refuse_code_of_results
from umbilical.cli.targets import PICTURES, check_target, draw_files
from umbilical.faces.tuning import conclusion, document, text


def tune(
    study: Annotated[str, Argument(help="A study with a section [tuning]: its name or a .toml file.")],
    changes: Changes = None,
    out: Annotated[Path | None, Option("--out", metavar="DIR", help="Folder; NAME-tuned if left out.")] = None,
    jobs: Jobs = None,
    picture: Annotated[
        Path | None, Option("--plot", metavar="FILE", help="Draw the front: a .png, .pdf or .svg.")
    ] = None,
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
    from umbilical.studies.tune import tune as search

    chosen = load_changed_study(study, changes or [])
    refuse_code_of_results(study, chosen)
    check_target(picture, PICTURES, force=force or resume)
    folder = out or Path(f"{chosen.name}-tuned")
    announce_compilation()
    try:
        with open_engine(chosen, jobs) as engine, bar(f"tuning {chosen.name}") as advance:
            found = search(
                chosen,
                folder,
                engine=engine,
                trust=trust,
                resume=resume,
                force=force,
                progress=advance,
            )
    except KeyboardInterrupt:
        report(f"interrupted; finished trials are kept, `--out {folder} --resume` goes on")
        raise
    files = {"trials": str(folder / "tuning.json")}
    files |= {f"scenario {k}": str(folder / name) for k, name in enumerate(found.files, start=1)}
    if found.front:
        files |= draw_files(found.plot, picture, force=force or resume)
    return conclude(
        conclusion(found),
        text=lambda: "\n\n".join([text(found), "\n".join(f"{role}: {path}" for role, path in _shortened(files))]),
        document=lambda: {**document(found), "files": files},
        as_json=as_json,
    )


def _shortened(files: Mapping[str, str]) -> list[tuple[str, str]]:
    """Of many scenarios the first and the last."""
    scenarios = [role for role in files if role.startswith("scenario")]
    return [(role, path) for role, path in files.items() if role not in scenarios[1:-1]]

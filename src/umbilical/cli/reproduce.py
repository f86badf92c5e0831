"""``umbilical reproduce``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, BadParameter, Option

from umbilical.cli.options import Force, Json
from umbilical.cli.output import conclude, report
from umbilical.cli.targets import make_room

if TYPE_CHECKING:
    from umbilical.papers.rao2022 import Reproduction


def reproduce_command(
    figures: Annotated[list[str] | None, Argument(metavar="[FIGURE]...", help="Only these, e.g. fig6 kappa.")] = None,
    out: Annotated[Path, Option("--out", metavar="DIR", help="Folder for the files; made if missing.")] = Path("paper"),
    maps: Annotated[bool, Option("--maps/--no-maps", help="Also the maps, some 2300 runs.")] = True,
    check: Annotated[bool, Option("--check", help="Exit with 7 if a published number or verdict has moved.")] = False,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Reproduce the paper: every figure with its data, every claim with a verdict, one report.

    \b
    examples
      umbilical reproduce --out paper
      umbilical reproduce --no-maps --check --json --out checked
      umbilical reproduce fig6 kappa --out figures

    Each figure is written as .png and .pdf, its data as .nc and .csv. The report, report.html, opens in any browser
    without a network. With figures named there is no ledger and no report.
    """
    names = check_names(figures or [], maps=maps, check=check)
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.papers.rao2022 import reproduction
    from umbilical.papers.rao2022.article import article
    from umbilical.papers.rao2022.summary import moved_in
    from umbilical.studies.engines import default_jobs

    make_room(out, reproduction.targets(reproduction.choose(names, maps=maps), out, report=not names), force=force)
    announce_compilation()
    with bar("reproducing the paper") as advance:
        found = reproduction.reproduce(names, maps=maps, processes=default_jobs(), progress=advance)
    moved = moved_in(found)
    written = reproduction.write_files(found, out, lambda made: article(made, moved), force=force)
    for one in moved:
        report(f"not as published: {one}")
    files = written if as_json else _files(found, out, written)
    return conclude(found, moved, check, files=files, as_json=as_json)


def check_names(names: list[str], *, maps: bool, check: bool) -> list[str]:
    """The figures asked for, each once; refused if they are not there, are left out, or there is nothing to check."""
    from umbilical.papers.rao2022 import PICTURES
    from umbilical.papers.rao2022.maps import MAPS

    unknown = [name for name in names if name not in PICTURES]
    if unknown:
        raise BadParameter(f"no figure {', '.join(unknown)}; there are {', '.join(PICTURES)}", param_hint="FIGURE")
    if left_out := [name for name in names if name in MAPS and not maps]:
        raise BadParameter(f"{', '.join(left_out)}: a map, and --no-maps leaves maps out", param_hint="FIGURE")
    if names and check:
        raise BadParameter("figures alone hold no published number; leave the figures out", param_hint="--check")
    return list(dict.fromkeys(names))


def _files(found: Reproduction, folder: Path, written: dict[str, Any]) -> dict[str, str]:
    """Where the files are, in few words."""
    from umbilical.papers.rao2022.reproduction import KINDS

    figures = {f"{len(found.shown)} figures": f"{folder}, each as {', '.join(KINDS)}"}
    return figures | {role: path for role, path in written.items() if role == "report"}

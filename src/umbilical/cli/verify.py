"""``umbilical verify``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from umbilical.cli.options import Force, Json
from umbilical.cli.output import conclude
from umbilical.cli.targets import make_room

if TYPE_CHECKING:
    from umbilical.verify import Verification

FILES = ("verification.md", "verification.json", "convergence.svg")


def verify_command(
    quick: Annotated[bool, Option("--quick", help="Half a minute: leave out what takes long.")] = False,
    out: Annotated[Path | None, Option("--out", metavar="DIR", help="Write table, data and pictures there.")] = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Compare this installation with closed forms, classical solutions and other codes.

    Every row: what is compared with what, ours, theirs, the error, the tolerance and why that tolerance. The exit
    code is 0 when all hold and 7 when one does not, or none could be made. With --out: verification.md, .json and
    convergence.svg.

    \b
    examples
      umbilical verify --quick
      umbilical verify --out evidence
    """
    targets = [out / name for name in FILES] if out else []
    if out:
        make_room(out, targets, force=force)
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.verify import verify_all

    announce_compilation()
    with bar("verifying") as advance:
        found = verify_all(quick, progress=advance)
    return conclude(found, files=_write(found, targets, force), as_json=as_json)


def _write(found: Verification, targets: list[Path], force: bool) -> dict[str, str]:
    """The files by role."""
    if not targets:
        return {}
    from umbilical.faces.verification import data, markdown_page
    from umbilical.files import write
    from umbilical.plots import plot_convergence, save_figure

    report, numbers, picture = targets
    write(report, markdown_page(found, picture.name).encode(), force=force)
    write(numbers, data(found).encode(), force=force)
    save_figure(plot_convergence(found.curves), picture, force=force)
    return {"table": str(report), "data": str(numbers), "plots": str(picture)}

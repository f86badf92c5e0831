"""``umbilical animate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from umbilical.cli.options import Force
from umbilical.cli.output import print_result
from umbilical.cli.targets import check_target


def animate_command(
    file: Annotated[Path, Argument(help="A .nc result of a run.")],
    compare: Annotated[
        Path | None, Option("--compare", metavar="FILE", help="Another result, on the same clock.")
    ] = None,
    out: Annotated[Path | None, Option("--out", "-o", metavar="FILE", help="An .html file.")] = None,
    force: Force = False,
) -> None:
    """Write one HTML file that plays a run in any browser, without network.

    A string is seen in its plane; a rope from two sides, with its tension, where it is slack and when it snaps taut.
    Without --out the page lies beside the result.

    \b
    examples
      umbilical animate paper.nc
      umbilical animate paper.nc --compare free.nc --out both.html
    """
    target = out or file.with_suffix(".html")
    check_target(target, ("html",), force=force)
    from umbilical import files
    from umbilical.analysis.comparison import distinct_names
    from umbilical.errors import FileError
    from umbilical.report.player import player
    from umbilical.stored_runs import open_run

    given = [path for path in (file, compare) if path]
    runs = [open_run(path) for path in given]
    names = [path.stem for path in given] if len({path.stem for path in given}) > 1 else distinct_names(runs)
    try:
        page = player(*runs, names=names)
    except ValueError as error:
        raise FileError(str(error)) from error
    written = files.write(target, page.encode("utf-8"), force=force)
    print_result(f"{written}: {len(page) / 1e3:.0f} kB, plays {' and '.join(names)}")

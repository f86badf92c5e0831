"""``umbilical plot``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from typer import Argument, BadParameter, Option

from umbilical.cli.speech import say
from umbilical.cli.targets import PICTURES, check_target

Kind = Literal["overview", "tip", "positions", "cable", "motors", "observers", "energy"]


def plot(
    file: Annotated[Path, Argument(help="A .nc result.")],
    kind: Annotated[Kind, Option("--kind", help="What to draw.")] = "overview",
    out: Annotated[Path | None, Option("--out", metavar="FILE", help="A .png, .pdf or .svg.")] = None,
    force: Annotated[bool, Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Draw a result. Without --out the picture is a .png beside the result.

    \b
    examples
      umbilical plot paper.nc
      umbilical plot paper.nc --kind cable --out cable.pdf
    """
    from umbilical.plots import PLOTS, as_figure, save_figure
    from umbilical.run import open_run

    target = out or file.with_name(f"{file.stem}-{kind}.png")
    run = open_run(file)
    check_target(target, PICTURES, force=force)
    try:
        figure = as_figure(PLOTS[kind](run))
    except ValueError as error:
        raise BadParameter(str(error), param_hint="--kind") from error
    say(f"plot: {save_figure(figure, target, force=force)}")

"""``umbilical plot``."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from typer import Argument, BadParameter, Option

from umbilical.cli.speech import say
from umbilical.cli.targets import PICTURES, check_target

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Kind = Literal[
    "overview", "tip", "positions", "cable", "motors", "observers", "energy",
    "distribution", "comparison", "map", "sensitivity",
]  # fmt: skip


def plot(
    file: Annotated[Path, Argument(help="A .nc result, of a run or of a study.")],
    kind: Annotated[Kind, Option("--kind", help="What to draw; the last four of studies.")] = "overview",
    metric: Annotated[str | None, Option("--metric", metavar="NAME", help="Of a study: what to draw it of.")] = None,
    out: Annotated[Path | None, Option("--out", metavar="FILE", help="A .png, .pdf or .svg.")] = None,
    force: Annotated[bool, Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Draw a result. Without --out the picture is a .png beside the result.

    \b
    examples
      umbilical plot paper.nc
      umbilical plot paper.nc --kind cable --out cable.pdf
      umbilical plot robust/study.nc --kind distribution --metric mid_rms
    """
    from umbilical.plots import as_figure, save_figure

    target = out or file.with_name(f"{file.stem}-{kind}.png")
    draw = _picture(file, kind, metric)
    check_target(target, PICTURES, force=force)
    try:
        figure = as_figure(draw())
    except ValueError as error:
        raise BadParameter(str(error), param_hint="--kind") from error
    say(f"plot: {save_figure(figure, target, force=force)}")


def _picture(file: Path, kind: Kind, metric: str | None) -> Callable[[], Axes | Figure]:
    """What draws the picture, of a run or of a study."""
    from umbilical.plots import PLOTS, STUDY_PLOTS
    from umbilical.run import open_run
    from umbilical.studies.load import is_study
    from umbilical.studies.results import open_study

    study = is_study(str(file))
    pictures: dict[str, Any] = STUDY_PLOTS if study else PLOTS
    if kind not in pictures:
        raise BadParameter(f"of a {'study' if study else 'run'} there are {', '.join(pictures)}", param_hint="--kind")
    if not study:
        return partial(pictures[kind], open_run(file))
    result = open_study(file)
    if metric is not None and metric not in result.metrics:
        raise BadParameter(f"there are {', '.join(result.metrics)}", param_hint="--metric")
    return partial(pictures[kind], result, *filter(None, [metric]))

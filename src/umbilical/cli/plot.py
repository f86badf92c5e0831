"""``umbilical plot``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from typer import Argument, BadParameter, Option

from umbilical.cli.options import Force
from umbilical.cli.output import print_result
from umbilical.cli.targets import PICTURES, check_target

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Kind = Literal[
    "overview", "tip", "positions", "cable", "winch", "motors", "observers", "energy", "shape", "tension", "snaps",
    "watch", "distribution", "comparison", "map", "sensitivity",
]  # fmt: skip


def plot_command(
    file: Annotated[Path, Argument(help="A .nc result, of a run or of a study.")],
    kind: Annotated[
        Kind, Option("--kind", help="What to draw; shape, tension, snaps, watch of a rope; the last four of studies.")
    ] = "overview",
    metric: Annotated[str | None, Option("--metric", metavar="NAME", help="Of a study: what to draw it of.")] = None,
    x: Annotated[str | None, Option("--x", metavar="DRAW", help="Of a map: what is drawn, to the right.")] = None,
    y: Annotated[str | None, Option("--y", metavar="DRAW", help="Of a map: what is drawn, upwards.")] = None,
    arm: Annotated[str | None, Option("--arm", metavar="NAME", help="Of a map or a sensitivity: which arm.")] = None,
    out: Annotated[Path | None, Option("--out", metavar="FILE", help="A .png, .pdf or .svg.")] = None,
    force: Force = False,
) -> None:
    """Draw a result. Without --out the picture is a .png beside the result.

    \b
    examples
      umbilical plot paper.nc
      umbilical plot paper.nc --kind cable --out cable.pdf
      umbilical plot robust/study.nc --kind distribution --metric mid_rms
      umbilical plot robust/study.nc --kind map --x fault.start --y fault.kind --arm proposed
    """
    from umbilical.plots import as_figure, save_figure

    target = out or file.with_name(f"{file.stem}-{kind}.png")
    draw = _picture(file, kind, metric, {"x": x, "y": y, "arm": arm})
    check_target(target, PICTURES, force=force)
    try:
        figure = as_figure(draw())
    except ValueError as error:
        raise BadParameter(str(error), param_hint="--kind") from error
    print_result(f"plot: {save_figure(figure, target, force=force)}")


_CHOOSES = {"map": ("x", "y", "arm"), "sensitivity": ("arm",)}
"""What can be chosen of a picture, beside its metric."""


def _picture(
    file: Path, kind: Kind, metric: str | None, options: Mapping[str, str | None]
) -> Callable[[], Axes | Figure]:
    """What draws the picture, of a run or of a study."""
    from umbilical.plots import PLOTS, ROPE_PLOTS, STUDY_PLOTS
    from umbilical.stored_runs import open_run
    from umbilical.studies.load import is_study

    study = is_study(str(file))
    pictures: dict[str, Any] = STUDY_PLOTS if study else PLOTS | ROPE_PLOTS
    if kind not in pictures:
        raise BadParameter(f"of a {'study' if study else 'run'} there are {', '.join(pictures)}", param_hint="--kind")
    chosen = {name: value for name, value in options.items() if value is not None}
    if senseless := [name for name in chosen if name not in _CHOOSES.get(kind, ())]:
        kinds = " and ".join(name for name, known in _CHOOSES.items() if senseless[0] in known)
        raise BadParameter(f"only for --kind {kinds}", param_hint=f"--{senseless[0]}")
    return partial(pictures[kind], *(_of_study(file, metric, chosen) if study else (open_run(file),)), **chosen)


def _of_study(file: Path, metric: str | None, chosen: Mapping[str, str]) -> tuple[Any, ...]:
    """The result and the metric that is drawn, if one was named."""
    from umbilical.plots.study_map import USUAL
    from umbilical.studies.results import open_study

    result = open_study(file)
    if (metric or USUAL) not in result.metrics:
        there = f"there are {', '.join(result.metrics)}" if result.metrics else "no member completed"
        raise BadParameter(there, param_hint="--metric")
    if (arm := chosen.get("arm")) is not None and arm not in result.arms:
        raise BadParameter(f"there are the arms {', '.join(result.arms)}", param_hint="--arm")
    return (result, *filter(None, [metric]))

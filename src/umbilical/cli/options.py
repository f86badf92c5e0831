"""Arguments and options that several commands have, each declared once, and what their words mean."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

from typer import Argument, BadParameter, Context, Option

from umbilical.cli.targets import PICTURES, check_target

_PACKAGE = Path(__file__).parents[1]


def source(words: str, *rooms: str) -> Any:
    """An argument of which the Tab key offers the presets of these rooms: ``scenario``, ``studies``, ``screening``."""

    def offered(incomplete: str) -> list[str]:
        found = (path.stem for room in rooms for path in (_PACKAGE / room / "presets").glob("*.toml"))
        return sorted(name for name in found if name.startswith(incomplete))

    return Argument(autocompletion=offered, help=words)


def free(*kinds: str) -> Callable[[Context, Path | None], Path | None]:
    """A check that a file with one of these endings could be written, before the work; what forces it is eager."""

    def checked(context: Context, path: Path | None) -> Path | None:
        check_target(path, kinds, force=any(context.params.get(name) for name in ("force", "resume")))
        return path

    return checked


Source = Annotated[str, source("A preset's name, a .toml file, or a .nc result.", "scenario")]
Changes = Annotated[list[str] | None, Option("--set", metavar="KEY=VALUE", help="Change one value; may be repeated.")]
Plot = Annotated[
    Path | None, Option("--plot", metavar="FILE", help="Draw it: .png, .pdf or .svg.", callback=free(*PICTURES))
]
ScenarioOut = Annotated[
    Path | None, Option("--out", metavar="FILE.toml", help="Store the new scenario.", callback=free("toml"))
]
Json = Annotated[bool, Option("--json", help="Print one JSON object instead of text.")]
Force = Annotated[bool, Option("--force", is_eager=True, help="Replace existing files.")]
Anew = Annotated[bool, Option("--force", is_eager=True, help="Begin anew, and remove what is in the folder.")]
"""``--force`` of a command whose result is a folder that it can also go on with."""
Jobs = Annotated[int | None, Option("--jobs", metavar="N", min=1, max=4096, help="Members at once; all cores.")]
Resume = Annotated[bool, Option("--resume", is_eager=True, help="Go on with what is in the folder.")]
Trust = Annotated[
    bool, Option("--trust", help="Import the Python controllers that the study names, which runs their code.")
]
Own = Annotated[
    str | None,
    Option(
        "--controller",
        metavar="MODULE:CLASS",
        help="A controller of your own in place of the scenario's; it is imported, which runs its code.",
    ),
]
Thrust = Annotated[float | None, Option("--operating-thrust", metavar="N", help="Where the motors are linearised, N.")]


def within(number: float, option: str, low: float, high: float) -> float:
    """The number itself; BadParameter if it is not within the bounds."""
    if not low <= number <= high:
        raise BadParameter(f"{number:g}: from {low:g} to {high:g}", param_hint=f"'{option}'")
    return number


def number_list(
    words: str | None, option: str, *, above: float = -math.inf, what: str = "numbers such as 300,400"
) -> list[float]:
    """Comma-separated finite numbers; none where the option was not given.

    Raises:
        BadParameter: something between the commas is no number, or none above the bound.
    """
    try:
        found = [] if words is None else [float(word) for word in words.split(",")]
    except ValueError:
        found = [math.nan]
    if not all(above < number < math.inf for number in found):
        raise BadParameter(f"'{words}' is not a list of {what}", param_hint=option)
    return found

"""Options that several commands have, each declared once."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

from typer import Argument, BadParameter, Option


def presets_like(incomplete: str) -> list[str]:
    """Names of scenarios that begin so: what the Tab key offers."""
    from umbilical.library import preset_names

    return [name for name in preset_names() if name.startswith(incomplete)]


Source = Annotated[str, Argument(autocompletion=presets_like, help="A preset's name, a .toml file, or a .nc result.")]

Changes = Annotated[list[str] | None, Option("--set", metavar="KEY=VALUE", help="Change one value; may be repeated.")]
Plot = Annotated[Path | None, Option("--plot", metavar="FILE", help="Draw it: .png, .pdf or .svg.")]
Json = Annotated[bool, Option("--json", help="Print one JSON object instead of text.")]
Force = Annotated[bool, Option("--force", help="Replace existing files.")]
Anew = Annotated[bool, Option("--force", help="Begin anew, and remove what is in the folder.")]
"""``--force`` of a command whose result is a folder that it can also go on with."""
Jobs = Annotated[int | None, Option("--jobs", metavar="N", min=1, max=4096, help="Members at once; all cores.")]
Resume = Annotated[bool, Option("--resume", help="Go on with what is in the folder.")]
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

"""Options that several commands have, each declared once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Option

Changes = Annotated[list[str] | None, Option("--set", metavar="KEY=VALUE", help="Change one value; may be repeated.")]
Plot = Annotated[Path | None, Option("--plot", metavar="FILE", help="Draw it: .png, .pdf or .svg.")]
Json = Annotated[bool, Option("--json", help="Print one JSON object instead of text.")]
Force = Annotated[bool, Option("--force", help="Replace existing files.")]
Anew = Annotated[bool, Option("--force", help="Begin anew, and remove what is in the folder.")]
"""``--force`` of a command whose result is a folder that it can also go on with."""
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

"""``umbilical design``."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from typer import Argument, BadParameter, Option

from umbilical.cli.conclusion import conclude
from umbilical.cli.options import Changes, Force, Json, Plot, Thrust
from umbilical.cli.progress import announce_compilation, bar
from umbilical.cli.running import load_changed
from umbilical.cli.targets import PICTURES, check_target
from umbilical.faces.design import conclusion, document, text

if TYPE_CHECKING:
    from umbilical.design.design import Design
    from umbilical.design.rounds import Limits

Objective = Literal["ringdown", "rejection", "both"]


def design(
    scenario: Annotated[str, Argument(help="A preset's name, a .toml file, or a .nc result.")],
    changes: Changes = None,
    objective: Annotated[Objective, Option("--objective", help="What the gains shall serve.")] = "both",
    inner: Annotated[bool, Option("--inner", help="Choose the motor loops' gains, too.")] = False,
    periods: Annotated[
        str | None, Option("--periods", metavar="S,...", help="Control periods to choose among, s; a search each.")
    ] = None,
    gain: Annotated[float, Option("--gain-margin", metavar="DB", help="Both ways, dB.")] = 6.0,
    phase: Annotated[float, Option("--phase-margin", metavar="DEG", help="Both ways, degrees.")] = 30.0,
    delay: Annotated[float, Option("--delay-margin", metavar="N", help="In control periods.")] = 2.0,
    limits: Annotated[
        str | None,
        Option("--limits", metavar="NAME=VALUE,...", help="voltage (V), speed (rad/s), chatter (V), noise (V)."),
    ] = None,
    operating_thrust: Thrust = None,
    out: Annotated[Path | None, Option("--out", metavar="FILE.toml", help="Store the new scenario.")] = None,
    plot: Plot = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Choose gains for the thrusters a scenario has, with margins, and try them in a simulation.

    \b
    examples
      umbilical design ringdown --inner --plot design.png
      umbilical design paper --objective rejection --limits voltage=40,chatter=0.05
      umbilical design my.toml --inner --periods 0.0005,0.001,0.002 --out tuned.toml

    Exit code 7: some margin or limit is not kept; what was found is told all the same.
    """
    chosen = load_changed(scenario, changes or [])
    if out:
        check_target(out, ("toml",), force=force)
    if plot:
        check_target(plot, PICTURES, force=force)
    from umbilical.design.design import design as compute
    from umbilical.design.score import Demands

    if not 0.0 <= gain <= 100.0 or not 0.0 <= phase < 90.0 or not 0.0 <= delay <= 1000.0:
        raise BadParameter("margins are 0 to 100 dB, 0 to 90 degrees and 0 to 1000 periods", param_hint="--*-margin")
    demands = Demands(10.0 ** (gain / 20.0), math.radians(phase), delay)
    announce_compilation()
    with bar("designing") as advance:
        found = compute(
            chosen, objective, inner=inner, periods=_periods(periods), demands=demands, limits=_limits(limits),
            operating_thrust=operating_thrust, progress=advance,
        )  # fmt: skip
    files = _write(found, out, plot, force)
    return conclude(
        conclusion(found), text=lambda: text(found), document=lambda: document(found), files=files, as_json=as_json
    )


def _periods(words: str | None) -> list[float]:
    """``0.001,0.002`` as periods, s.

    Raises:
        BadParameter: not positive numbers.
    """
    try:
        found = [float(word) for word in words.split(",")] if words else []
    except ValueError:
        found = [-1.0]
    if not all(0.0 < period < math.inf for period in found):
        raise BadParameter(f"'{words}' are not times above 0 s, with commas between them", param_hint="--periods")
    return found


def _limits(words: str | None) -> Limits:
    """``voltage=40,chatter=0.05`` as limits.

    Raises:
        BadParameter: another name, or not a positive number.
    """
    from umbilical.design.rounds import Limits

    given = {}
    for word in words.split(",") if words else []:
        name, _, value = word.partition("=")
        try:
            given[name] = float(value)
        except ValueError:
            given[name] = -1.0
        if name not in ("voltage", "speed", "chatter", "noise") or not given[name] > 0.0:
            raise BadParameter(
                f"'{word}' is not voltage=, speed=, chatter= or noise= and a number above 0", param_hint="--limits"
            )
    return Limits(**given)


def _write(found: Design, out: Path | None, plot: Path | None, force: bool) -> dict[str, str]:
    written = {}
    if out:
        from umbilical import files

        text_ = found.after.scenario.to_toml()
        written["scenario"] = str(files.write(out, text_.encode(), force=force))
    if plot:
        from umbilical.plots import plot_design, save_figure

        written["plot"] = str(save_figure(plot_design(found), plot, force=force))
    return written

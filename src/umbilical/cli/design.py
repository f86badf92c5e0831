"""``umbilical design``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from typer import BadParameter, Option

from umbilical.cli.loading import load_scenario
from umbilical.cli.options import Changes, Force, Json, Plot, ScenarioOut, Source, Thrust, number_list
from umbilical.cli.output import conclude
from umbilical.cli.progress import announce_compilation, bar
from umbilical.cli.targets import draw_files, write_scenario

if TYPE_CHECKING:
    from umbilical.synthesis.iterate import Limits

Objective = Literal["ringdown", "rejection", "both"]


def design_command(
    scenario: Source,
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
    out: ScenarioOut = None,
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
    from umbilical.synthesis.design import design
    from umbilical.synthesis.score import Demands

    chosen = load_scenario(scenario, changes)
    if not 0.0 <= gain <= 100.0 or not 0.0 <= phase < 90.0 or not 0.0 <= delay <= 1000.0:
        raise BadParameter("margins are 0 to 100 dB, 0 to 90 degrees and 0 to 1000 periods", param_hint="--*-margin")
    demands = Demands(10.0 ** (gain / 20.0), math.radians(phase), delay)
    choice = number_list(periods, "--periods", above=0.0, what="times above 0 s, such as 0.0005,0.001")
    announce_compilation()
    with bar("designing") as advance:
        found = design(
            chosen, objective, inner=inner, periods=choice, demands=demands, limits=_limits(limits),
            operating_thrust=operating_thrust, progress=advance,
        )  # fmt: skip
    written = write_scenario(out, found.after.scenario.to_toml(), force=force) if out else {}
    return conclude(found, files=written | draw_files(found.plot, plot, force=force), as_json=as_json)


def _limits(words: str | None) -> Limits:
    """``voltage=40,chatter=0.05`` as limits.

    Raises:
        BadParameter: another name, or not a positive number.
    """
    from umbilical.synthesis.iterate import Limits

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

"""``umbilical margins``."""

from __future__ import annotations

from typing import Annotated

from typer import Option

from umbilical.cli.loading import load_scenario, own_controller
from umbilical.cli.options import Changes, Force, Json, Own, Plot, Source, Thrust, number_list
from umbilical.cli.output import conclude, report
from umbilical.cli.progress import bar
from umbilical.cli.targets import draw_files

GRIDS, FINEST = (32, 64, 128), 256
"""Elements of the grids that are asked where none are named, and of the last one where those do not agree."""


def margins_command(
    scenario: Source,
    changes: Changes = None,
    lengths: Annotated[
        str | None, Option("--lengths", metavar="L1,L2,...", help="Cable lengths, m; default those of the run.")
    ] = None,
    operating_thrust: Thrust = None,
    grid: Annotated[
        str | None,
        Option(
            "--grid", metavar="N1,N2,N3", help="Elements of the grids to ask, 0 for none; 32,64,128, if need be 256."
        ),
    ] = None,
    controller: Own = None,
    plot: Plot = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Stability and margins of the sampled loop with its motors, from the exact cable.

    \b
    examples
      umbilical margins paper
      umbilical margins ringdown --set control.law.slope_gain=5  # exit code 7
      umbilical margins paper --lengths 100,300,500 --plot margins.png
      umbilical margins ringdown --set control.law.slope_gain=20 --grid 25,100,400  # exit code 7
      umbilical margins paper --controller my_module:MyLaw --grid 0

    Gain, phase and delay margins are for the loop opened at the thrusters. A controller of your own is linearised
    about the ROV at rest below the vessel by differences of its update, and held against it. Exit code 7: not stable
    at every length, or unresolved: exact cable, grids and eigenvalues do not say the same, or a controller does not do
    what its linearisation does.
    """
    from umbilical.stability.margins import margins

    chosen = load_scenario(scenario, changes, controller)

    elements = GRIDS if grid is None else [round(number) for number in number_list(grid, "--grid") if number]
    finest = FINEST if grid is None else 0
    own = own_controller(controller, chosen)
    with bar("margins") as advance:
        found = margins(
            chosen,
            number_list(lengths, "--lengths") or None,
            operating_thrust,
            controller=own,
            elements=elements,
            finest=finest,
            progress=advance,
        )
    if plot and found.doubt:
        report(f"{plot}: not drawn, there are no margins to draw")
        plot = None
    return conclude(found, files=draw_files(found.plot, plot, force=force), as_json=as_json)

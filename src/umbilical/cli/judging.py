"""``umbilical margins``."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, BadParameter, Option

from umbilical.cli.conclusion import conclude
from umbilical.cli.options import Changes, Force, Json, Own, Plot, Thrust
from umbilical.cli.progress import bar
from umbilical.cli.running import load_changed, own_controller
from umbilical.cli.speech import tell
from umbilical.cli.targets import PICTURES, check_target
from umbilical.faces.margins import conclusion, document, text

if TYPE_CHECKING:
    from umbilical.design.margins import MarginReport

GRIDS, FINEST = (32, 64, 128), 256
"""Elements of the grids that are asked where none are named, and of the last one where those do not agree."""


def margins(
    scenario: Annotated[str, Argument(help="A preset's name, a .toml file, or a .nc result.")],
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
      umbilical margins ringdown --set control.law.slope_gain=5
      umbilical margins paper --lengths 100,300,500 --plot margins.png
      umbilical margins ringdown --set control.law.slope_gain=20 --grid 25,100,400
      umbilical margins paper --controller my_module:MyLaw

    Gain, phase and delay margins are for the loop opened at the thrusters. A controller of your own is linearised
    about the ROV at rest below the vessel by differences of its update, and held against it. Exit code 7: not stable
    at every length, or unresolved: exact cable, grids and eigenvalues do not say the same, or a controller does not do
    what its linearisation does.
    """
    chosen = load_changed(scenario, changes or [])
    if plot:
        check_target(plot, PICTURES, force=force)
    from umbilical.design.margins import margins as compute

    elements = GRIDS if grid is None else [round(number) for number in _numbers(grid, "--grid") or [] if number]
    finest = FINEST if grid is None else 0
    own = own_controller(controller, chosen)
    with bar("margins") as advance:
        report = compute(
            chosen,
            _numbers(lengths),
            operating_thrust,
            controller=own,
            elements=elements,
            finest=finest,
            progress=advance,
        )
    files = _draw(report, plot, force)
    return conclude(
        conclusion(report), text=lambda: text(report), document=lambda: document(report), files=files, as_json=as_json
    )


def _numbers(words: str | None, option: str = "--lengths") -> list[float] | None:
    """Comma-separated numbers.

    Raises:
        BadParameter: something between the commas is not a finite number.
    """
    if words is None:
        return None
    try:
        found = [float(word) for word in words.split(",")]
    except ValueError:
        found = [math.nan]
    if not all(map(math.isfinite, found)):
        raise BadParameter(f"'{words}' is not a list of numbers such as 300,400", param_hint=option)
    return found


def _draw(report: MarginReport, plot: Path | None, force: bool) -> dict[str, str]:
    if not plot:
        return {}
    if report.doubt:
        tell(f"{plot}: not drawn, there are no margins to draw")
        return {}
    from umbilical.plots import plot_margins, save_figure

    return {"plot": str(save_figure(plot_margins(report), plot, force=force))}

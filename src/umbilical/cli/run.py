"""``umbilical run``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from umbilical.cli.loading import load_scenario, own_controller
from umbilical.cli.options import Changes, Force, Json, Own, Plot, free, source
from umbilical.cli.output import print_json, print_result, report
from umbilical.cli.targets import draw_files
from umbilical.errors import OutputError

if TYPE_CHECKING:
    from umbilical.run import Run
    from umbilical.scenario import Scenario


def run_command(
    scenario: Annotated[str, source("A preset's name, a .toml file, or a .nc result to run again.", "scenario")],
    changes: Changes = None,
    out: Annotated[
        Path | None, Option("--out", metavar="FILE.nc", help="Store the result (NetCDF4).", callback=free("nc"))
    ] = None,
    plot: Plot = None,
    controller: Own = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Simulate a scenario. Without --out nothing is stored.

    \b
    examples
      umbilical run paper
      umbilical run my.toml --out my.nc --plot my.png
      umbilical run paper --set control.law.slope_gain=5 --set motors.2.voltage_limit=8
      umbilical run my.nc --json
      umbilical run paper --controller my_module:MyLaw

    Lists are numbered from 1. A diverged or interrupted run is stored and drawn as far as it went.
    """
    chosen = load_scenario(scenario, changes, controller)
    if out:
        _check_size(chosen, out)
    from umbilical.cli.progress import simulate_visibly
    from umbilical.plant.checks.statics import statics

    found = statics(chosen)
    if found and found.slope:
        report(f"{chosen.name}: {found}")
    result = simulate_visibly(chosen, own_controller(controller, chosen))
    if controller:
        result.with_controller(controller)
    files = _write(result, out, plot, force)
    if as_json:
        known = {"files": files, "controller": result.controller or None, "statics": found and found._asdict()}
        print_json(result.to_dict() | known)
    else:
        print_result(_report(result, files, scenario))
    return result.status.exit_code


def _check_size(scenario: Scenario, out: Path) -> None:
    """Say before a long run what its result takes; OutputError if the disk has not the room."""
    from umbilical.machine import in_words, room
    from umbilical.plant.checks.sizes import LARGE, result_size

    if (size := result_size(scenario)) > (left := room(out.parent)):
        raise OutputError(f"{out}: the result takes {in_words(size)}, and the disk has {in_words(left)} left")
    if size >= LARGE:
        report(f"{out}: the result will take {in_words(size)}")


def _write(run: Run, out: Path | None, plot: Path | None, force: bool) -> dict[str, str]:
    """Store and draw what was asked for; the files by role."""
    files = {"result": str(run.save(out, force=force))} if out else {}
    if plot and run["time"].size < 2:
        report(f"{plot}: not drawn, the run ended before there was anything to draw")
        return files
    return files | draw_files(run.plot, plot, force=force)


def _report(run: Run, files: dict[str, str], scenario: str) -> str:
    lines = [run.summary()]
    if run.controller:
        lines.append(f"  controller: {run.controller} in place of the scenario's own; the result holds its name only")
    if count := len(run.scenario.assumed):
        lines.append(f"  assumed: {count} entries that no source gives; `umbilical show {scenario}` lists them")
    lines += [f"  {role}: {path}" for role, path in files.items()]
    if "result" not in files:
        lines.append("  nothing was stored; --out FILE.nc keeps the result")
    return "\n".join(lines)

"""``umbilical run``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, Option

from umbilical.cli.options import Changes, Force, Json, Own, Plot, presets_like
from umbilical.cli.output import print_json, print_result, report
from umbilical.cli.targets import PICTURES, check_target, draw_files
from umbilical.errors import FileError, OutputError, Problem, ScenarioError

if TYPE_CHECKING:
    from umbilical.control.contract import Controller
    from umbilical.run import Run
    from umbilical.scenario import Scenario


def run(
    scenario: Annotated[
        str, Argument(autocompletion=presets_like, help="A preset's name, a .toml file, or a .nc result to run again.")
    ],
    changes: Changes = None,
    out: Annotated[Path | None, Option("--out", metavar="FILE.nc", help="Store the result (NetCDF4).")] = None,
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
    chosen = load_changed(scenario, changes or [], controller)
    check_target(out, ("nc",), force=force)
    check_target(plot, PICTURES, force=force)
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

    if (size := result_size(scenario)) > (free := room(out.parent)):
        raise OutputError(f"{out}: the result takes {in_words(size)}, and the disk has {in_words(free)} left")
    if size >= LARGE:
        report(f"{out}: the result will take {in_words(size)}")


def own_controller(name: str | None, scenario: Scenario) -> Controller | None:
    """The controller that ``--controller`` names, tried; None where it is not given.

    Raises:
        ScenarioError: there is none, or it fails at once.
    """
    if name is None:
        return None
    from umbilical.studies.controllers import named_controller

    return named_controller(name, scenario)


def load_changed(source: str, changes: Sequence[str], controller: str | None = None) -> Scenario:
    """A scenario with ``key=value`` changes.

    Of a result that another controller made it says so, unless a ``controller`` is given.

    Raises:
        FileError: there is no such scenario.
        ScenarioError: with every problem of the changes and of what they make of the scenario.
    """
    from umbilical.library import load
    from umbilical.scenario.document import assignment

    found: dict[str, Any] = {}
    problems: list[Problem] = []
    for text in changes:
        try:
            key, value = assignment(text)
            found[key] = value
        except ScenarioError as error:
            problems += error.problems
    try:
        scenario = load(source, found)
    except FileError:
        _refuse_operation(source)
        raise
    except ScenarioError as error:
        _refuse_operation(source)
        raise ScenarioError([*problems, *error.problems], error.origin) from error
    if problems:
        raise ScenarioError(problems, source)
    if Path(source).suffix == ".nc" and not controller:
        _report_other_controller(source)
    return scenario


def _refuse_operation(source: str) -> None:
    """Say where an operation belongs, rather than which keys of a scenario it lacks."""
    from umbilical.screening.load import is_operation

    if is_operation(source):
        raise FileError(f"{source}: this is an operation; `umbilical operate`, `lower` and `show` take it")


def _report_other_controller(source: str) -> None:
    from umbilical.stored_runs import controller_name

    if name := controller_name(source):
        report(f"{source}: this run had the controller {name}; what follows is about the scenario's own controller")


def _write(run: Run, out: Path | None, plot: Path | None, force: bool) -> dict[str, str]:
    """Store and draw what was asked for; the files by role."""
    files = {}
    if out:
        files["result"] = str(run.save(out, force=force))
    if plot and run["time"].size < 2:
        report(f"{plot}: not drawn, the run ended before there was anything to draw")
        return files
    return files | draw_files(run.plot, plot, force=force)


def _report(run: Run, files: dict[str, str], source: str) -> str:
    lines = [run.summary()]
    if run.controller:
        lines.append(f"  controller: {run.controller} in place of the scenario's own; the result holds its name only")
    if run.scenario.assumed:
        count = len(run.scenario.assumed)
        lines.append(f"  assumed: {count} entries that no source gives; `umbilical show {source}` lists them")
    lines += [f"  {role}: {path}" for role, path in files.items()]
    if "result" not in files:
        lines.append("  nothing was stored; --out FILE.nc keeps the result")
    return "\n".join(lines)

"""``umbilical show`` and ``compare``: what is read from scenarios and results."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, BadParameter, Option

from umbilical.cli.options import Json, source
from umbilical.cli.output import conclude, print_json, print_result
from umbilical.tables import text_table, wrapped

if TYPE_CHECKING:
    from umbilical.scenario import Scenario
    from umbilical.screening import Operation

_ORIGIN = ("scenario_hash", "seed", "version_umbilical", "version_numpy", "version_numba", "version_python")


def show_command(
    file: Annotated[
        str,
        source(
            "A .nc result, a .toml scenario, study or operation, or a preset's name.",
            "scenario",
            "studies",
            "screening",
        ),
    ],
    metric: Annotated[
        list[str] | None, Option("--metric", metavar="NAME", help="Of a study: show this one; may be repeated.")
    ] = None,
    sensitivity: Annotated[
        str | None, Option("--sensitivity", metavar="METRIC", help="Of a study: which draws matter for it.")
    ] = None,
    against: Annotated[
        str | None, Option("--against", metavar="ARM", help="Of a study: compare with this arm; the first if left out.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Show a result's metrics, what a study found, or the values of a scenario or operation and what is assumed.

    \b
    examples
      umbilical show paper
      umbilical show work-class
      umbilical show paper.nc
      umbilical show robust/study.nc --metric tip_peak --sensitivity tip_peak
    """
    from umbilical.library import preset_names
    from umbilical.screening.load import is_operation
    from umbilical.studies.load import is_study

    if is_study(file):
        _show_study(file, tuple(metric or ()), sensitivity, against, as_json)
    elif metric or sensitivity or against:
        raise BadParameter("only the result of a study has distributions", param_hint="--metric")
    elif Path(file).suffix == ".nc":
        _show_run(file, as_json)
    elif file not in preset_names() and is_operation(file):
        _show_operation(file, as_json)
    else:
        _show_scenario(file, as_json)


def _show_study(
    file: str, metrics: tuple[str, ...], sensitivity: str | None, against: str | None, as_json: bool
) -> None:
    from umbilical.faces import study as study_face
    from umbilical.studies.load import load_study
    from umbilical.studies.results import open_study

    if Path(file).suffix != ".nc":
        study = load_study(file)
        document = {"study": study.to_dict(), "study_hash": study.hash}
        print_json(document) if as_json else print_result(study_face.describe(study))
        return
    result = open_study(file)
    if unknown := [name for name in (*metrics, *filter(None, [sensitivity])) if name not in result.metrics]:
        there = f"there are {', '.join(result.metrics)}" if result.metrics else study_face.NONE_COMPLETED
        raise BadParameter(f"{unknown[0]} is not there; {there}", param_hint="--metric")
    if against is not None and against not in result.arms:
        raise BadParameter(f"there are the arms {', '.join(result.arms)}", param_hint="--against")
    conclude(result, metrics, against, sensitivity, files={"result": file} if as_json else None, as_json=as_json)


def _show_run(file: str, as_json: bool) -> None:
    from umbilical.stored_runs import open_run

    run = open_run(file)
    if as_json:
        print_json(run.to_dict() | {"files": {"result": file}})
        return
    sizes = ", ".join(f"{name} {size}" for name, size in run.data.sizes.items())
    origin = text_table([(name, str(run.data.attrs[name])) for name in _ORIGIN])
    print_result(f"{run.summary()}\n\nholds: {sizes}\n{origin}")


def _show_scenario(source: str, as_json: bool) -> None:
    from umbilical.library import admit, load
    from umbilical.plant.checks.statics import statics

    scenario = load(source)
    notices = [str(notice) for notice in admit(scenario)]
    found = statics(scenario)
    if as_json:
        known = {"statics": found and found._asdict(), "notices": notices}
        print_json({"scenario": scenario.to_dict(), "scenario_hash": scenario.hash, **known})
    else:
        told = f"before the first step: {found}" if found else ""
        print_result("\n\n".join([_inventory(scenario, told), *(f"note: {notice}" for notice in notices)]))


def _show_operation(source: str, as_json: bool) -> None:
    from umbilical.screening import load_operation

    operation = load_operation(source)
    if as_json:
        print_json({"operation": operation.to_dict(), "operation_hash": operation.hash})
    else:
        print_result(_inventory(operation))


def _inventory(whole: Scenario | Operation, told: str = "") -> str:
    """Every value with its unit and meaning, and what is assumed."""
    from umbilical.scenario.inventory import inventory

    entries = [
        (e.key, _shortened(e.value), e.unit, "assumed" if e.assumed else "", e.meaning)
        for e in inventory(whole, whole.assumed)
    ]
    parts = [f"{whole.name}, {whole.hash[:12]}", wrapped(whole.description), told, text_table(entries)]
    if whole.assumed:
        parts += ["assumed, because no source gives them:", text_table(list(whole.assumed.items()))]
    return "\n\n".join(filter(None, parts))


_LONGEST = 48
"""Characters of the longest value in a table of a scenario; --json has all of it."""


def _shortened(value: str) -> str:
    """A value as one cell: of a long one its beginning and how long it is."""
    if len(value) <= _LONGEST:
        return value
    entries = f" ({value.count(',') + 1} entries)" if value.startswith("[") else f" ({len(value)} characters)"
    return f"{value[: _LONGEST - 20]}...{entries}"


def compare_command(
    files: Annotated[list[Path], Argument(help="Two or more .nc results; ratios are to the first.")],
    as_json: Json = False,
) -> None:
    """Compare the metrics of results, side by side with ratios.

    \b
    example
      umbilical compare free.nc my.nc paper.nc
    """
    from umbilical.analysis.comparison import compare
    from umbilical.stored_runs import open_run

    if len(files) < 2:
        raise BadParameter("two or more results are compared", param_hint="FILES")
    found = compare(*(open_run(file) for file in files), names=[file.stem for file in files])
    if as_json:
        whole = found.face.document(found)
        for run, file in zip(whole["runs"], files, strict=True):
            run["files"] = {"result": str(file)}
        print_json(whole)
    else:
        print_result(found.face.text(found))

"""``umbilical export``: a result for other tools, a controller for other machines."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from typer import BadParameter, Option

from umbilical.cli.loading import load_scenario
from umbilical.cli.options import Changes, Force, source
from umbilical.cli.output import print_result

_RESULTS = ("csv", "mat")


def export_command(
    file: Annotated[str, source("A .nc result; for c and fmu also a .toml scenario or a preset's name.", "scenario")],
    to: Annotated[
        Literal["csv", "mat", "c", "fmu"],
        Option("--to", help="csv: channels over time; mat: every array; c, fmu: the scenario's controller."),
    ],
    out: Annotated[
        Path | None, Option("--out", "-o", metavar="PATH", help="A file; for c a folder. By default named after it.")
    ] = None,
    changes: Changes = None,
    prefix: Annotated[
        str | None, Option("--prefix", metavar="NAME", help="c: what every name begins with; umb_ if left out.")
    ] = None,
    hold: Annotated[
        float | None,
        Option("--hold", metavar="S", help="c, fmu: hold the last command this long without a valid reading, s."),
    ] = None,
    force: Force = False,
) -> None:
    """Write a result for other tools, or a scenario's controller as C99 or as an FMU.

    \b
    examples
      umbilical export paper.nc --to csv
      umbilical export paper.nc --to mat --out for_matlab.mat
      umbilical export paper --to c -o controller --hold 0.05
      umbilical export paper --to fmu
    """
    if to in _RESULTS:
        _refuse_options({"--set": changes, "--prefix": prefix, "--hold": hold}, to)
        _export_result(Path(file), to, out, force)
        return
    scenario = load_scenario(file, changes)
    stem = out or Path(f"{Path(file).stem}-controller" if to == "c" else f"{Path(file).stem}.fmu")
    if to == "c":
        from umbilical.interop.c_code import to_c

        written = to_c(scenario, stem, prefix=prefix or "umb_", hold=hold, force=force)
        print_result(f"export: {stem}: {', '.join(path.name for path in written)}")
    else:
        _refuse_options({"--prefix": prefix}, to)
        from umbilical.interop.fmu import to_fmu

        fmu = to_fmu(scenario, stem, hold=hold, force=force)
        print_result(f"export: {fmu.path}: FMI 2.0 for co-simulation, {fmu.binaries}")


def _export_result(file: Path, to: Literal["csv", "mat"], out: Path | None, force: bool) -> None:
    from umbilical.stored_runs import open_run

    written = open_run(file).export(out or file.with_suffix(f".{to}"), to, force=force)
    print_result(f"export: {written}")


def _refuse_options(given: dict[str, object], to: str) -> None:
    """Refuse options that this kind of file does not know, so that none is silently ignored."""
    if wrong := [name for name, value in given.items() if value is not None]:
        raise BadParameter(f"not with --to {to}", param_hint=wrong[0])

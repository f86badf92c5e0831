"""The controller of a scenario as an FMU: FMI 2.0 for co-simulation, around its C99 sources."""

from __future__ import annotations

import hashlib
import io
import os
import re
import shutil
import subprocess
import tempfile
import uuid
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from xml.sax.saxutils import quoteattr

import umbilical
from umbilical import files
from umbilical.control.contract import MotorDecision, MotorReadings, OuterDecision, TipReadings
from umbilical.errors import OutputError, expect, import_partner
from umbilical.frames import Frame
from umbilical.interop.c_code import c_files, fill_template, head, template
from umbilical.interop.units import base_units
from umbilical.quantities import find
from umbilical.scenario.scenario import Scenario

_HEADERS = ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h")
_SOURCES = ("fmu.c", "umbilical_controller.c")
_LONG_AGO = (1980, 1, 1, 0, 0, 0)
"""The date of everything in the archive: the same scenario gives the same bytes."""


class Fmu(NamedTuple):
    """An FMU that was written: where, and what it can run on without being compiled."""

    path: Path
    binaries: str


class FmiVariable(NamedTuple):
    """A real variable: its name in the FMU, the expression in C, and the quantity that it is."""

    name: str
    expression: str
    quantity: str


def to_fmu(scenario: Scenario, path: str | os.PathLike[str], *, hold: float | None = None, force: bool = False) -> Fmu:
    """Write the controller of a scenario as an FMU: sources, and a binary for this machine if it has a C compiler.

    One step of the co-simulation is one update for each control period in it, on the inputs of its beginning; the
    outputs after it are the commands from its beginning on. So let the controller step before the plant.

    Args:
        scenario: whose ``control`` section is written.
        path: the ``.fmu`` file.
        hold: as for :func:`~umbilical.interop.c_code.to_c`.
        force: replace an existing file.

    Returns:
        The path, and what binaries are in it.

    Raises:
        MissingPartnerError: fmpy, from whose files the headers of FMI are taken, is not installed.
        ScenarioError: as for :func:`~umbilical.interop.c_code.to_c`.
        OutputError: the file cannot be written.

    >>> import tempfile, umbilical
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     to_fmu(umbilical.load("crosscheck-pd"), folder + "/pd.fmu").path.name
    'pd.fmu'
    """
    expect(scenario, "Scenario", "load")
    fmpy = import_partner("fmpy", "to_fmu takes the headers of FMI from fmpy: pip install 'umbilical[fmi]'")
    target = Path(path)
    if target.suffix.lower() != ".fmu":
        raise OutputError(f"{target}: the name must end with .fmu")
    files.check_free(target, force=force)
    content = _content(scenario, hold, Path(fmpy.__file__).parent / "c-code")
    binary, values = _compiled(content, _identifier(scenario), fmpy)
    return Fmu(files.write(target, _packed({**content, **binary}), force=force), values)


def _content(scenario: Scenario, hold: float | None, headers: Path) -> dict[str, str]:
    """Texts by their places in the archive."""
    texts = c_files(scenario, hold=hold)
    controller = {name: texts[name] for name in ("umbilical_controller.h", "umbilical_controller.c")}
    guid = _guid([*controller.values(), *_own_files(scenario, "").values()])
    own = _own_files(scenario, guid)
    sources = controller | {"fmu.c": own["fmu.c"]}
    sources |= {name: (headers / name).read_text(encoding="utf-8") for name in _HEADERS}
    return {
        "modelDescription.xml": own["modelDescription.xml"],
        "documentation/README.txt": template("fmu.txt"),
        **{f"sources/{name}": text for name, text in sources.items()},
    }


def _own_files(scenario: Scenario, guid: str) -> dict[str, str]:
    """What makes an FMU of the controller."""
    inputs, outputs = _inputs(scenario), _outputs(scenario)
    cases = (f"    case {k}: return &m->{v.expression};" for k, v in enumerate([*inputs, *outputs]))
    values = {"GUID": guid, "HEAD": head(scenario), "INPUTS": str(len(inputs)), "REALS": "\n".join(cases)}
    values |= _description(scenario, inputs, outputs)
    return {name: fill_template(template(name), values) for name in ("fmu.c", "modelDescription.xml")}


def _guid(texts: Sequence[str]) -> str:
    """A name for these texts, which others do not have."""
    return f"{{{uuid.uuid5(uuid.NAMESPACE_OID, hashlib.sha256(''.join(texts).encode()).hexdigest())}}}"


def _identifier(scenario: Scenario) -> str:
    """A name that C, file systems and simulators take."""
    return "umbilical_" + re.sub(r"\W", "_", scenario.name, flags=re.ASCII)


def _inputs(scenario: Scenario) -> list[FmiVariable]:
    ideal = scenario.control.law.reads_rates
    tip = [name for name in TipReadings.fields if ideal or name in ("tip_displacement", "tip_slope")]
    return [
        *(FmiVariable(name, f"readings.tip.{name}", name) for name in tip),
        FmiVariable("payout_acceleration", "readings.winch.payout_acceleration", "payout_acceleration"),
        *_per_motor(MotorReadings, "readings.motors", len(scenario.motors)),
    ]


def _outputs(scenario: Scenario) -> list[FmiVariable]:
    outer = [FmiVariable(name, f"state.decision.outer.{name}", name) for name in OuterDecision.fields]
    return [*outer, *_per_motor(MotorDecision, "state.decision.motors", len(scenario.motors))]


def _per_motor(frame: type[Frame], place: str, motors: int) -> list[FmiVariable]:
    """One variable per motor and field; motors are numbered from 1 in names and from 0 in C."""
    each = [(name, i) for name in frame.fields for i in range(motors)]
    return [FmiVariable(f"{name}[{i + 1}]", f"{place}[{i}].{name}", name) for name, i in each]


def _description(scenario: Scenario, inputs: Sequence[FmiVariable], outputs: Sequence[FmiVariable]) -> dict[str, str]:
    """What modelDescription.xml says of a scenario."""
    units = sorted({find(v.quantity).unit for v in [*inputs, *outputs]} - {"", "1"})
    variables = [_real(k, v, k < len(inputs)) for k, v in enumerate([*inputs, *outputs])]
    first = len(inputs) + 2  # variables are counted from 1, and a boolean stands after the inputs
    unknown = [f'      <Unknown index="{first + k}" dependencies=""/>' for k in range(len(outputs) + 1)]
    return {
        "IDENTIFIER": _identifier(scenario), "NAME": quoteattr(f"{scenario.name}: controller"),
        "DESCRIPTION": quoteattr(f"scenario {scenario.hash}"), "VERSION": umbilical.__version__,
        "PERIOD": repr(scenario.control.period), "STOP": repr(scenario.duration),
        "UNITS": "\n".join(map(_unit, units)),
        "INPUT_VARIABLES": "\n".join(variables[: len(inputs)]),
        "OUTPUT_VARIABLES": "\n".join(variables[len(inputs) :]),
        "UNKNOWNS": "\n".join(unknown),
        "SOURCE_FILES": "\n".join(f'      <File name="{name}"/>' for name in _SOURCES),
    }  # fmt: skip


def _unit(unit: str) -> str:
    exponents = "".join(f' {base}="{exponent}"' for base, exponent in base_units(unit).items())
    return f"    <Unit name={quoteattr(unit)}><BaseUnit{exponents}/></Unit>"


def _real(reference: int, variable: FmiVariable, is_input: bool) -> str:
    quantity = find(variable.quantity)
    kind = 'causality="input" variability="continuous"'
    if not is_input:
        kind = 'causality="output" variability="discrete" initial="calculated"'
    unit = f" unit={quoteattr(quantity.unit)}" if quantity.unit not in ("", "1") else ""
    start = ' start="0"' if is_input else ""
    values = f'name={quoteattr(variable.name)} valueReference="{reference}" description={quoteattr(quantity.meaning)}'
    return f"    <ScalarVariable {values} {kind}><Real{unit}{start}/></ScalarVariable>"


def _compiled(content: Mapping[str, str], identifier: str, fmpy: Any) -> tuple[dict[str, bytes], str]:
    """The shared library for this machine by its place in the archive, and what it is."""
    compiler = next((found for name in ("cc", "gcc", "clang") if (found := shutil.which(name))), None)
    if compiler is None:
        return {}, "sources only: this machine has no C compiler; `fmpy compile` adds a binary where there is one"
    name = f"{identifier}{fmpy.sharedLibraryExtension}"
    options = ("-std=c99", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-s")
    with tempfile.TemporaryDirectory() as folder:
        for place, text in content.items():
            if place.startswith("sources/"):
                (Path(folder) / Path(place).name).write_text(text, encoding="utf-8")
        command = [compiler, *options, "-o", name, *_SOURCES, "-lm"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return {}, f"sources only: {compiler} failed: {done.stderr.strip()[:300]}"
        library = (Path(folder) / name).read_bytes()
    return {f"binaries/{fmpy.platform}/{name}": library}, f"sources and a binary for {fmpy.platform}"


def _packed(content: Mapping[str, str | bytes]) -> bytes:
    """A zip archive without dates."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, data in sorted(content.items()):
            entry = zipfile.ZipInfo(name, _LONG_AGO)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            packed.writestr(entry, data)
    return archive.getvalue()

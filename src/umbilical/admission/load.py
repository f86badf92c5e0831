"""Where scenarios come from: presets by name, TOML files, result files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from umbilical import files
from umbilical.admission.examine import admit_data
from umbilical.admission.presets import preset_names, preset_text
from umbilical.admission.recorded import consequences, forget, read_files
from umbilical.errors import FileError, Problem, ScenarioError
from umbilical.scenario import Scenario
from umbilical.scenario.document import extend, read, try_override
from umbilical.scenario.problems import nearest, shown


def load(source: str | os.PathLike[str], overrides: Mapping[str, Any] | None = None) -> Scenario:
    """A scenario that has passed every check.

    Args:
        source: name of a preset, path of a ``.toml`` file, or path of a ``.nc`` result file, whose scenario
            is taken. A file may start from a preset with ``extends = "paper"`` and say only what differs.
        overrides: values by dotted keys, lists numbered from 1, e.g. ``{"cable.line_density": 3.0}``.

    Files that the scenario names are read relative to its folder (to the current one, for a preset), and their numbers
    are kept in it.

    Raises:
        FileError: there is no such preset or file, it cannot be read, or it is not TOML.
        ScenarioError: with every problem of the fields and between them.

    >>> load("paper", {"duration": 10.0}).duration
    10.0
    """
    origin = os.fspath(source)
    data = _extended(read(_text(origin), origin), origin)
    changed, lost = try_override(data, overrides or {})
    forget(changed, overrides or {})
    unread = read_files(changed, Path() if origin in preset_names() else Path(origin).parent)
    try:
        return admit_data(changed, origin, [*lost, *unread])
    except ScenarioError as error:
        raise ScenarioError(consequences(error.problems, unread), origin) from error


def _extended(data: dict[str, Any], origin: str) -> dict[str, Any]:
    """The document laid over the preset it extends, which may itself extend another."""
    if "extends" not in data:
        return data
    name = data["extends"]
    changes = {key: value for key, value in data.items() if key != "extends"}
    if name not in preset_names():
        reason = "only the presets of this package can be extended"
        problem = Problem(
            "extends",
            shown(name),
            f"one of {', '.join(preset_names())}",
            reason,
            nearest(name if isinstance(name, str) else "", preset_names()),
        )
        raise ScenarioError([problem], origin)
    return extend(_extended(read(preset_text(name), name), name), changes)


def _text(source: str) -> str:
    if source in preset_names():
        return preset_text(source)
    path = Path(source)
    if path.suffix == ".nc":
        from umbilical.run import scenario_text  # brings xarray along

        return scenario_text(path)
    return _file_text(path)


def _file_text(path: Path) -> str:
    try:
        text = files.read_text(path)
    except FileError as error:
        if isinstance(error.__cause__, FileNotFoundError):
            raise FileError(
                f"{path}: there is no preset or file of this name; {nearest(str(path), preset_names())}"
            ) from error
        raise
    if not text.strip():
        raise FileError(f"{path}: the file is empty; start from `umbilical presets --copy paper {path.name}`")
    return text

"""Where scenarios come from: presets by name, TOML files, result files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from umbilical import files
from umbilical.errors import FileError, ScenarioError
from umbilical.library.admit import admit_data
from umbilical.library.recorded import consequences, forget, read_files
from umbilical.scenario import Scenario
from umbilical.scenario.document import read_document, try_override
from umbilical.scenario.presets import Presets
from umbilical.scenario.problems import nearest
from umbilical.stored_runs import scenario_text

PRESETS = Presets("umbilical.scenario", "preset")


def preset_names() -> tuple[str, ...]:
    """Names of the scenarios that come with the package.

    >>> "paper" in preset_names()
    True
    """
    return PRESETS.names


def preset_text(name: str) -> str:
    """TOML text of a preset, as it is in the package.

    Raises:
        FileError: there is no such preset.

    >>> preset_text("paper-dead").splitlines()[0]
    'extends = "paper"'
    """
    return PRESETS.text(name)


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
    own = read_document(_text(origin), origin)
    data = PRESETS.extended(own, origin)
    if origin not in preset_names() and "extends" in own and "description" not in own:
        data["description"] = f"Changed from {own['extends']}. {data.get('description', '')}".rstrip()
    changed, lost = try_override(data, overrides or {})
    forget(changed, overrides or {})
    unread = read_files(changed, Path() if origin in preset_names() else Path(origin).parent)
    try:
        return admit_data(changed, origin, [*lost, *unread])
    except ScenarioError as error:
        raise ScenarioError(consequences(error.problems, unread), origin) from error


def _text(source: str) -> str:
    if source in preset_names():
        return preset_text(source)
    path = Path(source)
    if path.suffix == ".nc":
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

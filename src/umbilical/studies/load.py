"""Where studies come from: presets by name, TOML files, result files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from umbilical import files
from umbilical.errors import FileError, Problem, ScenarioError
from umbilical.library import load
from umbilical.scenario.document import Data, read_document
from umbilical.scenario.presets import Presets
from umbilical.scenario.problems import nearest
from umbilical.studies.results import is_study_file, study_of_file
from umbilical.studies.study import Study, override_study

STUDIES = Presets("umbilical.studies", "study")


def load_study(source: str | os.PathLike[str], overrides: Mapping[str, Any] | None = None) -> Study:
    """A study that has passed every check.

    Args:
        source: name of a preset, path of a ``.toml`` file, or path of a study's ``.nc`` result. In a file,
            ``scenario`` is a preset's name, the path of a scenario beside the file, or a whole scenario.
        overrides: values by dotted keys of the study, lists numbered from 1, e.g. ``{"members": 50}``.

    Raises:
        FileError: there is no such preset or file, it cannot be read, or it is not TOML.
        ScenarioError: with every problem of the study, of its scenario and of what its arms make of it.

    >>> load_study("fault-map", {"seed": 7}).seed
    7
    """
    origin = os.fspath(source)
    data = read_document(_text(origin), origin)
    data["scenario"] = _scenario_data(data.get("scenario"), Path(origin).parent, origin)
    return override_study(data, overrides or {}, origin)


def study_names() -> tuple[str, ...]:
    """Names of the studies that come with the package.

    >>> study_names()
    ('fault-map', 'gain-tuning', 'paper-robustness')
    """
    return STUDIES.names


def is_study(source: str) -> bool:
    """Whether a name or file is a study rather than a scenario or a run; False for what cannot be read."""
    try:
        if source in study_names() or Path(source).suffix != ".toml":
            return source in study_names() or (Path(source).suffix == ".nc" and is_study_file(source))
        return "scenario" in read_document(_text(source), source)
    except FileError:
        return False


def _text(source: str) -> str:
    if source in study_names():
        return STUDIES.text(source)
    if Path(source).suffix == ".nc":
        return study_of_file(source)
    try:
        return files.read_text(source)
    except FileError as error:
        if isinstance(error.__cause__, FileNotFoundError):
            raise FileError(f"{error}, and no study of this name; {nearest(source, study_names())}") from error
        raise


def _scenario_data(scenario: Any, folder: Path, origin: str) -> Data:
    """The whole scenario a study starts from."""
    if isinstance(scenario, Mapping):
        return dict(scenario)
    if isinstance(scenario, str):
        beside = folder / scenario
        return load(str(beside) if beside.suffix == ".toml" else scenario).to_dict()
    found, bound = "missing" if scenario is None else str(scenario), "a preset's name, or a .toml file beside the study"
    why = Problem("scenario", found, bound, "a study varies a scenario", 'e.g. scenario = "paper"')
    raise ScenarioError([why], origin)

"""Where studies come from: presets by name, TOML files, result files."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from umbilical import files
from umbilical.errors import FileError, Problem, ScenarioError
from umbilical.library import load
from umbilical.scenario.document import Data, freeze, read_document, try_override
from umbilical.scenario.presets import Presets
from umbilical.scenario.problems import nearest, problems_of
from umbilical.studies.checks import problems_across
from umbilical.studies.study import Study

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


def override_study(data: Mapping[str, Any], overrides: Mapping[str, Any], origin: str) -> Study:
    """Study of plain data with some values changed, by dotted keys.

    What is said of the scenario here is the last word on it: the study's own ``changes`` of the same keys go.

    Raises:
        ScenarioError: with every problem.
    """
    said = tuple(key.removeprefix("scenario.") for key in overrides if key.startswith("scenario."))
    own = data.get("changes")
    if said and isinstance(own, Mapping):
        data = {
            **data,
            "changes": {key: own[key] for key in own if not f"{key}.".startswith(tuple(f"{k}." for k in said))},
        }
    changed, lost = try_override(data, overrides)
    return admit_study(changed, origin, lost)


def admit_study(data: Mapping[str, Any], origin: str, problems: list[Problem] | None = None) -> Study:
    """Study of plain data, after all checks.

    Raises:
        ScenarioError: with every problem.
    """
    try:
        study = Study.model_validate(freeze(data))
    except ValidationError as error:
        found = [*(problems or []), *problems_of(error, Study), *_beside(data, error)]
        raise ScenarioError(found, origin) from error
    if found := [*(problems or []), *problems_across(study)]:
        raise ScenarioError(found, origin)
    return study


def _beside(data: Mapping[str, Any], error: ValidationError) -> list[Problem]:
    """What is wrong across the fields that are sound one by one, so that all problems come at once."""
    places = [complaint["loc"] for complaint in error.errors(include_url=False)]
    kept = {key: value for key, value in data.items() if key not in {str(place[0]) for place in places if place}}
    if "arms" not in kept:
        kept.pop("tuning", None)  # which speaks of them
    for key, stub in (("factors", None), ("arms", {"name": "wrong"})):  # an arm keeps its number, a factor has its key
        wrong = {place[1] for place in places if len(place) > 1 and place[0] == key}
        if wrong:
            kept[key] = [stub if number in wrong else entry for number, entry in enumerate(data[key])]
            kept[key] = [entry for entry in kept[key] if entry is not None]
    try:
        return problems_across(Study.model_validate(freeze(kept)))
    except ValidationError:  # without its scenario or its name nothing more can be said
        return []


def study_names() -> tuple[str, ...]:
    """Names of the studies that come with the package.

    >>> study_names()
    ('fault-map', 'gain-tuning', 'paper-robustness')
    """
    return STUDIES.names


def study_text(name: str) -> str:
    """TOML text of a study that comes with the package.

    Raises:
        FileError: there is none of this name.
    """
    return STUDIES.text(name)


def is_study(source: str) -> bool:
    """Whether a name or file is a study rather than a scenario or a run; False for what cannot be read."""
    if source in study_names():
        return True
    try:
        if Path(source).suffix == ".nc":
            from umbilical.studies.results import is_study_file

            return is_study_file(source)
        return Path(source).suffix == ".toml" and "scenario" in read_document(_text(source), source)
    except FileError:
        return False


def _text(source: str) -> str:
    if source in study_names():
        return study_text(source)
    if Path(source).suffix == ".nc":
        from umbilical.studies.results import study_of_file  # brings xarray along

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
    raise ScenarioError(
        [
            Problem(
                "scenario",
                "missing" if scenario is None else str(scenario),
                "a preset's name, or a .toml file beside the study",
                "a study varies a scenario",
                'e.g. scenario = "paper"',
            )
        ],
        origin,
    )

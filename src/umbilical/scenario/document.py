"""The plain data of a document: TOML read, one laid over another, values set by dotted keys."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from copy import deepcopy
from numbers import Integral, Real
from typing import Any

from umbilical.errors import FileError, Problem, ScenarioError
from umbilical.scenario.fields import TAGS, place_of
from umbilical.scenario.problems import abridged, shown

Data = dict[str, Any]
_ABSENT = object()
DEEPEST = 32
"""Tables and lists within each other, at the most; a scenario needs eight."""
_LARGEST_BITS = 1000
_TOO_LARGE = "a whole number of hundreds of digits, which no quantity is"
_TOO_DEEP = f"nested too deeply: no scenario or study has more than {DEEPEST} levels"


def read_document(text: str, origin: str = "scenario") -> Data:
    """Plain data of a TOML text.

    Raises:
        FileError: the text is not TOML; the message names line and column.
    """
    try:
        data = tomllib.loads(text)
    except RecursionError as error:
        raise FileError(f"{origin}: {_TOO_DEEP}") from error
    except ValueError as error:  # not TOML, or a whole number of thousands of digits
        end = f"at the end of the text, line {len(text.splitlines())}"
        raise FileError(f"{origin}: this is not TOML: {str(error).replace('at end of document', end)}") from error
    if reason := _impossible(data):
        raise FileError(f"{origin}: {reason}")
    return data


def freeze(value: Any) -> Any:
    """The same data as the strict records take it: lists become tuples, numpy's numbers Python's."""
    if isinstance(value, Mapping):
        return {key: freeze(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return tuple(freeze(item) for item in value)
    if isinstance(value, bool):
        return value
    if isinstance(value, Integral):
        return int(value)
    return float(value) if isinstance(value, Real) else value


def extend(base: Mapping[str, Any], changes: Mapping[str, Any]) -> Data:
    """Lay a document over its base: tables merge, everything else replaces.

    A table that names another kind (``law = "constant"`` over ``law = "quintic"``) replaces the whole table.
    """
    merged = _merge(base, {key: value for key, value in changes.items() if key != "assumed"})
    stated = changes.get("assumed", {})
    marks = {**_marks_kept(base, merged), **stated} if isinstance(stated, Mapping) else stated
    return {**merged, "assumed": marks} if marks else merged


def override(data: Mapping[str, Any], overrides: Mapping[str, Any], origin: str = "scenario") -> Data:
    """Set values by dotted keys; motors, faults and all other lists are numbered from 1.

    A value of None takes the key away. Naming another kind of table empties the table first, whatever the
    order of the overrides. The mark *assumed* of a value goes with the value.

    Args:
        data: plain data of a scenario; left as it is.
        overrides: e.g. ``{"cable.line_density": 3.0, "motors.2.thrust_coefficient": 1.0}``.
        origin: what to call the data in errors.

    Raises:
        ScenarioError: keys that lead nowhere.

    >>> override({"motors": [{"inertia": 1.0}, {"inertia": 1.0}]}, {"motors.2.inertia": 3.0})
    {'motors': [{'inertia': 1.0}, {'inertia': 3.0}]}
    """
    changed, problems = try_override(data, overrides)
    if problems:
        raise ScenarioError(problems, origin)
    return changed


def try_override(data: Mapping[str, Any], overrides: Mapping[str, Any]) -> tuple[Data, list[Problem]]:
    """As :func:`override`, but hands back the problems beside what the good overrides made of the data."""
    changed = deepcopy(dict(data))
    kinds_first = sorted(overrides, key=lambda key: key.rpartition(".")[2] not in TAGS)
    found = [_assign(changed, key, overrides[key]) for key in kinds_first]
    if isinstance(changed.get("assumed"), Mapping):
        stated = {key.removeprefix("assumed.") for key in overrides if key.startswith("assumed.")}
        kept = stated | set(_marks_kept(data, changed))
        changed["assumed"] = {key: reason for key, reason in changed["assumed"].items() if key in kept}
    return changed, [problem for problem in found if problem]


def assignment(text: str) -> tuple[str, Any]:
    """Key and value of ``key=value`` as typed on a command line; the value is TOML, else text.

    Raises:
        ScenarioError: there is no key or equals sign, or the value is nested too deeply, too long or not UTF-8.

    >>> assignment("cable.length=250"), assignment("control.law.kind=pd")
    (('cable.length', 250), ('control.law.kind', 'pd'))
    """
    key, equals, value = text.partition("=")
    if not equals or not key.strip():
        reason, fix = "one value is set per key", "e.g. duration=10"
        raise ScenarioError([Problem(key.strip() or "--set", shown(text), "key=value", reason, fix)])
    if any("\ud800" <= character <= "\udfff" for character in text):  # bytes that the shell passed on undecoded
        raise ScenarioError([_refused(key.strip(), value, "not UTF-8 text")])
    try:
        return key.strip(), tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return key.strip(), value.strip()
    except (RecursionError, ValueError) as error:  # or of thousands of digits
        reason = _TOO_DEEP if isinstance(error, RecursionError) else _TOO_LARGE
        raise ScenarioError([_refused(key.strip(), value, reason)]) from None


def look_up(data: Any, key: str) -> Any:
    """Value at a dotted key of plain data; raises KeyError where there is none."""
    for step in key.split("."):
        place = _place(data, step)
        if place is None or (isinstance(data, Mapping) and place not in data):
            raise KeyError(key)
        data = data[place]
    return data


def _merge(base: Mapping[str, Any], changes: Mapping[str, Any]) -> Data:
    merged = dict(base)
    for key, value in changes.items():
        old = merged.get(key)
        if isinstance(old, Mapping) and isinstance(value, Mapping) and not _other_kind(old, value):
            value = _merge(old, value)
        merged[key] = deepcopy(value)
    return merged


def _other_kind(old: Mapping[str, Any], new: Mapping[str, Any]) -> bool:
    return any(isinstance(new.get(name), str) and new[name] != old.get(name) for name in TAGS)


def _marks_kept(before: Mapping[str, Any], after: Mapping[str, Any]) -> dict[str, str]:
    """Marks *assumed* of ``before`` whose values are the same in ``after``."""
    marks = before.get("assumed", {})
    if not isinstance(marks, Mapping):
        return {}
    return {key: reason for key, reason in marks.items() if _find(before, key) == _find(after, key)}


def _find(data: Mapping[str, Any], key: str) -> Any:
    try:
        return look_up(data, key)
    except KeyError:
        return _ABSENT


def _assign(data: Data, key: str, value: Any) -> Problem | None:
    """Set one value; a problem where the key leads nowhere."""
    if reason := _impossible(value, key.count(".")):
        return _refused(key, value, reason)
    *path, last = ["assumed", key.partition(".")[2]] if key.startswith("assumed.") else key.split(".")
    table: Any = data
    for step in path:
        if isinstance(table, dict):
            table.setdefault(step, {})
        table = None if (place := _place(table, step)) is None else table[place]
    if (place := _place(table, last)) is None:
        return _nowhere(data, key, value)
    if last in TAGS and isinstance(value, str) and isinstance(table, dict) and table.get(last, value) != value:
        table.clear()
    table[place] = _thaw(value)
    if value is None and isinstance(table, dict):
        del table[place]
    return None


def _impossible(value: Any, level: int = 0) -> str:
    """Why plain data, ``level`` tables down, is none of ours; empty if it may be. It never recurses."""
    layer = [value]
    while layer:
        if any(isinstance(part, int) and part.bit_length() > _LARGEST_BITS for part in layer):
            return _TOO_LARGE
        layer = [part for part in layer if isinstance(part, Mapping | list | tuple)]
        level += bool(layer)
        if level > DEEPEST:
            return _TOO_DEEP
        layer = [part for item in layer for part in (item.values() if isinstance(item, Mapping) else item)]
    return ""


def _refused(key: str, value: Any, reason: str) -> Problem:
    return Problem(abridged(key), shown(value), "what a scenario or study has", reason, "see `umbilical schema`")


def _thaw(value: Any) -> Any:
    """A copy that further overrides can enter: a frozen list is a list again."""
    if isinstance(value, Mapping):
        return {key: _thaw(item) for key, item in value.items()}
    return [_thaw(item) for item in value] if isinstance(value, list | tuple) else value


def _place(data: Any, step: str) -> Any:
    """Key or index that a step of a dotted key means in a table or a list; None where it can mean none."""
    if isinstance(data, Mapping):
        return step
    return place_of(step, len(data)) if isinstance(data, list | tuple) else None


def _nowhere(data: Data, key: str, value: Any) -> Problem:
    parent = key.rpartition(".")[0]
    while parent and _find(data, parent) is _ABSENT:
        parent = parent.rpartition(".")[0]
    found = _find(data, parent)
    if isinstance(found, list):
        bound = f"places 1 to {len(found)} of {parent}" if found else f"no place: {parent} is empty"
        return Problem(abridged(key), shown(value), bound, "lists are numbered from 1", "name a place that exists")
    bound = f"{parent} is {shown(found)}"
    return Problem(abridged(key), shown(value), bound, "only tables and lists have parts", "drop it")

"""What must hold of a result file before anything in it is believed: it may have been written or changed by anybody.

Readers list the attributes they rely on with a rule each, and what they need of each array; everything wrong is told at
once, in one error. Nothing behind :func:`check_contents` needs to doubt the file again.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Mapping
from math import inf
from numbers import Integral
from typing import TYPE_CHECKING, Any

from umbilical.errors import FileError

if TYPE_CHECKING:
    import xarray

Rule = Callable[[Any], str]
"""What is wrong with a value, as the end of a sentence; empty if nothing is."""
CONTENTS = "contents"
"""Attribute that says what a result held when it was written: sizes and names."""


def text_rule(value: Any) -> str:
    """Rule of a text."""
    return "" if isinstance(value, str) else "must be a text"


def whole_number(value: Any) -> str:
    """Rule of a whole number."""
    return "" if isinstance(value, Integral) and not isinstance(value, bool) else "must be a whole number"


def instant(value: Any) -> str:
    """Rule of a time, s."""
    good = isinstance(value, int | float) and 0.0 <= value < inf
    return "" if good else "must be a finite number of seconds, not below 0"


def one_of(names: Collection[str]) -> Rule:
    """Rule of a text that must be one of some."""
    return lambda value: "" if isinstance(value, str) and value in names else f"must be one of {', '.join(names)}"


def json_of(kind: type, *items: type) -> Rule:
    """Rule of a JSON text: a list, or an object's values, of texts or numbers."""

    def wrong(value: Any) -> str:
        try:
            found = json.loads(value) if isinstance(value, str) else None
        except (ValueError, RecursionError):
            found = None
        parts = found.values() if isinstance(found, dict) else found if isinstance(found, list) else ()
        fits = isinstance(found, kind) and all(isinstance(part, items) for part in parts)
        return "" if fits else f"must be JSON of a {kind.__name__} of {' or '.join(i.__name__ for i in items)}"

    return wrong


def pairs(value: Any) -> str:
    """Rule of a JSON text of pairs of numbers, such as instants with their peaks."""
    if wrong := json_of(list, list)(value):
        return wrong
    good = all(len(pair) == 2 and all(type(part) in (int, float) for part in pair) for pair in json.loads(value))
    return "" if good else "must be JSON of pairs of numbers"


def kind_of(data: xarray.Dataset) -> str:
    """What a result is of: a run, a study, or neither."""
    kind = data.attrs.get("kind", "run")
    return kind if isinstance(kind, str) else "something else"


def contents_of(data: xarray.Dataset) -> str:
    """What a result says of its contents, so that a reader notices what was taken out of it."""
    return json.dumps({"variables": sorted(map(str, data.variables)), "sizes": dict(data.sizes)}, sort_keys=True)


def stated_sizes(data: xarray.Dataset) -> dict[str, int]:
    """Sizes that a result had when it was written; only of one that was checked."""
    return json.loads(data.attrs[CONTENTS])["sizes"]


def check_contents(data: xarray.Dataset, rules: dict[str, Rule], may_shrink: str, origin: str) -> None:
    """Refuse a result whose attributes break a rule, or that no longer holds what it says.

    Args:
        data: what was read.
        rules: of each attribute that is needed.
        may_shrink: dimension along which a part of a result may have been taken.
        origin: what to call the file.

    Raises:
        FileError: with everything that is wrong.
    """
    wrong = [*_wrong_attributes(data.attrs, rules | {CONTENTS: _contents})]
    if not wrong:
        stated = json.loads(data.attrs[CONTENTS])
        wrong = [*_missing(data, stated["variables"]), *_wrong_sizes(data, stated["sizes"], may_shrink)]
    refuse(wrong, origin)


def refuse(wrong: Iterable[str], origin: str) -> None:
    """Raise FileError if anything is wrong."""
    if told := [*dict.fromkeys(wrong)]:
        lines = "\n".join(f"  {one}" for one in told)
        raise FileError(f"{origin}: not as Umbilical wrote it; xarray reads it all the same\n{lines}")


def wrong_array(array: xarray.DataArray, dims: tuple[str, ...], kinds: str) -> str:
    """What is wrong with an array that is needed over ``dims`` and with a numpy ``dtype.kind`` in ``kinds``."""
    if tuple(map(str, array.dims)) != dims:
        return f"{array.name}: is over ({', '.join(map(str, array.dims))}), not ({', '.join(dims)})"
    if array.dtype.kind not in kinds and not (array.dtype == object and _all_texts(array, kinds)):
        return f"{array.name}: holds {array.dtype}, which it never does"
    if broken := [name for name in ("units", "long_name", "symbol") if not isinstance(array.attrs.get(name, ""), str)]:
        return f"{array.name}: its {broken[0]} must be a text"
    return ""


def _all_texts(array: xarray.DataArray, kinds: str) -> bool:
    return "U" in kinds and all(isinstance(value, str) for value in array.values.ravel())


def _wrong_attributes(found: Mapping[Any, Any], rules: Mapping[str, Rule]) -> Iterable[str]:
    for name, rule in rules.items():
        if name not in found:
            yield f"{name}: is missing"
        elif reason := rule(found[name]):
            shown = str(found[name]).replace("\n", " ")
            yield f"{name} = {shown[:60]}{'...' * (len(shown) > 60)}: {reason}"


def _contents(value: Any) -> str:
    if reason := json_of(dict, dict, list)(value):
        return reason
    found = json.loads(value)
    names, sizes = found.get("variables"), found.get("sizes")
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        return "must list the variables"
    fits = isinstance(sizes, dict) and all(not whole_number(size) and size >= 0 for size in sizes.values())
    return "" if fits else "must give the sizes"


def _missing(data: xarray.Dataset, names: Iterable[str]) -> Iterable[str]:
    return (f"{name}: was taken out" for name in names if name not in data.variables)


def _wrong_sizes(data: xarray.Dataset, sizes: Mapping[str, int], may_shrink: str) -> Iterable[str]:
    for name, size in sizes.items():
        found = data.sizes.get(name)
        if found is None:
            yield f"{name}: the dimension is gone"
        elif found != size and not (name == may_shrink and found < size):
            yield f"{name}: has {found} places, and had {size}"

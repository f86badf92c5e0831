"""C structs and constants from frames, named tuples and arrays, with the units of :mod:`umbilical.quantities`."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import Any, get_type_hints

import numpy as np

from umbilical.frames import Frame
from umbilical.quantities import find


def c_literal(value: float) -> str:
    """A number in C99, to the last bit.

    >>> c_literal(0.1), c_literal(3), c_literal(float("-inf"))
    ('0x1.999999999999ap-4', '3', '-HUGE_VAL')
    """
    if isinstance(value, bool | np.bool_ | int | np.integer):
        return str(int(value))
    if np.isinf(value):
        return "HUGE_VAL" if value > 0.0 else "-HUGE_VAL"
    return float(value).hex()


def type_name(cls: type) -> str:
    """The C name of a frame or a named tuple.

    >>> from umbilical.control.contract import TipReadings
    >>> type_name(TipReadings)
    'umb_tip_readings'
    """
    return "umb_" + re.sub(r"(?<=[a-z])(?=[A-Z])", "_", cls.__name__).lower()


def frame_structs(frame: type[Frame], used: Collection[str], known: set[str] | None = None) -> Iterator[str]:
    """The struct of a frame, those inside it first; of the fields only those that are ``used``."""
    known = set() if known is None else known
    for field in frame.fields.values():
        if field.frame is not None:
            yield from frame_structs(field.frame, used, known)
    if frame.__name__ not in known:
        known.add(frame.__name__)
        yield _struct(type_name(frame), [_frame_field(name, frame) for name in frame_fields(frame, used)])


def frame_fields(frame: type[Frame], used: Collection[str]) -> list[str]:
    """The fields of a frame that are ``used``, in their order."""
    return [name for name in frame.fields if name in used]


def value_structs(value: Any, used: Collection[str], known: set[str] | None = None) -> Iterator[str]:
    """The struct of a named tuple's type, those inside it first."""
    known, cls, hints = set() if known is None else known, type(value), get_type_hints(type(value))
    for name in tuple_fields(value, used):
        part = getattr(value, name)
        if hasattr(part, "_fields"):
            yield from value_structs(part, used, known)
        elif isinstance(part, np.ndarray) and part.dtype.names:
            yield from frame_structs(hints[name], used, known)
    if cls.__name__ not in known:
        known.add(cls.__name__)
        members = [_member(name, getattr(value, name), hints[name]) for name in tuple_fields(value, used)]
        yield _struct(type_name(cls), members)


def tuple_fields(value: Any, used: Collection[str]) -> list[str]:
    """The fields of a named tuple that are ``used``, in their order."""
    return [name for name in value._fields if name in used]


def initialiser(value: Any, used: Collection[str], indent: str = "") -> str:
    """A value as C initialises it: named tuples and records by name, arrays in braces."""
    deeper = indent + "    "
    if hasattr(value, "_fields"):
        named = [(name, getattr(value, name)) for name in tuple_fields(value, used)]
    elif isinstance(value, np.void):
        named = [(name, value[name]) for name in value.dtype.names or () if name in used]
    elif isinstance(value, tuple):
        return _row([initialiser(entry, used, deeper) for entry in value])
    elif isinstance(value, np.ndarray):
        entries = value if value.size else [np.zeros(1, value.dtype)[0]]  # C has no array of length 0
        parts = [initialiser(entry, used, deeper) for entry in entries]
        rows = value.ndim > 1 or value.dtype.names
        return "{\n" + "".join(f"{deeper}{part},\n" for part in parts) + indent + "}" if rows else _row(parts)
    else:
        return c_literal(value)
    lines = [f"{deeper}.{name} = {initialiser(part, used, deeper)},{_decimal(part)}\n" for name, part in named]
    return "{\n" + "".join(lines) + indent + "}"


def _row(parts: list[str]) -> str:
    return "{" + ", ".join(parts) + "}"


def _decimal(value: Any) -> str:
    return f" /* {value:.9g} */" if isinstance(value, float) and np.isfinite(value) else ""


def _frame_field(name: str, frame: type[Frame]) -> tuple[str, str, str]:
    field = frame.fields[name]
    if field.frame is not None:
        return type_name(field.frame), name, ""
    return ("int64_t" if field.dtype is np.int64 else "double"), name, _meaning(name)


def _member(name: str, value: Any, hint: Any) -> tuple[str, str, str]:
    """C type, declared name and meaning of a field of a named tuple."""
    if hasattr(value, "_fields"):
        return type_name(type(value)), name, ""
    if isinstance(value, np.ndarray) and value.dtype.names:
        return type_name(hint), f"{name}[{max(1, value.size)}]", ""
    if isinstance(value, tuple | np.ndarray):
        return "double", name + "".join(f"[{size}]" for size in np.shape(value)), ""
    return ("int" if isinstance(value, bool | int) else "double"), name, _meaning(name)


def _meaning(name: str) -> str:
    """Unit and meaning of a quantity; empty for what is none."""
    try:
        quantity = find(name)
    except KeyError:
        return ""
    unit = quantity.unit if quantity.unit not in ("", "1") else ""
    return ", ".join(filter(None, [unit, quantity.meaning]))


def _struct(name: str, members: list[tuple[str, str, str]]) -> str:
    lines = [f"    {kind} {field};{f' /* {meaning} */' if meaning else ''}\n" for kind, field, meaning in members]
    return f"typedef struct {{\n{''.join(lines)}}} {name};\n"

"""Frames: records of named quantities, declared once.

A frame is a class whose attributes are quantities of :mod:`umbilical.quantities`: an attribute has the name of
its entry there, so that unit, symbol and meaning are said in one place. Kernels get arrays of numpy records laid
out like the frame (one record per motor, or an array of one) and are annotated with it, so a type checker knows
every name in a kernel. A number of motors is a length of an array, never part of a type: it compiles nothing.

Two habits of numpy's records to know: a float that is put into an ``integer`` loses its fraction silently, and a
record that is marked read-only can still be written through its attributes.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Self, TypeVar, overload

import numpy as np

from umbilical.quantities import find

F = TypeVar("F", bound="Frame")


class Field(NamedTuple):
    """How a quantity, or a frame inside a frame (``frame``), lies in memory."""

    dtype: Any
    shape: tuple[int, ...] = ()
    frame: type[Frame] | None = None


def real() -> float:
    """Declare a number."""
    return Field(np.float64)  # pyright: ignore[reportReturnType]


def integer() -> int:
    """Declare a count or an index."""
    return Field(np.int64)  # pyright: ignore[reportReturnType]


def vector(size: int) -> np.ndarray:
    """Declare a few numbers. The size is part of the type: the order of a method, never a count of a scenario."""
    return Field(np.float64, (size,))  # pyright: ignore[reportReturnType]


def part(frame: type[F]) -> F:
    """Declare a frame inside a frame."""
    return Field(frame.dtype, frame=frame)  # pyright: ignore[reportReturnType]


def numbers(record: Frame) -> tuple[Any, ...]:
    """Copy the numbers of one record, or of an array of one; a part becomes a tuple of its own."""
    return record.item()  # pyright: ignore[reportAttributeAccessIssue]


def as_array(records: Frame) -> np.ndarray:
    """See records of nothing but real numbers as an array with one more dimension, the field; the same memory."""
    width = records.dtype.itemsize // np.dtype(np.float64).itemsize
    return records.view(np.float64).reshape(*records.shape, width)  # pyright: ignore[reportAttributeAccessIssue]


def leaves(frame: type[Frame]) -> Iterator[tuple[str, Any]]:
    """Name and type of every number of a frame, those of its parts as ``part.name``; each takes eight bytes."""
    for name, field in frame.fields.items():
        if field.frame is None:
            yield name, field.dtype
        else:
            yield from ((f"{name}.{inner}", dtype) for inner, dtype in leaves(field.frame))


class Frame:
    """Base of all frames, aligned as a C compiler aligns a struct.

    Attributes:
        fields: what was declared, in its order.
        dtype: of numpy's records.

    Raises:
        TypeError: an attribute that is no field, or is called like a method of numpy's records.
        KeyError: a quantity that :mod:`umbilical.quantities` does not know.

    >>> from umbilical.frames import Frame, real
    >>> class Motion(Frame):
    ...     tip_displacement = real()
    ...     tip_velocity = real()
    >>> motion = Motion.many(3)
    >>> motion[1].tip_velocity = 0.5
    >>> motion["tip_velocity"]
    array([0. , 0.5, 0. ])
    """

    fields: ClassVar[dict[str, Field]] = {}
    dtype: ClassVar[np.dtype]

    def __init_subclass__(cls) -> None:
        own = {name: value for name, value in vars(cls).items() if not name.startswith("__")}
        if wrong := [name for name, value in own.items() if not isinstance(value, Field) or hasattr(np.record, name)]:
            raise TypeError(f"{cls.__name__}: no fields, or methods of numpy's records: {', '.join(wrong)}")
        for name, field in own.items():
            if field.frame is None:
                find(name)
        cls.fields = cls.fields | own
        layout = [(name, field.dtype, field.shape) for name, field in cls.fields.items()]
        cls.dtype = np.dtype((np.record, np.dtype(layout, align=True)))

    @classmethod
    def many(cls, *shape: int) -> Self:
        """Make records of zeros, an array of this shape."""
        return np.zeros(shape, cls.dtype)  # pyright: ignore[reportReturnType]

    @classmethod
    def one(cls, *values: float, **named: float) -> Self:
        """Make one record in memory of its own, by order or by name; what is not given is zero."""
        record = cls.many(1)[0]
        for name, value in [*zip(cls.fields, values, strict=False), *named.items()]:
            setattr(record, name, value)
        return record

    if TYPE_CHECKING:  # what an array of records can do
        size: int
        shape: tuple[int, ...]

        @overload
        def __getitem__(self, place: str) -> np.ndarray: ...
        @overload
        def __getitem__(self, place: Any) -> Self: ...
        def __getitem__(self, place: Any) -> Any: ...
        def __iter__(self) -> Iterator[Self]: ...
        def __setitem__(self, place: Any, value: Any) -> None: ...

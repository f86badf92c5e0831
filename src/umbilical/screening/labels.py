"""What results of screening share: an operation, and arrays that say what they are."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from umbilical.result import ResultFaces
from umbilical.screening.operation import Operation
from umbilical.screening.response import unknown_parts


class ScreeningResult(ResultFaces):
    """Base of what screening finds of an operation."""

    operation: Operation

    def notices(self) -> tuple[str, ...]:
        """What it does not know."""
        return tuple(unknown_parts(self.operation))

    def plain(self, arrays: str, **more: Any) -> dict[str, Any]:
        """Plain data: the operation and the verdict, arrays by their names, and what else is given."""
        about = {"operation": self.operation.name, "operation_hash": self.operation.hash, "headline": self.summary()}
        lists = {name: getattr(self, name).tolist() for name in arrays.split()}
        return {**about, **lists, **more, "notices": self.notices(), "assumed": self.operation.assumed}


def labelled(rows: Iterable[tuple[str, Any, Any, str, str]]) -> dict[str, tuple[Any, Any, dict[str, str]]]:
    """Variables of a dataset from rows of name, dimensions, values, unit and meaning."""
    return {name: (dims, values, {"units": unit, "long_name": said}) for name, dims, values, unit, said in rows}

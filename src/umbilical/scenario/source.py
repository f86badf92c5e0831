"""Numbers of a table that come from a file: which columns, in which units, and what was done to them."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from umbilical.scenario.base import LARGEST, Number, Record


class FromFile(Record):
    """A CSV or NetCDF file, relative to the scenario's folder. Its numbers are kept in the scenario that is stored."""

    name: str = Field(min_length=1, description="name of the file; alone it can stand for this table")
    across: str | None = Field(default=None, description="column of the points; left out, the first")
    value: str | None = Field(default=None, description="column of the values; left out, the only other one")
    across_unit: str | None = Field(default=None, description="unit of the points, where the header gives none")
    unit: str | None = Field(default=None, description="unit of the values, where the header gives none")
    fill: tuple[Number, ...] = Field(default=(), description="numbers that stand for a missing value")
    blanks: bool = Field(default=False, description="leave out rows with a blank cell")
    drift: str = Field(
        default="keep", pattern=r"^(keep|mean|highpass\([0-9.]+(e[0-9]+)?\))$",
        description="what is taken off the values: keep (nothing), mean, highpass(T) (all that is slower than T s)",
    )  # fmt: skip
    noise: float | None = Field(
        default=None, gt=0.0, le=LARGEST,
        description="standard deviation of the noise in a record, in SI units; a smoothing spline takes it off",
    )  # fmt: skip
    start: float | None = Field(
        default=None, ge=-LARGEST, le=LARGEST, json_schema_extra={"unit": "s"},
        description="what is subtracted from the times; left out, the first time if they are dates, else 0",
    )  # fmt: skip
    sha256: str | None = Field(default=None, description="of the file, written when it was read")


def from_file(across: str, values: str, across_unit: str = "s", unit: str = "") -> Any:
    """A field of a table whose lists ``across`` and ``values`` a file can fill.

    Args:
        across, values: names of the two lists.
        across_unit, unit: their SI units; an empty unit is that of the signal the table is a term of.
    """
    extra: Any = {"fills": [across, values], "units": [across_unit, unit]}
    return Field(default=None, description="file that the numbers come from", json_schema_extra=extra)

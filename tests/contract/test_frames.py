"""Frames: what they are made of, and what they refuse."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest

from umbilical import compile as compiling
from umbilical.control.contract import Measurement, MotorReadings, TipReadings, WinchReadings
from umbilical.frames import Frame, integer, numbers, part, real, vector
from umbilical.quantities import CHANNELS, PARAMETERS, STATES, find

pytestmark = pytest.mark.nojit


class Motion(Frame):
    tip_displacement = real()
    tip_velocity = real()


class Whole(Frame):
    updates = integer()
    motion = part(Motion)
    kappa = vector(2)


class Longer(Motion):
    tip_slope = real()


def test_records_lie_as_declared() -> None:
    assert Whole.dtype.names == ("updates", "motion", "kappa")
    assert Whole.dtype.itemsize == 8 * (1 + 2 + 2)
    assert list(Longer.fields) == ["tip_displacement", "tip_velocity", "tip_slope"]


def test_parts_share_the_memory_of_the_whole() -> None:
    records = Whole.many(3)
    motion, kappa = records[1].motion, records[1].kappa
    motion.tip_velocity, kappa[1] = 2.0, 3.0
    assert records["motion"]["tip_velocity"].tolist() == [0.0, 2.0, 0.0]
    assert records["kappa"].tolist() == [[0.0, 0.0], [0.0, 3.0], [0.0, 0.0]]


def test_one_record_by_order_and_by_name() -> None:
    assert numbers(Longer.one(1.0, tip_slope=3.0)) == (1.0, 0.0, 3.0)


@pytest.mark.parametrize("name", ["mean", "min", "size", "copy", "item", "dtype"])
def test_names_of_numpys_methods_are_refused(name: str) -> None:
    """A kernel would read the field, the same code as plain Python the method."""
    with pytest.raises(TypeError, match=f"Broken.*{name}"):
        type("Broken", (Frame,), {name: real()})


@pytest.mark.parametrize("name", ["typo", "payout_sped"])
def test_a_quantity_without_an_entry_is_refused(name: str) -> None:
    with pytest.raises(KeyError, match=name):
        type("Broken", (Frame,), {name: real()})


def test_what_is_no_field_is_refused() -> None:
    with pytest.raises(TypeError, match="tip_slope"):
        type("Broken", (Frame,), {"tip_slope": 0.0})


def test_a_name_stands_for_one_quantity() -> None:
    tables = (CHANNELS, STATES, PARAMETERS)
    for name in {n for table in tables for n in table}:
        units = {table[name].unit for table in tables if name in table}
        assert units == {find(name).unit}, name


def test_the_declaration_names_the_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    """An edit of it compiles anew, as one of a kernel does."""
    before = compiling._fingerprint()
    read = compiling.Path.read_bytes
    monkeypatch.setattr(
        compiling.Path, "read_bytes", lambda p: read(p) + (b"#" if p.name == "frames.py" else b""), raising=True
    )
    assert compiling._fingerprint() != before


def test_numbers_are_copied() -> None:
    record = Motion.one(1.0, 2.0)
    before = numbers(record)
    record.tip_velocity = np.inf
    assert before == (1.0, 2.0)


def test_a_measurement_has_the_names_of_the_readings() -> None:
    """In any order: in Python the rates come last, since they may be absent, and the rope's second direction."""
    declared = [*TipReadings.fields, *MotorReadings.fields, *WinchReadings.fields, "across"]
    assert sorted(field.name for field in fields(Measurement)) == sorted(declared)

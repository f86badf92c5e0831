"""New motors under the gains of a preset are told; the preset's own, and gains of one's own, are not."""

from __future__ import annotations

from typing import Any

import pytest

import umbilical
from umbilical.library import admit, preset_names

LARGE = {"inertia": 2.0, "torque_constant": 3.0}


def told(changes: dict[str, Any], preset: str = "paper") -> list[str]:
    return [str(notice) for notice in admit(umbilical.load(preset, changes)) if "chosen for other" in str(notice)]


def of(number: int, **constants: float) -> dict[str, float]:
    return {f"motors.{number}.{name}": value for name, value in constants.items()}


def test_a_file_that_replaces_the_motors_and_keeps_the_gains_is_told(tmp_path) -> None:
    motor = umbilical.load("paper").motors[0].model_dump(exclude_none=True)
    lines = [f"{name} = {value}" for name, value in (motor | LARGE).items() if isinstance(value, float)]
    text = "\n".join(['extends = "paper"', "[[motors]]", *lines])
    (tmp_path / "mine.toml").write_text(text, encoding="utf-8")
    found = told({}, str(tmp_path / "mine.toml"))
    assert len(found) == 1
    assert "preset 'paper'" in found[0]
    assert "motors.1 has inertia 2 for 0.5, torque_constant 3 for" in found[0]
    assert any("chosen for other" in note for note in umbilical.simulate(
        umbilical.load(tmp_path / "mine.toml", {"duration": 0.1})).notices)  # fmt: skip


@pytest.mark.parametrize(
    "changes",
    [
        of(2, inertia=0.55),  # a tenth more: a spread, no other motor
        of(1, voltage_limit=8.0),  # what the gains do not depend on
        of(1, **LARGE) | {"control.motor_loop.speed_gain": 20.0},  # gains of one's own
        of(1, **LARGE) | {"ideal_thruster": True},
        of(1, **LARGE) | {"control.law": {"kind": "none"}},
    ],
)
def test_no_word_without_need(changes: dict[str, Any]) -> None:
    assert told(changes) == []


def test_one_of_two_and_a_third() -> None:
    assert len(told(of(2, resistance=5.0))) == 1
    third = [m.model_dump(exclude_none=True) for m in umbilical.load("paper").motors]
    assert told({"motors": [*third, third[0]]}) == []
    assert len(told({"motors": [*third, third[0] | LARGE]})) == 1


def test_the_presets_are_silent() -> None:
    assert all(told({}, name) == [] for name in preset_names())

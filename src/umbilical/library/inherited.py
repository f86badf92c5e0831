"""Gains that came with a preset, under motors that did not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from umbilical.control.rates import drives_motors
from umbilical.scenario.control import Control
from umbilical.scenario.document import read_document
from umbilical.scenario.findings import Finding, Notice
from umbilical.scenario.hardware import Motor
from umbilical.scenario.presets import Presets

_GAINS = ("speed_gain", "current_gain", "observer_gain")
_CONSTANTS = (
    "inertia", "viscous_friction", "torque_constant", "load_coefficient", "resistance", "inductance",
    "back_emf_constant",
)  # fmt: skip
_ALIKE = 0.2
"""Share by which a motor may differ from the one its gains were chosen for without a word."""


class Chosen(NamedTuple):
    """The motor loop of a preset and the motors it was chosen for, as plain data."""

    preset: str
    loop: Mapping[str, float]
    motors: Sequence[Mapping[str, float]]


def gains_of_other_motors(control: Control, motors: Sequence[Motor], ideal_thruster: bool) -> Iterator[Finding]:
    """The gains of a preset's motor loop drive the motors they were chosen for."""
    loop = control.motor_loop
    if loop is None or not drives_motors(control, ideal_thruster):
        return
    for chosen in _chosen():
        if any(getattr(loop, name) != chosen.loop[name] for name in _GAINS):
            continue
        for number, motor in enumerate(motors, start=1):
            before = chosen.motors[min(number, len(chosen.motors)) - 1]
            if other := [name for name in _CONSTANTS if _differs(getattr(motor, name), before[name])]:
                yield Notice(
                    "control.motor_loop",
                    f"its gains are those of preset '{chosen.preset}', chosen for other motors: motors.{number} has "
                    + ", ".join(f"{name} {getattr(motor, name):g} for {before[name]:g}" for name in other),
                )


def _differs(value: float, before: float) -> bool:
    return abs(value - before) > _ALIKE * abs(before)


@lru_cache(maxsize=1)
def _chosen() -> tuple[Chosen, ...]:
    """Every preset that brings a motor loop and motors of its own."""
    found: list[Chosen] = []
    presets = Presets("umbilical.scenario", "preset")
    for name in presets.names:
        data: Any = read_document(presets.text(name), name)
        loop, motors = data.get("control", {}).get("motor_loop"), data.get("motors")
        if loop and motors:
            found.append(Chosen(name, loop, motors))
    return tuple(found)

"""Controllers of a user, as tests need them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from umbilical import Command, Measurement


class Recorder:
    """Remembers what it sees and when; answers with the same command each time."""

    def __init__(self, command: Any, period: float = 1e-3) -> None:
        self.period, self._command = period, command
        self.seen: list[Measurement] = []
        self.times: list[float] = []
        self.starts: list[Measurement] = []

    def start(self, measurement: Measurement) -> int:
        self.starts.append(measurement)
        return 0

    def update(self, t: float, measurement: Measurement, state: int) -> tuple[Any, int]:
        assert state == len(self.seen), "the engine hands back the state it was given"
        self.seen.append(measurement)
        self.times.append(t)
        return self._command, state + 1


class Answering:
    """Answers with ``answer(t)``, whatever that is or raises."""

    period = 1e-3

    def __init__(self, answer: Callable[[float], Any]) -> None:
        self._answer = answer

    def start(self, measurement: Measurement) -> None:
        return None

    def update(self, t: float, measurement: Measurement, state: None) -> tuple[Command, None]:
        return self._answer(t), None

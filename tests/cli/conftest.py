"""The command line as a function: arguments in; exit code and both outputs back."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

import pytest

from umbilical.cli import main, progress


class Outcome(NamedTuple):
    code: int
    out: str
    err: str

    def document(self) -> dict[str, Any]:
        """Stdout as one strict JSON object."""
        return json.loads(self.out, parse_constant=_refuse)


def _refuse(constant: str) -> NoReturn:
    raise AssertionError(f"{constant} is not JSON")


@pytest.fixture
def umbilical(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Callable[..., Outcome]:
    """The command line in this process, as wide as a pipe: a slow machine and a narrow terminal change no output."""
    monkeypatch.setattr(progress, "PATIENCE_IN_LOGS", inf)
    monkeypatch.delenv("COLUMNS", raising=False)

    def call(*arguments: object) -> Outcome:
        capsys.readouterr()
        code = main([str(argument) for argument in arguments])
        printed = capsys.readouterr()
        return Outcome(code, printed.out, printed.err)

    return call


@pytest.fixture(scope="session")
def stored(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Two short results: with motors and with none."""
    from umbilical import load, simulate

    folder = tmp_path_factory.mktemp("stored")
    names = {"driven": "paper", "free": "crosscheck-none"}
    return {
        name: simulate(load(preset, {"duration": 1.0})).save(folder / f"{name}.nc") for name, preset in names.items()
    }

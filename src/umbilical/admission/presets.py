"""The scenarios that come with the package, as text."""

from __future__ import annotations

from functools import lru_cache
from importlib import resources
from typing import Any

from umbilical.errors import FileError
from umbilical.scenario.problems import nearest


def preset_names() -> tuple[str, ...]:
    """Names of the scenarios that come with the package.

    >>> "paper" in preset_names()
    True
    """
    return tuple(sorted(item.name.removesuffix(".toml") for item in _folder().iterdir() if item.name.endswith(".toml")))


def preset_text(name: str) -> str:
    """TOML text of a preset, as it is in the package.

    Raises:
        FileError: there is no such preset.

    >>> preset_text("paper-dead").splitlines()[0]
    'extends = "paper"'
    """
    if name not in preset_names():
        raise FileError(f"{name}: there is no preset of this name; {nearest(name, preset_names())}")
    return (_folder() / f"{name}.toml").read_text(encoding="utf-8")


@lru_cache(maxsize=1)
def _folder() -> Any:
    return resources.files("umbilical.scenario") / "presets"

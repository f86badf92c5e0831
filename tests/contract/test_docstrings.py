"""Every example in a docstring runs and gives what it shows."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import pytest

import umbilical

MODULES = sorted(
    m.name for m in pkgutil.walk_packages(umbilical.__path__, "umbilical.") if m.name != "umbilical.__main__"
)

DOCS = Path(__file__).parents[2] / "docs"
ELSEWHERE = {"design": "design.md", "plot_design": "design.md"}
"""What takes half a minute: its example is on a page, which test_pages.py runs."""


def test_modules_were_found():
    assert len(MODULES) > 50


@pytest.mark.parametrize("name", ["umbilical", *MODULES])
def test_examples(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = importlib.import_module(name)
    assert doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0


@pytest.mark.parametrize("name", umbilical.__all__)
def test_every_public_name_has_an_example(name: str) -> None:
    text = inspect.getdoc(getattr(umbilical, name)) or ""
    if name in ELSEWHERE:
        blocks = re.findall(
            r"^```python\n(.*?)^```", (DOCS / ELSEWHERE[name]).read_text("utf-8"), re.DOTALL | re.MULTILINE
        )
        assert any(f"umbilical.{name}(" in block for block in blocks)
    else:
        assert ">>>" in text


def undescribed(thing: Any) -> list[str]:
    """Arguments of a function, fields of a record, that its docstring does not name before its example."""
    text = (inspect.getdoc(thing) or "").split(">>>")[0]
    if inspect.isclass(thing):
        names = [field.name for field in fields(thing) if field.repr] if is_dataclass(thing) else []
    else:
        names = list(inspect.signature(thing).parameters)
    return [name for name in names if not name.startswith("_") and not re.search(rf"\b{name}s?\b", text)]


@pytest.mark.parametrize("name", umbilical.__all__)
def test_every_argument_and_field_is_described(name: str) -> None:
    assert undescribed(getattr(umbilical, name)) == []


def test_an_argument_that_is_not_described_is_noticed() -> None:
    def draw(run: object, width: float) -> None:
        """Draw a run."""

    assert undescribed(draw) == ["width"]


def test_whatever_reads_a_file_or_a_scenario_says_what_it_raises() -> None:
    readers = [name for name in umbilical.__all__ if name.startswith(("load", "open_", "to_"))]
    judges = ["certify", "compare", "design", "margins", "simulate", "sweep", "tune"]
    assert [n for n in readers + judges if "Raises:" not in (inspect.getdoc(getattr(umbilical, n)) or "")] == []

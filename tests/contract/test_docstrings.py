"""Every example in a docstring runs and gives what it shows."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

import umbilical

MODULES = sorted(
    m.name for m in pkgutil.walk_packages(umbilical.__path__, "umbilical.") if m.name != "umbilical.__main__"
)


def test_modules_were_found():
    assert len(MODULES) > 50


@pytest.mark.parametrize("name", ["umbilical", *MODULES])
def test_examples(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = importlib.import_module(name)
    assert doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0

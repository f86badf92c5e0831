"""docs/paper.md: the paper and what became of its claims, with every number taken from expected.toml."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from writing import page, table

from umbilical.papers.rao2022.expected import published
from umbilical.papers.rao2022.ledger import percent, short

TEMPLATE = Path(__file__).with_name("paper.md")


def paper() -> str:
    """The paper and what became of its claims."""
    expected = published()
    text = TEMPLATE.read_text(encoding="utf-8").replace("{{ledger}}", ledger(expected))
    return page("The paper, reproduced", filled(text, expected).strip())


def ledger(expected: Mapping[str, Any]) -> str:
    """Every claim with its verdict."""
    rows = ((name, claim["statement"], claim["conclusion"]) for name, claim in expected.items())
    return table(("", "claim", "verdict"), rows)


def filled(text: str, expected: Mapping[str, Any]) -> str:
    """The text with ``{{C1.tip_peak}}`` replaced: three digits, ``:%`` in per cent, ``:d`` as a whole number."""

    def number(found: re.Match[str]) -> str:
        claim, name, how = found.groups()
        value = float(expected[claim][name]["value"])
        return percent(value) if how == "%" else str(round(value)) if how == "d" else short(value)

    return re.sub(r"\{\{(\w+)\.(\w+)(?::([%d]))?\}\}", number, text)

"""What the command line says: texts on stdout, news on stderr, JSON without NaN, and exit codes."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from sys import maxsize
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from umbilical.cli.terminal import print_result as say
from umbilical.cli.terminal import report as tell  # noqa: F401 (for the commands)
from umbilical.cli.terminal import width
from umbilical.errors import ScenarioError

if TYPE_CHECKING:
    from umbilical.run import Run

DOES_NOT_HOLD = 7
EXIT_CODES = {
    0: "completed",
    1: "unexpected error: a bug of ours",
    2: "bad input: command line, scenario or file",
    3: "the run diverged; its result up to then is kept",
    4: "a file cannot be written",
    5: "a controller failed",
    6: "an optional package is missing",
    DOES_NOT_HOLD: "what was asked does not hold, or is unresolved",
    130: "interrupted; the result up to then is kept",
}


_NARROWEST = 20
"""Characters of the narrowest column that texts are wrapped in."""


def say_json(document: Mapping[str, Any]) -> None:
    """One JSON object, to stdout."""
    say(json.dumps(plain(document), indent=2, allow_nan=False))


def plain(value: Any) -> Any:
    """The same data as JSON can hold it: what is not finite becomes null.

    >>> plain({"a": (1.0, float("nan"))})
    {'a': [1.0, None]}
    """
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value


def run_document(run: Run, files: Mapping[str, str] | None = None) -> dict[str, Any]:
    """A run as ``--json`` prints it; ``files`` are those it was written to, by role."""
    return {
        "status": run.status.name,
        "reason": run.reason,
        "end_time": run.end_time,
        "scenario": run.scenario.name,
        "scenario_hash": run.scenario.hash,
        "metrics": run.metrics,
        "timing": dict(run.timing),
        "notices": run.notices,
        "assumed": run.scenario.assumed,
        "files": dict(files or {}),
    }


def refusal(error: BaseException, text: str, code: int) -> dict[str, Any]:
    """An error as ``--json`` prints it: the same keys as a run that never began, and every problem."""
    problems = [asdict(problem) for problem in error.problems] if isinstance(error, ScenarioError) else []
    return {
        "status": "REFUSED" if code == 2 else "FAILED",
        "reason": text.splitlines()[0],
        "error": text,
        "exit_code": code,
        "problems": problems,
        "metrics": {},
        "timing": {},
        "scenario_hash": None,
        "notices": [],
    }


def shown_unit(unit: str) -> str:
    """A unit as it stands behind a number: nothing for a pure number."""
    return "" if unit == "1" else unit


def table(rows: Sequence[Sequence[str]], right: Sequence[int] = ()) -> str:
    """Rows of cells as aligned columns; those numbered in ``right`` are flush right. Of a line that is too long for the
    terminal (or for ``COLUMNS``) the last cell is wrapped.

    >>> print(table([("a", "1"), ("bb", "10")], right=[1]))
      a    1
      bb  10
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)] if rows else []
    last = len(widths) - 1
    indent = sum(widths[:-1]) + 2 * len(widths)
    room = max((width() or maxsize) - indent, _NARROWEST)
    lines = []
    for row in rows:
        cells = [f"{c:>{w}}" if k in right else f"{c:<{w}}" for k, (c, w) in enumerate(zip(row, widths, strict=True))]
        if cells and last not in right:
            cells[-1] = f"\n{' ' * indent}".join(wrap(row[-1], room)) if len(row[-1]) > room else row[-1]
        lines.append(("  " + "  ".join(cells)).rstrip())
    return "\n".join(lines)

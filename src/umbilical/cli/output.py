"""What the command line says: texts on stdout, news on stderr, JSON without NaN, and exit codes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from umbilical.cli.terminal import (
    print_result,
    report,  # noqa: F401 (for the commands)
)
from umbilical.errors import ScenarioError
from umbilical.faces.conclusion import DOES_NOT_HOLD
from umbilical.result import ResultFaces
from umbilical.tables import plain

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


def print_json(document: Mapping[str, Any]) -> None:
    """One JSON object, to stdout."""
    print_result(json.dumps(plain(document, finite=True), indent=2, allow_nan=False))


def conclude(result: ResultFaces, *beside: Any, files: Mapping[str, Any] | None = None, as_json: bool) -> int:
    """Print a result by its own face: first line, ``--json`` and exit code follow from one verdict.

    Args:
        result: what was found.
        beside: what its face takes with it, such as an audit.
        files: written ones by role.
        as_json: whether to print one JSON object instead of text.

    Returns:
        The exit code.
    """
    verdict = result.face.conclusion(result, *beside)
    if as_json:
        print_json(verdict.document() | {"files": dict(files or {})} | result.face.to_dict(result, *beside))
    else:
        written = [f"  {role}: {path}" for role, path in (files or {}).items()]
        print_result("\n".join([result.face.summary(result, *beside), *written]))
    return verdict.exit_code


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

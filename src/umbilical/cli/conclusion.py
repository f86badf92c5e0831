"""How a command ends that judges: first line, ``--json`` and exit code follow from one verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from umbilical.cli.output import print_json, print_result
from umbilical.faces.conclusion import Conclusion
from umbilical.result import ResultFaces


def conclude(
    conclusion: Conclusion,
    *,
    text: Callable[[], str],
    document: Callable[[], Mapping[str, Any]],
    files: Mapping[str, Any] | None = None,
    as_json: bool,
) -> int:
    """Print a verdict and what it rests on.

    Args:
        conclusion: the verdict.
        text: makes what is printed below the headline.
        document: makes the rest of the ``--json`` object.
        files: written ones by role, unless ``text`` and ``document`` name them.
        as_json: whether to print one JSON object instead of text.

    Returns:
        The exit code.
    """
    if as_json:
        verdict = conclusion.document()  # first, and not to be contradicted by what a result says of itself
        print_json({**verdict, "files": dict(files or {}), **document(), **verdict})
    else:
        written = [f"  {role}: {path}" for role, path in (files or {}).items()]
        print_result("\n".join(filter(None, [conclusion.headline, text(), *written])))
    return conclusion.exit_code


def conclude_result(result: ResultFaces, *beside: Any, files: Mapping[str, Any] | None = None, as_json: bool) -> int:
    """Print a result by its own faces, as :func:`conclude`; ``beside`` is what they take with it, such as an audit."""
    faces = import_module(result.shown_by)
    return conclude(
        faces.conclusion(result, *beside),
        text=lambda: faces.text(result, *beside),
        document=lambda: faces.document(result, *beside),
        files=files,
        as_json=as_json,
    )

"""Modules of our own are imported inside functions by the command line; elsewhere only where it is listed here."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

SOURCE = Path(__file__).parents[2] / "src"
FILES = {
    ".".join(path.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__"): path
    for path in (SOURCE / "umbilical").rglob("*.py")
}
LATER: dict[str, set[str]] = {}
"""What is imported inside functions outside ``cli/``: kernels and pictures that many callers never need, and what would
be a circle at import."""
CIRCLES: set[frozenset[str]] = set()
"""Files that import one another, imports inside functions counted."""


def imports(text: str) -> set[tuple[str, bool]]:
    """Modules of ours that a text imports, and whether inside a function; what is for type checkers is left out."""
    return set(below(ast.parse(text), False))


def below(node: ast.AST, inside: bool) -> Iterator[tuple[str, bool]]:
    if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
        return
    names = []
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
        full = [f"{node.module}.{alias.name}" for alias in node.names]
        names = [name if name in FILES else node.module for name in full]
    yield from ((name, inside) for name in names if name in FILES)
    inside = inside or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    for part in ast.iter_child_nodes(node):
        if isinstance(part, ast.stmt | ast.ExceptHandler):
            yield from below(part, inside)


@cache
def all_imports() -> dict[str, set[tuple[str, bool]]]:
    return {name: imports(path.read_text(encoding="utf-8")) for name, path in FILES.items()}


def reached(graph: dict[str, set[str]], start: str) -> set[str]:
    """What a file imports, and what that imports."""
    found: set[str] = set()
    new = list(graph[start])
    while new:
        if (name := new.pop()) not in found:
            found.add(name)
            new.extend(graph[name])
    return found


def short(name: str) -> str:
    return name.removeprefix("umbilical.")


def circles(graph: dict[str, set[str]]) -> set[frozenset[str]]:
    """Groups of files each of which is reached from each."""
    far = {name: reached(graph, name) for name in graph}
    return {frozenset(short(other) for other in far[name] if name in far[other]) for name in graph if name in far[name]}


def test_imports_inside_functions_are_the_command_lines_but_for_those_listed() -> None:
    found: dict[str, set[str]] = {}
    for name, imported in all_imports().items():
        later = {short(other) for other, inside in imported if inside}
        if later and not name.startswith("umbilical.cli"):
            found[short(name)] = later
    assert found == LATER


def test_no_circle_of_files_but_for_those_listed() -> None:
    graph = {name: {other for other, _ in imported} for name, imported in all_imports().items()}
    assert circles(graph) == CIRCLES


def test_both_are_noticed() -> None:
    text = "import umbilical.run\ndef f():\n    from umbilical.engine import loop"
    assert imports(text) == {("umbilical.run", False), ("umbilical.engine.loop", True)}
    assert circles({"a": {"b"}, "b": {"a", "c"}, "c": set()}) == {frozenset("ab")}

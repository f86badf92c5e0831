"""Modules of our own are imported inside functions by the command line alone, files import one another in no circle,
and a public name stands in one folder."""

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


def test_imports_inside_functions_are_the_command_lines() -> None:
    found: dict[str, set[str]] = {}
    for name, imported in all_imports().items():
        later = {short(other) for other, inside in imported if inside}
        if later and not name.startswith("umbilical.cli"):
            found[short(name)] = later
    assert found == {}


def test_no_circle_of_files() -> None:
    graph = {name: {other for other, _ in imported} for name, imported in all_imports().items()}
    assert circles(graph) == set()


def shared_names(files: dict[str, str]) -> dict[str, set[str]]:
    """Names of public functions and classes that files of several folders define, and those folders."""
    folders: dict[str, set[str]] = {}
    for folder, text in files.items():
        for part in ast.parse(text).body:
            if isinstance(part, ast.FunctionDef | ast.ClassDef) and not part.name.startswith("_"):
                folders.setdefault(part.name, set()).add(folder.rpartition("/")[0])
    return {name: found for name, found in folders.items() if len(found) > 1}


def test_no_two_folders_give_a_public_name() -> None:
    files = {path.relative_to(SOURCE).as_posix(): path.read_text(encoding="utf-8") for path in FILES.values()}
    assert shared_names(files) == {}
    assert shared_names({"a/x.py": "def f(): ...\ndef _g(): ...", "b/y.py": "class f: ...\ndef _g(): ..."}) == {
        "f": {"a", "b"}
    }


def test_both_are_noticed() -> None:
    text = "import umbilical.run\ndef f():\n    from umbilical.engine import loop"
    assert imports(text) == {("umbilical.run", False), ("umbilical.engine.loop", True)}
    assert circles({"a": {"b"}, "b": {"a", "c"}, "c": set()}) == {frozenset("ab")}

"""Change one operator, comparison, sign or number at a time, and see whether the tests notice.

`.venv/bin/python tools/mutants.py --sample 40 --seed 1` copies the package, changes one place of a sampled file in the
copy, and runs the tests of its folder without the compiler. What no test notices is printed as a row of a table;
docs/mutants.md lists what was found so, with reasons. It is a tool for finding gaps, not a gate: no part of CI.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
NO_COMPILER = {"NUMBA_DISABLE_JIT": "1"}
# Folder of the package: tests that hold it, which of them, and the environment they run in.
FOLDERS: dict[str, tuple[tuple[str, ...], str, dict[str, str]]] = {
    "plant": (("tests/plant", "tests/engine"), "nojit", NO_COMPILER),
    "control": (("tests/control", "tests/engine"), "nojit", NO_COMPILER),
    "engine": (("tests/engine",), "nojit", NO_COMPILER),
    "certificate": (
        tuple(f"tests/analysis/test_{name}.py" for name in ("proof", "bounds", "certificate")),
        "not slow",
        {},
    ),
    "studies": (("tests/studies",), "not slow", {}),
}
SWAPS: dict[type, type] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.And: ast.Or, ast.Or: ast.And,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
}  # fmt: skip
NAMES = {"min": "max", "max": "min", "left": "right", "right": "left"}


def changed(node: ast.AST) -> ast.AST | None:
    """The node with its one change; None for nodes that have none."""
    new: Any = deepcopy(node)
    match new:
        case ast.BinOp() | ast.BoolOp() if type(new.op) in SWAPS:
            new.op = SWAPS[type(new.op)]()
        case ast.Compare() if type(new.ops[0]) in SWAPS:
            new.ops[0] = SWAPS[type(new.ops[0])]()
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            new = new.operand
        case ast.AugAssign():
            new = ast.Assign([new.target], new.value)
        case ast.Name(id=name) if name in NAMES:
            new.id = NAMES[name]
        case ast.Constant(value=str() as text) if text in NAMES:
            new.value = NAMES[text]
        case ast.Constant(value=bool() as value):
            new.value = not value
        case ast.Constant(value=int() | float() as value):
            new.value = value + 1 if isinstance(value, int) else 2.0 * value or 1.0
        case _:
            return None
    return ast.copy_location(new, node)


class Change(ast.NodeTransformer):
    """Visits the places of a file in a fixed order; replaces the one of the given number, and keeps what it was."""

    def __init__(self, number: int = -1) -> None:
        self.number, self.count, self.row = number, 0, ""

    def visit(self, node: ast.AST) -> Any:
        """Messages, type hints and decorators are left alone: they are not what a model computes."""
        if isinstance(node, ast.JoinedStr | ast.Raise | ast.ImportFrom | ast.arg):
            return node
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            node.body = [self.visit(part) for part in node.body]
            return node
        if new := changed(node):
            self.count += 1
            if self.count - 1 == self.number:
                self.row = f"{getattr(node, 'lineno', 0)} | `{ast.unparse(node)}` | `{ast.unparse(new)}`"
                return new
        return self.generic_visit(node)


def places(folder: str) -> Iterator[tuple[str, Path, int]]:
    """Every change of a folder: the folder, the file within the package, and the number of the place."""
    for path in sorted((ROOT / "src/umbilical" / folder).rglob("*.py")):
        visitor = Change()
        visitor.visit(ast.parse(path.read_text(encoding="utf-8")))
        for number in range(visitor.count):
            yield folder, path.relative_to(ROOT / "src"), number


def noticed(folder: str, package: Path, limit: float) -> bool:
    """Whether the folder's tests fail on the package as it is, or take longer than the limit, s."""
    tests, mark, environment = FOLDERS[folder]
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "-m", mark, *tests]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", **environment, "PYTHONPATH": str(package)}
    try:
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return True
    return done.returncode != 0


def survives(place: tuple[str, Path, int], package: Path, limit: float) -> str:
    """The row of a change that no test notices; empty if one does."""
    folder, name, number = place
    file = package / name
    original = file.read_text(encoding="utf-8")
    change = Change(number)
    tree = ast.fix_missing_locations(change.visit(ast.parse(original)))
    file.write_text(ast.unparse(tree), encoding="utf-8")
    try:
        return "" if noticed(folder, package, limit) else f"| `{name.relative_to('umbilical')}` | {change.row} |"
    finally:
        file.write_text(original, encoding="utf-8")


def main() -> int:
    """Sample, try, and print the survivors; 1 if the tests fail without any change."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sample", type=int, default=40, help="changes to try")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=300.0, help="longest time for the tests of one change, s")
    parser.add_argument("--budget", type=float, default=float("inf"), help="begin no change after this time, s")
    parser.add_argument("folders", nargs="*", default=list(FOLDERS))
    options = parser.parse_args()
    every = [place for folder in options.folders for place in places(folder)]
    chosen = random.Random(options.seed).sample(every, min(options.sample, len(every)))
    with tempfile.TemporaryDirectory() as scratch:
        package, tried, rows = Path(scratch), 0, []
        shutil.copytree(ROOT / "src/umbilical", package / "umbilical", ignore=shutil.ignore_patterns("__pycache__"))
        if failing := [folder for folder in options.folders if noticed(folder, package, options.limit)]:
            print(f"the tests fail, or take too long, without any change: {', '.join(failing)}")
            return 1
        begun = time.monotonic()
        for place in chosen:
            if time.monotonic() - begun > options.budget:
                break
            tried, row = tried + 1, survives(place, package, options.limit)
            print(row or ".", flush=True)
            rows += [row] * bool(row)
    print(f"\n{tried} of {len(every)} changes tried (seed {options.seed}), {len(rows)} not noticed")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

"""Imports point only downward, and the rule that says so can fail."""

from __future__ import annotations

import ast
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAM = shutil.which("lint-imports", path=str(Path(sys.executable).parent))

lint = pytest.mark.skipif(PROGRAM is None, reason="needs the extra `dev`")


def lint_imports(folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(PROGRAM), "--no-cache", "--config", folder / "pyproject.toml"],
        cwd=folder,
        env={"PYTHONPATH": str(folder / "src"), "PYTHONUTF8": "1"},
        capture_output=True,
        text=True,
        check=False,
    )


@lint
def test_the_contracts_hold():
    done = lint_imports(ROOT)
    assert done.returncode == 0, done.stdout + done.stderr


@lint
@pytest.mark.parametrize(
    ("module", "line"),
    [
        ("scenario/base.py", "import umbilical.run"),
        ("plant/layout.py", "import umbilical.control"),
        ("control/__init__.py", "import umbilical.plant"),
        ("errors.py", "import umbilical.quantities"),
        ("run.py", "import numba"),
        ("run.py", "import matplotlib.pyplot"),
        ("papers/rao2022/claims.py", "import umbilical.engine.loop"),
    ],
)
def test_an_import_that_points_upward_or_outside_is_noticed(tmp_path, module, line):
    shutil.copytree(ROOT / "src", tmp_path / "src", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    with (tmp_path / "src" / "umbilical" / module).open("a") as file:
        file.write(f"\n{line}\n")
    done = lint_imports(tmp_path)
    assert done.returncode != 0
    assert "BROKEN" in done.stdout


def imported_of_ours(source: str) -> set[str]:
    """Modules of this package that a file imports, but for the references of the verification."""
    names = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {name.name for name in node.names}
        if isinstance(node, ast.ImportFrom):
            names.add("." * node.level + (node.module or ""))
    return {n for n in names if n.startswith((".", "umbilical")) and not n.startswith("umbilical.verify.references")}


def test_what_judges_the_engine_imports_nothing_of_this_package() -> None:
    files = [*(ROOT / "src" / "umbilical" / "verify" / "references").glob("*.py")]
    assert len(files) > 10
    assert {file.name: found for file in files if (found := imported_of_ours(file.read_text(encoding="utf-8")))} == {}
    assert imported_of_ours("def f():\n    from umbilical.engine import simulate") == {"umbilical.engine"}

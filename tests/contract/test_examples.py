"""The examples run as they are, each in a process and a folder of its own."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


@pytest.fixture
def play(tmp_path):
    def run(example: Path) -> str:
        done = subprocess.run([sys.executable, example], cwd=tmp_path, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
        return done.stdout

    return run


def test_the_first_run_leaves_a_result_and_a_picture(play, tmp_path):
    assert "paper: COMPLETED" in play(ROOT / "examples" / "first_run.py")
    assert (tmp_path / "paper.nc").exists()
    assert (tmp_path / "paper.png").read_bytes().startswith(b"\x89PNG")


def test_the_controller_of_ones_own_damps_and_is_short(play):
    example = ROOT / "examples" / "own_controller.py"
    free, damped = map(float, re.findall(r"([\d.]+) m", play(example)))
    assert damped < 0.2 * free
    assert len(example.read_text().splitlines()) < 40


def test_the_readme_shows_the_first_example():
    body = (ROOT / "examples" / "first_run.py").read_text().split('"""', 2)[2].strip()
    assert f"```python\n{body}\n```" in (ROOT / "README.md").read_text()


@pytest.mark.slow
def test_learning_with_stable_baselines3(play):
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is not installed; it brings torch")
    assert "boundary law: return -" in play(ROOT / "examples" / "learn_with_sb3.py")


def test_no_example_is_left_out():
    """Of plant_fmu.py an FMU is built: tests/interop/test_plant_fmu.py."""
    names = {example.name for example in EXAMPLES}
    assert names == {"first_run.py", "own_controller.py", "learn_with_sb3.py", "plant_fmu.py"}

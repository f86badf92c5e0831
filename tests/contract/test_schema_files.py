"""Every preset passes the published JSON Schema in a checker that is not ours."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PRESETS = sorted((ROOT / "src" / "umbilical" / "scenario" / "presets").glob("*.toml"))


def check(*files: Path) -> subprocess.CompletedProcess[str]:
    schema = ROOT / "docs" / "scenario.schema.json"
    command = [sys.executable, "-m", "check_jsonschema", "--schemafile", schema, *files]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_presets_keep_the_published_schema() -> None:
    assert len(PRESETS) > 15
    done = check(*PRESETS)
    assert done.returncode == 0, done.stdout


def test_a_misspelt_key_is_noticed(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.toml"
    wrong.write_text('extends = "paper"\n[payload]\nmas = 400.0\n', encoding="utf-8")
    done = check(wrong)
    assert done.returncode == 1
    assert "mas" in done.stdout

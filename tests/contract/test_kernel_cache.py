"""Compiled kernels on disk: damage is mended, folders of others are left alone, and no disk stops a run."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

posix = pytest.mark.skipif(os.name == "nt", reason="permissions of POSIX")
PROGRAM = """
import sys
from umbilical import kernel_cache
if "full" in sys.argv:
    def _full(*_):
        raise OSError(28, "No space left on device")
    kernel_cache.IndexDataCacheFile._open_for_write = _full
from umbilical.compile import cache_folder, entry_kernel

@entry_kernel
def twice(x):
    return 2.0 * x

assert twice(3.0) == 6.0
print(sum(twice.stats.cache_hits.values()), cache_folder())
"""


@pytest.fixture
def program(tmp_path, monkeypatch):
    script = tmp_path / "program.py"
    script.write_text(PROGRAM)
    for name in ("NUMBA_DISABLE_JIT", "UMBILICAL_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)

    def run(*words: str, **environment: str) -> tuple[int, Path, str]:
        """How many kernels came from the disk, where they are, and what was said."""
        done = subprocess.run(
            [sys.executable, str(script), *words],
            env=os.environ | environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        hits, folder = done.stdout.strip().split(" ", 1)
        return int(hits), Path(folder), done.stderr

    return run


def test_damaged_files_are_compiled_anew_and_replaced(program, tmp_path):
    cache = str(tmp_path / "cache")
    assert program(UMBILICAL_CACHE=cache)[0] == 0
    hits, folder, said = program(UMBILICAL_CACHE=cache)
    assert (hits, said) == (1, "")
    files = [path for path in folder.rglob("*twice*") if path.suffix in (".nbc", ".nbi")]
    assert len(files) == 2
    for path, empty in zip(files, (True, False), strict=True):
        whole = path.read_bytes()
        middle = len(whole) // 2
        flipped = whole[:middle] + bytes([whole[middle] ^ 1]) + whole[middle + 1 :]
        for damaged in (b"" if empty else whole[:middle], flipped):
            path.write_bytes(damaged)
            assert program(UMBILICAL_CACHE=cache)[0] == 0
    assert program(UMBILICAL_CACHE=cache)[0] == 1


@posix
def test_a_folder_that_others_can_write_to_is_not_loaded(program, tmp_path):
    cache, temporary = str(tmp_path / "cache"), tmp_path / "tmp"
    temporary.mkdir()
    folder = program(UMBILICAL_CACHE=cache)[1]
    folder.chmod(0o777)
    for hits in (0, 1):
        found, other, said = program(UMBILICAL_CACHE=cache, TMPDIR=str(temporary))
        assert found == hits
        assert other.parent.parent == temporary
        assert other.stat().st_mode & 0o077 == 0
        assert "can be written to by others" in said


@posix
def test_without_a_writable_home_every_process_uses_the_same_folder(program, tmp_path):
    temporary, home = tmp_path / "tmp", tmp_path / "home"
    temporary.mkdir()
    home.write_text("no folder can be made here")
    found = [program(HOME=str(home), TMPDIR=str(temporary)) for _ in range(2)]
    assert [hits for hits, _, _ in found] == [0, 1]
    assert found[0][1] == found[1][1]
    assert all("kept in" in said and "cannot be written" in said for _, _, said in found)


def test_a_full_disk_means_compiling_again_and_is_said_once(program, tmp_path):
    for _ in range(2):
        hits, _, said = program("full", UMBILICAL_CACHE=str(tmp_path / "cache"))
        assert hits == 0
        assert said.count("cannot be kept (No space left on device)") == 1

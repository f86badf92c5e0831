"""What is on the disk: resumable wherever it was cut, locked, whole or not at all."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.studies import small_study
from umbilical.errors import FileError, OutputError
from umbilical.studies import journal
from umbilical.studies.journal import Journal, entries
from umbilical.studies.store import open_store
from umbilical.studies.sweep import sweep

posix = pytest.mark.skipif(os.name == "nt", reason="signals, limits and permissions of POSIX")


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    """The folder of an uninterrupted sweep."""
    folder = tmp_path_factory.mktemp("whole") / "out"
    sweep(small_study(), folder)
    return folder


def test_cut_at_any_byte_a_journal_resumes_to_the_same_bytes(whole, tmp_path):
    text = (whole / "journal.txt").read_bytes()
    generator = random.Random(1)
    for cut in [0, 1, len(text) - 1, *(generator.randrange(len(text)) for _ in range(5))]:
        folder = tmp_path / str(cut)
        folder.mkdir()
        shutil.copy(whole / "manifest.json", folder)
        (folder / "journal.txt").write_bytes(text[:cut])
        sweep(small_study(), folder, resume=True)
        assert (folder / "study.nc").read_bytes() == (whole / "study.nc").read_bytes()


def test_a_journal_gives_back_the_very_numbers(tmp_path):
    numbers = [0.1 + 0.2, 1e-320, float("inf"), -0.0, 1e308]
    written = Journal(tmp_path / "j")
    written.append(numbers)
    written.append([float("nan")])
    written.close()
    first, second = entries(tmp_path / "j")
    assert [number.hex() for number in first] == [number.hex() for number in numbers]
    assert second[0] != second[0]


def test_a_finished_study_is_not_run_again(whole, monkeypatch):
    before = (whole / "study.nc").read_bytes()
    monkeypatch.setattr("umbilical.studies.sweep.run_member", lambda *_: pytest.fail("it ran"))
    sweep(small_study(), whole, resume=True)
    assert (whole / "study.nc").read_bytes() == before


def test_what_is_there_is_neither_overwritten_nor_mixed(whole, tmp_path):
    with pytest.raises(OutputError, match="--resume goes on with it"):
        sweep(small_study(), whole)
    with pytest.raises(FileError, match="begun with another study"):
        sweep(small_study(seed=5), whole, resume=True)
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"holds thesis\.txt"):
        sweep(small_study(), tmp_path, force=True)
    assert [entry.name for entry in tmp_path.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize(
    "mine",
    [
        {"journal.txt": "dear diary", "runs/data.txt": "mine"},
        {"manifest.json": '{"name": "of another program"}', "runs/member-1-arm-1.nc": "mine"},
        {"manifest.json": "not JSON", "study.nc": "mine"},
        {"lock": "a key"},
        {"deep/.umbilical-1.part": "mine"},
    ],
)
def test_files_of_others_are_left_alone_whatever_their_names(tmp_path, mine, force):
    for name, text in mine.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    with pytest.raises(OutputError, match="and no study"):
        sweep(small_study(), tmp_path, force=force)
    assert {name: (tmp_path / name).read_text() for name in mine} == mine
    assert sum(entry.is_file() for entry in tmp_path.rglob("*")) == len(mine)


def test_force_begins_anew_and_removes_what_is_ours_only(tmp_path):
    sweep(small_study(members=2, trajectories={"keep": "all"}), tmp_path / "out")
    (tmp_path / "out" / "runs" / "notes.txt").write_text("mine")
    found = sweep(small_study(members=3), tmp_path / "out", force=True)
    assert found.data.sizes["member"] == 3
    assert len(list(entries(tmp_path / "out" / "journal.txt"))) == 3
    assert [entry.name for entry in (tmp_path / "out" / "runs").iterdir()] == ["notes.txt"]


def test_what_a_killed_process_left_is_ours(tmp_path):
    (tmp_path / "lock").touch()
    (tmp_path / f".umbilical-{7:016x}.part").write_text("half a manifest")
    sweep(small_study(members=2), tmp_path)
    assert not (tmp_path / f".umbilical-{7:016x}.part").exists()


def test_two_processes_never_share_a_folder(tmp_path):
    study = small_study()
    with (
        open_store(tmp_path / "out", study, "sweep", resume=False, force=False),
        pytest.raises(OutputError, match="another process is at work"),
    ):
        sweep(study, tmp_path / "out", resume=True)


@posix
def test_a_full_disk_keeps_what_was_finished_and_nothing_by_halves(tmp_path, whole):
    import resource

    study = small_study(members=50)
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, ((whole / "manifest.json").stat().st_size + 1000, hard))
    try:
        with pytest.raises(OutputError, match="File too large"):
            sweep(study, tmp_path / "out")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    text = (tmp_path / "out" / "journal.txt").read_bytes()
    assert text.endswith(b"\n")
    assert 0 < len(list(entries(tmp_path / "out" / "journal.txt"))) < 50
    assert not list((tmp_path / "out").glob(".*.part"))
    assert not (tmp_path / "out" / "study.nc").exists()
    sweep(study, tmp_path / "out", resume=True)
    sweep(study, tmp_path / "roomy")
    assert (tmp_path / "out" / "study.nc").read_bytes() == (tmp_path / "roomy" / "study.nc").read_bytes()


@posix
def test_a_read_only_folder_is_named_as_the_reason(tmp_path):
    if os.geteuid() == 0:
        (tmp_path / "file").write_text("")
        with pytest.raises(OutputError, match="cannot be made"):
            sweep(small_study(), tmp_path / "file" / "out")
        return
    tmp_path.chmod(0o555)
    with pytest.raises(OutputError, match="Permission denied"):
        sweep(small_study(), tmp_path / "out")


SCRIPT = """
import sys
from tests.support.studies import small_study
from umbilical.studies.sweep import sweep
sweep(small_study(members=60), sys.argv[1], jobs=2, resume="resume" in sys.argv)
"""


def start(folder: Path, *options: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen([sys.executable, "-c", SCRIPT, str(folder), *options], cwd=Path(__file__).parents[2])


@posix
@pytest.mark.slow
def test_killed_at_twenty_random_moments_it_resumes_to_the_same_bytes(tmp_path):
    """Every kill falls between the first written row and the result, or the sweep is over before it."""
    assert start(tmp_path / "whole").wait() == 0
    expected = (tmp_path / "whole" / "study.nc").read_bytes()
    size = (tmp_path / "whole" / "journal.txt").stat().st_size
    generator, kills = random.Random(7), 0
    for attempt in range(20):
        folder = tmp_path / str(attempt)
        process = start(folder)
        wanted = generator.randrange(size)
        while process.poll() is None:
            if (folder / "journal.txt").exists() and (folder / "journal.txt").stat().st_size >= wanted:
                time.sleep(generator.random() * 0.01)
                process.send_signal(signal.SIGKILL)
                break
            time.sleep(0.0005)
        kills += process.wait() == -signal.SIGKILL
        assert start(folder, "resume").wait() == 0
        assert (folder / "study.nc").read_bytes() == expected
        assert not [entry for entry in folder.iterdir() if entry.name.startswith(".umbilical")]
    assert kills >= 15


@posix
def test_killed_in_the_middle_of_a_write_it_resumes_to_the_same_bytes(tmp_path, whole):
    """The process dies with half a line on the disk."""
    script = SCRIPT.replace("members=60", "members=12").replace(
        "sweep(small", "from umbilical.studies import journal\nimport os\n"
        "def half(self, line):\n"
        "    self._file.write(line[: len(line) // 2]); os.kill(os.getpid(), 9) if self._size > 2000 else "
        "self._file.write(line[len(line) // 2 :])\n"
        "journal.Journal._write = half\nsweep(small",
    )  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "out")], cwd=Path(__file__).parents[2], check=False
    )
    assert done.returncode == -9
    assert not (tmp_path / "out" / "journal.txt").read_bytes().endswith(b"\n")
    sweep(small_study(), tmp_path / "out", resume=True)
    assert (tmp_path / "out" / "study.nc").read_bytes() == (whole / "study.nc").read_bytes()


def test_a_journal_that_forgot_its_checksums_would_be_noticed(whole, tmp_path, monkeypatch):
    """Negative control of the cuts above: half a line that is believed ends in an error or in other bytes."""
    monkeypatch.setattr(journal, "is_whole_line", lambda line: True)
    shutil.copytree(whole, tmp_path / "out")
    (tmp_path / "out" / "study.nc").unlink()
    text = (whole / "journal.txt").read_bytes()
    (tmp_path / "out" / "journal.txt").write_bytes(text[: text.index(b"\n") + 200])
    with pytest.raises(FileError, match="is not what Umbilical writes"):
        sweep(small_study(), tmp_path / "out", resume=True)

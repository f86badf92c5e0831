"""A file appears whole or not at all, and what was there before is never lost."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import threading
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from umbilical import files
from umbilical.errors import FileError, OutputError

posix = pytest.mark.skipif(os.name == "nt", reason="limits and permissions of POSIX")


def names(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


@pytest.fixture
def ordinary_user():
    """Root may write anywhere, so these tests step down to nobody for a moment."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)


def test_writes_exactly_the_content_and_nothing_else(tmp_path):
    content = bytes(range(256)) * 100
    assert files.write(tmp_path / "a.bin", content).read_bytes() == content
    assert names(tmp_path) == ["a.bin"]


@posix
def test_a_new_file_has_the_permissions_any_other_would(tmp_path):
    (tmp_path / "plain").write_bytes(b"")
    files.write(tmp_path / "ours", b"")
    modes = {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("plain", "ours")}
    assert len(modes) == 1


def test_refuses_to_replace_a_file_unless_forced(tmp_path):
    target = tmp_path / "a.nc"
    files.write(target, b"old")
    with pytest.raises(OutputError, match="exists already"):
        files.write(target, b"new")
    assert target.read_bytes() == b"old"
    files.write(target, b"new", force=True)
    assert target.read_bytes() == b"new"
    assert names(tmp_path) == ["a.nc"]


def test_of_many_writers_at_once_exactly_one_wins(tmp_path):
    target, start, results = tmp_path / "a.nc", threading.Barrier(8), []

    def contend(k: int) -> None:
        start.wait()
        try:
            files.write(target, bytes([k]) * 1000)
            results.append(k)
        except OutputError:
            pass

    threads = [threading.Thread(target=contend, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 1
    assert target.read_bytes() == bytes(results) * 1000
    assert names(tmp_path) == ["a.nc"]


def test_a_disk_without_links_still_gets_the_file_and_still_refuses(tmp_path, monkeypatch):
    def no_links(self, other):
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(Path, "hardlink_to", no_links)
    files.write(tmp_path / "a.nc", b"old")
    with pytest.raises(OutputError, match="exists already"):
        files.write(tmp_path / "a.nc", b"new")
    assert (tmp_path / "a.nc").read_bytes() == b"old"


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize(
    ("target", "message"),
    [(".", "this is a folder"), ("missing/a.nc", "there is no folder"), ("n" * 300, "File name too long")],
)
def test_refuses_a_target_that_cannot_be_a_file(tmp_path, target, message, force):
    with pytest.raises(OutputError, match=message):
        files.write(tmp_path / target, b"x", force=force)
    assert names(tmp_path) == []


@posix
def test_refuses_to_replace_a_device_even_when_forced(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OutputError, match="not an ordinary file"):
        files.write(tmp_path / "pipe", b"x", force=True)
    assert stat.S_ISFIFO((tmp_path / "pipe").stat().st_mode)


@posix
def test_a_read_only_folder_is_named_as_the_reason(ordinary_user):
    with TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o555)
        with pytest.raises(OutputError, match="Permission denied"):
            files.write(folder / "a.nc", b"x")
        folder.chmod(0o755)
        assert names(folder) == []


@posix
def test_a_full_disk_leaves_the_old_file_and_no_trace_of_the_new(tmp_path):
    import resource

    target = tmp_path / "a.nc"
    files.write(target, b"old")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, hard))
    try:
        with pytest.raises(OutputError, match="File too large"):
            files.write(target, bytes(10_000), force=True)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert target.read_bytes() == b"old"
    assert names(tmp_path) == ["a.nc"]


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError])
def test_an_interruption_before_the_name_is_given_leaves_nothing(tmp_path, monkeypatch, error):
    def interrupted(*_):
        raise error

    monkeypatch.setattr(files, "_publish", interrupted)
    with pytest.raises(error):
        files.write(tmp_path / "a.nc", b"x")
    assert names(tmp_path) == []


@posix
def test_killed_while_writing_the_target_holds_the_old_content(tmp_path):
    target = tmp_path / "a.nc"
    files.write(target, b"old")
    script = (
        "import os, sys; from umbilical import files\n"
        "files.os.fsync = lambda number: os.kill(os.getpid(), 9)\n"
        "files.write(sys.argv[1], b'new' * 1000, force=True)\n"
    )
    done = subprocess.run([sys.executable, "-c", script, target], check=False)
    assert done.returncode == -9
    assert target.read_bytes() == b"old"


def test_read_says_what_is_wrong(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        files.read(tmp_path / "missing.nc")
    with pytest.raises(FileError, match=r"folder, not a file|cannot be read"):
        files.read(tmp_path)


@posix
def test_read_names_a_file_it_may_not_open(ordinary_user):
    with TemporaryDirectory() as name:
        secret = Path(name, "a.nc")
        secret.write_bytes(b"x")
        secret.chmod(0)
        with pytest.raises(FileError, match=r"cannot be read \(Permission denied\)"):
            files.read(secret)


@posix
def test_read_takes_ordinary_files_only_and_no_name_is_an_accident(tmp_path):
    with pytest.raises(FileError, match="not an ordinary file"):
        files.read("/dev/zero")
    with pytest.raises(FileError, match="larger than"):
        files.read_text("/dev/zero")
    for name in ("a\0b", "n" * 300):
        with pytest.raises(FileError, match="cannot be read"):
            files.read(tmp_path / name)
        with pytest.raises(OutputError, match="cannot be written"):
            files.write(tmp_path / name, b"")


@posix
def test_a_link_is_followed_and_one_that_leads_nowhere_is_refused(tmp_path):
    real, link = tmp_path / "real.nc", tmp_path / "link.nc"
    link.symlink_to(real)
    for force in (False, True):
        with pytest.raises(OutputError, match=r"a link to .*real\.nc, which is not there"):
            files.check_free(link, force=force)
        with pytest.raises(OutputError, match="which is not there"):
            files.write(link, b"new", force=force)
    real.write_bytes(b"old")
    with pytest.raises(OutputError, match="exists already"):
        files.write(link, b"new")
    files.write(link, b"new", force=True)
    assert link.is_symlink()
    assert real.read_bytes() == b"new"


@posix
def test_what_a_killed_process_left_is_removed_by_the_next_and_nothing_else(tmp_path):
    script = (
        "import os, sys; from umbilical import files\n"
        "files.os.fsync = lambda number: {}\n"
        "files.write(sys.argv[1], b'n')"
    )
    stuck = "(print('writing', flush=True), input())"
    with subprocess.Popen(
        [sys.executable, "-c", script.format(stuck), tmp_path / "b"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as living:
        assert living.stdout is not None
        living.stdout.readline()
        subprocess.run([sys.executable, "-c", script.format("os.kill(os.getpid(), 9)"), tmp_path / "a"], check=False)
        others = {".umbilical-mine.part", f".umbilical-{'0' * 16}.part.txt"}
        for name in others:
            (tmp_path / name).write_bytes(b"")
        assert sum(name.endswith(".part") for name in names(tmp_path)) == 3
        files.write(tmp_path / "c", b"c")
        assert sum(name.endswith(".part") for name in names(tmp_path)) == 2
        living.communicate("\n")
    assert set(names(tmp_path)) == {"b", "c", *others}

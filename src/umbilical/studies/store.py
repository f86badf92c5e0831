"""The folder of a study: manifest, journal, result, and a lock, so that two processes never share one."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

from umbilical import __version__, files
from umbilical.errors import FileError, OutputError
from umbilical.studies.journal import Journal, entries
from umbilical.studies.rows import NAMES
from umbilical.studies.study import Study

MANIFEST, JOURNAL, LOCK, RUNS = "manifest.json", "journal.txt", "lock", "runs"
RESULTS = ("study.nc", "tuning.json", "tuned.toml")


class Store:
    """The open folder of a study, locked by this process."""

    def __init__(self, folder: Path, journal: Journal) -> None:
        self.folder = folder
        self.journal = journal

    def entries(self) -> Iterator[Any]:
        """Every line of the journal so far."""
        return entries(self.folder / JOURNAL)

    def save(self, content: bytes, name: str) -> Path:
        """A file of the folder, whole or not at all; what is there already came from the same study."""
        path = self.folder / name
        _make(path.parent)
        return files.write(path, content, force=True)


@contextmanager
def open_store(folder: Path, study: Study, task: str, *, resume: bool, force: bool) -> Iterator[Store]:
    """The folder of a study, made if need be.

    Args:
        folder: where its files are.
        study: what is run; ``resume`` refuses the parts of another.
        task: what is done with it, and by what means.
        resume: go on with what is there.
        force: begin anew, and remove what is there.

    Raises:
        OutputError: the folder cannot be made or written, is in use, or holds something already.
        FileError: what is there belongs to another study or was made by another version.
    """
    _make(folder)
    _refuse_strangers(folder)
    with _locked(folder):
        for part in folder.rglob(".umbilical-*.part"):
            part.unlink()  # of a process that was killed while it wrote
        if force:
            _clear(folder)
        _settle(folder, study, task, resume)
        journal = Journal(folder / JOURNAL)
        try:
            yield Store(folder, journal)
        finally:
            journal.close()


def fingerprint(study: Study, task: str) -> dict[str, Any]:
    """What must be equal for two parts of a study to fit together bit for bit."""
    from umbilical.compile import cache_folder

    kernels = cache_folder().name  # a hash of every kernel source and of the versions that compile them
    return {
        "task": task,
        "study_hash": study.hash,
        "version": __version__,
        "kernels": kernels,
        "metrics": list(NAMES),
    }


def _settle(folder: Path, study: Study, task: str, resume: bool) -> None:
    """Write the manifest into a new folder, or compare with the one that is there."""
    path, mine = folder / MANIFEST, fingerprint(study, task)
    if not path.exists():
        (folder / JOURNAL).unlink(missing_ok=True)  # whose it was nobody knows
        content = {**mine, "name": study.name, "study": study.to_toml()}
        files.write(path, (json.dumps(content, indent=1) + "\n").encode())
        return
    if not resume:
        raise OutputError(f"{folder}: holds a study already; --resume goes on with it, --force begins anew")
    try:
        found = json.loads(files.read(path))
    except ValueError as error:
        raise FileError(f"{path}: this is not a manifest ({error}); --force begins anew") from error
    different = [name for name, value in mine.items() if found.get(name) != value]
    if different:
        reason = _WORDS[different[0]]
        raise FileError(f"{folder}: was begun with {reason}, and the parts would not fit; --force begins anew")


_WORDS = {
    "task": "another task, or with another optimiser",
    "study_hash": "another study",
    "version": "another version of Umbilical",
    "kernels": "other kernels",
    "metrics": "other metrics",
}


def _refuse_strangers(folder: Path) -> None:
    """Leave folders alone that hold something else."""
    ours = (LOCK, JOURNAL, RUNS)
    strangers = [e.name for e in folder.iterdir() if e.name not in ours and not e.name.startswith(".umbilical-")]
    if strangers and MANIFEST not in strangers:
        raise OutputError(f"{folder}: holds {min(strangers)}, and no study; name another folder")


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be made ({error.strerror})") from error


def _clear(folder: Path) -> None:
    """Remove what this module wrote, and nothing else."""
    for name in (MANIFEST, *RESULTS, JOURNAL):  # the manifest first: without it nothing counts
        (folder / name).unlink(missing_ok=True)
    shutil.rmtree(folder / RUNS, ignore_errors=True)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Held by the system for as long as this process lives: one that was killed holds nothing."""
    try:
        file = (folder / LOCK).open("ab")
    except OSError as error:
        raise OutputError(f"{folder}: cannot be written to ({error.strerror})") from error
    with file:
        if not _lock(file):
            raise OutputError(f"{folder}: another process is at work there; wait for it, or name another folder")
        yield


def _lock(file: IO[bytes]) -> bool:
    try:
        if os.name == "nt":
            import msvcrt

            locking: Any = msvcrt
            locking.locking(file.fileno(), locking.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True

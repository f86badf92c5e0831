"""The folder of a study: manifest, journal, result, and a lock, so that two processes never share one."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from umbilical import __version__, files
from umbilical import compile as compiling
from umbilical.errors import FileError, OutputError
from umbilical.studies.journal import Journal, entries
from umbilical.studies.rows import NAMES
from umbilical.studies.study import Study

MANIFEST, JOURNAL, LOCK, RUNS = "manifest.json", "journal.txt", "lock", "runs"
RESULTS = ("study.nc", "tuning.json", "tuned-[0-9]*.toml")
STORED = "member-*-arm-*.nc"
"""Complete runs, in the folder ``runs``."""
_PARTS = ".umbilical-*.part"
"""What a process leaves that was killed while it wrote."""


@dataclass(frozen=True)
class Store:
    """The open folder of a study, locked by this process."""

    folder: Path
    journal: Journal

    def entries(self) -> Iterator[Any]:
        """Every line of the journal so far."""
        return entries(self.folder / JOURNAL)

    def save(self, content: bytes, name: str) -> Path:
        """A file of the folder, whole or not at all; what is there already came from the same study."""
        path = self.folder / name
        files.make_folder(path.parent)
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
    files.make_folder(folder)
    _refuse_strangers(folder, resume)
    with _locked(folder):
        for place in (folder, folder / RUNS):
            files.remove_stale_parts(place)
        if force:
            _clear(folder)
        _settle(folder, study, task, resume)
        with closing(Journal(folder / JOURNAL)) as journal:
            yield Store(folder, journal)


def study_fingerprint(study: Study, task: str) -> dict[str, Any]:
    """What must be equal for two parts of a study to fit together bit for bit."""
    kernels = compiling.cache_folder().name  # a hash of every kernel source and of the versions that compile them
    found = (task, study.hash, __version__, kernels, list(NAMES))
    return dict(zip(_WORDS, found, strict=True))


def _settle(folder: Path, study: Study, task: str, resume: bool) -> None:
    """Write the manifest into a new folder, or compare with the one that is there."""
    mine, found = study_fingerprint(study, task), _manifest(folder)
    if found is None:
        content = {**mine, "name": study.name, "study": study.to_toml()}
        files.write(folder / MANIFEST, (json.dumps(content, indent=1) + "\n").encode())
    elif not resume:
        raise OutputError(f"{folder}: holds a study already; --resume goes on with it, --force begins anew")
    elif different := [reason for name, reason in _WORDS.items() if found[name] != mine[name]]:
        raise FileError(f"{folder}: was begun with {different[0]}, and the parts would not fit; --force begins anew")


def _manifest(folder: Path) -> dict[str, Any] | None:
    """What the folder's manifest says, if it is one of ours: only then are its files."""
    try:
        found = json.loads((folder / MANIFEST).read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) and found.keys() >= _WORDS.keys() else None


_WORDS = {
    "task": "another task, or with another optimiser",
    "study_hash": "another study",
    "version": "another version of Umbilical",
    "kernels": "other kernels",
    "metrics": "other metrics",
}


def _refuse_strangers(folder: Path, resume: bool) -> None:
    """Leave folders alone that hold something else: without a manifest no file is ours, whatever its name."""
    lock = folder / LOCK  # ours is an empty file
    ours = [lock.name] if lock.is_file() and lock.stat().st_size == 0 else []
    strangers = sorted(e.name for e in folder.iterdir() if e.name not in ours and not e.match(_PARTS))
    if strangers and _manifest(folder) is None:
        if resume and MANIFEST in strangers:
            raise FileError(f"{folder / MANIFEST}: is damaged, or no manifest of a study; name another folder")
        raise OutputError(f"{folder}: holds {strangers[0]}, and no study; name another folder")


def _clear(folder: Path) -> None:
    """Remove what this module wrote, and nothing else; the manifest last, which says whose all the rest is."""
    for pattern in (*RESULTS, JOURNAL, f"{RUNS}/{STORED}", MANIFEST):
        for path in folder.glob(pattern):
            path.unlink()
    with suppress(OSError):  # it is not there, or holds what is not ours
        (folder / RUNS).rmdir()


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Held by the system for as long as this process lives: one that was killed holds nothing."""
    try:
        file = (folder / LOCK).open("ab")
    except OSError as error:
        raise OutputError(f"{folder}: cannot be written to ({error.strerror})") from error
    with file:
        if not files.try_lock(file):
            raise OutputError(f"{folder}: another process is at work there; wait for it, or name another folder")
        yield

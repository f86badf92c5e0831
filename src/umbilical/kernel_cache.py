"""Compiled kernels on disk: in a folder that nobody else can write to, each file with a checksum of its own.

numba's cache holds pickled machine code, which is executed as it is. So a folder of somebody else's is not used, and a
file that is damaged counts as missing: the kernel is compiled anew and the file replaced.
"""

from __future__ import annotations

import hashlib
import io
import logging
import os
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, IndexDataCacheFile

_SEAL = 32
"""Bytes of the checksum at the end of every file."""
_log = logging.getLogger("umbilical")


def user_cache() -> Path:
    """The folder of this user's compiled kernels; ``UMBILICAL_CACHE`` names another."""
    if override := os.environ.get("UMBILICAL_CACHE"):
        return Path(override)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", tempfile.gettempdir())) / "umbilical" / "cache"
    try:
        if sys.platform == "darwin":
            return Path.home() / "Library" / "Caches" / "umbilical"
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "umbilical"
    except RuntimeError:  # a user without a home
        return _temporary()


def folder_for(fingerprint: str) -> Path:
    """The folder of the kernels of one source, made if need be.

    Where the user's cache cannot be used, it is one folder in the temporary files, the same for all processes of this
    user; where that is not safe either, a new one that is this process's own.
    """
    wanted = user_cache() / fingerprint
    reasons = {}
    for folder in (wanted, _temporary() / fingerprint):
        if not (reason := _unusable(folder)):
            if reasons:
                _log.warning("compiled kernels are kept in %s: %s %s", folder, *next(iter(reasons.items())))
            return folder
        reasons[folder] = reason
    own = Path(tempfile.mkdtemp(prefix="umbilical-"))
    _log.warning("compiled kernels are kept for this process only: %s %s", wanted, reasons[wanted])
    return own


def is_whole(path: Path) -> bool:
    """Whether a file of the cache is there and as it was written."""
    try:
        content = path.read_bytes()
    except OSError:
        return False
    return hashlib.sha256(content[:-_SEAL]).digest() == content[-_SEAL:]


def seal(dispatcher: Any) -> Any:
    """Let a dispatcher of numba's keep its code in files with checksums."""
    if isinstance(cache := getattr(dispatcher, "_cache", None), FunctionCache):
        cache.__class__, cache._cache_file.__class__ = _QuickCache, _SealedFile
    return dispatcher


class _QuickCache(FunctionCache):
    """numba's cache, which reads code without first learning every function that numba can compile: 0.2 s."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        with self._guard_against_spurious_io_errors():
            return self._load_overload(sig, target_context)


class _SealedFile(IndexDataCacheFile):
    """Index and code of one kernel; pickle does not look at what stands behind the end of its own."""

    def _load_index(self) -> dict[Any, str]:
        return super()._load_index() if is_whole(Path(self._index_path)) else {}

    def _load_data(self, name: str) -> Any:
        path = Path(self._data_path(name))
        if not is_whole(path):
            raise OSError(f"{path} is damaged")  # which numba takes for missing
        return super()._load_data(name)

    def save(self, key: Any, data: Any) -> None:
        try:
            super().save(key, data)
        except OSError as error:
            _say_once(f"compiled kernels cannot be kept ({error.strerror}); the next process compiles them again")

    @contextmanager
    def _open_for_write(self, filepath: str) -> Iterator[io.BytesIO]:
        content = io.BytesIO()
        yield content
        with super()._open_for_write(filepath) as file:
            file.write(content.getvalue() + hashlib.sha256(content.getvalue()).digest())


@cache
def _say_once(text: str) -> None:
    _log.warning(text)


def _temporary() -> Path:
    return Path(tempfile.gettempdir()) / f"umbilical-{os.geteuid() if os.name != 'nt' else os.environ.get('USERNAME')}"


def _unusable(folder: Path) -> str:
    """Make a folder that only this user can write to; why it cannot be used, or empty."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        folder.mkdir(exist_ok=True, mode=0o700)
        with tempfile.TemporaryFile(dir=folder):
            pass
        for place in (folder, folder.parent):
            if os.name != "nt" and (reason := _unsafe(place.lstat(), folder.parent == place)):
                return reason
    except OSError as error:
        return f"cannot be written ({error.strerror})"
    return ""


def _unsafe(found: os.stat_result, parent: bool) -> str:
    """Why somebody else could put code into a folder; of its parent only an owner matters, who could replace it."""
    if found.st_uid not in (os.geteuid(), *([0] if parent else [])):
        return "belongs to another user, and would be executed"
    if stat.S_ISLNK(found.st_mode) and not parent:
        return "is a link"
    if (found.st_mode & 0o022 and not parent) or found.st_mode & 0o1002 == 0o002:
        return "can be written to by others, and would be executed"
    return ""

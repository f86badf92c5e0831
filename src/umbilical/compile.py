"""The one decorator that turns a function into a compiled kernel, and where the compiled code is kept.

numba's own cache watches a kernel's own file only, so editing a kernel that another file calls would
silently run the old code. Here the cache lives in a folder named by a hash of every kernel source.
"""

from __future__ import annotations

import hashlib
import os
import platform
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy
from numba.core import config as numba_config

config: Any = numba_config  # its settings are made at run time, unknown to type checkers

_FLOORS_WITH_KERNELS = ("relations", "plant", "control", "engine")
_BESIDES = ("compile.py", "frames.py")
"""Files outside these floors that the compiled code depends on."""
_PACKAGE = Path(__file__).parent


def _user_cache() -> Path:
    if override := os.environ.get("UMBILICAL_CACHE"):
        return Path(override)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", tempfile.gettempdir())) / "umbilical" / "cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "umbilical"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "umbilical"


def _fingerprint() -> str:
    """Hash of all kernel sources, of what declares their records, of versions and of flags that change the code."""
    digest = hashlib.sha256()
    besides = [_PACKAGE / name for name in _BESIDES]
    for source in besides + [p for f in _FLOORS_WITH_KERNELS for p in sorted((_PACKAGE / f).rglob("*.py"))]:
        digest.update(source.relative_to(_PACKAGE).as_posix().encode())
        digest.update(source.read_bytes())
    versions = (platform.python_version(), numba.__version__, llvmlite.__version__, numpy.__version__)
    digest.update(repr((versions, bool(config.BOUNDSCHECK))).encode())
    return digest.hexdigest()[:16]


@cache
def cache_folder() -> Path:
    """Folder of the compiled kernels of exactly this source; falls back to a temporary one."""
    folder = _user_cache() / _fingerprint()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f".probe-{os.getpid()}"
        probe.touch()
        probe.unlink()
    except OSError:
        folder = Path(tempfile.mkdtemp(prefix="umbilical-"))
    return folder


def is_warm() -> bool:
    """Whether the main loop has been compiled before and will load from disk."""
    return any(cache_folder().rglob("*run_steps*.nbc"))


def _compiled(function: Callable[..., Any], **special: Any) -> Any:
    njit: Any = numba.njit  # its last options are not in its annotations
    before, config.CACHE_DIR = config.CACHE_DIR, str(cache_folder())
    try:
        common = {"cache": True, "nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False}
        return njit(**common, **special)(function)
    finally:
        config.CACHE_DIR = before


def kernel(function: Callable[..., Any]) -> Any:
    """A compiled function whose machine code is taken into every kernel that calls it.

    Compiled when first called, kept on disk, and without the GIL while it runs. No fast-math: results must
    not depend on the compiler's mood. Division by zero gives inf or NaN, which the engine looks for, instead
    of raising inside a loop. Without numba's reference counting (three times the cost of the arithmetic), so
    a kernel that allocates does not compile.
    """
    return _compiled(function, forceinline=True)


def glue(function: Callable[..., Any]) -> Any:
    """A kernel that only puts others in order: its source is taken into its callers before they are compiled.

    Many large arguments then are neither passed nor compiled for once more on every floor.
    """
    return _compiled(function, inline="always")


def entry_kernel(function: Callable[..., Any]) -> Any:
    """A kernel that stays a function of its own: what Python calls, and what kernels call rarely."""
    return _compiled(function)

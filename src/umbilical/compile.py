"""The one decorator that turns a function into a compiled kernel, and where the compiled code is kept.

numba's own cache watches a kernel's own file only, so editing a kernel that another file calls would
silently run the old code. Here the cache lives in a folder named by a hash of every kernel source.
"""

from __future__ import annotations

import hashlib
import logging
import platform
from collections.abc import Callable
from functools import cache
from multiprocessing import parent_process
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy
from numba.core import config as numba_config

from umbilical.kernel_cache import folder_for, is_whole, seal

config: Any = numba_config  # its settings are made at run time, unknown to type checkers

_FLOORS_WITH_KERNELS = ("relations", "plant", "control", "engine")
_BESIDES = ("compile.py", "frames.py")
"""Files outside these floors that the compiled code depends on."""
_PACKAGE = Path(__file__).parent


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
    """Folder of the compiled kernels of exactly this source, see :mod:`umbilical.kernel_cache`."""
    return folder_for(_fingerprint())


def is_warm(loop: str = "run_steps") -> bool:
    """Whether a loop has been compiled before and will load from disk: ``run_held`` is that of an episode."""
    return any(is_whole(path) for path in cache_folder().rglob(f"*{loop}*.nbc"))


@cache
def announce(loop: str = "run_steps") -> None:
    """Say once, before a kernel of a loop is first called, that kernels are about to be compiled.

    The message is a warning of the logger ``umbilical``, which Python writes to stderr;
    ``logging.getLogger("umbilical").setLevel("ERROR")`` switches it off.
    """
    if not config.DISABLE_JIT and not is_warm(loop) and parent_process() is None:
        _say_once()


@cache
def _say_once() -> None:
    """Without arguments, so that whoever asks first, for whichever loop, has asked for all."""
    logging.getLogger("umbilical").warning(
        "compiling the kernels once, which takes half a minute to three minutes; later runs load them from disk"
    )


def _compiled(function: Callable[..., Any], **special: Any) -> Any:
    njit: Any = numba.njit  # its last options are not in its annotations
    before, config.CACHE_DIR = config.CACHE_DIR, str(cache_folder())
    try:
        common = {"cache": True, "nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False}
        return seal(njit(**common, **special)(function))
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

"""What this machine has: memory, and room on its disks."""

from __future__ import annotations

import os
import shutil
from contextlib import suppress
from math import inf
from pathlib import Path


def memory() -> float:
    """Bytes of memory this process may use at the most; infinite where the system does not say."""
    found = [inf]
    with suppress(AttributeError, ValueError, OSError):  # another system has no such names
        found.append(float(os.sysconf("SC_PHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE"))
    for limit in ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"):
        with suppress(OSError, ValueError):  # no container, or no limit
            found.append(float(Path(limit).read_text()))
    return min(size for size in found if size > 0.0)


def room(folder: Path) -> float:
    """Bytes that can still be written into a folder; infinite where the system does not say."""
    try:
        return float(shutil.disk_usage(folder).free)
    except OSError:
        return inf


def in_words(size: float) -> str:
    """A number of bytes.

    >>> in_words(6.8e9), in_words(1234)
    ('6.8 GB', '0.0012 MB')
    >>> in_words(272e6)
    '272 MB'
    """
    value, unit = (size / 1e9, "GB") if size >= 1e9 else (size / 1e6, "MB")
    return f"{value:.0f} {unit}" if value >= 99.5 else f"{value:.2g} {unit}"

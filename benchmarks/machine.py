"""What a measurement ran on."""

from __future__ import annotations

import os
import platform
import sys
from importlib.metadata import version
from pathlib import Path


def machine() -> dict[str, str | int]:
    """Processor, cores and the versions that matter for speed."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count() or 1,
        "Python": platform.python_version(),
        "numba": version("numba"),
        "numpy": version("numpy"),
    }


def _processor() -> str:
    """Linux keeps the model's name where `platform` does not look."""
    described = Path("/proc/cpuinfo")
    lines = described.read_text().splitlines() if described.exists() else []
    models = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.processor() or platform.machine()


def peak_of_children() -> float:
    """Largest memory any finished child of this process held, MB; NaN where the system does not say."""
    if sys.platform == "win32":
        return float("nan")
    import resource

    largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    return largest / (1e6 if sys.platform == "darwin" else 1e3)

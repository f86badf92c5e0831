"""``umbilical doctor``: what this machine has."""

from __future__ import annotations

import os
import platform
import sys
import tempfile
from pathlib import Path
from typing import Any

from umbilical.cli.options import Json
from umbilical.cli.output import print_json, print_result
from umbilical.tables import text_table

NEEDED = ("numpy", "scipy", "numba", "pydantic", "xarray", "h5netcdf", "h5py", "matplotlib", "rich", "typer", "mpmath")
PARTNERS = (
    "control",
    "distributed",
    "SALib",
    "optuna",
    "moordyn",
    "fmpy",
    "pythonfmu3",
    "gymnasium",
    "wavespectra",
)


def doctor_command(as_json: Json = False) -> int:
    """Show versions, folders and cores, to send along with a question.

    \b
    example
      umbilical doctor --json
    """
    findings = examine()
    if as_json:
        print_json(findings)
    else:
        print_result("\n\n".join(f"{topic}\n{text_table(_rows(found))}" for topic, found in findings.items()))
    return 0 if all(findings["packages"].values()) else 6


def examine() -> dict[str, dict[str, Any]]:
    """Findings by topic."""
    from umbilical import __version__
    from umbilical.compile import cache_folder, is_warm

    folder = cache_folder()
    return {
        "umbilical": {"version": __version__, "folder": str(Path(__file__).parents[1])},
        "machine": {
            "python": platform.python_version(),
            "executable": sys.executable,
            "system": platform.platform(),
            "cores": os.cpu_count(),
        },
        "kernels": {"cache": str(folder), "compiled": is_warm()},
        "writable": {str(path): os.access(path, os.W_OK) for path in _folders(folder)},
        "packages": {name: _version(name) for name in NEEDED},
        "optional partners": {name: _version(name) for name in PARTNERS},
    }


def _folders(cache: Path) -> tuple[Path, ...]:
    return Path.cwd(), cache, Path(tempfile.gettempdir())


def _version(package: str) -> str | None:
    from importlib.metadata import PackageNotFoundError, version  # slow to import, and help would wait for it

    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _rows(found: dict[str, Any]) -> list[tuple[str, str]]:
    return [(name, _word(value)) for name, value in found.items()]


def _word(value: Any) -> str:
    if value is None:
        return "not installed"
    return ("no", "yes")[value] if isinstance(value, bool) else str(value)

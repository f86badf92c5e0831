#!/usr/bin/env python3
"""Set up a local environment and run this project in it: `python3 do.py run`, `python3 do.py test`.

Needs Python 3.11 or newer with pip, and nothing else. Packages come from requirements.lock, at exactly the
versions and hashes written there, into .venv beside this file; that is done again only when the lock changes.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
BIN = VENV / ("Scripts" if os.name == "nt" else "bin")
PYTHON = BIN / ("python.exe" if os.name == "nt" else "python")
STAMP = VENV / "installed-from"
LOCK = ROOT / "requirements.lock"


SUPPORTED = ("3.11", "3.12", "3.13")
TWO_AT_A_TIME = ("-n", "2", "--dist", "loadfile")  # tests of a file may follow each other
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1"}
"""Small matrices on many threads take ten times longer when the machine is busy."""
OUTSIDE = getattr(sys, "_base_executable", None) or sys.executable
"""The Python that .venv is made with: not its own, should it be active, for it goes with the old one."""


def call(*command: str | Path, **environment: str) -> bool:
    """Run a command from the project's folder with its own output; True when it succeeded."""
    return _call_in(ROOT, command, environment)


def _call_in(folder: Path, command: Iterable[str | Path], environment: Mapping[str, str]) -> bool:
    words = list(command)
    print("+", *(f"{k}={v}" for k, v in environment.items()), *map(_shown, words), flush=True)
    done = subprocess.run(list(map(str, words)), cwd=folder, env={**os.environ, **environment}, check=False)
    return done.returncode == 0


def _shown(part: str | Path) -> str:
    return str(part.relative_to(ROOT)) if isinstance(part, Path) and part.is_relative_to(ROOT) else str(part)


def fingerprint() -> str:
    """Changes when the lock, the package's own declarations or the interpreter do."""
    parts = (LOCK.read_bytes(), (ROOT / "pyproject.toml").read_bytes(), sys.version.encode(), str(ROOT).encode())
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def set_up() -> None:
    """Make .venv from the lock, unless it already is."""
    wanted = fingerprint()
    if PYTHON.exists() and STAMP.exists() and STAMP.read_text() == wanted:
        return
    if VENV.exists():
        shutil.rmtree(VENV)
    pip = _make_venv()
    print("do.py: installing the packages of requirements.lock into .venv, a minute or two", flush=True)
    quiet = ("--quiet", "--no-input", "--disable-pip-version-check")
    if not call(*pip, "install", *quiet, "--require-hashes", "--requirement", LOCK):
        raise SystemExit("do.py: the packages of requirements.lock could not be installed (see above).")
    if not call(*pip, "install", *quiet, "--no-deps", "--no-build-isolation", "--editable", "."):
        raise SystemExit("do.py: the package itself could not be installed (see above).")
    STAMP.write_text(wanted)


def _make_venv() -> tuple[str | Path, ...]:
    """An empty environment and the pip command that fills it.

    Debian splits ensurepip from Python; there, a pip outside fills the environment instead.
    """
    if importlib.util.find_spec("ensurepip"):
        made, pip = call(OUTSIDE, "-m", "venv", VENV), (PYTHON, "-m", "pip")
    elif importlib.util.find_spec("pip"):
        made = call(OUTSIDE, "-m", "venv", "--without-pip", VENV)
        pip = (OUTSIDE, "-m", "pip", "--python", PYTHON)
    else:
        raise SystemExit("do.py: this Python has neither ensurepip nor pip; on Debian: apt install python3-venv")
    if not made:
        raise SystemExit("do.py: no virtual environment could be made (see above); on Debian: apt install python3-venv")
    return pip


def run() -> Iterable[bool]:
    """Simulate the paper's scenario: out/paper.nc, out/paper.png and a summary."""
    out = ROOT / "out"
    out.mkdir(exist_ok=True)
    yield call(BIN / "umbilical", "run", "paper", "--out", out / "paper.nc", "--plot", out / "paper.png", "--force")


def test() -> Iterable[bool]:
    """The default tests, two at a time."""
    yield call(PYTHON, "-m", "pytest", *TWO_AT_A_TIME, **ONE_THREAD)


def check() -> Iterable[bool]:
    """Style, types and the direction of imports."""
    yield call(PYTHON, "-m", "ruff", "check", ".")
    yield call(PYTHON, "-m", "ruff", "format", "--check", ".")
    yield call(PYTHON, "-m", "pyright", "--pythonpath", PYTHON)
    yield call(BIN / "lint-imports", "--no-cache")


def thorough() -> Iterable[bool]:
    """Slow tests; kernels as plain Python, with what of them is covered; kernels with their array bounds checked."""
    yield call(PYTHON, "-m", "pytest", "-m", "slow", "-rs", *TWO_AT_A_TIME, **ONE_THREAD)
    # Only plain Python shows which lines and branches of a kernel a test has been through.
    yield call(PYTHON, "-m", "coverage", "run", "-m", "pytest", "-m", "nojit", NUMBA_DISABLE_JIT="1")
    yield call(PYTHON, "-m", "coverage", "report")
    yield call(PYTHON, "-m", "pytest", "-m", "bounds", NUMBA_BOUNDSCHECK="1")


FIRST_RUN = """
import pathlib, umbilical
run = umbilical.simulate(umbilical.load("paper", {"duration": 1.0}))
umbilical.plot_overview(run).savefig("first.png")
assert pathlib.Path("first.png").stat().st_size > 10_000 and ".venv" not in umbilical.__file__
print(run.summary().splitlines()[0])
"""


def package() -> Iterable[bool]:
    """Build sdist and wheel; install the wheel without extras on each Python that is here; make a first run with it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        yield call(PYTHON, "-m", "hatchling", "build", "--directory", folder)
        (wheel,) = folder.glob("*.whl")
        pins = folder / "pins.txt"
        pins.write_text("".join(line.split(" \\")[0] + "\n" for line in LOCK.read_text().splitlines() if "==" in line))
        for version in SUPPORTED:
            if found := _interpreter(version):
                yield from _first_run(found, wheel, pins, folder / f"env{version}")
            else:
                print(f"package: no Python {version} here, skipped", flush=True)


def _interpreter(version: str) -> str | None:
    """A Python of this version that runs: on the path, where a shim may lead nowhere, or among pyenv's."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    on_path = shutil.which(f"python{version}")
    for candidate in [*filter(None, [on_path]), *sorted(map(str, pyenv.glob(f"{version}*/bin/python")))]:
        if subprocess.run([candidate, "-c", ""], capture_output=True, check=False).returncode == 0:
            return candidate
    return None


def _first_run(python: str, wheel: Path, pins: Path, environment: Path) -> Iterable[bool]:
    """Install a wheel into an environment of its own; make the first picture from another folder."""
    ours = environment / BIN.name / PYTHON.name
    yield call(python, "-m", "venv", "--without-pip", environment)
    with_pip = PYTHON if (BIN / "pip").exists() else sys.executable  # see _make_venv
    print("do.py: installing the packages of requirements.lock into .venv, a minute or two", flush=True)
    quiet = ("--quiet", "--no-input", "--disable-pip-version-check")
    yield call(with_pip, "-m", "pip", "--python", ours, "install", *quiet, "--constraint", pins, wheel)
    elsewhere = environment / "elsewhere"
    elsewhere.mkdir(parents=True)
    yield _call_in(elsewhere, (ours, "-c", FIRST_RUN), {})


def docs() -> Iterable[bool]:
    """The site in out/docs, from pages, docstrings and examples; every warning is an error."""
    yield call(
        PYTHON, "-m", "sphinx", "-W", "--keep-going", "-n", "-q", "-b", "html", ROOT / "docs", ROOT / "out" / "docs"
    )


def mutants() -> Iterable[bool]:
    """Whether the tests notice small changes of the source: a sample, on which see docs/mutants.md."""
    yield call(PYTHON, "tools/mutants.py")


def bench() -> Iterable[bool]:
    """Measured times on this machine; `.venv/bin/python -m benchmarks --help` says what else it takes."""
    yield call(PYTHON, "-m", "benchmarks")


TASKS: dict[str, Callable[[], Iterable[bool]]] = {
    "run": run,
    "test": test,
    "check": check,
    "thorough": thorough,
    "package": package,
    "docs": docs,
    "mutants": mutants,
    "bench": bench,
}
CI = tuple(name for name in TASKS if name not in ("mutants", "bench"))
"""All but those that have no verdict."""


def main() -> int:
    """Do the named tasks in order; a failure is remembered and the rest still runs."""
    listing = "\n".join(f"  {name:<9} {task.__doc__}" for name, task in TASKS.items())
    parser = argparse.ArgumentParser(
        description=(__doc__ or "").splitlines()[0],
        epilog=f"tasks:\n{listing}\n  ci        {', '.join(CI)}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("tasks", nargs="+", choices=[*TASKS, "ci"], metavar="task")
    names = parser.parse_args().tasks
    if sys.version_info < (3, 11):  # noqa: UP036  (this script is what an older Python is started with)
        raise SystemExit(f"do.py: Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    set_up()
    chosen = list(CI) if "ci" in names else names
    failed = [name for name in chosen if not all(list(TASKS[name]()))]
    if failed:
        print(f"do.py: failed: {', '.join(failed)}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())

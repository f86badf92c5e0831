"""Run one input through the command line, in this process, and say what is wrong with the answer."""

from __future__ import annotations

import io
import json
import math
import os
import signal
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any, NamedTuple
from unittest.mock import patch

import typer

from tests.fuzz.inputs import Case
from umbilical.cli import main
from umbilical.cli.app import make_app
from umbilical.cli.output import EXIT_CODES
from umbilical.engine import simulate

_COMMAND = typer.main.get_command(make_app())
"""Built once: typer takes longer for that than most inputs take."""
SECONDS = 120
"""After which an input is said to hang; on a processor with nothing else to do the slowest takes a few."""
GIGABYTES = 6
"""Of address space beyond what the process has, above which an input is said to be greedy."""


class Answer(NamedTuple):
    """Exit code, both outputs, and how many simulations were begun."""

    code: int
    out: str
    err: str
    simulations: int


class Hangs(BaseException):
    """An input took too long."""


def answer(case: Case) -> Answer:
    """What the command line makes of a case, in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder, _counted() as begun, _bounded():
        for name, content in case.files:
            (Path(folder) / name).write_bytes(content)
        arguments = [_filled(word, folder) for word in case.arguments]
        out, err, here = io.StringIO(), io.StringIO(), Path.cwd()
        os.chdir(folder)
        try:
            with (
                redirect_stdout(out),
                redirect_stderr(err),
                patch.object(typer.main, "get_command", lambda _: _COMMAND),
            ):
                code = main(arguments)
        finally:
            os.chdir(here)
    return Answer(code, out.getvalue(), err.getvalue(), len(begun))


def faults(case: Case, found: Answer) -> Iterator[str]:
    """What no answer may be."""
    if found.code not in EXIT_CODES:
        yield f"undocumented exit code {found.code}"
    if found.code == 1 or "This is a bug" in found.err:
        yield f"called a bug: {found.err.splitlines()[:1]}"
    if "Traceback" in found.out + found.err:
        yield "traceback"
    if found.code in (2, 4, 5, 6) and not found.err.strip():
        yield "refused without a word"
    if any(ord(sign) < 32 and sign not in "\n\t" for sign in found.out + found.err):
        yield "control characters reach the terminal"
    if "--json" in case.arguments and found.out.strip().startswith("{"):
        yield from _faults_of_json(found.out)


def _faults_of_json(text: str) -> Iterator[str]:
    """JSON is strict, and a completed run has no metric that is not a number: what does not exist is left out."""
    try:
        document = json.loads(text, parse_constant=float)
    except ValueError as error:
        yield f"no JSON: {error}"
        return
    if document.get("status") == "COMPLETED":
        yield from (
            f"{name} = {value}, COMPLETED" for name, value in document["metrics"].items() if not _is_sound(value)
        )


def _is_sound(value: Any) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)


def _filled(word: str, folder: str) -> str:
    if word.startswith("{") and word.endswith("}") and "." in word:
        return str(Path(folder) / word[1:-1])
    return word.replace("{out}", folder)


@contextmanager
def _counted() -> Iterator[list[int]]:
    """Counts the simulations that are begun."""
    begun: list[int] = []
    original = simulate.make_model

    def noted(*given: Any, **named: Any) -> Any:
        found = original(*given, **named)
        begun.append(1)
        return found

    simulate.make_model = noted
    try:
        yield begun
    finally:
        simulate.make_model = original


@contextmanager
def _bounded() -> Iterator[None]:
    """Bounds of time and memory, where the system has them."""
    if os.name == "nt":
        yield
        return
    import resource

    def hangs(*_: Any) -> None:
        raise Hangs(f"{SECONDS} s")

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    before = signal.signal(signal.SIGALRM, hangs)
    resource.setrlimit(resource.RLIMIT_AS, (_address_space() + GIGABYTES * 10**9, hard))
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def _address_space() -> int:
    status = Path("/proc/self/statm")
    return int(status.read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE") if status.exists() else 10**12


def _command_built() -> Any:
    return patch.object(typer.main, "get_command", lambda _: _COMMAND)

"""Help comes at once, says what a newcomer needs, and brings nothing heavy along."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from umbilical import __version__
from umbilical.cli.output import EXIT_CODES
from umbilical.errors import UmbilicalError
from umbilical.faces.conclusion import DOES_NOT_HOLD
from umbilical.run import Status

HEAVY = ("numba", "llvmlite", "numpy", "scipy", "xarray", "pandas", "matplotlib", "h5netcdf", "rich")
COMMANDS = (
    "run", "show", "compare", "export", "plot", "animate", "certify", "reproduce", "sweep", "member", "tune", "verify",
    "margins", "design", "operate", "lower", "presets", "examples", "schema", "doctor", "warm-up",
)  # fmt: skip


@pytest.mark.parametrize(
    ("arguments", "heavy"),
    [
        (["--help"], (*HEAVY, "pydantic")),
        (["--version"], (*HEAVY, "pydantic")),
        (["run", "--help"], HEAVY),  # typer reads arguments with pydantic
    ],
)
def test_help_imports_nothing_heavy(arguments, heavy):
    script = (
        "import sys; from umbilical.cli import main; code = main(sys.argv[1:])\n"
        f"print('heavy:', *sorted(set({heavy}) & set(sys.modules)), file=sys.stderr); raise SystemExit(code)"
    )
    done = subprocess.run([sys.executable, "-c", script, *arguments], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.split()) == (0, ["heavy:"])
    assert done.stdout


def test_the_module_is_the_command():
    done = subprocess.run([sys.executable, "-m", "umbilical", "--version"], capture_output=True, text=True, check=False)
    assert done.stdout == f"umbilical {__version__}\n"


def test_help_names_every_command_and_exit_code(umbilical):
    shown = umbilical("--help").out
    for command in COMMANDS:
        assert f"\n  {command} " in shown
    for code, meaning in EXIT_CODES.items():
        assert f"    {code:<4} {meaning}" in shown


def test_the_exit_codes_are_those_of_runs_and_errors():
    of_errors = {kind.exit_code for kind in UmbilicalError.__subclasses__()} | {UmbilicalError.exit_code}
    of_runs = {status.exit_code for status in Status}
    of_verdicts = {DOES_NOT_HOLD}
    assert set(EXIT_CODES) == of_errors | of_runs | of_verdicts


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself_with_an_example(umbilical, command):
    shown = umbilical(command, "--help").out
    assert f"umbilical {command}" in shown.partition("\n")[2]


def test_no_command_at_all_shows_the_help(umbilical):
    done = umbilical()
    assert done.code == 2
    assert "Commands:" in done.err


def test_a_shell_is_told_what_could_come_next():
    asked = os.environ | {"_UMBILICAL_COMPLETE": "complete_bash", "COMP_WORDS": "umbilical marg", "COMP_CWORD": "1"}
    done = subprocess.run([sys.executable, "-m", "umbilical"], env=asked, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.split()) == (0, ["margins"])


def test_the_tab_key_offers_commands_options_and_presets():
    def offered(line: str) -> list[str]:
        words = {"COMP_WORDS": line, "COMP_CWORD": str(line.count(" ")), "_UMBILICAL_COMPLETE": "complete_bash"}
        done = subprocess.run(
            [sys.executable, "-m", "umbilical"], env=os.environ | words, capture_output=True, text=True
        )
        return done.stdout.split()

    assert offered("umbilical ma") == ["margins"]
    assert offered("umbilical margins --len") == ["--lengths"]
    assert offered("umbilical run paper-d") == ["paper-dead", "paper-dead-adaptive"]
    assert offered("umbilical tune gain") == ["gain-tuning"]
    assert offered("umbilical lower work") == ["work-class"]
    assert {"work-class", "work-class-1000m-current"} <= {*offered("umbilical show work")}

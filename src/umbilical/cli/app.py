"""The commands under one name, and the one place where errors become texts and exit codes."""

from __future__ import annotations

import os
import re
import traceback
from collections.abc import Iterable, Sequence
from contextlib import suppress
from importlib import import_module
from typing import Annotated

import typer

from umbilical import __version__
from umbilical.cli.output import EXIT_CODES, print_json, print_result, refusal, report
from umbilical.errors import OutputError, UmbilicalError

# typer brings its own copy of click and exports only this child of click's UsageError.
_UsageError: type[Exception] = typer.BadParameter.__mro__[1]

_COMPLETION = "_UMBILICAL_COMPLETE"
_NO_CHOICE = re.compile("'([^']*)' is not one of (.*)")

_CODES = "\n".join(f"  {code:<4} {meaning}" for code, meaning in EXIT_CODES.items())

COMMANDS = {
    "run": "run", "sweep": "sweep", "member": "sweep", "tune": "tune", "show": "show", "compare": "show",
    "export": "export", "plot": "plot", "animate": "animate", "certify": "certify", "reproduce": "reproduce",
    "margins": "margins", "design": "design", "operate": "operate", "lower": "operate", "snap": "snap",
    "presets": "presets", "examples": "presets", "schema": "presets", "doctor": "doctor", "warm-up": "warm_up",
    "verify": "verify",
}  # fmt: skip
"""Commands, and the file of each: there ``warm-up`` is ``warm_up_command``."""


def make_app(names: Iterable[str] = COMMANDS) -> typer.Typer:
    """The command line with these commands; each takes some milliseconds."""
    app = typer.Typer(
        name="umbilical",
        callback=umbilical,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        no_args_is_help=True,
        context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
        epilog=f"\b\nexit codes\n{_CODES}",
    )
    for name in names:
        module = import_module(f"umbilical.cli.{COMMANDS[name]}")
        app.command(name)(getattr(module, f"{name.replace('-', '_')}_command"))
    return app


def _version(wanted: bool) -> None:
    if wanted:
        print_result(f"umbilical {__version__}")
        raise typer.Exit


def umbilical(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Its version.")] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Tracebacks of errors; may stand anywhere.")] = False,
) -> None:
    """Simulate the vibration control of a vessel - umbilical cable - ROV system.

    \b
    examples
      umbilical run paper --out paper.nc --plot paper.png
      umbilical run paper --set winch.end_length=480 --json
      umbilical presets --copy paper my.toml
      umbilical show my.toml
      umbilical compare paper.nc other.nc
      umbilical certify ringdown --set control.law.slope_gain=5
      umbilical sweep paper-robustness --out robust
      umbilical tune gain-tuning --out tuned
    """


def execute(given: list[str], signals: Sequence[int] = ()) -> int:
    """Run the words of one command line; whatever error comes while ``signals`` holds one is an interruption."""
    # Read when numpy is first imported: our matrices are small, and threads cost them more than they bring.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if _COMPLETION in os.environ:  # a shell asks what could come next; typer answers and exits
        make_app()(prog_name="umbilical")
    try:
        return _invoke([word for word in given if word != "--debug"])
    except BrokenPipeError:  # the reader has gone
        return 4
    except (Exception, KeyboardInterrupt) as error:
        if "--debug" in given:
            report("".join(traceback.format_exception(error)))
        return _explain(KeyboardInterrupt() if signals else error, as_json="--json" in given)


def _invoke(words: list[str]) -> int:
    """Parse and call, without typer's own handling of errors: ours says more."""
    command = typer.main.get_command(make_app([name for name in words[:1] if name in COMMANDS] or COMMANDS))
    try:
        with command.make_context("umbilical", words) as context:
            return command.invoke(context) or 0
    except typer.Exit as done:
        return done.exit_code


def _explain(error: BaseException, *, as_json: bool) -> int:
    """One text on stderr, one object on stdout if that was wanted; returns the exit code."""
    code, text = _verdict(error)
    report(text)
    if as_json:
        with suppress(OutputError, BrokenPipeError):  # which is perhaps the very error
            print_json(refusal(error, text, code))
    return code


def _verdict(error: BaseException) -> tuple[int, str]:
    """Exit code and text of an error."""
    match error:
        case UmbilicalError():
            return error.exit_code, f"umbilical: {error}"
        case _UsageError():
            return 2, _usage(error)
        case KeyboardInterrupt() | typer.Abort():
            return 130, "umbilical: interrupted"
    return 1, (
        f"umbilical: {type(error).__name__}: {error}\n"
        "This is a bug of Umbilical, not of your input. Please report it with the command, the scenario and the\n"
        "traceback, which the same command shows with --debug."
    )


def _usage(error: Exception) -> str:
    """A mistyped command line: what is wrong with it, and where to read how it goes."""
    context = getattr(error, "ctx", None)
    if type(error).__name__ == "NoArgsIsHelpError" and context:
        return context.get_help()
    place = context.command_path if context else "umbilical"
    text = getattr(error, "format_message", error.__str__)().replace(": Value error, ", ": ")  # of pydantic in typer
    if found := _NO_CHOICE.search(text):
        text += _hint(found.group(1), re.findall("'([^']*)'", found.group(2)))
    return f"umbilical: {text}\nTry '{place} --help'."


def _hint(word: str, choices: Sequence[str]) -> str:
    """The choice that a word is a slip of; all of them are in the text already."""
    from umbilical.scenario.problems import nearest

    found = nearest(word, choices)
    return f" {found}" if found.startswith("did you") else ""

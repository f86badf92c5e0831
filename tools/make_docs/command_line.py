"""docs/cli.md: every command with its options, from the functions behind them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from inspect import getdoc
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

from writing import code, page, table

from umbilical.cli.app import make_app
from umbilical.cli.output import EXIT_CODES

FILES = Path(__file__).with_suffix(".md")
"""What the examples need that none of them makes."""


def command_line() -> str:
    """Every command, and the exit codes."""
    return page(
        "Command line",
        "A scenario is the name of a preset, a `.toml` file, or a `.nc` result, whose scenario is taken. Nothing is "
        "overwritten without `--force`; files appear complete or not at all. `--json` prints exactly one object on "
        "stdout; news and errors go to stderr. `--debug` anywhere shows the traceback of an error.",
        FILES.read_text(encoding="utf-8").strip(),
        *(section(str(it.name), it.callback) for it in make_app().registered_commands if it.callback),
        "## Exit codes",
        table(("code", "meaning"), ((str(number), text) for number, text in EXIT_CODES.items())),
    )


def section(name: str, command: Callable[..., Any]) -> str:
    """A command: what it does, its arguments and options, notes and examples.

    In its docstring a line with ``\\b`` opens the examples, and an empty one closes them.
    """
    text, _, rest = (getdoc(command) or "").partition("\n\n\b\n")
    examples, _, notes = rest.partition("\n\n")
    lines = [line.strip() for line in examples.splitlines()[1:]]
    options = list(parameters(command))
    parts = [f"## `umbilical {name}`", text, notes]
    parts.append(table(("argument or option", "meaning"), options) if options else "")
    parts.append("\n".join(["```bash", *lines, "```"]) if lines else "")
    return "\n\n".join(filter(None, parts))


def parameters(command: Callable[..., Any]) -> Iterator[tuple[str, str]]:
    """Arguments and options with their help."""
    for name, hint in get_type_hints(command, include_extras=True).items():
        if hasattr(hint, "__metadata__"):
            kind, info = get_args(hint)[:2]
            # typer takes the first name of an option for its default, as it was before Annotated.
            flag = " ".join(n for n in (info.default, *(info.param_decls or ())) if str(n).startswith("-"))
            yield code(f"{flag} {shape(kind, info.metavar)}".strip() if flag else name.upper()), info.help or ""


def shape(kind: Any, metavar: str | None) -> str:
    """What stands behind an option: its choices, or what it is; nothing behind a switch."""
    if get_origin(kind) is Literal:
        return "|".join(get_args(kind))
    said = next((part for part in get_args(kind) if part is not type(None)), kind)  # X of ``X | None``
    return metavar or ("" if said is bool else said.__name__.upper())

"""The command line. A thin face: every command is a call of the library, and a text about what came back.

Only this package prints. Nothing heavy is imported before a command needs it, so that help comes at once.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from umbilical.cli.interruption import interruptible

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command line.

    Args:
        arguments: what stands behind ``umbilical``; those of this process if left out.

    Returns:
        The exit code, see :data:`umbilical.cli.output.EXIT_CODES`.
    """
    with interruptible() as came:
        try:
            from umbilical.cli import app, terminal

            terminal.occupy_closed_streams()
            return app.execute(list(sys.argv[1:] if arguments is None else arguments), came)
        except KeyboardInterrupt:  # while modules were imported, or while an error was explained
            if sys.stderr is not None:
                sys.stderr.write("umbilical: interrupted\n")
            return 130

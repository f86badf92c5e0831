"""The command line. A thin face: every command is a call of the library, and a text about what came back.

Only this package prints. Nothing heavy is imported before a command needs it, so that help comes at once.
"""

from umbilical.cli.app import main

__all__ = ["main"]

"""``python -m umbilical`` is the command ``umbilical``."""

from umbilical.cli import main

if __name__ == "__main__":
    raise SystemExit(main())

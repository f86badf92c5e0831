"""An option that several commands have is declared in one place."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from umbilical import cli

DECLARED = re.compile(r'Option\(\s*"(--[a-z-]+)"[^)]*help="([^"]*)"')


def test_no_option_is_declared_twice() -> None:
    """The same flag with the same words."""
    sources = [path.read_text(encoding="utf-8") for path in Path(cli.__file__).parent.glob("*.py")]
    declared = Counter(found for source in sources for found in DECLARED.findall(source))
    assert {"--json", "--force", "--set", "--plot"} <= {flag for flag, _ in declared}
    assert [flag for (flag, _), times in declared.items() if times > 1] == []

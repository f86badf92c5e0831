"""Publish the numbers of the paper's reproduction: `.venv/bin/python tools/make_expected`.

Runs all of it, maps included, and writes expected.toml and the pictures of docs/paper.md. Then run tools/make_docs,
which writes the page itself, and put what moved under *Numbers* in CHANGELOG.md; this tool prints it.
"""

from __future__ import annotations

import sys
from pathlib import Path

from umbilical import files
from umbilical.papers.rao2022.expected import FILE, deviations, expected_text
from umbilical.papers.rao2022.reproduction import reproduce
from umbilical.plots.figure import render

ROOT = Path(__file__).resolve().parents[2]
SHOWN = ("fig3", "fig6", "absorption", "adaptation", "gain", "map-rates")
"""Figures of docs/paper.md."""
RESOLUTION = 160
"""Dots per inch there: a page, not a print."""


def main() -> int:
    """Publish."""
    found = reproduce(progress=lambda share: print(f"\r{share:4.0%}", end="", file=sys.stderr))
    for moved in deviations(found.findings):
        print(moved)
    target = ROOT / "src" / "umbilical" / "papers" / "rao2022" / FILE
    files.write(target, expected_text(found.findings).encode(), force=True)
    for one in found.shown:
        if one.picture.name in SHOWN:
            picture = render(one.picture.draw(one.data), "png", dpi=RESOLUTION)
            files.write(ROOT / "docs" / "img" / f"{one.picture.name}.png", picture, force=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

"""A headless browser, where there is one: what it says about a page, how wide it is, and how it looks."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
PROGRAM = next((found for name in NAMES if (found := shutil.which(name))), None)

_QUIET = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--hide-scrollbars",
    "--host-resolver-rules=MAP * ~NOTFOUND",
)
_WIDTH = "<script>parent.postMessage(document.documentElement.scrollWidth, '*')</script>"
_FRAME = """<!DOCTYPE html><body style="margin: 0"><script>onmessage = m => document.title = 'width ' + m.data</script>
<iframe src="{name}" style="border: 0; width: {window}px; height: {height}px"></iframe></body>"""
"""A page in a window of any width: the browser's own is at least 500 pixels wide."""


def _call(page: Path, *options: str) -> subprocess.CompletedProcess[str]:
    profile = page.parent / "profile"
    command = [str(PROGRAM), *_QUIET, f"--user-data-dir={profile}", *options, page.resolve().as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)


def console(page: Path) -> list[str]:
    """What the page makes the browser say on its console."""
    done = _call(page, "--enable-logging=stderr", "--v=0", "--dump-dom")
    return [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def dump(page: Path) -> str:
    """The page after five seconds of its own time."""
    return _call(page, "--virtual-time-budget=5000", "--dump-dom").stdout


def width(page: Path, window: int) -> int:
    """How wide the page is, in pixels, in a window that wide; measured in a copy with a script."""
    copy = page.with_name(f"measured-{page.name}")
    copy.write_text(page.read_text(encoding="utf-8").replace("</body>", f"{_WIDTH}</body>"), encoding="utf-8")
    dump = _call(_framed(copy, window, 900), "--window-size=1400,900", "--virtual-time-budget=5000", "--dump-dom")
    found = re.search(r"<title>width (\d+)</title>", dump.stdout)
    assert found
    return int(found[1])


def _framed(page: Path, window: int, height: int) -> Path:
    frame = page.with_name(f"framed-{page.name}")
    frame.write_text(_FRAME.format(name=page.name, window=window, height=height), encoding="utf-8")
    return frame


def screenshot(page: Path, target: Path, window: int, *, dark: bool = False) -> bytes:
    """The page as a PNG."""
    shade = ("--blink-settings=preferredColorScheme=0",) if dark else ()
    size = f"--window-size={max(window, 500)},2000"
    _call(_framed(page, window, 2000), size, f"--screenshot={target}", *shade)
    return target.read_bytes()

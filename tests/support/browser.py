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
_WIDTH = "<script>document.title = 'width ' + document.documentElement.scrollWidth</script>"


def _call(page: Path, *options: str) -> subprocess.CompletedProcess[str]:
    profile = page.parent / "profile"
    command = [str(PROGRAM), *_QUIET, f"--user-data-dir={profile}", *options, page.resolve().as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)


def console(page: Path) -> list[str]:
    """What the page makes the browser say on its console."""
    done = _call(page, "--enable-logging=stderr", "--v=0", "--dump-dom")
    return [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def width(page: Path, window: int) -> int:
    """How wide the page is, in pixels, in a window that wide; measured in a copy with a script."""
    copy = page.with_name(f"measured-{page.name}")
    copy.write_text(page.read_text(encoding="utf-8").replace("</body>", f"{_WIDTH}</body>"), encoding="utf-8")
    found = re.search(r"<title>width (\d+)</title>", _call(copy, f"--window-size={window},900", "--dump-dom").stdout)
    assert found
    return int(found[1])


def screenshot(page: Path, target: Path, window: int, *, dark: bool = False) -> bytes:
    """The page as a PNG."""
    shade = ("--blink-settings=preferredColorScheme=0",) if dark else ()
    _call(page, f"--window-size={window},2000", f"--screenshot={target}", *shade)
    return target.read_bytes()

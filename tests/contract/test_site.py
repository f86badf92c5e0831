"""The site of the documentation: built without a warning, complete without network."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support import browser

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    sphinx = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-n", "-q", "-b", "html"]
    done = subprocess.run([*sphinx, ROOT / "docs", folder], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder


def test_nothing_is_fetched(site: Path) -> None:
    fetched = re.compile(
        r"<(?:script|img|iframe|source)[^>]*\ssrc=\"(https?:|//)|<link[^>]*stylesheet[^>]*href=\"(https?:|//)"
    )
    assert [page.name for page in site.rglob("*.html") if fetched.search(page.read_text(encoding="utf-8"))] == []


def test_every_example_has_a_picture_and_every_formula_is_drawn(site: Path) -> None:
    examples = sorted(path.stem for path in (ROOT / "examples" / "gallery").glob("*.py"))
    assert len(examples) >= 12
    assert [name for name in examples if not (site / "_images" / f"sphx_glr_{name}_001.png").exists()] == []
    notation = (site / "notation.html").read_text(encoding="utf-8")
    assert notation.count('<img class="math"') > 90
    assert "$" not in re.sub(r"<[^>]*>", "", notation)


def test_the_reference_has_every_public_name(site: Path) -> None:
    import umbilical

    page = (site / "api.html").read_text(encoding="utf-8")
    assert [name for name in umbilical.__all__ if f'id="umbilical.{name}"' not in page] == []


@pytest.mark.browser
@pytest.mark.skipif(browser.PROGRAM is None, reason="no Chromium on this machine")
def test_the_search_works_from_disk_without_network(site: Path) -> None:
    command = [str(browser.PROGRAM), *browser._QUIET, f"--user-data-dir={site / 'profile'}"]
    address = (site / "search.html").resolve().as_uri() + "?q=tension"
    done = subprocess.run(
        [*command, "--virtual-time-budget=8000", "--dump-dom", address],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert 'href="theory.html' in done.stdout.split('id="search-results"')[1]

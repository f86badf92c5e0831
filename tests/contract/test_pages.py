"""Every command and every block of the documentation runs, as tools/pages.py runs them."""

from __future__ import annotations

import re
import runpy
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest
import typer.main

from umbilical.cli.app import make_app

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
RUNNER = runpy.run_path(str(ROOT / "tools" / "pages.py"), run_name="pages")
LANGUAGES = {"bash", "python", "toml", "csv", "c", "output", "text"}
QUICK = ("certificates.md",)
"""Pages of few seconds."""

each_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
COMMANDS = {command.name: command for command in typer.main.get_command(make_app()).commands.values()}  # type: ignore[attr-defined]


def with_blocks() -> Iterator[object]:
    """Pages that have anything to run."""
    for page in PAGES:
        if any(block.language in ("bash", "python") for block in RUNNER["blocks"](page)):
            yield pytest.param(page, id=page.name, marks=[] if page.name in QUICK else pytest.mark.slow)


@pytest.mark.parametrize("page", list(with_blocks()))
def test_all_blocks_of_a_page_run(page: Path, tmp_path: Path) -> None:
    RUNNER["run_page"](page, tmp_path, RUNNER["replacements"](page.name))


@pytest.mark.parametrize(
    ("block", "complaint"),
    [
        ("```bash\nfalse\n```", "exit code 1"),
        ("```bash\numbilical rum paper\n```", "exit code 2"),
        ("```bash\nfalse # exit code 7\n```", "exit code 1"),
        ("```bash\ntrue # exit code 7\n```", "exit code 0"),
        ("```bash\necho 1\n```\n```output\n2\n```", "was printed"),
        ("```bash\necho 100 m\n```\n```output\n103 m\n```", "was printed"),
        ("```bash\necho 1; echo 2; echo 3\n```\n```output\n1\n3\n```", "was printed"),
        ("```bash\necho 1; echo 2; echo 3\n```\n```output\n1\n...\n4\n```", "was printed"),
        ("```python\nassert 1 > 2\n```", "line 1"),
    ],
)
def test_a_block_that_does_something_else_is_noticed(block: str, complaint: str, tmp_path: Path) -> None:
    (tmp_path / "page.md").write_text(block + "\n", encoding="utf-8")
    with pytest.raises(Exception, match=complaint):
        RUNNER["run_page"](tmp_path / "page.md", tmp_path)


def test_what_a_page_shows_may_differ_by_round_off_and_leave_lines_out() -> None:
    RUNNER["compare"]("a  100 m\n...\nd 2e-05\n", "a 100.9 m\n\nb\nc\nd 2.01e-05\n")


def unknown(text: str) -> list[str]:
    """Commands and options of ``umbilical`` in a text that do not exist."""
    words = shlex.split(text, comments=True)
    name, found = words[1] if len(words) > 1 else "", []
    if name.startswith("-"):
        return [] if name in ("--help", "--version", "--install-completion") else [text]
    if name not in COMMANDS:
        return [text]
    known = {option for parameter in COMMANDS[name].params for option in parameter.opts + parameter.secondary_opts}
    for word in words[2:]:
        if re.match(r"--?[a-z]", word) and word.split("=")[0] not in known | {"--help", "--debug"}:
            found.append(f"{name} {word}")
    return found


def spoken(page: Path) -> Iterator[str]:
    """Calls of ``umbilical`` in the text of a page and in its blocks."""
    text = page.read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    yield from (" ".join(found.split()) for found in re.findall(r"`(umbilical [^`]+)`", prose))
    for block in RUNNER["blocks"](page):
        if block.language == "bash":
            parts = (part for command in RUNNER["commands"](block) for part in re.split(r"&&|\|", command.text))
            yield from (part.strip() for part in parts if part.strip().startswith("umbilical "))


@each_page
def test_commands_and_options_exist(page: Path) -> None:
    """Those of the text, too, and those that pages.toml leaves out."""
    assert [wrong for text in spoken(page) for wrong in unknown(text)] == []


def test_a_mistyped_command_or_option_is_noticed() -> None:
    assert unknown("umbilical rum paper") == ["umbilical rum paper"]
    assert unknown("umbilical run paper --polt a.png -o") == ["run --polt", "run -o"]
    assert unknown("umbilical run paper --set a=-1 --plot a.png  # --nothing") == []


@each_page
def test_every_block_has_a_language_and_no_command_stands_outside(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    languages = re.findall(r"^```(.*)\n(?:.*\n)*?```", text, flags=re.MULTILINE)
    assert set(languages) - LANGUAGES - {"{toctree}"} == set()
    assert re.findall(r"^    +(?:\$|(?:\.venv/bin/)?umbilical|python3?|pip|cc|git) .*", text, flags=re.MULTILINE) == []


@each_page
def test_what_is_not_run_as_it_stands_is_on_its_page(page: Path) -> None:

    listed = RUNNER["replacements"](page.name)
    there = [c.text for b in RUNNER["blocks"](page) if b.language == "bash" for c in RUNNER["commands"](b)]
    assert sorted(set(listed) - set(there)) == []


def test_the_list_of_what_is_not_run_names_pages_and_reasons() -> None:
    listed = RUNNER["tomllib"].loads((ROOT / "tools" / "pages.toml").read_text(encoding="utf-8"))
    assert set(listed) <= {page.name for page in PAGES}
    for entries in listed.values():
        for entry in entries.values():
            assert set(entry) in ({"add", "why"}, {"run", "why"}, {"skip"})

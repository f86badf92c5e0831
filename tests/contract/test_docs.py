"""The documentation is current, points at things that exist, and its examples run."""

from __future__ import annotations

import re
import runpy
import sys
import tomllib
from collections import Counter
from pathlib import Path

import pytest

import umbilical
from umbilical.library.admit import admit_data
from umbilical.library.load import preset_text
from umbilical.quantities import CHANNELS, METRICS, PARAMETERS, STATES
from umbilical.scenario.document import extend
from umbilical.studies.load import load_study

ROOT = Path(__file__).parents[2]
DOCS = sorted((ROOT / "docs").glob("*.md"))
SOURCE = ROOT / "src" / "umbilical"
WRITER = runpy.run_path(str(ROOT / "tools" / "make_docs"))

each_page = pytest.mark.parametrize("page", DOCS, ids=lambda page: page.name)


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)


def anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as GitHub makes them."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


@pytest.mark.parametrize("name", WRITER["PAGES"])
def test_generated_pages_are_current(name: str) -> None:
    """If this fails: .venv/bin/python tools/make_docs"""
    assert WRITER["is_current"](name)


@pytest.mark.parametrize("name", WRITER["PAGES"])
def test_a_page_that_is_not_current_is_noticed(name: str, tmp_path: Path) -> None:
    assert not WRITER["is_current"](name, tmp_path)
    (tmp_path / name).write_text(WRITER["PAGES"][name]() + " ", encoding="utf-8")
    assert not WRITER["is_current"](name, tmp_path)


def test_the_reference_has_every_public_name_once() -> None:
    named = re.findall(r"^\.\. auto(?:class|function):: (\w+)$", (ROOT / "docs" / "api.rst").read_text("utf-8"), re.M)
    assert sorted(named) == sorted(umbilical.__all__)


@each_page
def test_links_lead_somewhere(page: Path) -> None:
    lost = []
    for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
        if link.startswith("https://"):
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        if not target.exists() or (anchor and anchor not in anchors(target)):
            lost.append(link)
    assert lost == []


@each_page
def test_files_named_are_there(page: Path) -> None:
    """`plant/cable.py` stands for src/umbilical/plant/cable.py, a longer path for itself."""
    named = set(re.findall(r"`((?:[\w.]+/)+|[\w/.]+\.(?:py|toml|md|json))`", page.read_text(encoding="utf-8")))
    users = {"my.toml", "my_law.py"}
    assert sorted(n for n in named - users if not any((root / n).exists() for root in (ROOT, SOURCE))) == []


@each_page
def test_functions_named_with_their_file_are_in_it(page: Path) -> None:
    """`plant/cable.py: evaluate, drift` names functions, classes or constants of that file, or tests."""
    missing = []
    for name, things in re.findall(r"`([\w/]+\.py): ([\w, ]+)`", page.read_text(encoding="utf-8")):
        text = (ROOT / name if name.startswith("tests/") else SOURCE / name).read_text(encoding="utf-8")
        missing += [
            f"{name}: {t}" for t in things.split(", ") if not re.search(rf"^(def|class) {t}\b|^{t}\b", text, re.M)
        ]
    assert missing == []


@pytest.mark.parametrize(
    ("page", "text"),
    [(page.name, text) for page in DOCS for text in blocks(page, "toml") if not re.match(r"# [\w-]+\.toml\n", text)],
)
def test_toml_examples_are_scenarios(page: str, text: str, tmp_path: Path) -> None:
    """An example that does not say what it extends is a piece of one that extends the paper's; some are studies.

    One with a name is a file of its page, which uses it where test_pages.py runs the page.
    """
    data = {"extends": "paper", **tomllib.loads(text)}
    if isinstance(data.get("scenario"), str):
        (tmp_path / "study.toml").write_text(text, encoding="utf-8")
        load_study(tmp_path / "study.toml")
        return
    base = tomllib.loads(preset_text(str(data.pop("extends"))))
    while "extends" in base:
        base = extend(tomllib.loads(preset_text(str(base.pop("extends")))), base)
    admit_data(extend(base, data), page)


@pytest.mark.parametrize(
    "table", [PARAMETERS, CHANNELS, STATES, METRICS], ids=["parameters", "channels", "states", "metrics"]
)
def test_every_word_means_one_thing(table: dict[str, umbilical.quantities.Quantity]) -> None:
    assert [m for m, count in Counter(q.meaning for q in table.values()).items() if count > 1] == []


def test_every_parameter_stands_at_a_key() -> None:
    """The one that does not is a dimension of the results."""
    places = sys.modules["scenario"].keys_by_meaning()
    assert [name for name, q in PARAMETERS.items() if q.meaning not in places] == ["sigma"]


def test_every_channel_and_metric_is_in_a_run() -> None:
    """The metric after a fault is only there with one, the saturated share with a limit, a snap after slack."""
    changes = {"duration": 0.05, "faults.1.start": 0.02, "motors.1.voltage_limit": 400.0}
    runs = [
        umbilical.simulate(umbilical.load("paper-dead", changes | {"model": model})) for model in ("string", "rope")
    ]
    wet = {"environment.water": {}, "cable.water": {"diameter": 0.03}, "cable.wet_line_density": 1.3, "duration": 0.05}
    runs.append(umbilical.simulate(umbilical.load("paper", wet)))
    held = {str(name) for run in runs for name in run.data.data_vars if not str(name).startswith("metric_")}
    assert held == set(CHANNELS)
    assert {name for run in runs for name in run.metrics} | {"largest_snap"} == set(METRICS)


def lost_words(text: str) -> list[str]:
    """Backticked files and names of a page's tables that are nowhere in the tree."""
    quoted = [word for row in text.splitlines() if row.startswith("| ") for word in re.findall(r"`([^`]+)`", row)]
    files = [word for word in quoted if "/" in word and " " not in word]
    folders = [SOURCE, ROOT]
    lost = [word for word in files if not any([*folder.glob(word.rstrip("/"))] for folder in folders)]
    code = [path for folder in (SOURCE, ROOT / "tests" / "support") for path in folder.rglob("*.*")]
    known = "\n".join(p.read_text(encoding="utf-8") for p in code if p.suffix in (".py", ".toml", ".c", ".html"))
    names = (name for word in quoted if word not in files for name in re.findall(r"[A-Za-z_]\w{2,}", word))
    return lost + [name for name in names if name not in known]


def test_the_architecture_names_what_is_there() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    assert lost_words(page) == []
    assert lost_words("| `plant/nowhere.py` | `no_such_function` of `plant/winch.py` |") == [
        "plant/nowhere.py",
        "no_such_function",
    ]

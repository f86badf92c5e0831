"""Inputs as users and accidents make them: a command line and the files it names, mutated from sound ones."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from typing import Any, NamedTuple

from hypothesis import strategies as st

from tests.support.studies import small_study
from umbilical import load

PRESETS = ("paper", "paper-adaptive", "paper-dead", "paper-pd", "ringdown", "haul-in", "crosscheck-none")
SHORT = {"duration": 0.05, "grid.elements": 8}
"""So that the engine is reached often; no mutation makes a run long."""
_SLOW_KEYS = ("duration", "elements", "step", "period", "members", "interval", "schema_version", "count", "trials")
"""Scaled down only by what stays short, or made invalid."""


class Case(NamedTuple):
    """One input.

    Attributes:
        kind: of the generator.
        arguments: of the command line; ``{name}`` stands for the path of a file, ``{out}`` for a folder to write to.
        files: content by name.
    """

    kind: str
    arguments: tuple[str, ...]
    files: tuple[tuple[str, bytes], ...] = ()


numbers = st.one_of(
    st.sampled_from([0.0, -0.0, -1.0, 1e-9, 1e9, 1e300, -1e300, 5e-324, float("inf"), float("nan"), 10**30, 2**63]),
    st.floats(width=32),
    st.integers(-10, 10),
)
texts = st.one_of(st.sampled_from(["", "none", "1e3", "\x1b[31m", "../a", "paper", "a" * 300]), st.text(max_size=12))
anything: st.SearchStrategy[Any] = st.recursive(
    st.one_of(numbers, texts, st.booleans()),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text("abc_.1", max_size=5), inner, max_size=2)
    ),
    max_leaves=4,
)


def leaves(data: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of everything in nested tables and lists, containers too."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    return [found for key, value in items for found in ((*path, key), *leaves(value, (*path, key)))]


@st.composite
def mutated(draw: Callable[..., Any], data: dict[str, Any], wild: bool) -> dict[str, Any]:
    """Plain data with one to three places changed: numbers by a factor, or, if wild, anything to anything."""
    data = copy.deepcopy(data)
    for _ in range(draw(st.integers(1, 3))):
        path = draw(st.sampled_from(leaves(data)))
        place = data
        for step in path[:-1]:
            place = place[step]
        value, slow = place[path[-1]], path[-1] in _SLOW_KEYS
        if not wild and type(value) is float and not slow:
            place[path[-1]] = value * draw(st.floats(0.5, 2.0)) * draw(st.sampled_from([1.0] * 6 + [-1.0, 100.0]))
        elif wild and draw(st.integers(0, 3)) == 0:
            del place[path[-1]]
        elif wild and draw(st.integers(0, 5)) == 0 and isinstance(place, dict):
            place[draw(st.text("abcdefgh_", min_size=1, max_size=8))] = draw(anything)
        elif wild:
            place[path[-1]] = draw(numbers if type(value) in (int, float) else anything)
            if slow and type(place[path[-1]]) in (int, float) and not place[path[-1]] <= 0:
                place[path[-1]] = draw(st.sampled_from([-1, 0, "a"]))
    return data


def as_text(data: dict[str, Any]) -> bytes:
    """Plain data as TOML, one line a key: a writer that keeps layouts would take longer than what is tested."""
    return "".join(f"{json.dumps(key)} = {_toml(value)}\n" for key, value in data.items()).encode()


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return repr(value) if isinstance(value, float) else json.dumps(value)


SCENARIOS = {name: load(name, SHORT).to_dict() for name in PRESETS}
STUDY = small_study(
    members=2, scenario__duration=0.02, campaigns__1__start={"kind": "uniform", "low": 0.0, "high": 0.01}
)


@st.composite
def spoilt(draw: Callable[..., Any], content: bytes) -> bytes:
    """Bytes cut short, or with a few of them changed."""
    if draw(st.booleans()):
        return content[: draw(st.integers(0, len(content)))]
    changed = bytearray(content)
    for _ in range(draw(st.integers(1, 8))):
        changed[draw(st.integers(0, len(content) - 1))] = draw(st.integers(0, 255))
    return bytes(changed)


@st.composite
def scenario_files(draw: Callable[..., Any]) -> Case:
    """A scenario with changed values, or a damaged text."""
    data = SCENARIOS[draw(st.sampled_from(PRESETS))]
    content = as_text(draw(mutated(data, draw(st.sampled_from([False] * 5 + [True])))))
    if draw(st.integers(0, 11)) == 0:
        content = draw(spoilt(content))
    more = draw(st.sampled_from([(), (), (), ("--out", "{out}/a.nc"), ("--out", "{out}/no/a.nc")]))
    command = draw(st.sampled_from(["run"] * 9 + ["show"]))
    options = ("--json", *more) if command == "run" else ("--json",)
    return Case("scenario", (command, "{a.toml}", *options), (("a.toml", content),))


def _at(data: Any, path: tuple[Any, ...]) -> Any:
    for step in path:
        data = data[step]
    return data


keys = st.one_of(
    st.sampled_from(sorted({".".join(str(s + 1 if isinstance(s, int) else s) for s in path)
                            for data in SCENARIOS.values() for path in leaves(data)})),
    st.text("abcdefghijklmnop._-0123456789", max_size=20),
    st.text(max_size=6),
)  # fmt: skip
values = st.one_of(
    numbers.map(str),
    st.text(max_size=10),
    st.sampled_from(["[", "{", "'", '"', "[" * 500, "{a=" * 200, "9" * 5000, "true", "nan", "[1,2]", "{kind='none'}"]),
    st.floats(0.5, 2.0).map(str),
)
_FLOATS = {
    ".".join(str(step + 1 if isinstance(step, int) else step) for step in path): _at(SCENARIOS["paper"], path)
    for path in leaves(SCENARIOS["paper"])
    if type(_at(SCENARIOS["paper"], path)) is float and path[-1] not in _SLOW_KEYS
}
scaled = st.builds(
    lambda key, factor: f"{key}={_FLOATS[key] * factor}", st.sampled_from(sorted(_FLOATS)), st.floats(0.5, 2)
)
assignments = st.one_of(
    st.tuples(keys, values).map("=".join),
    st.text(max_size=12),
    st.just("a." * 1000 + "a=1"),
    st.just("=" * 50),
)


@st.composite
def assigned(draw: Callable[..., Any]) -> Case:
    """Changes on the command line."""
    words = [
        word
        for text in draw(st.lists(scaled if draw(st.integers(0, 2)) else assignments, min_size=1, max_size=2))
        for word in ("--set", text)
    ]
    short = [word for key, value in SHORT.items() for word in ("--set", f"{key}={value}")]
    return Case("set", ("run", draw(st.sampled_from(PRESETS)), *words, *short, "--json"))


@st.composite
def study_files(draw: Callable[..., Any]) -> Case:
    """A study with changed values."""
    content = as_text(draw(mutated(STUDY.to_dict(), draw(st.booleans()))))
    if draw(st.integers(0, 11)) == 0:
        content = draw(spoilt(content))
    command = draw(st.sampled_from(["sweep", "sweep", "sweep", "show", "member"]))
    more = (
        ("--out", "{out}/s", "--jobs", "1", "--json") if command == "sweep" else ("1",) if command == "member" else ()
    )
    return Case("study", (command, "{s.toml}", *more), (("s.toml", content),))


@st.composite
def words(draw: Callable[..., Any]) -> Case:
    """Command lines that are none."""
    commands = ("run", "show", "compare", "export", "plot", "sweep", "member", "presets", "schema", "tune", "nope", "")
    options = (
        "--json",
        "--set",
        "--out",
        "--force",
        "--help",
        "--metric",
        "--jobs",
        "--kind",
        "--copy",
        "--version",
    )
    tail = st.lists(st.one_of(st.sampled_from(options), texts, st.just("{out}/x")), max_size=3)
    found = tuple(draw(tail))
    command = draw(st.sampled_from(commands))
    first = (
        ("{out}/none.nc",) if command in ("run", "sweep", "tune", "plot") else ()
    )  # no run of a preset's full length
    return Case("words", tuple(word.replace("\x00", "") for word in (command, *first, *found)))


@st.composite
def result_files(draw: Callable[..., Any], alterations: Callable[..., bytes]) -> Case:
    """The result of a run or of a study, with attributes or variables changed, or damaged."""
    which = draw(st.sampled_from(["run", "study"]))
    content = alterations(draw, which)
    commands = {
        "run": (("show",), ("run", "--json"), ("compare",), ("export", "--to", "csv", "--out", "{out}/a.csv")),
        "study": (("show",), ("show", "--json"), ("member", "1"), ("sweep", "--out", "{out}/again", "--jobs", "1")),
    }
    command, *more = draw(st.sampled_from(commands[which]))
    return Case("result", (command, "{a.nc}", *more), (("a.nc", content),))

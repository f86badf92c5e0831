"""Published numbers with the tolerance each may move by, and the comparison with what was computed.

``expected.toml`` is written by ``tools/make_expected`` from a complete reproduction and read by everybody: the
check of ``umbilical reproduce --check``, and the page docs/paper.md, whose numbers are taken from it.
"""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from importlib import resources
from typing import Any, NamedTuple

from umbilical.papers.rao2022.ledger import Finding, Kind, Number

TOLERANCES: dict[Kind, tuple[str, float, str]] = {
    Kind.PEAK: ("relative", 0.01, "half the step and period on 96 elements move it by less than half a per cent"),
    Kind.ERROR: ("relative", 0.05, "a small difference of large numbers, of stored samples"),
    Kind.SAMPLED: ("relative", 0.05, "at the preset's period of 1 ms; it is proportional to the period"),
    Kind.FRONT: (
        "relative",
        0.1,
        "a wave front is in it; half the step and period on 96 elements move it by 4 per cent",
    ),
    Kind.EXACT: ("relative", 1e-5, "it follows from settings, not from a run; written with six digits"),
    Kind.COUNT: ("relative", 0.05, "cells on the edge of stability fall to either side; where none is lost, none may"),
    Kind.FEW: ("absolute", 1.0, "one value on the edge may fall to the other side"),
    Kind.SHARE: ("absolute", 0.03, "cells in which both arms are nearly equal fall to either side"),
    Kind.INSTANT: (
        "relative",
        0.2,
        "an instability grows from almost nothing; half the step and period move it by a tenth",
    ),
    Kind.EDGE: ("relative", 0.03, "an edge of stability; on three grids it is the same within this"),
    Kind.CROSSING: ("relative", 0.03, "where two curves cross, along straight lines between points of a scan"),
    Kind.SOLVED: ("relative", 0.01, "solved without a grid: an ordinary differential equation or a frequency response"),
    Kind.SEARCH: ("relative", 0.03, "the end of a search, which another processor may end a little elsewhere"),
}
"""How far a number of each kind may move, and why so far."""

FILE = "expected.toml"
_HEAD = """\
# Every number that docs/paper.md publishes, with the tolerance it may move by and why, and every verdict.
# Written by `.venv/bin/python tools/make_expected`; compared by `umbilical reproduce --check`.
"""


class Deviation(NamedTuple):
    """One thing that is not as published: which number or verdict, what was found, published and allowed."""

    name: str
    found: str
    published: str
    allowed: str

    def __str__(self) -> str:
        return f"{self.name}: {self.found}, published {self.published}, allowed {self.allowed}"


@lru_cache(maxsize=1)
def published() -> Mapping[str, Any]:
    """What expected.toml says, by claim."""
    return parse((resources.files("umbilical.papers.rao2022") / FILE).read_text(encoding="utf-8"))


def parse(text: str) -> dict[str, Any]:
    """Claims of a text of :func:`expected_text`; each number has the tolerance of its kind, and why so much."""
    claims = tomllib.loads(text)
    tolerances = claims.pop("tolerances")
    for entry in (entry for claim in claims.values() for entry in claim.values() if isinstance(entry, dict)):
        entry |= tolerances[entry["kind"]]
    return claims


def expected_text(findings: Iterable[Finding]) -> str:
    """The file for a complete ledger."""
    kinds = (
        f"{kind.value} = {{ {how} = {size:g}, why = {json.dumps(why)} }}"
        for kind, (how, size, why) in TOLERANCES.items()
    )
    return "\n".join([_HEAD, "[tolerances]", *kinds, *(line for finding in findings for line in _claim(finding)), ""])


def _claim(finding: Finding) -> Iterator[str]:
    yield from ("", f"[{finding.id}]")
    yield f"statement = {json.dumps(finding.statement)}"
    yield f"verdict = {json.dumps(finding.verdict.value)}"
    yield f"conclusion = {json.dumps(finding.conclusion)}"
    for number in finding.numbers:
        entry = f"value = {number.value:.6g}, unit = {json.dumps(number.unit)}, kind = {json.dumps(number.kind.value)}"
        yield f"{number.name} = {{ {entry} }}  # {number.meaning}"


def deviations(
    findings: Sequence[Finding], against: Mapping[str, Any] | None = None, *, complete: bool = True
) -> list[Deviation]:
    """Everything that is not as published.

    Args:
        findings: what was computed.
        against: what was published; ``expected.toml`` if left out.
        complete: whether maps were made; without them what needs them is not asked for.
    """
    expected = published() if against is None else against
    found = [d for finding in findings for d in _of_claim(finding, expected.get(finding.id, {}), complete)]
    missing = expected.keys() - {finding.id for finding in findings}
    return found + [Deviation(name, "no such claim", "a claim", "none missing") for name in sorted(missing)]


def _of_claim(finding: Finding, expected: Mapping[str, Any], complete: bool) -> Iterator[Deviation]:
    if finding.verdict.value != expected.get("verdict"):
        yield Deviation(
            f"{finding.id} verdict", finding.verdict.value, str(expected.get("verdict", "nothing")), "the same"
        )
    numbers = {number.name: number for number in finding.numbers}
    for name in sorted(numbers.keys() - expected.keys()):
        yield Deviation(f"{finding.id}.{name}", f"{numbers[name].value:.6g}", "nothing", "what is published")
    for name, entry in expected.items():
        if isinstance(entry, Mapping):
            yield from _of_number(f"{finding.id}.{name}", numbers.get(name), entry, complete)


def _of_number(name: str, number: Number | None, entry: Mapping[str, Any], complete: bool) -> Iterator[Deviation]:
    value, limit = float(entry["value"]), _limit(entry)
    if number is None:
        if complete:
            yield Deviation(name, "not computed", f"{value:g}", f"{limit:.2g} off")
    elif not _near(number.value, value, limit):
        yield Deviation(name, f"{number.value:.6g} {number.unit}", f"{value:g}", f"{limit:.2g} off")


def _limit(entry: Mapping[str, Any]) -> float:
    """How far a number may be off."""
    return float(entry["absolute"]) if "absolute" in entry else float(entry["relative"]) * abs(float(entry["value"]))


def _near(found: float, value: float, limit: float) -> bool:
    if not math.isfinite(value) or not math.isfinite(found):
        return math.isnan(value) == math.isnan(found) and math.isinf(value) == math.isinf(found)
    return abs(found - value) <= limit

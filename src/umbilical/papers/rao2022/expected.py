"""Published numbers with the tolerance each may move by, and the comparison with what was computed.

``expected.toml`` is written by ``tools/make_expected`` from a complete reproduction and read by everybody: the
check of ``umbilical reproduce --check``, and the page docs/paper.md, whose numbers are taken from it.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from umbilical.papers.rao2022.experiments import read_data
from umbilical.papers.rao2022.ledger import WORDS, Finding, Number

FILE = "expected.toml"
_HEAD = """\
# Every number that docs/paper.md publishes, and every verdict. How far each kind may move, and why, says claims.toml.
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
    return with_tolerances(read_data(FILE))


def with_tolerances(claims: dict[str, Any]) -> dict[str, Any]:
    """Claims as the file has them; each number gets the tolerance of its kind, and why so much."""
    for entry in (entry for claim in claims.values() for entry in claim.values() if isinstance(entry, dict)):
        entry |= WORDS["tolerances"][entry["kind"]]
    return claims


def expected_text(findings: Iterable[Finding]) -> str:
    """The file for a complete ledger."""
    return "\n".join([_HEAD, *(line for finding in findings for line in _claim(finding))])


def _claim(finding: Finding) -> Iterator[str]:
    yield f"[{finding.id}]"
    words = {"statement": finding.statement, "verdict": finding.verdict.value, "conclusion": finding.conclusion}
    yield from (f"{key} = {json.dumps(text)}" for key, text in words.items())
    for n in finding.numbers:
        yield f'{n.name} = {{ value = {n.value:.6g}, unit = "{n.unit}", kind = "{n.kind}" }}  # {n.meaning}'
    yield ""


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
    verdict, published_one = finding.verdict.value, str(expected.get("verdict", "nothing"))
    if verdict != published_one:
        yield Deviation(f"{finding.id} verdict", verdict, published_one, "the same")
    numbers = {number.name: number for number in finding.numbers}
    for name in sorted(numbers.keys() - expected.keys()):
        yield Deviation(f"{finding.id}.{name}", f"{numbers[name].value:.6g}", "nothing", "what is published")
    for name, entry in expected.items():
        if isinstance(entry, Mapping) and (name in numbers or complete):
            yield from _of_number(f"{finding.id}.{name}", numbers.get(name), entry)


def _of_number(name: str, number: Number | None, entry: Mapping[str, Any]) -> Iterator[Deviation]:
    value = float(entry["value"])
    limit = float(entry["absolute"]) if "absolute" in entry else float(entry["relative"]) * abs(value)
    none = number is not None and math.isnan(number.value) and math.isnan(value)
    if number is None or not (none or math.isclose(number.value, value, rel_tol=0.0, abs_tol=limit)):
        found = f"{number.value:.6g} {number.unit}" if number else "not computed"
        yield Deviation(name, found, f"{value:g}", f"{limit:.2g} off")

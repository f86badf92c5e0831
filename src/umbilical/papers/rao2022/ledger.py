"""What a claim comes to: a statement, numbers, a verdict, and where it holds; its words are those of claims.toml."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from string import Formatter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from umbilical import Run, Status
from umbilical.papers.rao2022.experiments import Runs, read_data
from umbilical.papers.rao2022.proofs import Proofs

if TYPE_CHECKING:
    import xarray

WORDS = read_data("claims.toml")
"""What is said of every claim, and the tolerances of numbers by their kind."""
BOUNDS: dict[str, float] = WORDS["bounds"]
"""From which value on we say what we say."""


class Verdict(Enum):
    """What became of a claim."""

    HOLDS = "holds"
    CONDITIONAL = "holds only when"
    FAILS = "does not reproduce"


class Edge(NamedTuple):
    """The least gain at which a loop runs away, and whether it is the same on all grids."""

    gain: float
    same: bool


class Evidence(NamedTuple):
    """What claims are judged by.

    Attributes:
        runs: single runs by the names of their experiments.
        gain: the scan of the gain of the allocation.
        edges: where the loop runs away, by case, arm and observer.
        maps: by name; empty when they were left out.
        proofs: what can be proved of the proposed law's loop.
    """

    runs: Runs
    gain: xarray.Dataset
    edges: Mapping[tuple[str, str, str], Edge]
    maps: Mapping[str, xarray.Dataset]
    proofs: Proofs


class Judged(NamedTuple):
    """What a claim was judged by: values by the names that its words use, and whether it holds everywhere it was
    looked at, or only somewhere."""

    values: Mapping[str, Any]
    holds: bool
    somewhere: bool = False

    @property
    def verdict(self) -> Verdict:
        """The verdict.

        >>> Judged({}, True).verdict.value, Judged({}, False, True).verdict.value, Judged({}, False).verdict.value
        ('holds', 'holds only when', 'does not reproduce')
        """
        if self.holds:
            return Verdict.HOLDS
        return Verdict.CONDITIONAL if self.somewhere else Verdict.FAILS


class Number(NamedTuple):
    """One computed number of a claim; ``name`` is unique within it, ``kind`` decides how far it may move."""

    name: str
    value: float
    unit: str
    meaning: str
    kind: str


@dataclass(frozen=True)
class Finding:
    """One line of the ledger.

    Attributes:
        id: the claim's, as in docs/paper.md.
        verdict: the conclusion, drawn from the numbers.
        numbers: what came out.
        statement: what is claimed, in our words.
        measure: what was measured, and from which value on the statement is said to hold.
        because: the conclusion in words, with its numbers.
        region: where it holds, as far as that was looked at.
        when: what completes "holds only when".
    """

    id: str
    verdict: Verdict
    numbers: tuple[Number, ...]
    statement: str
    measure: str
    because: str
    region: str
    when: str = ""

    @property
    def conclusion(self) -> str:
        """The verdict as a sentence's end."""
        return f"{self.verdict.value} {self.when}" if self.verdict is Verdict.CONDITIONAL else self.verdict.value


def make_finding(name: str, judged: Judged, evidence: Evidence) -> Finding:
    """What became of a claim, in its words."""
    words, values = WORDS[name], {**BOUNDS, **metric_values(name, evidence.runs), **judged.values}
    for key, ways in words.get("either", {}).items():
        values[key] = say(ways[not values.get(key, evidence.maps)], values)
    told = {key: say(text, values) for key, text in words.items() if isinstance(text, str)}
    return Finding(name, judged.verdict, tuple(_numbers(words["numbers"], values)), **told)


def metric_values(name: str, runs: Runs) -> dict[str, float]:
    """Numbers of a claim that are metrics of runs, or ratios of them."""
    words = {number: word for number, word in WORDS[name]["numbers"].items() if "run" in word}
    ones = {number: runs[word["over"]].metrics[word["metric"]] for number, word in words.items() if "over" in word}
    return {n: runs[word["run"]].metrics[word["metric"]] / ones.get(n, 1.0) for n, word in words.items()}


def _numbers(words: Mapping[str, Mapping[str, str]], values: Mapping[str, Any]) -> Iterator[Number]:
    """Those whose value there is; a map's are left out with it."""
    for pattern, word in words.items():
        found = values.get(word["of"], {}) if "of" in word else {"": values[pattern]} if pattern in values else {}
        for key, value in found.items():
            name, meaning = (say(text, values, key) for text in (pattern, word["meaning"]))
            yield Number(name.replace(" ", "_"), float(value), word.get("unit", "1"), meaning, word.get("kind", "peak"))


class _Words(Formatter):
    """Numbers with three digits, in per cent by ``%``; several with commas, by ``&`` with "and"."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if isinstance(value, Mapping):
            return self._all(
                [f"{self.format_field(v, format_spec.rstrip('&'))} ({k})" for k, v in value.items()], format_spec
            )
        if isinstance(value, list):
            return self._all([self.format_field(v, format_spec.rstrip("&")) for v in value], format_spec)
        if isinstance(value, float) and format_spec in ("", "%"):
            return percent(value) if format_spec else short(value)
        return format(value, format_spec)

    def _all(self, parts: list[str], format_spec: str) -> str:
        return (" and " if format_spec.endswith("&") else ", ").join(parts)


def say(text: str, values: Mapping[str, Any], key: str = "") -> str:
    """A text with values in place of their names, and the parts of a key in place of {0}, {1}.

    >>> say("{peak} m, {left:%&} left, {0}", {"peak": 11.04, "left": {"dead": 0.5, "stuck": 1.0}}, "on")
    '11 m, 50 % (dead) and 100 % (stuck) left, on'
    """
    return _Words().vformat(text, key.split("/"), values)


def short(value: float) -> str:
    """Three digits.

    >>> short(0.0084162), short(41.0)
    ('0.00842', '41')
    """
    return f"{value:.3g}"


def percent(share: float) -> str:
    """A share in per cent, two digits.

    >>> percent(0.07314), percent(1.0)
    ('7.3 %', '100 %')
    """
    return f"{100 * share:.2g} %" if share < 0.995 else f"{100 * share:.3g} %"


def window_peak(run: Run, begin: float, end: float) -> float:
    """Largest |y(l,t)| of the stored samples between two instants, m."""
    return float(abs(run["tip_displacement"].sel(time=slice(begin, end))).max())


def relative_error(truth: xarray.DataArray, estimate: xarray.DataArray) -> float:
    """Root mean square of the error over that of the truth."""
    return float(np.sqrt(((truth - estimate) ** 2).mean() / (truth**2).mean()))


def all_completed(runs: Iterable[Run]) -> bool:
    """Whether all came to their end."""
    return all(run.status is Status.COMPLETED for run in runs)

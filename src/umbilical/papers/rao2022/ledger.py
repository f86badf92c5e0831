"""What a claim comes to: a statement, numbers, a verdict, and where it holds."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from umbilical import Run, Status
from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.proofs import Proofs

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray


class Verdict(Enum):
    """What became of a claim."""

    HOLDS = "holds"
    CONDITIONAL = "holds only when"
    FAILS = "does not reproduce"


class Kind(Enum):
    """What sort of number it is, which decides how far it may move; see :mod:`umbilical.papers.rao2022.expected`."""

    PEAK = "peak"
    ERROR = "error"
    SAMPLED = "sampled"
    FRONT = "front"
    EXACT = "exact"
    COUNT = "count"
    FEW = "few"
    SHARE = "share"
    INSTANT = "instant"
    EDGE = "edge"
    CROSSING = "crossing"
    SOLVED = "solved"
    SEARCH = "search"


class Number(NamedTuple):
    """One computed number of a claim; ``name`` is unique within it."""

    name: str
    value: float
    unit: str
    meaning: str
    kind: Kind = Kind.PEAK


@dataclass(frozen=True)
class Finding:
    """One line of the ledger.

    Attributes:
        id: the claim's, as in docs/paper.md.
        statement: what is claimed, in our words.
        measure: what was measured, and from which value on the statement is said to hold.
        numbers: what came out.
        verdict: the conclusion, drawn from the numbers.
        because: the conclusion in words, with its numbers.
        region: where it holds, as far as that was looked at.
        when: what completes "holds only when"; empty for the other verdicts.
    """

    id: str
    statement: str
    measure: str
    numbers: tuple[Number, ...]
    verdict: Verdict
    because: str
    region: str
    when: str = ""

    @property
    def conclusion(self) -> str:
        """The verdict as a sentence's end."""
        return f"{self.verdict.value} {self.when}" if self.verdict is Verdict.CONDITIONAL else self.verdict.value


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


UNMAPPED = "The maps were left out (--no-maps)."
FOLLOWS = 0.1
"""A relative error below which we say that an estimate follows."""


def count_kind(size: int) -> Kind:
    """The kind of a count of so many: a few along one axis of a map, or the cells of a map."""
    return Kind.FEW if size < 100 else Kind.COUNT


def decide(holds: bool, somewhere: bool = False) -> Verdict:
    """The verdict of a statement that holds everywhere it was looked at, only somewhere, or nowhere.

    >>> decide(True).value, decide(False, somewhere=True).value, decide(False).value
    ('holds', 'holds only when', 'does not reproduce')
    """
    if holds:
        return Verdict.HOLDS
    return Verdict.CONDITIONAL if somewhere else Verdict.FAILS


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


def completed(runs: Iterable[Run]) -> bool:
    """Whether all came to their end."""
    return all(run.status is Status.COMPLETED for run in runs)

"""What a verification consists of: cases, and in each the checks of one number against another.

A check holds when its error is not above its tolerance; NaN is above everything.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from time import perf_counter
from typing import Any

import numpy as np

from umbilical.analysis.convergence import Curve, orders
from umbilical.errors import UmbilicalError
from umbilical.verify.references import CaseError

UNFINISHED = "the whole case"
"""The quantity of a check that stands for those which a case did not come to."""
ORDER_SLACK = 0.1
"""How far below the stated order the finest pair of grids may be."""


@dataclass(frozen=True)
class Check:
    """One number of ours against one of a reference.

    Attributes:
        quantity: what is compared, with its unit.
        ours: of the engine; of several numbers the worst.
        expected: of the reference, at the same place.
        error: in the measure of the tolerance.
        tolerance: the largest error that is accepted.
        why: where the tolerance comes from.
        curve: errors over grids, where the check is an observed order.
    """

    quantity: str
    ours: float
    expected: float
    error: float
    tolerance: float
    why: str
    curve: Curve | None = None

    @property
    def holds(self) -> bool:
        """Whether the error is within the tolerance."""
        return bool(self.error <= self.tolerance)

    @property
    def verdict(self) -> str:
        """Likewise, in a word."""
        return "holds" if self.holds else "FAILS"


@dataclass(frozen=True)
class Case:
    """One comparison with a reference.

    Attributes:
        name: what is compared, in a few words.
        reference: what it is compared with.
        source: where the reference comes from.
        find: computes the checks.
        quick: whether ``--quick`` includes it.
        needs: an optional package without which it is skipped.
    """

    name: str
    reference: str
    source: str
    find: Callable[[], Iterable[Check]]
    quick: bool = True
    needs: str = ""

    def judge(self) -> Result:
        """All checks of the case, or why there are none."""
        begun = perf_counter()
        if self.needs and find_spec(self.needs) is None:
            return Result(self, (), f"needs {self.needs}", 0.0)
        checks: list[Check] = []
        try:
            checks.extend(self.find())
        except Exception as error:  # any error fails this case only
            nan = float("nan")
            what = error if isinstance(error, CaseError | UmbilicalError) else repr(error)
            checks.append(Check(UNFINISHED, nan, nan, nan, 0.0, f"could not be carried through: {what}"))
        return Result(self, tuple(checks), "", perf_counter() - begun)


@dataclass(frozen=True)
class Result:
    """A case with its checks; ``skipped`` says why there are none."""

    case: Case
    checks: tuple[Check, ...]
    skipped: str
    seconds: float

    @property
    def holds(self) -> bool:
        """Whether no check fails. A skipped case has none."""
        return all(check.holds for check in self.checks)


def each(
    name: str, reference: str, source: str, find: Callable[[Any], Iterable[Check]],
    settings: Mapping[str, Any] | Sequence[Any], **options: Any,
) -> tuple[Case, ...]:  # fmt: skip
    """A case for each of some settings, which are named in a mapping, or values that ``name`` shows; the rest alike."""
    named = settings if isinstance(settings, Mapping) else {value: value for value in settings}
    return tuple(
        Case(name.format(shown), reference, source, partial(find, value), **options) for shown, value in named.items()
    )


def close(quantity: str, ours: float, expected: float, tolerance: float, why: str) -> Check:
    """Two numbers; the error is relative to the expected one."""
    return Check(quantity, float(ours), float(expected), abs(ours - expected) / abs(expected), tolerance, why)


def small(quantity: str, value: float, tolerance: float, why: str) -> Check:
    """A number that should vanish."""
    return Check(quantity, float(value), 0.0, abs(float(value)), tolerance, why)


def each_close(quantity: str, ours: Any, expected: Any, tolerance: float, why: str) -> Check:
    """Several numbers, each relative to its own; the worst is shown."""
    found, exact = np.ravel(ours), np.ravel(expected)
    relative = np.abs(found - exact) / np.abs(exact)
    worst = int(np.argmax(relative))
    return Check(quantity, _shown(found[worst]), _shown(exact[worst]), float(relative[worst]), tolerance, why)


def history_close(quantity: str, ours: Any, expected: Any, tolerance: float, why: str) -> Check:
    """Histories or fields; the largest distance over the peak of the expected one, shown where it is largest."""
    found, exact = np.ravel(ours), np.ravel(expected)
    off = np.abs(found - exact)
    worst = int(np.argmax(off if off.any() else np.abs(exact)))  # nowhere apart: shown at the peak
    return Check(
        quantity, _shown(found[worst]), _shown(exact[worst]), float(off[worst] / np.abs(exact).max()), tolerance, why
    )


def channels_close(
    ours: Any, theirs: Any, names: Mapping[str, str], *limit: Any, factor: float = 1.0
) -> Iterator[Check]:
    """Channels of two runs, by name with their units; ``factor`` is of the expected ones."""
    for name, unit in names.items():
        shown = f"{name.replace('_', ' ')}, {unit}"
        yield history_close(shown, ours[name].values, factor * theirs[name].values, *limit)


def at_least(quantity: str, value: float, least: float, why: str) -> Check:
    """A number that must not be small; the error is what it lacks, as a ratio."""
    return Check(quantity, value, least, least / value, 1.0, why)


def order_reached(curve: Curve, why: str) -> Check:
    """The order of the finest pair of grids; the error is what it lacks to the stated one."""
    found = float(orders(curve.errors, curve.sizes)[-1])
    return Check(
        f"order of {curve.name} in {curve.size}", found, curve.order, curve.order - found, ORDER_SLACK, why, curve
    )


def worst_ratio(checks: Sequence[Check]) -> float:
    """Largest error over its tolerance; infinite for NaN, and for any error where none is tolerated."""
    return max(map(_ratio, checks), default=0.0)


def _ratio(check: Check) -> float:
    if check.holds and not check.tolerance:
        return 0.0
    ratio = check.error / check.tolerance if check.tolerance else np.inf
    return float(ratio) if np.isfinite(ratio) else np.inf


def _shown(value: complex) -> float:
    """A pole is shown by its imaginary part, its frequency."""
    return float(np.imag(value) if np.iscomplexobj(value) else np.real(value))

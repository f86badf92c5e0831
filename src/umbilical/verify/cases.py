"""What a verification consists of: cases, and in each the checks of one number against another.

A check holds when its error is not above its tolerance; NaN is above everything.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from importlib.util import find_spec
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from umbilical.analysis.convergence import Curve, orders
from umbilical.errors import UmbilicalError
from umbilical.verify.references import CaseError

UNFINISHED = "the whole case"
"""The quantity of a check that stands for those which a case did not come to."""
ORDER_SLACK = 0.1
"""How far below the stated order the finest pair of grids may be."""
Checks: TypeAlias = Iterator["Check"]


class Check(NamedTuple):
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


class Case(NamedTuple):
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
        if self.needs and find_spec(self.needs) is None:
            return Result(self, (), f"needs {self.needs}")
        checks: list[Check] = []
        try:
            checks.extend(self.find())
        except Exception as error:  # any error fails this case only
            what = error if isinstance(error, CaseError | UmbilicalError) else repr(error)
            checks.append(Check(UNFINISHED, np.nan, np.nan, np.nan, 0.0, f"could not be carried through: {what}"))
        return Result(self, tuple(checks))


class Result(NamedTuple):
    """A case with its checks; ``skipped`` says why there are none."""

    case: Case
    checks: tuple[Check, ...]
    skipped: str = ""

    @property
    def holds(self) -> bool:
        """Whether no check fails. A skipped case has none."""
        return all(check.holds for check in self.checks)


class Cases(list[Case]):
    """The cases of a family, in the order in which they stand in its file."""

    def add(self, name: str, reference: str, source: str, settings: Any = None, **options: Any) -> Callable[[Any], Any]:
        """Decorate what computes the checks of a case.

        With ``settings`` it is a case for each of them: named in a mapping, or values that ``name`` shows.
        """

        def of(find: Callable[..., Checks]) -> Callable[..., Checks]:
            if settings is None:
                self.append(Case(name, reference, source, find, **options))
            else:
                pairs = settings.items() if isinstance(settings, Mapping) else zip(settings, settings, strict=True)
                self.extend(Case(name.format(shown), reference, source, partial(find, value), **options)
                            for shown, value in pairs)  # fmt: skip
            return find

        return of


def close(quantity: str, ours: Any, expected: Any, tolerance: float, why: str) -> Check:
    """Numbers, each relative to its own; of several the worst is shown."""
    found, exact = np.ravel(ours), np.ravel(expected)
    relative = np.abs(found - exact) / np.abs(exact)
    return _shown(quantity, found, exact, relative, int(np.argmax(relative)), tolerance, why)


def small(quantity: str, value: Any, tolerance: float, why: str) -> Check:
    """A number that should vanish."""
    return Check(quantity, float(value), 0.0, abs(float(value)), tolerance, why)


def same_history(quantity: str, ours: Any, expected: Any, tolerance: float, why: str) -> Check:
    """Histories or fields; the largest distance over the peak of the expected one, shown where it is largest."""
    found, exact = np.ravel(ours), np.ravel(expected)
    off = np.abs(found - exact)
    worst = int(np.argmax(off if off.any() else np.abs(exact)))  # nowhere apart: shown at the peak
    return _shown(quantity, found, exact, off / np.abs(exact).max(), worst, tolerance, why)


def same_channels(ours: Any, theirs: Any, names: Mapping[str, str], *limit: Any, factor: float = 1.0) -> Checks:
    """Channels of two runs, by name with their units; ``factor`` is of the expected ones."""
    for name, unit in names.items():
        shown = f"{name.replace('_', ' ')}, {unit}"
        yield same_history(shown, ours[name].values, factor * theirs[name].values, *limit)


def at_least(quantity: str, value: float, least: float, why: str) -> Check:
    """A number that must not be small; the error is what it lacks, as a ratio."""
    return Check(quantity, value, least, least / value, 1.0, why)


def order_reached(curve: Curve, why: str = "stated") -> Check:
    """The order of the finest pair of grids; the error is what it lacks to the stated one."""
    found = float(orders(curve.errors, curve.sizes)[-1])
    what = f"order of {curve.name} in {curve.size}"
    return Check(what, found, curve.order, curve.order - found, ORDER_SLACK, why, curve)


def orders_reached(
    names: Mapping[str, float], size: str, sizes: Sequence[float], rows: Any, why: str = "stated"
) -> Checks:
    """Orders by name; ``rows`` of shape (sizes, names or more) are the errors."""
    for (name, order), errors in zip(names.items(), np.transpose(rows).tolist(), strict=False):
        yield order_reached(Curve(name, size, tuple(sizes), tuple(errors), order), why)


def worst_ratio(checks: Sequence[Check]) -> float:
    """Largest error over its tolerance; infinite for NaN, and for any error where none is tolerated."""
    ratios = (check.error / check.tolerance if check.tolerance else 0.0 if check.holds else np.inf for check in checks)
    return max((float(ratio) if np.isfinite(ratio) else np.inf for ratio in ratios), default=0.0)


def _shown(quantity: str, found: Any, exact: Any, errors: Any, worst: int, *limit: Any) -> Check:
    """One of many; a pole is shown by its imaginary part, its frequency."""
    ours, expected = (float(v[worst].imag if np.iscomplexobj(v) else v[worst]) for v in (found, exact))
    return Check(quantity, ours, expected, float(errors[worst]), *limit)

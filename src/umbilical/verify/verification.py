"""All cases, judged one after the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pkgutil import resolve_name
from typing import Any, ClassVar

from umbilical.analysis.convergence import Curve
from umbilical.result import ResultFaces, call_plot
from umbilical.verify.cases import Case, Result

_PLACES = {
    "Hanging cable": ("hanging_string:CASES",),
    "Damping and reflection": ("hanging_string:DAMPING",),
    "Moving end": ("moving_end:CASES",),
    "Vessel in motion": ("moordyn:CASES",),
    "Manufactured solutions": ("manufactured:CASES",),
    "Power balance": ("power_balance:CASES",),
    "Motor": ("control:MOTORS",),
    "Control laws and observers": ("control:CASES",),
    "Instants": ("instants:CASES",),
    "Whole loop": ("whole_loop:CASES",),
    "Invariance": ("invariance:CASES",),
    "Sea and heave": ("sea:CASES", "water_pairs:SEA_CASES"),
    "String in water": ("manufactured:AT_SEA_CASES", "water:CASES", "water_pairs:CASES", "water:SHAKEN"),
    "Rope": ("rope:CASES", "manufactured:ROPE_CASES", "rope_waves:CASES", "rope_pairs:CASES"),
}
FAMILIES: dict[str, tuple[Case, ...]] = {
    family: tuple(case for place in places for case in resolve_name(f"umbilical.verify.{place}"))
    for family, places in _PLACES.items()
}
"""Every case, in the order of the table."""


@dataclass(frozen=True)
class Verification(ResultFaces):
    """What a verification found: a result for each case, by family."""

    shown_by: ClassVar[str] = "umbilical.faces.verification"
    families: dict[str, tuple[Result, ...]]

    def plot(self, **options: Any) -> Any:
        """Draw the convergence of every family whose order is judged."""
        return call_plot("plot_convergence", self.curves, **options)

    @property
    def results(self) -> tuple[Result, ...]:
        """All of them."""
        return tuple(result for results in self.families.values() for result in results)

    @property
    def holds(self) -> bool:
        """Whether every check that could be made holds."""
        return all(result.holds for result in self.results)

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Errors over grids, named after their cases."""
        return tuple(
            check.curve._replace(name=f"{result.case.name}: {check.curve.name}")
            for result in self.results for check in result.checks if check.curve
        )  # fmt: skip

    @property
    def headline(self) -> str:
        """How many checks there were and how many hold."""
        holding = [check.holds for result in self.results for check in result.checks]
        failed, skipped = holding.count(False), sum(bool(result.skipped) for result in self.results)
        made = f"{_counted(len(holding), 'check')} in {_counted(len(self.results) - skipped, 'case')}"
        more = [f", {failed} FAIL"] * bool(failed) + [f", {_counted(skipped, 'case')} skipped"] * bool(skipped)
        return f"{made}: {holding.count(True)} hold" + "".join(more)


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def verify_all(quick: bool = False, *, progress: Callable[[float], None] = lambda share: None) -> Verification:
    """Judge every case.

    Args:
        quick: leave out the cases that take long.
        progress: called with the share done, 0 to 1.

    Returns:
        All results. A case that lacks an optional package is skipped, and says so.

    >>> from umbilical.verify.control import MOTORS
    >>> MOTORS[0].judge().holds
    True
    """
    chosen = [(name, case) for name, cases in FAMILIES.items() for case in cases if case.quick or not quick]
    found: dict[str, tuple[Result, ...]] = {}
    for done, (family, case) in enumerate(chosen, start=1):
        found[family] = (*found.get(family, ()), case.judge())
        progress(done / len(chosen))
    return Verification(found)

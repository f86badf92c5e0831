"""All cases, judged one after the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any, ClassVar

from umbilical.analysis.convergence import Curve
from umbilical.result import ResultFaces
from umbilical.verify.cases import Case, Result

_FILES = {
    "Hanging cable": ("hanging_string", "static_deflection"),
    "Damping and reflection": ("tip_damper",),
    "Moving end": ("moving_end",),
    "Vessel in motion": ("moordyn",),
    "Manufactured solutions": ("manufactured",),
    "Power balance": ("power_balance",),
    "Motor": ("motor",),
    "Control laws and observers": ("laws", "observers", "adaptation"),
    "Instants": ("instants",),
    "Whole loop": ("crosscheck", "cascade"),
    "Invariance": ("invariance",),
    "Sea and heave": ("sea", "sea_pairs"),
    "String in water": ("water", "water_pairs", "water_response"),
    "Rope": ("rope", "rope_manufactured", "rope_waves", "rope_invariance", "rope_pairs"),
}
FAMILIES: dict[str, tuple[Case, ...]] = {
    family: tuple(case for name in names for case in import_module(f"umbilical.verify.{name}").CASES)
    for family, names in _FILES.items()
}
"""Every case, in the order of the table."""

Progress = Callable[[float], None]


@dataclass(frozen=True)
class Verification(ResultFaces):
    """What a verification found: a result for each case, by family."""

    shown_by: ClassVar[str] = "umbilical.verify.summary"
    families: dict[str, tuple[Result, ...]]

    def plot(self, **options: Any) -> Any:
        """Draw the convergence of every family whose order is judged."""
        from umbilical.plots import plot_convergence

        return plot_convergence(self.curves, **options)

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
            for result in self.results
            for check in result.checks
            if check.curve
        )

    @property
    def headline(self) -> str:
        """How many checks there were and how many hold."""
        checks = [check for result in self.results for check in result.checks]
        failed, skipped = sum(not c.holds for c in checks), sum(bool(r.skipped) for r in self.results)
        made = f"{_counted(len(checks), 'check')} in {_counted(len(self.results) - skipped, 'case')}"
        parts = [f"{made}: {len(checks) - failed} hold"]
        parts += [f"{failed} FAIL"] if failed else []
        parts += [f"{_counted(skipped, 'case')} skipped"] if skipped else []
        return ", ".join(parts)


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def verify_all(quick: bool = False, *, progress: Progress = lambda share: None) -> Verification:
    """Judge every case.

    Args:
        quick: leave out the cases that take long.
        progress: called with the share done, 0 to 1.

    Returns:
        All results. A case that lacks an optional package is skipped, and says so.

    >>> from umbilical.verify.motor import CASES
    >>> CASES[0].judge().holds
    True
    """

    chosen = {family: [case for case in cases if case.quick or not quick] for family, cases in FAMILIES.items()}
    total, found = sum(map(len, chosen.values())), {}
    for done, (family, case) in enumerate(((f, case) for f, cases in chosen.items() for case in cases), start=1):
        found[family] = (*found.get(family, ()), case.judge())
        progress(done / total)
    return Verification(found)

"""All cases, judged one after the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from umbilical.analysis.convergence import Curve
from umbilical.result import ResultFaces
from umbilical.verify import (
    adaptation,
    cascade,
    crosscheck,
    hanging_string,
    instants,
    invariance,
    laws,
    manufactured,
    moordyn,
    motor,
    moving_end,
    observers,
    power_balance,
    rope,
    rope_invariance,
    rope_manufactured,
    rope_pairs,
    rope_waves,
    sea,
    sea_pairs,
    static_deflection,
    tip_damper,
    water,
    water_pairs,
    water_response,
)
from umbilical.verify.cases import Case, Check, Result

FAMILIES: dict[str, tuple[Case, ...]] = {
    "Hanging cable": (*hanging_string.CASES, *static_deflection.CASES),
    "Damping and reflection": tip_damper.CASES,
    "Moving end": moving_end.CASES,
    "Vessel in motion": moordyn.CASES,
    "Manufactured solutions": manufactured.CASES,
    "Power balance": power_balance.CASES,
    "Motor": motor.CASES,
    "Control laws and observers": (*laws.CASES, *observers.CASES, *adaptation.CASES),
    "Instants": instants.CASES,
    "Whole loop": (*crosscheck.CASES, *cascade.CASES),
    "Invariance": invariance.CASES,
    "Sea and heave": (*sea.CASES, *sea_pairs.CASES),
    "String in water": (*water.CASES, *water_pairs.CASES, *water_response.CASES),
    "Rope": (*rope.CASES, *rope_manufactured.CASES, *rope_waves.CASES, *rope_invariance.CASES, *rope_pairs.CASES),
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
    total, done, found = sum(map(len, chosen.values())), 0, {}
    for family, cases in ((family, cases) for family, cases in chosen.items() if cases):
        results = []
        for case in cases:
            results.append(case.judge())
            done += 1
            progress(done / total)
        found[family] = tuple(results)
    return Verification(found)


def rows_of(result: Result) -> list[dict[str, Any]]:
    """Rows of the table, one for each check, or one that says why there is none."""
    common = {"case": result.case.name, "reference": result.case.reference, "source": result.case.source}
    if result.skipped:
        return [common | {"verdict": f"skipped: {result.skipped}"}]
    return [common | _row(check) for check in result.checks]


def _row(check: Check) -> dict[str, Any]:
    plain = {
        "quantity": check.quantity, "ours": check.ours, "expected": check.expected, "error": check.error,
        "tolerance": check.tolerance, "why": check.why, "verdict": "holds" if check.holds else "FAILS",
    }  # fmt: skip
    if check.curve:
        plain["sizes"], plain["errors"] = list(check.curve.sizes), list(check.curve.errors)
    return plain

"""Runs beside each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from umbilical.errors import expect
from umbilical.quantities import METRICS
from umbilical.result import ResultFaces, call_plot
from umbilical.run import Run


@dataclass(frozen=True, eq=False)
class Comparison(ResultFaces):
    """Metrics of two or more runs side by side.

    Attributes:
        runs: in the order given; ratios are to the first.
        names: what each is called.

    >>> import umbilical
    >>> runs = [umbilical.simulate(umbilical.load(name, {"duration": 0.5})) for name in ("paper-none", "paper")]
    >>> umbilical.compare(*runs).names
    ('paper-none', 'paper')
    """

    shown_by: ClassVar[str] = "umbilical.faces.comparison"

    runs: tuple[Run, ...]
    names: tuple[str, ...]

    @property
    def metrics(self) -> dict[str, tuple[float | None, ...]]:
        """Values in SI units by metric, one for each run; None where a run does not have it."""
        found = {name: tuple(run.metrics.get(name) for run in self.runs) for name in METRICS}
        return {name: values for name, values in found.items() if any(value is not None for value in values)}

    @property
    def ratios(self) -> dict[str, tuple[float | None, ...]]:
        """Each value over that of the first run; None where one is missing or the first is zero."""
        return {
            name: tuple(value / values[0] if value is not None and values[0] else None for value in values)
            for name, values in self.metrics.items()
        }

    def plot(self, **options: Any) -> Any:
        """Draw the displacement of the ROV in all runs; options as for :func:`umbilical.plot_tip`."""
        return call_plot("plot_tip", self.runs, names=self.names, **options)


def compare(*runs: Run, names: Sequence[str] = ()) -> Comparison:
    """Compare the metrics of runs, as ``umbilical compare`` does.

    Args:
        runs: two or more; ratios are to the first.
        names: what each is called; the names of the runs, numbered where equal, if left out.

    Raises:
        ValueError: fewer than two runs, or another number of names.
        TypeError: something that is not a run.

    >>> import umbilical
    >>> scenario = umbilical.load("crosscheck-none", {"duration": 1.0})
    >>> found = umbilical.compare(*(umbilical.simulate(s) for s in (scenario, scenario.replace({"payload.mass": 9e3}))))
    >>> found.names, found.ratios["tip_peak"][1] < 1.0
    (('crosscheck-none', 'crosscheck-none (2)'), True)
    """
    for run in runs:
        expect(run, "Run", "open_run")
    if len(runs) < 2 or (names and len(names) != len(runs)):
        raise ValueError(f"compare takes two or more runs and a name for each; got {len(runs)} and {len(names)} names")
    return Comparison(runs, tuple(names) or distinct_names(runs))


def distinct_names(runs: Sequence[Run]) -> tuple[str, ...]:
    """The names of runs, equal ones numbered from the second on."""
    names = [run.name for run in runs]
    before = [list(names[:k]).count(name) for k, name in enumerate(names)]
    return tuple(f"{name} ({n + 1})" if n else name for name, n in zip(names, before, strict=True))

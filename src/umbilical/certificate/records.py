"""What a certificate is: inequalities with their margins, the numbers they were found with, and what follows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from umbilical.certificate.loads import Loads
from umbilical.certificate.setting import Loop
from umbilical.errors import Problem
from umbilical.result import ResultFaces
from umbilical.scenario.scenario import Scenario


@dataclass(frozen=True)
class Inequality:
    """One condition, ``left <= right``, where it is tightest.

    Attributes:
        name: as in docs/certificates.md, e.g. ``K5``.
        equation: what it says, in symbols.
        left, right: both sides there, in ``unit``.
        unit: SI unit of both sides.
        x: distance from the vessel where it is tightest, m; None if it has none.
        t: instant at which it is tightest, s; None if it has none.
        strict: whether equality breaks it.

    >>> slow = Inequality("K2", "lam (l + x0)/gam <= beta", 0.8, 1.0, "m/s")
    >>> round(slow.margin, 12), slow.holds
    (0.2, True)
    """

    name: str
    equation: str
    left: float
    right: float
    unit: str
    x: float | None = None
    t: float | None = None
    strict: bool = False

    @property
    def margin(self) -> float:
        """``right - left``: how much is left, or by how much it fails."""
        return self.right - self.left

    @property
    def holds(self) -> bool:
        """Whether it does; never with a side that is not a number."""
        return self.margin > 0.0 if self.strict else self.margin >= 0.0


class Weights(NamedTuple):
    """The free numbers of V, all over gam.

    Attributes:
        cross: lam/gam, 1/s, weight of V2.
        vessel: lam x0/gam, m/s; what pays for hauling in.
        boundary: eta/gam, weight of V3.
    """

    cross: float
    vessel: float
    boundary: float


class Span(NamedTuple):
    """Bounds from below and above, arrays of one shape."""

    low: np.ndarray
    high: np.ndarray


class Ranges(NamedTuple):
    """What the winch does in every piece of time, proved by intervals; bounds of shape (slabs, pieces).

    Attributes:
        length: l, m.
        speed: v, m/s.
        net: g - a, m/s2.
    """

    length: Span
    speed: Span
    net: Span


class Start(NamedTuple):
    """Where the scenario starts from.

    Attributes:
        cable: V1 + V2, J.
        error: u_a, m/s.
        missed: D~ = D - D^, N.
    """

    cable: float
    error: float
    missed: float


class Proof(NamedTuple):
    """What interval arithmetic found.

    Attributes:
        holds: every condition is proved for all x in [0, l(t)] and all t of the run.
        boxes: intervals of time it took; none where no weights were found that could be tried.
        open: what could not be proved, by name and interval of time, s.
    """

    holds: bool
    boxes: int
    open: tuple[tuple[str, float, float], ...] = ()


@dataclass(frozen=True, eq=False)
class Certificate(ResultFaces):
    """How fast the ideal loop of a scenario is proved to calm down, and how far its loads can push it.

    V is scaled so that gam = 1: it is an energy, in J. Between the instants ``edges`` the rates are constant:
    ``V' <= -(rates - spent) V + residual``; over an instant of ``jumps`` V may grow as written there.

    Attributes:
        scenario: what was certified.
        inequalities: K0 to K6, each where it is tightest.
        margins: smallest margin in each slab over the larger side, by name, shape (slabs,).
        paper: the paper's own iota_1 ... iota_7, as printed, signs restored.
        loop: constants of the ideal loop.
        weights: the numbers found by the search.
        edges: instants between which the rate is constant, s, shape (slabs + 1,).
        rates: proved rate th of V in each slab, 1/s, shape (slabs,); not a number where nothing can be certified.
        stretch: factor V may grow by at each edge because the tension jumps there, shape (slabs + 1,).
        ranges: length, speed and g - a over pieces of each slab, by intervals.
        fixed_length_rate: best rate with the winch stopped at its greatest length, 1/s, found but not proved.
        exact_rate: rate of V there by the exact eigenvalues of the ideal loop, 1/s.
        loads: suprema over the run of what acts from outside.
        spent: part del of the rate that pays for loads along the cable, 1/s.
        residual: Th, W; infinite when a load has no bound.
        cable_residual: what loads along the cable and the vessel leave of it, W.
        start: where the scenario starts from.
        reach: bound of ``|y - e|/sqrt(V)`` at the middle and at the ROV, m/sqrt(J), the largest over the run.
        proof: the independent verification.
        fixes: what would mend it, when it does not hold and this was asked for.
        limits: what it does not speak about.

    >>> import umbilical
    >>> certificate = umbilical.certify(umbilical.load("ringdown", {"control.law.slope_gain": 5.0}))
    >>> certificate.holds, bool(certificate.rates.min() > 0.0)
    (True, True)
    """

    shown_by: ClassVar[str] = "umbilical.faces.certificate"
    drawn_by: ClassVar[str] = "plot_certificate"

    scenario: Scenario
    inequalities: tuple[Inequality, ...]
    margins: Mapping[str, np.ndarray]
    paper: tuple[Inequality, ...]
    loop: Loop
    weights: Weights
    edges: np.ndarray
    rates: np.ndarray
    stretch: np.ndarray
    ranges: Ranges
    fixed_length_rate: float
    exact_rate: float
    loads: Loads
    spent: float
    residual: float
    cable_residual: float
    start: Start
    reach: tuple[float, float]
    proof: Proof
    fixes: tuple[Problem, ...]
    limits: tuple[str, ...]

    def __repr__(self) -> str:
        state = f"certified, {self.rate:.4g} 1/s" if self.holds else "NOT certified"
        return f"<Certificate {self.scenario.name}: {state}>"

    @property
    def rate(self) -> float:
        """The smallest rate th of V over the run, 1/s; amplitudes decay at half of it."""
        return float(self.rates.min())

    @property
    def holds(self) -> bool:
        """Whether V decays at a positive rate all along the run, and this was verified."""
        return self.proof.holds and self.rate > 0.0 and all(inequality.holds for inequality in self.inequalities)

    @property
    def broken(self) -> tuple[Inequality, ...]:
        """The inequalities that fail."""
        return tuple(inequality for inequality in self.inequalities if not inequality.holds)

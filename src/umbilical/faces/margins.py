"""Margins as a verdict, a text and data."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import attributes, text_table

if TYPE_CHECKING:
    from umbilical.stability.grid import GridJudgement
    from umbilical.stability.judgement import Judgement
    from umbilical.stability.limits import Limit
    from umbilical.stability.margins import MarginReport
    from umbilical.stability.matrix import Counted, MatrixCheck


SHOWN_MODES = 3
SHOWN = {"phase": (180.0 / math.pi, " deg"), "delay": (1e3, " ms"), "frequency that grows": (1.0, " rad/s")}
"""Factor and unit in which a number is shown."""


def _conclusion(report: MarginReport) -> Conclusion:
    """Whether the loop is stable at every length, if the grids that were asked agree."""
    if report.doubt:
        return Conclusion("UNRESOLVED", f"{report.name}: UNRESOLVED, {report.doubt}")
    state = "stable" if report.stable else "NOT STABLE"
    if report.resolved is False:
        return Conclusion("UNRESOLVED", f"{report.name}: UNRESOLVED, {_disagreement(report)}")
    headline = f"{report.name}: {state} in linearised sampled operation"
    return Conclusion("HOLDS" if report.stable else "DOES_NOT_HOLD", headline)


def _document(report: MarginReport) -> dict[str, Any]:
    """A report as ``--json`` prints it."""
    return {
        "scenario": report.scenario.name,
        "scenario_hash": report.scenario.hash,
        **attributes(report, "operating_thrust stable resolved limits"),
        "controller": report.controller or None,
        "doubt": report.doubt or None,
        "grids": [
            attributes(g, "elements difference")
            | {"unstable_poles": g.stability.unstable, "differs_most": g.differs, "heard_up_to": g.heard}
            for g in report.grids
        ],
        "eigenvalues": report.check
        and attributes(report.check, "elements states counts") | {"agree": report.check.agrees},
        "lengths": [_one_length(judgement) for judgement in report.judgements],
    }


def _one_length(j: Judgement) -> dict[str, Any]:
    worst = j.stability.worst
    return {
        **attributes(j, "length stable modes"),
        "unstable_poles": j.stability.unstable,
        "unstable_poles_without_cable_end": j.stability.endless,
        "fastest_growth": None if worst is None else attributes(worst, "frequency rate"),
        "margins": j.margins
        and {
            name: attributes(margin, "size frequency")
            for name, margin in attributes(j.margins, "gain_low gain_high phase delay").items()
        },
        "reflection": {"frequency": j.frequency, "size": j.reflection},
    }


def _text(report: MarginReport) -> str:
    """What the verdict rests on, as people read it."""
    thrust = f"  motors linearised at a thrust of {report.operating_thrust:.4g} N"
    if report.doubt:
        return "  no margins are given"
    if report.controller:
        thrust += f"; {report.controller} linearised with the ROV at rest"
    lines = [thrust, text_table(rows(report), right=range(7))]
    lines += [f"  at {j.length:g} m: {line}" for j in report.judgements for line in _remarks(j)]
    outside = f"  outside these margins: {'; '.join(report.limits) or 'nothing'}"
    return "\n".join([*lines, *_grids(report), outside])


def _grids(report: MarginReport) -> list[str]:
    """What the engine's own grids say at the longest length."""
    lines = [f"  {g.elements} elements: {_apart(g)}; up to {g.heard:.3g} rad/s" for g in report.grids]
    if report.check:
        lines.append(f"  {report.check.elements} elements, {_eigenvalues(report.check)}")
    if report.resolved:
        lines.append("  at the longest length the grids agree with the exact cable")
    return lines


def _apart(g: GridJudgement) -> str:
    """How far a grid is from the exact cable, and in what."""
    d, (factor, unit) = g.differs, SHOWN.get(g.differs.name, (1.0, ""))
    what = f"{d.name.replace('_', ' ')} {factor * d.grid:.4g}{unit}, exact {factor * d.exact:.4g}{unit}"
    if not math.isfinite(d.size):
        return f"stability differs ({what})"
    shared = "margins" if g.margins else "both unstable, poles and fastest growth"
    return f"{shared} within {100.0 * d.size:.3g} % ({what})"


def _eigenvalues(check: MatrixCheck) -> str:
    counts = ", ".join(f"{_how_many(count)} {count.change}" for count in check.counts)
    agreement = "as counted" if check.agrees else "NOT as counted: " + ", ".join(str(c.nyquist) for c in check.counts)
    return f"unstable eigenvalues of the closed matrix of {check.states} states: {counts}; {agreement}"


def _how_many(count: Counted) -> str:
    most = count.eigenvalues + count.undecided
    return f"{count.eigenvalues} to {most}" if count.undecided else f"{most}"


def _disagreement(report: MarginReport) -> str:
    """Which two of exact cable, grids and eigenvalues say different things."""
    exact = f"the exact cable says {'stable' if report.stable else 'not stable'}"
    if report.check and not report.check.agrees:
        return f"eigenvalues and Nyquist's count disagree on {report.check.elements} elements; {exact}"
    worst = max(report.grids[-2:], key=lambda grid: grid.difference)
    return f"the grid of {worst.elements} elements differs from the exact cable: {_apart(worst)}; {exact}"


def rows(report: MarginReport) -> list[tuple[str, ...]]:
    """A row of cells for each length, below their names."""
    names = ("length", "effectiveness", "phase", "delay", "unstable poles", "first modes, rad/s", "damping ratios")
    return [names, *(_row(j) for j in report.judgements)]


def _row(j: Judgement) -> tuple[str, ...]:
    shown = j.modes[:SHOWN_MODES]
    frequencies = ", ".join(f"{mode.frequency:.4g}" for mode in shown) or "-"
    mode = (frequencies, ", ".join(f"{mode.damping_ratio:.2g}" for mode in shown) or "-")
    if j.margins is None:
        return (f"{j.length:g} m", "-", "-", "-", str(j.stability.unstable), *mode)
    m = j.margins
    low = f"{m.gain_low.size:.3g}"
    gains = f"{low} to {_or_more(m.gain_high.size, '.3g', '100')}"
    phase = _or_more(math.degrees(m.phase.size), ".3g", "90") + " deg"
    return (f"{j.length:g} m", gains, phase, _or_more(1e3 * m.delay.size, ".3g", "1000") + " ms", "0", *mode)


def _or_more(value: float, form: str, largest: str) -> str:
    """A number, or that it is beyond what was searched."""
    return f"{value:{form}}" if math.isfinite(value) else f"over {largest}"


def _remarks(j: Judgement) -> list[str]:
    """What grows, or what would first."""
    if j.stability.endless:
        return ["observers, sampling and motors are unstable even on a cable without an end"]
    if worst := j.stability.worst:
        return [f"waves of {worst.frequency:.4g} rad/s grow by {worst.rate:.2g} 1/s: the ROV feeds them"]
    if j.margins is None:
        return []
    named = {"less thrust": j.margins.gain_low, "more thrust": j.margins.gain_high, "delay": j.margins.delay}
    found = [f"{words}: {_frequency(limit)}" for words, limit in named.items() if math.isfinite(limit.frequency)]
    return ["what would grow first with " + ", ".join(found)] if found else []


def _frequency(limit: Limit) -> str:
    return f"{limit.frequency:.3g} rad/s"


FACE = Face(_conclusion, _text, _document)

"""In which sea an operation is possible: limits over depth, period and heading, as a verdict, a text and data."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.faces import confirmation
from umbilical.faces.conclusion import Conclusion, Face
from umbilical.tables import text_table

if TYPE_CHECKING:
    from umbilical.screening import Operability, Operation
    from umbilical.studies.confirm import Confirmation


def _conclusion(found: Operability, height: float | None = None, runs: Confirmation | None = None) -> Conclusion:
    """Whether a sea of this Hs is workable everywhere, if that was asked; runs of the rope, if any, have the word."""
    if runs:
        verdict = confirmation.FACE.conclusion(runs)
        return Conclusion(verdict.decision, f"{verdict.headline}; screening: {found.summary()}")
    if height is None:
        return Conclusion("NOT_ASKED", found.summary())
    holds = found.holds(height)
    where = f"over all {found.limit.size} depths, periods and headings" if found.limit.size > 1 else "there"
    headline = f"Hs {height:g} m is {'workable' if holds else 'NOT workable'} {where}; {found.summary()}"
    return Conclusion("HOLDS" if holds else "DOES_NOT_HOLD", headline)


def _text(found: Operability, height: float | None = None, runs: Confirmation | None = None) -> str:
    screened = "\n".join(_limits(found))
    return "\n".join([confirmation.FACE.text(runs), "", "the frequency domain:", screened]) if runs else screened


def _limits(found: Operability) -> Iterator[str]:
    """A table of the worst heading, thinned to a screen, and what the limits do not know."""
    rows, columns = thinned(found.depth.size), thinned(found.period.size)
    worst, steepest = found.limit.min(axis=2), found.steepest
    yield text_table(
        [
            ("limiting Hs [m] at", *(f"Tp {found.period[j]:.3g} s" for j in columns), "T1"),
            *(
                (
                    f"{found.depth[i]:.4g} m",
                    *(f"{'>' if steepest[i, j] else ''}{worst[i, j]:.2f}" for j in columns),
                    f"{found.axial_period[i]:.2f} s",
                )
                for i in rows
            ),
        ],
        right=range(1, len(columns) + 2),
    )
    headings = ", ".join(f"{angle:.0f}" for angle in np.degrees(found.heading))
    yield f"  worst of the headings {headings} deg; T1: longest axial period of cable and body"
    if steepest.any():
        yield "  >: no limit below the steepest sea of the period, a seventh of its wavelength"
    if worst.size > len(rows) * len(columns):
        of = f"{found.depth.size} depths x {found.period.size} periods"
        yield f"  shown: {len(rows)} x {len(columns)} of {of}; --json and --out have all"
    yield from remarks(found.notices(), found.operation)


def thinned(count: int, most: int = 11) -> list[int]:
    """Places of so many rows as a screen has room for, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int)).tolist()


def remarks(notices: Iterable[str], operation: Operation) -> Iterator[str]:
    """What a result does not know, and what of its operation is assumed."""
    yield from (f"  note: {notice}" for notice in notices)
    yield f"  assumed: {', '.join(operation.assumed) or 'nothing'}"


def _document(found: Operability, height: float | None = None, runs: Confirmation | None = None) -> dict[str, Any]:
    confirmed = {"confirmation": confirmation.FACE.document(runs)} if runs else {}
    return {**found.to_dict(), "height": height, **confirmed}


FACE = Face(_conclusion, _text, _document)

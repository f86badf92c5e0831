"""A comparison of runs as a verdict, a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.quantities import METRICS
from umbilical.tables import shown_unit, text_table

if TYPE_CHECKING:
    from umbilical.analysis.comparison import Comparison


def _conclusion(found: Comparison) -> Conclusion:
    """Nothing is judged."""
    return Conclusion("NOT_ASKED", f"{', '.join(found.names[1:])} over {found.names[0]}")


def _document(found: Comparison) -> dict[str, Any]:
    """A comparison as plain data, each run as its own ``to_dict()``."""
    runs = [{"name": name} | run.to_dict() for name, run in zip(found.names, found.runs, strict=True)]
    return {"runs": runs, "ratios": found.ratios}


def _text(found: Comparison) -> str:
    """Metrics side by side, then what each run notes."""
    head = ["", "", found.names[0]] + [cell for name in found.names[1:] for cell in (name, "ratio")]
    first, *others = (run.status.name for run in found.runs)
    rows = [head, ["status", "", first] + [cell for status in others for cell in (status, "")]]
    ratios = found.ratios
    for name, values in found.metrics.items():
        cells = [_shown(values[0], 6)]
        for value, ratio in zip(values[1:], ratios[name][1:], strict=True):
            cells += [_shown(value, 6), _shown(ratio, 4)]
        rows.append([name, shown_unit(METRICS[name].unit), *cells])
    notes = [f"  note: {name}: {n}" for name, run in zip(found.names, found.runs, strict=True) for n in run.notices]
    return "\n".join([text_table(rows, right=range(2, len(head))), *notes])


def _shown(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}g}"


FACE = Face(_conclusion, _text, _document)

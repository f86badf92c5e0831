"""A reproduction as a verdict, a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces.conclusion import Conclusion, Face
from umbilical.papers.rao2022.expected import Deviation, deviations

if TYPE_CHECKING:
    from umbilical.papers.rao2022.reproduction import Reproduction


def moved_in(found: Reproduction) -> list[Deviation]:
    """Numbers and verdicts that are not as published."""
    return deviations(found.findings, complete=found.mapped) if found.findings else []


def _conclusion(found: Reproduction, moved: list[Deviation] | None = None, check: bool = True) -> Conclusion:
    """Whether every number is as published, where that was asked."""
    moved = moved_in(found) if moved is None else moved
    made = f"reproduced: {len(found.findings)} claims, {len(found.shown)} figures"
    if not found.findings:
        return Conclusion("NOT_ASKED", f"reproduced: {len(found.shown)} figures")
    count = "1 number or verdict is" if len(moved) == 1 else f"{len(moved)} numbers or verdicts are"
    state = f"{count} NOT as published" if moved else "every number is as published"
    decision = "NOT_ASKED" if not check else "DOES_NOT_HOLD" if moved else "HOLDS"
    return Conclusion(decision, f"{made}; {state}")


def _text(found: Reproduction, *_: object) -> str:
    """The ledger."""
    return "\n".join(
        f"{f.id:<4} {f.statement}\n     {f.conclusion[0].upper() + f.conclusion[1:]}. {f.because}"
        for f in found.findings
    )


def _document(found: Reproduction, moved: list[Deviation] | None = None, *_: object) -> dict[str, Any]:
    """A reproduction as ``--json`` prints it."""
    moved = moved_in(found) if moved is None else moved
    claims = [
        {
            "id": f.id,
            "statement": f.statement,
            "verdict": f.verdict.value,
            "when": f.when if f.conclusion != f.verdict.value else "",
            "because": f.because,
            "region": f.region,
            "measure": f.measure,
            "numbers": {n.name: {"value": n.value, "unit": n.unit, "meaning": n.meaning} for n in f.numbers},
        }
        for f in found.findings
    ]
    runs = {name: {"status": run.status.name, "scenario_hash": run.scenario.hash} for name, run in found.runs.items()}
    return {"claims": claims, "not_as_published": [one._asdict() for one in moved], "runs": runs}


FACE = Face(_conclusion, _text, _document)

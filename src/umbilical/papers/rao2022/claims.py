"""The ledger: every claim, in order."""

from __future__ import annotations

from umbilical.papers.rao2022.claims_adaptation import a1, a2, a3
from umbilical.papers.rao2022.claims_faults import c6, c7a, c7b, c7c, c8, c9, c11
from umbilical.papers.rao2022.claims_sensing import c10
from umbilical.papers.rao2022.claims_theorems import t1, t2a, t2b, t3
from umbilical.papers.rao2022.claims_vibration import c1, c2, c3, c4, c5
from umbilical.papers.rao2022.ledger import Evidence, Finding, make_finding

CLAIMS = {
    "C1": c1, "C2": c2, "C3": c3, "C4": c4, "C5": c5, "C6": c6, "C7a": c7a, "C7b": c7b, "C7c": c7c, "C8": c8, "C9": c9,
    "C10": c10, "C11": c11, "T1": t1, "T2a": t2a, "T2b": t2b, "T3": t3, "A1": a1, "A2": a2, "A3": a3,
}  # fmt: skip


def judge_claims(evidence: Evidence) -> tuple[Finding, ...]:
    """What becomes of every claim."""
    return tuple(make_finding(name, claim(evidence), evidence) for name, claim in CLAIMS.items())

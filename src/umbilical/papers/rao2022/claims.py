"""The ledger: every claim, in order."""

from __future__ import annotations

from umbilical.papers.rao2022.claims_adaptation import a1, a2, a3
from umbilical.papers.rao2022.claims_faults import c6, c7a, c7b, c7c, c8, c9, c11
from umbilical.papers.rao2022.claims_sensing import c10
from umbilical.papers.rao2022.claims_theorems import t1, t2a, t2b, t3
from umbilical.papers.rao2022.claims_vibration import c1, c2, c3, c4, c5
from umbilical.papers.rao2022.ledger import Evidence, Finding

CLAIMS = (c1, c2, c3, c4, c5, c6, c7a, c7b, c7c, c8, c9, c10, c11, t1, t2a, t2b, t3, a1, a2, a3)


def judge(evidence: Evidence) -> tuple[Finding, ...]:
    """What becomes of every claim."""
    return tuple(claim(evidence) for claim in CLAIMS)

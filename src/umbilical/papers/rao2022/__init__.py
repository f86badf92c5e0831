"""The paper, reproduced: every figure from its runs, every claim with a verdict that numbers decide.

``experiments`` are single runs, ``slices`` the maps; ``datasets`` hold what each figure shows, ``figures`` are the
catalogue, ``claims`` the ledger, ``expected`` the published numbers, ``article`` the report.
"""

from umbilical.papers.rao2022.figures import PICTURES
from umbilical.papers.rao2022.reproduction import Reproduction, reproduce

__all__ = ["PICTURES", "Reproduction", "reproduce"]

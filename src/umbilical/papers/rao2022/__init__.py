"""The paper, reproduced: every figure from its runs, every claim with a verdict that numbers decide.

``experiments`` are single runs, ``maps`` the maps; ``figures`` hold each its data and its drawing and are the
catalogue, ``claims`` the ledger, ``expected`` the published numbers, ``article`` the report.
"""

from umbilical.papers.rao2022.figures import PICTURES
from umbilical.papers.rao2022.reproduction import Reproduction, reproduce

__all__ = ["PICTURES", "Reproduction", "reproduce"]

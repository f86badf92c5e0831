"""The paper's experiments, run once for all tests here."""

from __future__ import annotations

import pytest

from umbilical.reproduce.claims import judge
from umbilical.reproduce.experiments import EXPERIMENTS, Runs
from umbilical.reproduce.ledger import Evidence, Finding
from umbilical.reproduce.reproduction import run_experiments


@pytest.fixture(scope="session")
def runs() -> Runs:
    return run_experiments(tuple(EXPERIMENTS))


@pytest.fixture(scope="session")
def findings(runs: Runs) -> tuple[Finding, ...]:
    """The ledger without maps."""
    return judge(Evidence(runs, {}, {}))

"""The paper's experiments, run once for all tests here."""

from __future__ import annotations

import pytest

from umbilical.papers.rao2022.claims import judge_claims
from umbilical.papers.rao2022.experiments import EXPERIMENTS, Runs
from umbilical.papers.rao2022.ledger import Evidence, Finding
from umbilical.papers.rao2022.maps import compute_maps
from umbilical.papers.rao2022.reproduction import evidence as collect
from umbilical.papers.rao2022.reproduction import run_experiments


@pytest.fixture(scope="session")
def runs() -> Runs:
    return run_experiments(tuple(EXPERIMENTS))


@pytest.fixture(scope="session")
def evidence(runs: Runs) -> Evidence:
    """Runs, the scan of the gain and its edges; no maps."""
    return collect(runs, compute_maps(["gain"]))


@pytest.fixture(scope="session")
def findings(evidence: Evidence) -> tuple[Finding, ...]:
    """The ledger without maps."""
    return judge_claims(evidence)

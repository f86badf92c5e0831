"""Which worker has which tests, where several work at once."""

from __future__ import annotations

import pytest


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log):
    """Tests of a file may follow each other; those of the paper's room share its runs, so that one worker has them."""
    if config.getoption("dist") != "loadfile":
        return None
    from xdist.scheduler import LoadFileScheduling

    class ByRuns(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return "tests/papers" if nodeid.startswith("tests/papers/") else super()._split_scope(nodeid)

    return ByRuns(config, log)

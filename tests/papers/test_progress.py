"""Many runs at once: in order, with progress, and an error of one is an error of all."""

from __future__ import annotations

import pytest

from umbilical.papers.rao2022.experiments import EXPERIMENTS
from umbilical.papers.rao2022.progress import parts
from umbilical.studies.engines import in_order


def test_results_come_in_order() -> None:
    from time import sleep

    def slow_first(number: int) -> int:
        sleep(0.02 if number == 0 else 0.0)
        return number

    seen: list[float] = []
    assert in_order(slow_first, range(8), seen.append) == list(range(8))
    assert seen == sorted(seen)
    assert seen[-1] == 1.0


def test_an_error_is_raised_and_the_rest_dropped() -> None:
    begun: list[int] = []

    def failing(number: int) -> None:
        begun.append(number)
        raise RuntimeError(number)

    with pytest.raises(RuntimeError):
        in_order(failing, range(1000))
    assert len(begun) < 1000


def test_a_part_left_out_takes_no_share() -> None:
    seen: list[float] = []
    first, nothing, last = parts(seen.append, [1.0, 0.0, 1.0])
    for part in (first, nothing, last):
        part(1.0)
    assert seen == [0.5, 0.5, 1.0]


def test_only_what_is_not_the_papers_is_changed() -> None:
    """The paper's own cases are presets as they are; every other experiment says what it changes."""
    for experiment in EXPERIMENTS.values():
        assert experiment.what
        scenario, base = experiment.scenario(), type(experiment)(experiment.preset, "").scenario()
        assert (scenario == base) == (not experiment.changes)


def test_a_changed_value_is_no_longer_called_assumed() -> None:
    changed = EXPERIMENTS["blind, dead, fast"].scenario()
    assert "control.allocation.rates" not in changed.assumed
    assert "control.allocation.leak" in changed.assumed

"""What a study costs: a thousand members of one arm, what a second thread brings, and memory."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from time import perf_counter
from typing import TYPE_CHECKING

from benchmarks.machine import peak_of_children
from benchmarks.rows import Row

if TYPE_CHECKING:
    from umbilical.studies.study import Study

THOUSAND = 1000
_ARM = [{"name": "proposed"}]


def study_rows(members: int, plain: float) -> list[Row]:
    """Measure with some members, told for a thousand, and with ten times fewer each time, down to ten.

    Args:
        members: how many are run on two threads; on one, a thousand of them at the most.
        plain: seconds the plain script takes for one run.
    """
    _seconds(_one_arm(4), 2)  # what is loaded once
    costs = {count: _seconds(_one_arm(count), 2) for count in [*_fewer(members), members]}
    few = min(members, THOUSAND)  # more say nothing new on one thread
    one, two = _seconds(_one_arm(few), 1), costs[few]
    scaled = f"paper-robustness, one arm, metrics only; {few} members" + ("" if few == THOUSAND else ", scaled")
    return [
        Row("1000 members, 2 threads", two * THOUSAND / few, "s", 50.0 * few / two, scaled),
        Row("  one member, 1 thread", 1e3 * one / few, "ms", 50.0 * few / one, "draws, checks, run, row"),
        Row("  speed-up from 1 to 2 threads", one / two, "x"),
        *(_cost(count, seconds) for count, seconds in costs.items()),
        Row("1000 members, numpy + scipy", plain * THOUSAND, "s", 50.0 / plain, "one core, scaled"),
    ]


def _fewer(members: int) -> list[int]:
    """Sizes below: does a member cost the same whatever their number?"""
    return [count for count in (10, 100, 1000) if count < members]


def _cost(members: int, seconds: float) -> Row:
    return Row(f"  each of {members} members, 2 threads", 1e3 * seconds / members, "ms", 50.0 * members / seconds)


def memory_row(members: int) -> Row:
    """Peak memory of a whole process that runs a study."""
    arms = '[{name="proposed"}]'
    with tempfile.TemporaryDirectory(prefix="umbilical-bench-") as folder:
        command = ["sweep", "paper-robustness", "--set", f"members={members}", "--set", f"arms={arms}", "--jobs", "2"]
        words = [sys.executable, "-m", "umbilical", *command, "--out", f"{folder}/out"]
        subprocess.run(words, stdout=subprocess.DEVNULL, check=True)
    return Row("umbilical sweep, peak memory", peak_of_children(), "MB", note=f"{members} members, 2 threads")


def _one_arm(members: int) -> Study:
    from umbilical.studies.load import load_study

    return load_study("paper-robustness", {"members": members, "arms": _ARM})


def _seconds(study: Study, jobs: int) -> float:
    from umbilical.studies.engines import threads
    from umbilical.studies.sweep import sweep

    begun = perf_counter()
    sweep(study, engine=threads(jobs))
    return perf_counter() - begun

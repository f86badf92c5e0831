"""T1 to T3: what the paper's three theorems claim, held against runs, our certificate and the error equations."""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.experiments import ARMS, CASES, cell
from umbilical.papers.rao2022.ledger import BOUNDS, Evidence, Judged, all_completed, window_peak
from umbilical.papers.rao2022.motor_error import (
    DECADES,
    decade_times,
    error_rate,
    premise_band,
    sign_time,
    ultimate_bound,
)
from umbilical.papers.rao2022.regions import runaways
from umbilical.plant import signals
from umbilical.scenario.control import MotorLoop

HEALTHY = cell("none", "without")


def t1(evidence: Evidence) -> Judged:
    """Theorem 1: the boundary displacement stays bounded, and the proof of it."""
    runs, proofs = evidence.runs, evidence.proofs
    longest = {"none": runs["none, with, endless"], "dead": runs["dead, with, lasting"]}
    late = {case: _late_ratio(run) for case, run in longest.items()}
    ended = all_completed([*longest.values(), *(runs[cell(case, "with")] for case in CASES)])
    holds = ended and max(late.values()) <= 1.0
    values = {
        "late": late,
        "none_late": late["none"],
        "dead_late": late["dead"],
        "rate": proofs.rate,
        "certified_from": proofs.certified,
        "fixed_rate": proofs.fixed_rate,
        "fixed_bound": proofs.fixed_bound,
        "broken": len(proofs.broken),
        "negative": ", ".join(proofs.broken) or "none",
        "peak": runs[HEALTHY].metrics["tip_peak"],
        "holds": holds,
        **runaways(evidence.edges, "with"),
    }
    return Judged(values, holds and proofs.rate > 0.0 and not proofs.broken, holds)


def _late_ratio(run: Run) -> float:
    """Peak of the ROV in the last quarter over that before."""
    end = run.scenario.duration
    return window_peak(run, 0.75 * end, end) / window_peak(run, 0.0, 0.75 * end)


def t2a(evidence: Evidence) -> Judged:
    """Theorem 2, first part: the motor system is bounded."""
    runs, loop = _runs(evidence), _loop(evidence)
    band, late, bound = premise_band(loop), max(map(_late_error, runs)), ultimate_bound(loop, _left(runs, loop))
    true = [(_error(run)[run["time"].values >= 1.0] >= band).mean() for run in runs]
    values = {"late_error": late, "bound": bound, "band": band, "premise": float(np.mean(true))}
    return Judged(values, all_completed(runs) and late <= bound)


def _runs(evidence: Evidence) -> list[Run]:
    return [evidence.runs[cell(case, arm)] for case, arm in product(CASES, ARMS)]


def _loop(evidence: Evidence) -> MotorLoop:
    loop = evidence.runs[HEALTHY].scenario.control.motor_loop
    assert loop is not None
    return loop


def _error(run: Run) -> np.ndarray:
    """\\|e1\\| of every motor over time, rad/s, shape (samples, motors)."""
    return abs((run["motor_speed"] - run["speed_reference"]).transpose("time", "motor").values)


def _late_error(run: Run) -> float:
    return float(_error(run)[run["time"].values >= 0.8 * run.scenario.duration].max())


def _steepest(loop: MotorLoop) -> float:
    """k1 + db1 mu/e0, what (52) is near zero, 1/s."""
    return loop.speed_gain + loop.speed_bound * loop.robust_factor / loop.speed_width


def _left(runs: list[Run], loop: MotorLoop) -> tuple[float, float]:
    """Largest disturbances left in the two error equations, over all motors of all runs.

    r1 = f13 d1; r2 = f23 d2 less its estimate, and ``d i_d/d z1`` times r1, which (59) leaves out.
    """
    missed = max(float(abs(r["motor_disturbance"] - r["motor_disturbance_estimate"]).max()) for r in runs)
    speed = max(run.metrics["motor_speed_peak"] for run in runs)
    motors, time = runs[0].scenario.motors, runs[0]["time"].values
    torque = max(float(abs(signals.evaluate(m.torque_disturbance, time)).max()) / m.inertia for m in motors)
    drag = max((m.viscous_friction + 2.0 * m.load_coefficient * speed) / m.inertia for m in motors)
    return torque, missed + (_steepest(loop) + drag) * torque


def t2b(evidence: Evidence) -> Judged:
    """Theorem 2, second part: convergence in finite time."""
    loop = _loop(evidence)
    before, last = map(float, decade_times(partial(error_rate, loop))[-2:])
    values = {
        "last_decade": last,
        "ratio": last / before,
        "rate": float(np.log(10.0)) / last,
        "linear_rate": _steepest(loop),
        "sign_time": sign_time(loop),
        "late_error": max(map(_late_error, _runs(evidence))),
        "decades": DECADES,
    }
    return Judged(values, last / before < BOUNDS["shrinks"])


def t3(evidence: Evidence) -> Judged:
    """Theorem 3: the cascade of both stays bounded and stable."""
    proofs, bounded = evidence.proofs, all_completed(_runs(evidence))
    values = {
        "unstable_from": proofs.unstable_from,
        "certified_from": proofs.certified,
        "delay": proofs.delay,
        "stable": proofs.stable,
        "both": not proofs.certified >= proofs.unstable_from,
        **runaways(evidence.edges, "without"),
    }
    holds = bounded and proofs.stable
    return Judged(values, holds and not proofs.unstable_from < np.inf, holds)

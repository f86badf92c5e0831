"""T1 to T3: what the paper's three theorems claim, held against runs, our certificate and the error equations."""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.experiments import ARMS, CASES, cell
from umbilical.papers.rao2022.ledger import (
    Evidence,
    Finding,
    Kind,
    Number,
    completed,
    decide,
    percent,
    short,
    window_peak,
)
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
LASTING = {"none": "none, with, endless", "dead": "dead, with, lasting"}
"""The longest runs with fault control, by case."""
SHRINKS = 0.5
"""Ratio of the last decade's time to the one before below which a decay ends in finite time: for e' = -|e|^s with
s < 1 it is 10^(s - 1)."""


def t1(evidence: Evidence) -> Finding:
    """Theorem 1: the boundary displacement stays bounded, and the proof of it."""
    runs, proofs = evidence.runs, evidence.proofs
    bounded = {case: _stays_bounded(runs[name]) for case, name in LASTING.items()}
    faults = completed(runs[cell(case, "with")] for case in CASES)
    lasting = {case: _late_ratio(runs[name]) for case, name in LASTING.items()}
    found = runaways(evidence.edges, "with")
    peak = runs[HEALTHY].metrics["tip_peak"]
    holds = faults and all(bounded.values())
    return Finding(
        "T1",
        "Theorem 1: law, observers and fault control keep y(l,t) bounded, for reasonable parameters.",
        "Bounded: runs come to their end, and of two long ones the last quarter does not exceed what came before. "
        "Proved: a positive rate of V over the run at the paper's gains (our conditions, ideal loop).",
        (
            *(
                Number(f"{case}_late", v, "1", f"peak of the last quarter over that before, {LASTING[case]}")
                for case, v in lasting.items()
            ),
            Number("rate", proofs.rate, "1/s", "best rate of V on the paper's winch and gains", Kind.SEARCH),
            Number("certified_from", proofs.certified, "m/s", "beta from which on a rate is proved", Kind.SEARCH),
            Number("fixed_rate", proofs.fixed_rate, "1/s", "proved rate, winch stopped at 500 m", Kind.SEARCH),
            Number("fixed_bound", proofs.fixed_bound, "m", "bound of |y| that follows there", Kind.SEARCH),
            Number("broken", len(proofs.broken), "1", "of the 7 printed conditions iota: negative", Kind.COUNT),
        ),
        decide(holds and proofs.rate > 0.0 and not proofs.broken, holds),
        f"{'Every' if holds else 'Not every'} run stays bounded; in the last quarter of the long ones the ROV reaches "
        f"{_shares(lasting)} of what came before. The proof does not apply to the paper's numbers: its printed "
        f"conditions {', '.join(proofs.broken) or 'none'} are negative, and the corrected ones give V a rate of "
        f"{short(proofs.rate)} 1/s on this winch.",
        f"A rate is proved from beta = {short(proofs.certified)} m/s on; the paper has 0.01. With the winch stopped "
        f"{short(proofs.fixed_rate)} 1/s is proved at the paper's gains, and |y| below {short(proofs.fixed_bound)} m, "
        f"where the run reaches {short(peak)} m. {found.words} The ideal loop is proved only: no observers, no "
        "adaptation.",
        f"the runs are taken as evidence: the proof needs beta from {short(proofs.certified)} m/s on, or a winch that "
        "stands still",
    )


def _late_ratio(run: Run) -> float:
    """Peak of the ROV in the last quarter over that before."""
    end = run.scenario.duration
    return window_peak(run, 0.75 * end, end) / window_peak(run, 0.0, 0.75 * end)


def _stays_bounded(run: Run) -> bool:
    return completed([run]) and _late_ratio(run) <= 1.0


def _shares(values: dict[str, float]) -> str:
    return " and ".join(f"{percent(value)} ({name})" for name, value in values.items())


def t2a(evidence: Evidence) -> Finding:
    """Theorem 2, first part: the motor system is bounded."""
    runs = [evidence.runs[cell(case, arm)] for case, arm in product(CASES, ARMS)]
    loop = _loop(evidence)
    bound = ultimate_bound(loop, _left(runs, loop))
    late = max(_late_error(run) for run in runs)
    premise = float(np.mean([_premise_share(run, loop) for run in runs]))
    return Finding(
        "T2a",
        "Theorem 2: the motor system is bounded and stable.",
        "Speed error e1 in the last fifth of the runs against the bound that follows from V' with the disturbances "
        "that are left; all fault cases, both arms.",
        (
            Number("late_error", late, "rad/s", "largest |e1| of the last fifth", Kind.SAMPLED),
            Number("bound", bound, "rad/s", "bound of |e1| in the end", Kind.SAMPLED),
            Number("band", premise_band(loop), "rad/s", "|e1| below which the premise of (55) is false", Kind.EXACT),
            Number("premise", premise, "1", "share of the time after 1 s in which it is true", Kind.SHARE),
        ),
        decide(completed(runs) and late <= bound),
        f"In the last fifth |e1| is at most {short(late)} rad/s, and V' bounds it by {short(bound)} rad/s.",
        f"The paper's proof does not cover it: the premise of (55) asks for |e1| of {short(premise_band(loop))} rad/s "
        f"or more, which after 1 s is true in {percent(premise)} of the time. What follows is an ultimate bound, in "
        "continuous time and without a limit of the voltage; convergence to zero does not.",
    )


def _loop(evidence: Evidence) -> MotorLoop:
    loop = evidence.runs[HEALTHY].scenario.control.motor_loop
    assert loop is not None
    return loop


def _error(run: Run) -> np.ndarray:
    """|e1| of every motor over time, rad/s, shape (samples, motors)."""
    return abs((run["motor_speed"] - run["speed_reference"]).transpose("time", "motor").values)


def _late_error(run: Run) -> float:
    time = run["time"].values
    return float(_error(run)[time >= 0.8 * run.scenario.duration].max())


def _premise_share(run: Run, loop: MotorLoop) -> float:
    return float((_error(run)[run["time"].values >= 1.0] >= premise_band(loop)).mean())


def _left(runs: list[Run], loop: MotorLoop) -> tuple[float, float]:
    """Largest disturbances left in the two error equations, over all motors of all runs.

    r1 = f13 d1; r2 = f23 d2 less its estimate, and ``d i_d/d z1`` times r1, which (59) leaves out.
    """
    missed = max(float(abs(r["motor_disturbance"] - r["motor_disturbance_estimate"]).max()) for r in runs)
    speed = max(run.metrics["motor_speed_peak"] for run in runs)
    slope = loop.speed_gain + loop.speed_bound * loop.robust_factor / loop.speed_width
    motors = runs[0].scenario.motors
    time = runs[0]["time"].values
    torque = max(float(abs(signals.evaluate(m.torque_disturbance, time)).max()) / m.inertia for m in motors)
    drag = max((m.viscous_friction + 2.0 * m.load_coefficient * speed) / m.inertia for m in motors)
    return torque, missed + (slope + drag) * torque


def t2b(evidence: Evidence) -> Finding:
    """Theorem 2, second part: convergence in finite time."""
    loop = _loop(evidence)
    times = decade_times(partial(error_rate, loop))
    ratio, rate = float(times[-1] / times[-2]), float(np.log(10.0) / times[-1])
    late = max(_late_error(evidence.runs[cell(case, arm)]) for case, arm in product(CASES, ARMS))
    slowest = loop.speed_gain + loop.speed_bound * loop.robust_factor / loop.speed_width
    return Finding(
        "T2b",
        "Theorem 2: the motor system converges in finite time.",
        f"Time each of {DECADES} decades of e1 takes under (52), (60) in continuous time without disturbances, from an "
        f"error of 1 rad/s; finite: the last takes less than {percent(SHRINKS)} of the one before.",
        (
            Number("last_decade", float(times[-1]), "s", "time of the last decade", Kind.SOLVED),
            Number("ratio", ratio, "1", "time of the last decade over that of the one before", Kind.SOLVED),
            Number("rate", rate, "1/s", "rate of decay there", Kind.SOLVED),
            Number("linear_rate", slowest, "1/s", "k1 + db1 mu/e0, what (52) is near zero", Kind.EXACT),
            Number("sign_time", sign_time(loop), "s", "time to zero from 1 rad/s with the sign of (50)", Kind.EXACT),
            Number("late_error", late, "rad/s", "largest |e1| of the last fifth of the runs", Kind.SAMPLED),
        ),
        decide(ratio < SHRINKS),
        f"Every decade takes {short(times[-1])} s, as long as the one before (ratio {short(ratio)}): the decay is "
        f"exponential, at {short(rate)} 1/s, because the smoothed sign (51) is linear near zero. "
        "V' <= -k1 e1^2 - k2 e2^2 proves no more.",
        f"With the sign of (50) in place of (51) and e2 = 0 the error would vanish within {short(sign_time(loop))} s; "
        "but a sampled sign chatters, and (59) could not be formed. With the disturbances |e1| does not vanish at all: "
        f"{short(late)} rad/s in the last fifth of the runs.",
    )


def t3(evidence: Evidence) -> Finding:
    """Theorem 3: the cascade of both stays bounded and stable."""
    runs, proofs = evidence.runs, evidence.proofs
    bounded = completed(runs[cell(case, arm)] for case, arm in product(CASES, ARMS))
    holds = bounded and proofs.stable
    covered = not proofs.unstable_from < np.inf
    found = runaways(evidence.edges, "without")
    both = "no beta meets both" if proofs.certified >= proofs.unstable_from else "some gains meet both"
    return Finding(
        "T3",
        "Theorem 3: for reasonable parameters the cascade keeps y(l,t) bounded and both loops stable.",
        "At the paper's gains: every run comes to its end, and the linearised sampled loop with motors, observers and "
        "exact cable is stable at the shortest length. Then the slope gain is raised.",
        (
            Number(
                "unstable_from", proofs.unstable_from, "m/s", "beta from which on the cascade is unstable", Kind.SEARCH
            ),
            Number(
                "certified_from", proofs.certified, "m/s", "beta from which on the ideal loop is certified", Kind.SEARCH
            ),
            Number("delay", proofs.delay, "s", "extra delay the cascade survives at the paper's gains", Kind.SOLVED),
            *found.numbers[:1],
        ),
        decide(holds and covered, holds),
        "At the paper's gains all runs come to their end, and the linearised cascade is "
        f"{'stable' if proofs.stable else 'unstable'} and survives {short(proofs.delay)} s of delay. Two loops that "
        "are each stable do not make a stable cascade: the ideal outer loop is certified from beta = "
        f"{short(proofs.certified)} m/s on, the motor loops do not depend on beta, and the cascade is unstable from "
        f"{short(proofs.unstable_from)} m/s on.",
        f"On the paper's winch {both}: the certificate and a stable cascade. Linearised at the mean load; what grows "
        "are waves of the cable too short for the grids of the runs, so it does not show in them. The condition the "
        f"theorem refers to, (80), is not printed. {found.words}",
        f"beta stays below {short(proofs.unstable_from)} m/s",
    )

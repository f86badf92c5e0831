"""C6 to C9, C11: faults, what the motors go through, and the disturbance observers."""

from __future__ import annotations

from itertools import product

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.claims_vibration import worst_of_places
from umbilical.papers.rao2022.experiments import ARMS, CASES, FAULTS, OBSERVERS, Runs, cell
from umbilical.papers.rao2022.ledger import BOUNDS, Evidence, Judged, all_completed, metric_values, relative_error
from umbilical.papers.rao2022.regions import diverged, reversal, runaways, without_repeats


def c6(evidence: Evidence) -> Judged:
    """No fault: known factors are better, and both work."""
    names = {"free": "free", "without": cell("none", "without"), "with_control": cell("none", "with")}
    peaks, given = (
        {k: evidence.runs[n].metrics["tip_peak"] for k, n in names.items()},
        metric_values("C6", evidence.runs),
    )
    left, found = max(peaks["without"], peaks["with_control"]) / peaks["free"], reversal(evidence.gain)
    holds = max(given["peak_ratio"], given["rms_ratio"]) < 1.0 and left < BOUNDS["works"]
    return Judged({"worst_left": left, **peaks, **found}, holds and not found["when"], holds)


def c7a(evidence: Evidence) -> Judged:
    """A fault may make the loop without fault control diverge."""
    runs = {case: evidence.runs[cell(case, "without")] for case in FAULTS}
    lost = [case for case, run in runs.items() if not all_completed([run])]
    maps = {name: data for name, data in evidence.maps.items() if name in ("map-time", "map-factors")}
    counts = {name: diverged(data, "without") for name, data in maps.items()}
    lost += [name for name, (count, _) in counts.items() if count]
    values = {
        "peak": {case: run.metrics["tip_peak_after_fault"] for case, run in runs.items()},
        "D_error": max(map(_absorbed, runs.values())),
        "blind_dead_end": abs(evidence.runs["blind, dead, without"].metrics["tip_end"]),
        "lost": f"Lost: {', '.join(lost)}" if lost else "None does",
        **runaways(evidence.edges, "without"),
        **dict(zip(("diverged", "cells"), map(sum, zip(*counts.values(), strict=True)), strict=False)),
    }
    return Judged(values, bool(lost))


def _absorbed(run: Run) -> float:
    """Relative error of the estimate of D from the fault on."""
    after = slice(run.scenario.faults[0].start, None)
    return relative_error(run["disturbance"].sel(time=after), run["disturbance_estimate"].sel(time=after))


def c7b(evidence: Evidence) -> Judged:
    """With fault control the response jumps at the fault and stays bounded."""
    runs = evidence.runs
    peaks = {arm: {c: runs[cell(c, arm)].metrics["tip_peak_after_fault"] for c in FAULTS} for arm in ARMS}
    soon, size, _, _ = _excess(runs)
    jumps, stays = min(soon.values()) > BOUNDS["jump"], all_completed(runs[cell(case, "with")] for case in FAULTS)
    values = {
        "soon": soon,
        "size": size,
        "peak": peaks["with"],
        "ratio": {case: peaks["with"][case] / peaks["without"][case] for case in FAULTS},
        "stays": stays,
        **(lost_in_maps(evidence) if evidence.maps else {}),
    }
    return Judged(values, jumps and stays, jumps or stays)


def lost_in_maps(evidence: Evidence) -> dict[str, dict[str, int]]:
    """How many distinct runs of each map diverged with fault control, by observer, and of how many."""
    maps = {name: without_repeats(evidence.maps[f"map-{name}"]) for name in ("time", "factors", "rates")}
    found = {n: {o: diverged(data.sel(observer=[o]), "with") for o in OBSERVERS} for n, data in maps.items()}
    lost = {f"lost_{name}": {o: count for o, (count, _) in counts.items()} for name, counts in found.items()}
    return lost | {"cells": {name: counts["on"][1] for name, counts in found.items()}}


def c7c(evidence: Evidence) -> Judged:
    """With fault control the response falls again and settles."""
    _, _, left, swing = _excess(evidence.runs)
    back = [case for case in FAULTS if left[case] < BOUNDS["fallen"] and swing[case] < BOUNDS["settled"]]
    values = {"left": left, "swing": swing, "back": back}
    return Judged(values, len(back) == len(FAULTS), bool(back))


def _excess(runs: Runs) -> list[dict[str, float]]:
    """\\|y_fault - y_healthy\\| at the ROV over the healthy peak, soon after the fault and at its largest, by case.

    Of its largest, what is left at the end, and the swing of the difference there.
    """
    healthy = runs[cell("none", "with")]["tip_displacement"]
    found = []
    for run in (runs[cell(case, "with")] for case in FAULTS):
        start, difference = (
            run.scenario.faults[0].start,
            (run["tip_displacement"] - healthy) / float(abs(healthy).max()),
        )
        late = difference.sel(time=slice(float(difference["time"][-1]) - BOUNDS["later"], None))
        soon, largest = abs(difference).sel(time=slice(start, start + BOUNDS["prompt"])).max(), abs(difference).max()
        found.append([soon, largest, abs(late).max() / largest, (late.max() - late.min()) / largest])
    return [dict(zip(FAULTS, map(float, column), strict=True)) for column in zip(*found, strict=True)]


def c8(evidence: Evidence) -> Judged:
    """Motor speeds and voltages stay bounded."""
    runs = [evidence.runs[cell(case, arm)] for case, arm in product(CASES, ARMS)]
    names = ("speed_peak", "voltage_peak", "voltage_rms")
    values = {name: max(run.metrics[f"motor_{name}"] for run in runs) for name in names}
    growth = max(map(_growth, runs))
    return Judged(values | {"growth": growth, "runs": len(runs)}, all_completed(runs) and growth < 1.0)


def _growth(run: Run) -> float:
    """Voltage peak of the last fifth of a run over that before."""
    size = abs(run["motor_voltage"]).max("motor")
    end = float(size["time"][-1])
    return float(size.sel(time=slice(0.8 * end, None)).max() / size.sel(time=slice(0.0, 0.8 * end)).max())


def c9(evidence: Evidence) -> Judged:
    """The disturbance observers follow."""
    run = evidence.runs[cell("none", "without")]
    error = relative_error(run["disturbance"], run["disturbance_estimate"])
    both = run["motor_disturbance"], run["motor_disturbance_estimate"]
    motors = {str(k): relative_error(*(one.sel(motor=k) for one in both)) for k in run["motor"].values}
    control = run.scenario.control
    assert control.motor_loop is not None
    assert control.disturbance_observer is not None
    gain, slow = control.motor_loop.observer_gain, control.disturbance_observer.gain
    fastest = max(term.frequency for m in run.scenario.motors for term in m.voltage_disturbance if term.kind == "sine")
    values = {
        "D_error": error,
        "motor": motors,
        "motors": list(motors.values()),
        "d2_lag": fastest / float(np.hypot(fastest, gain)),
        "d2_limit": BOUNDS["follows"] * gain / float(np.sqrt(1.0 - BOUNDS["follows"] ** 2)),
        "D_limit": BOUNDS["follows"] * slow / float(np.sqrt(1.0 - BOUNDS["follows"] ** 2)),
        "fastest": fastest,
        "gain": gain,
        "slow": slow,
    }
    each = [error, *motors.values()]
    return Judged(values, max(each) < BOUNDS["follows"], min(each) < BOUNDS["follows"])


def c11(evidence: Evidence) -> Judged:
    """With fault control the vibration is suppressed with and without a fault, against no control."""
    runs, free = evidence.runs, evidence.runs["free"]
    worst = {case: worst_of_places(runs[cell(case, "with")], free, "peak", "rms") for case in CASES}
    kept = [case for case, left in worst.items() if all_completed([runs[cell(case, "with")]]) and left < 1.0]
    blind = {case: runs[f"blind, {case}, with"] for case in ("none", "dead", "stuck")}
    alone = {case: worst_of_places(run, free, "peak", "rms") for case, run in blind.items() if all_completed([run])}
    blind["none, 400 s"] = runs["blind, none, with, long"]
    lost = [case for case, run in blind.items() if not all_completed([run])]
    values = {
        "worst": worst,
        "alone": alone,
        "blind_lost": len(lost),
        "tried": len(blind),
        "lost": "; ".join(lost) or "none",
        "kept": kept,
    }
    return Judged(values, len(kept) == len(CASES), bool(kept))

"""C1 to C5: what the controllers do to the vibration, and what the observers see of it."""

from __future__ import annotations

from umbilical import Run
from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.ledger import BOUNDS, Evidence, Judged, relative_error, window_peak

PROPOSED = cell("none", "without")
AT = ("quarter", "mid", "three_quarter", "tip")
"""Places at which metrics are taken."""


def c1(evidence: Evidence) -> Judged:
    """Growth without control, with position and with time."""
    free, long = evidence.runs["free"], evidence.runs["free, long"]
    peaks = {f"{name}_peak": free.metrics[f"{name}_peak"] for name in AT}
    end, longest, in_order = free.scenario.duration, long.scenario.duration, list(peaks.values())
    early, late = window_peak(free, 0.0, end / 2), window_peak(free, end / 2, end)
    with_place = in_order == sorted(in_order)
    with_time = early < late < window_peak(long, 0.75 * longest, longest)
    values = {
        **peaks,
        "peak": in_order,
        "early_peak": early,
        "late_peak": late,
        "long_peak": long.metrics["tip_peak"],
        "reached": float(abs(free["tip_displacement"]).idxmax("time")),
        "grown": long.metrics["tip_peak"] / free.metrics["tip_peak"],
        "half": end / 2,
        "end": end,
        "longest": longest,
        "place": with_place,
        "time": with_time,
        "only": with_place,
    }
    return Judged(values, with_place and with_time, with_place or with_time)


def _ratios(runs: Runs, name: str, to: str, *kinds: str) -> list[float]:
    """Ratios of peaks, or of metrics of other kinds, at the four places."""
    metrics = [f"{at}_{kind}" for kind in kinds or ("peak",) for at in AT]
    return [runs[name].metrics[metric] / runs[to].metrics[metric] for metric in metrics]


def c2(evidence: Evidence) -> Judged:
    """Both controllers suppress the vibration everywhere."""
    runs, middle = evidence.runs, evidence.runs["ringdown"]["displacement"].sel(sigma=0.5, method="nearest")
    worst = {
        "pd_worst": max(_ratios(runs, "pd", "free", "peak", "rms")),
        "proposed_worst": max(_ratios(runs, PROPOSED, "free", "peak", "rms")),
    }
    others = {
        "pd_worst_hauling": max(_ratios(runs, "pd, hauling in", "free, hauling in")),
        "proposed_worst_hauling": max(_ratios(runs, "proposed, hauling in", "free, hauling in")),
        "ringdown_left": float(abs(middle.sel(time=slice(40.0, None))).max()),
    }
    return Judged(worst | others, max(worst.values()) < 1.0, min(worst.values()) < 1.0)


def c3(evidence: Evidence) -> Judged:
    """At the boundary the proposed law is better than PD."""
    values = _against_pd(evidence.runs, "tip")
    blind, pd = (evidence.runs[name] for name in ("blind, none, without", "pd"))
    end = pd.scenario.duration
    for name, window in (("early", (0.0, end / 2)), ("late", (end / 2, end))):
        values[f"{name}_ratio_blind"] = window_peak(blind, *window) / window_peak(pd, *window)
    both = values["peak_ratio"], values["rms_ratio"]
    return Judged(values, max(both) < 1.0, min(both) < 1.0)


def _against_pd(runs: Runs, at: str) -> dict[str, float]:
    """Ratios of the proposed law to PD at one place."""

    def ratio(name: str, to: str, kind: str) -> float:
        return runs[name].metrics[f"{at}_{kind}"] / runs[to].metrics[f"{at}_{kind}"]

    return {
        "peak_ratio": ratio(PROPOSED, "pd", "peak"),
        "rms_ratio": ratio(PROPOSED, "pd", "rms"),
        "peak_ratio_hauling": ratio("proposed, hauling in", "pd, hauling in", "peak"),
        "peak_ratio_blind": ratio("blind, none, without", "pd", "peak"),
    }


def c4(evidence: Evidence) -> Judged:
    """At the midpoint the proposed law is significantly better."""
    values, (quarter, _, three_quarter, _) = _against_pd(evidence.runs, "mid"), _ratios(evidence.runs, PROPOSED, "pd")
    more = {
        "peak_ratio_quarter": quarter,
        "peak_ratio_three_quarter": three_quarter,
        "blind": values["peak_ratio_blind"] < BOUNDS["significant"],
    }
    worse = max(values["peak_ratio"], values["rms_ratio"])
    return Judged(values | more, worse < BOUNDS["significant"], worse < 1.0)


def c5(evidence: Evidence) -> Judged:
    """The high-gain observers give x2 and z2."""
    run, observer = evidence.runs[PROPOSED], evidence.runs[PROPOSED].scenario.control.velocity_observer
    assert observer is not None
    x2, z2 = (_error_of(run, name) for name in ("tip_velocity", "tip_slope_rate"))
    lag = observer.damping * observer.time_constant
    values = {
        "x2_error": x2,
        "z2_error": z2,
        "z2_error_smooth": _error_of(evidence.runs["proposed, no jump"], "tip_slope_rate"),
        "lag": lag,
        "limit": BOUNDS["follows"] / lag,
        "x2": x2 < BOUNDS["follows"],
        "z2": z2 < BOUNDS["follows"],
        "interval": run.scenario.output.interval,
    }
    return Judged(values, max(x2, z2) < BOUNDS["follows"], min(x2, z2) < BOUNDS["follows"])


def _error_of(run: Run, name: str) -> float:
    return relative_error(run[name], run[f"{name}_estimate"])

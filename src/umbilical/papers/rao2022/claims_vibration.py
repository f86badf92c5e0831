"""C1 to C5: what the controllers do to the vibration, and what the observers see of it."""

from __future__ import annotations

from umbilical import Run
from umbilical.papers.rao2022.experiments import cell
from umbilical.papers.rao2022.ledger import BOUNDS, Evidence, Judged, metric_values, relative_error, window_peak

PROPOSED = cell("none", "without")
AT = ("quarter", "mid", "three_quarter", "tip")
"""Places at which metrics are taken."""


def c1(evidence: Evidence) -> Judged:
    """Growth without control, with position and with time."""
    free, long, given = evidence.runs["free"], evidence.runs["free, long"], metric_values("C1", evidence.runs)
    peaks = [given[f"{name}_peak"] for name in AT]
    end, longest = free.scenario.duration, long.scenario.duration
    early, late = window_peak(free, 0.0, end / 2), window_peak(free, end / 2, end)
    with_place, with_time = peaks == sorted(peaks), early < late < window_peak(long, 0.75 * longest, longest)
    values = {
        "peak": peaks,
        "early_peak": early,
        "late_peak": late,
        "reached": float(abs(free["tip_displacement"]).idxmax("time")),
        "grown": given["long_peak"] / given["tip_peak"],
        "half": end / 2,
        "end": end,
        "longest": longest,
        "place": with_place,
        "time": with_time,
        "only": with_place,
    }
    return Judged(values, with_place and with_time, with_place or with_time)


def worst_of_places(run: Run, to: Run, *kinds: str) -> float:
    """Largest ratio of peaks, or of metrics of several kinds, to those of another run over the four places."""
    names = [f"{at}_{kind}" for at in AT for kind in kinds or ("peak",)]
    return max(run.metrics[name] / to.metrics[name] for name in names)


def c2(evidence: Evidence) -> Judged:
    """Both controllers suppress the vibration everywhere."""
    runs, middle = evidence.runs, evidence.runs["ringdown"]["displacement"].sel(sigma=0.5, method="nearest")
    worst = {
        "pd_worst": worst_of_places(runs["pd"], runs["free"], "peak", "rms"),
        "proposed_worst": worst_of_places(runs[PROPOSED], runs["free"], "peak", "rms"),
    }
    others = {
        "pd_worst_hauling": worst_of_places(runs["pd, hauling in"], runs["free, hauling in"]),
        "proposed_worst_hauling": worst_of_places(runs["proposed, hauling in"], runs["free, hauling in"]),
        "ringdown_left": float(abs(middle.sel(time=slice(40.0, None))).max()),
    }
    return Judged(worst | others, max(worst.values()) < 1.0, min(worst.values()) < 1.0)


def c3(evidence: Evidence) -> Judged:
    """At the boundary the proposed law is better than PD."""
    given, blind, pd = metric_values("C3", evidence.runs), evidence.runs["blind, none, without"], evidence.runs["pd"]
    half, end = pd.scenario.duration / 2, pd.scenario.duration
    values = {
        f"{name}_ratio_blind": window_peak(blind, *window) / window_peak(pd, *window)
        for name, window in (("early", (0.0, half)), ("late", (half, end)))
    }
    both = given["peak_ratio"], given["rms_ratio"]
    return Judged(values, max(both) < 1.0, min(both) < 1.0)


def c4(evidence: Evidence) -> Judged:
    """At the midpoint the proposed law is significantly better."""
    given, enough = metric_values("C4", evidence.runs), BOUNDS["significant"]
    worse = max(given["peak_ratio"], given["rms_ratio"])
    return Judged({"blind": given["peak_ratio_blind"] < enough}, worse < enough, worse < 1.0)


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

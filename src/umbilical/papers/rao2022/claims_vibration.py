"""C1 to C5: what the controllers do to the vibration, and what the observers see of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from umbilical import Run
from umbilical.papers.rao2022.experiments import PLACES, Runs, cell
from umbilical.papers.rao2022.ledger import (
    FOLLOWS,
    Evidence,
    Finding,
    Kind,
    Number,
    decide,
    percent,
    relative_error,
    short,
    window_peak,
)

if TYPE_CHECKING:
    import xarray

PROPOSED = cell("none", "without")
AT = dict(zip(PLACES, ("quarter", "mid", "three_quarter", "tip"), strict=True))
"""Metrics by the place they are taken at."""
SIGNIFICANT = 0.1
"""A ratio below which we call an improvement significant: an order of magnitude."""


def c1(evidence: Evidence) -> Finding:
    """Growth without control, with position and with time."""
    free, long = evidence.runs["free"], evidence.runs["free, long"]
    peaks = [free.metrics[f"{name}_peak"] for name in AT.values()]
    half = free.scenario.duration / 2
    early, late = window_peak(free, 0.0, half), window_peak(free, half, 2 * half)
    last = window_peak(long, 0.75 * long.scenario.duration, long.scenario.duration)
    with_place, with_time = peaks == sorted(peaks), early < late < last
    numbers = [Number(f"{name}_peak", p, "m", f"peak at {at}") for (at, name), p in zip(AT.items(), peaks, strict=True)]
    numbers += [
        Number("early_peak", early, "m", f"peak of the ROV, 0 to {half:g} s"),
        Number("late_peak", late, "m", f"peak of the ROV, {half:g} to {2 * half:g} s"),
        Number("long_peak", long.metrics["tip_peak"], "m", f"peak of the ROV in {long.scenario.duration:g} s"),
        Number("reached", _instant_of_peak(free), "s", "instant of the largest excursion"),
    ]
    return Finding(
        "C1",
        "Without control the vibration grows with time and with position.",
        "Peaks at l/4, l/2, 3l/4 and l; peak of the ROV in the first and second half, and in a run eight times as "
        "long.",
        tuple(numbers),
        decide(with_place and with_time, with_place or with_time),
        f"{'It grows' if with_place else 'It does not grow'} with position ({', '.join(map(short, peaks))} m). "
        + _with_time(with_time, early, late, _instant_of_peak(free)),
        f"In {long.scenario.duration:g} s the peak is {short(long.metrics['tip_peak'])} m, "
        f"{short(long.metrics['tip_peak'] / free.metrics['tip_peak'])} times that of {2 * half:g} s: the motion is "
        "that of "
        "a lightly damped cable under a bounded load. How far it gets depends on the load, which is assumed.",
        f"growth with position is meant, and with time that of the first {short(_instant_of_peak(free))} s"
        if with_place
        else "growth with time is meant",
    )


def _with_time(grows: bool, early: float, late: float, instant: float) -> str:
    if grows:
        return f"It grows with time ({short(early)} m, then {short(late)} m)."
    return (
        f"It grows with time only until {short(instant)} s; the second half's peak is {short(late)} m, "
        f"that of the first {short(early)} m."
    )


def _instant_of_peak(run: Run) -> float:
    return float(abs(run["tip_displacement"]).idxmax("time"))


def _ratios(runs: Runs, name: str, to: str, kind: str = "peak") -> list[float]:
    """Ratios of a metric at the four places."""
    return [runs[name].metrics[f"{at}_{kind}"] / runs[to].metrics[f"{at}_{kind}"] for at in AT.values()]


def c2(evidence: Evidence) -> Finding:
    """Both controllers suppress the vibration everywhere."""
    runs = evidence.runs
    worst = {n: max(_ratios(runs, n, "free") + _ratios(runs, n, "free", "rms")) for n in ("pd", PROPOSED)}
    haul = {n: max(_ratios(runs, f"{n}, hauling in", "free, hauling in")) for n in ("pd", "proposed")}
    ringing = runs["ringdown"]
    middle = abs(ringing["displacement"].sel(sigma=0.5, method="nearest").sel(time=slice(40.0, None)))
    left = float(middle.max())
    return Finding(
        "C2",
        "PD and the proposed law suppress the vibration at l/4, l/2, 3l/4 and l.",
        "Largest ratio to no control over the four places, of peaks and of root mean squares; below 1.",
        (
            Number("pd_worst", worst["pd"], "1", "worst ratio of PD"),
            Number("proposed_worst", worst[PROPOSED], "1", "worst ratio of the proposed law"),
            Number("pd_worst_hauling", haul["pd"], "1", "worst ratio of PD, hauling in"),
            Number("proposed_worst_hauling", haul["proposed"], "1", "worst ratio of the proposed law, hauling in"),
            Number("ringdown_left", left, "m", "midpoint after 40 s, of a start of 1 m and no load"),
        ),
        decide(max(worst.values()) < 1.0, min(worst.values()) < 1.0),
        f"Of what there is without control, PD leaves at most {percent(worst['pd'])}, the proposed law "
        f"{percent(worst[PROPOSED])}.",
        f"Also when hauling in ({percent(haul['pd'])} and {percent(haul['proposed'])}). It is the load on the ROV that "
        "is kept out of the cable: vibration that is in it already stays, because with beta = 0.01 m/s the ROV "
        "reflects "
        f"nearly everything (of a start of 1 m, {short(left)} m are left at the midpoint after 40 s).",
        "one of the two controllers is asked for",
    )


def c3(evidence: Evidence) -> Finding:
    """At the boundary the proposed law is better than PD."""
    runs = evidence.runs
    peak, rms = (_ratios(runs, PROPOSED, "pd", kind)[-1] for kind in ("peak", "rms"))
    haul = _ratios(runs, "proposed, hauling in", "pd, hauling in")[-1]
    blind = _ratios(runs, "blind, none, without", "pd")[-1]
    early, late = _halves(runs["blind, none, without"], runs["pd"])
    return Finding(
        "C3",
        "At the boundary the proposed law is better than PD.",
        "Ratio of the proposed law to PD at x = l; below 1.",
        (
            Number("peak_ratio", peak, "1", "ratio of the peaks at l"),
            Number("rms_ratio", rms, "1", "ratio of the root mean squares at l"),
            Number("peak_ratio_hauling", haul, "1", "the same, hauling in"),
            Number("peak_ratio_blind", blind, "1", "the same without the disturbance observer"),
            Number("early_ratio_blind", early, "1", "of that, in the first half"),
            Number("late_ratio_blind", late, "1", "of that, in the second half"),
        ),
        decide(max(peak, rms) < 1.0, min(peak, rms) < 1.0),
        f"The proposed law leaves {percent(peak)} of the peak and {percent(rms)} of the root mean square of PD.",
        f"Also hauling in ({percent(haul)}) and without the disturbance observer ({percent(blind)} of the peak; "
        f"{percent(early)} in the first half, {percent(late)} in the second).",
        "one of peak and root mean square is asked for",
    )


def _halves(run: Run, other: Run) -> tuple[float, float]:
    """Ratios of the peaks of the ROV in the first and in the second half."""
    half, end = run.scenario.duration / 2, run.scenario.duration
    early, late = ((window_peak(run, *w), window_peak(other, *w)) for w in ((0.0, half), (half, end)))
    return early[0] / early[1], late[0] / late[1]


def c4(evidence: Evidence) -> Finding:
    """At the midpoint the proposed law is significantly better."""
    runs = evidence.runs
    quarter, peak, three_quarter, _ = _ratios(runs, PROPOSED, "pd")
    rms = _ratios(runs, PROPOSED, "pd", "rms")[1]
    haul = _ratios(runs, "proposed, hauling in", "pd, hauling in")[1]
    blind = _ratios(runs, "blind, none, without", "pd")[1]
    return Finding(
        "C4",
        "At the midpoint the proposed law is significantly better than PD.",
        f"Ratio of |y(l/2,t)|; significant is what we call a ratio below {SIGNIFICANT:g}.",
        (
            Number("peak_ratio", peak, "1", "ratio of the peaks at l/2"),
            Number("peak_ratio_quarter", quarter, "1", "ratio of the peaks at l/4"),
            Number("peak_ratio_three_quarter", three_quarter, "1", "ratio of the peaks at 3l/4"),
            Number("rms_ratio", rms, "1", "ratio of the root mean squares at l/2"),
            Number("peak_ratio_hauling", haul, "1", "the same, hauling in"),
            Number("peak_ratio_blind", blind, "1", "the same without the disturbance observer"),
        ),
        decide(max(peak, rms) < SIGNIFICANT, max(peak, rms) < 1.0),
        f"The proposed law leaves {percent(peak)} of the peak and {percent(rms)} of the root mean square of PD.",
        f"Also hauling in ({percent(haul)}). Without the disturbance observer it is {percent(blind)}: better, "
        f"{'still' if blind < SIGNIFICANT else 'not'} by an order of magnitude. The paper finds the other two places "
        f"unclear; here the ratios are {percent(quarter)} at l/4 and {percent(three_quarter)} at 3l/4.",
        "significantly means at all",
    )


def c5(evidence: Evidence) -> Finding:
    """The high-gain observers give x2 and z2."""
    run = evidence.runs[PROPOSED]
    errors = {n: relative_error(run[n], run[f"{n}_estimate"]) for n in ("tip_velocity", "tip_slope_rate")}
    observer = run.scenario.control.velocity_observer
    assert observer is not None
    lag = observer.damping * observer.time_constant
    seen = {n: errors[n] < FOLLOWS for n in errors}
    smooth = relative_error(*_slope_rates(evidence.runs["proposed, no jump"]))
    said = [
        f"{symbol} {'is given' if seen[n] else 'is followed roughly'} (error {percent(errors[n])})"
        for n, symbol in (("tip_velocity", "x2"), ("tip_slope_rate", "z2"))
    ]
    return Finding(
        "C5",
        "The high-gain observers give x2 and z2.",
        f"Root mean square of the error over that of the signal, of samples every {run.scenario.output.interval:g} s; "
        f"below {FOLLOWS:g}.",
        (
            Number("x2_error", errors["tip_velocity"], "1", "relative error of x2", Kind.FRONT),
            Number("z2_error", errors["tip_slope_rate"], "1", "relative error of z2", Kind.FRONT),
            Number("z2_error_smooth", smooth, "1", "the same when the load does not jump at the start", Kind.FRONT),
            Number("lag", lag, "s", "delay of the observers, lam eps", Kind.EXACT),
            Number("limit", FOLLOWS / lag, "rad/s", "frequency up to which the error stays below it", Kind.EXACT),
        ),
        decide(all(seen.values()), any(seen.values())),
        "; ".join(said) + ".",
        f"An observer lags by lam eps = {short(lag)} s, an error of {short(lag)} s times the frequency: it gives what "
        f"moves slower than {short(FOLLOWS / lag)} rad/s. The assumed load starts with a jump of 100 N, whose front "
        "runs "
        f"up and down the cable from then on; without the jump the error of z2 is {percent(smooth)}. Law (22) takes z2 "
        "times beta m = 5 kg m/s and hardly notices.",
        f"the signal is slower than {short(FOLLOWS / lag)} rad/s",
    )


def _slope_rates(run: Run) -> tuple[xarray.DataArray, xarray.DataArray]:
    return run["tip_slope_rate"], run["tip_slope_rate_estimate"]

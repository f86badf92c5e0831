"""A1 to A3, beyond the paper: where the adaptive law (27) helps, where it harms, and what a box changes."""

from __future__ import annotations

from umbilical.reproduce.experiments import BOX, OBSERVERS
from umbilical.reproduce.ledger import (
    UNMAPPED,
    Evidence,
    Finding,
    Kind,
    Number,
    decide,
    percent,
    short,
)
from umbilical.reproduce.regions import diverged, runaways
from umbilical.reproduce.slices import BOXED
from umbilical.run import Run, Status

HELPS = 0.5
"""Ratio of peaks below which we say that adaptation clearly helps."""


def a1(evidence: Evidence) -> Finding:
    """A setting in which adaptation clearly helps."""
    runs = evidence.runs
    without, misjudged, with_control = (
        runs[f"blind, dead, {name}"].metrics["tip_peak_after_fault"] for name in ("without", "misjudged", "with")
    )
    ratio, ratio_misjudged = with_control / without, with_control / misjudged
    region, numbers = UNMAPPED, []
    if evidence.maps:
        shares = {obs: _better(evidence, obs) for obs in ("on", "off")}
        numbers = [
            Number(
                f"better_{obs}",
                share,
                "1",
                f"share of the cells of map-time where it is better, observer {obs}",
                Kind.SHARE,
            )
            for obs, share in shares.items()
        ]
        region = (
            "Over effectiveness and instant of the fault (map-time) the adaptive arm is better in "
            f"{percent(shares['off'])} "
            f"of the cells without the observer and in {percent(shares['on'])} with it."
        )
    return Finding(
        "A1",
        "Ours: without the disturbance observer the adaptive law clearly helps after a fault.",
        f"Peak after the fault, motor 2 dead, with over without fault control; clearly: below {HELPS:g}.",
        (
            Number("without_peak", without, "m", "peak without fault control"),
            Number("with_peak", with_control, "m", "peak with fault control"),
            Number("ratio", ratio, "1", "their ratio"),
            Number("ratio_misjudged", ratio_misjudged, "1", "to factors believed four times too large"),
            *numbers,
        ),
        decide(ratio < HELPS, ratio < 1.0),
        f"It leaves {percent(ratio)} of the peak ({short(with_control)} of {short(without)} m), and "
        f"{percent(ratio_misjudged)} of that of factors believed four times too large. Its offsets integrate u_a: "
        "they do, "
        "slowly, what the disturbance observer does fast.",
        region,
    )


def _better(evidence: Evidence, observer: str, name: str = "map-time", arm: str = "with") -> float:
    """Share of the cells of a map in which an arm has the lower peak than known factors."""
    peaks = evidence.maps[name]["peak"].sel(observer=observer)
    return float((peaks.sel(arm=arm) < peaks.sel(arm="without")).mean())


def a2(evidence: Evidence) -> Finding:
    """A setting in which adaptation harms: the ratchet."""
    runs = evidence.runs
    fast, long = runs["blind, dead, fast"], runs["blind, none, with, long"]
    seen = runs["none, with, long"]
    begin, end = (float(seen["kappa"].isel(kappa_index=0, time=k)) for k in (0, -1))
    before = float(long["kappa"].isel(kappa_index=0).sel(time=long.end_time - 10.0, method="nearest"))
    numbers = [
        Number("fast_end", fast.end_time, "s", "dead, ten times faster, no observer: diverges at", Kind.INSTANT),
        Number("long_end", long.end_time, "s", "no fault, rates of the preset, no observer: diverges at", Kind.INSTANT),
        Number("long_kappa", before, "rad2/(N s2)", "kappa_0 ten seconds before; exact is 0.5", Kind.INSTANT),
        Number(
            "observer_kappa", end, "rad2/(N s2)", f"kappa_0 after {seen.end_time:g} s with the observer", Kind.ERROR
        ),
    ]
    region = f"With the disturbance observer u_a is small and the ratchet slow: kappa_0 goes from {short(begin)} to "
    region += f"{short(end)} in {seen.end_time:g} s, and is still rising. "
    if evidence.maps:
        found = runaways(evidence.edges, "with")
        numbers += found.numbers
        region += (
            f"A start of kappa_0 at {short(found.numbers[0].value)} times its exact value runs away at once "
            f"({short(found.numbers[1].value)} times without the observer)."
        )
    lost = [run.status is Status.DIVERGED for run in (fast, long)]
    return Finding(
        "A2",
        "Ours: the published adaptation drives the loop apart by itself (the ratchet).",
        "Whether the run diverges: motor 2 dead with ten times the rates; and no fault, the preset's rates, 400 s.",
        tuple(numbers),
        decide(all(lost), any(lost)),
        f"Without the disturbance observer it diverges {_when(fast)} with ten times the rates, and with the preset's "
        f"rates and no fault {_when(long)}. Any motion pushes kappa_0 up, to {short(before)} ten seconds before that, "
        "where 0.5 is exact.",
        region,
    )


def _when(run: Run) -> str:
    return f"at {short(run.end_time)} s" if run.status is Status.DIVERGED else f"not within {short(run.end_time)} s"


def a3(evidence: Evidence) -> Finding:
    """What projection changes."""
    runs = evidence.runs
    boxed = [runs["blind, dead, boxed"], runs["blind, none, boxed, long"]]
    bare = [runs["blind, dead, fast"], runs["blind, none, with, long"]]
    saved = [b.status is Status.COMPLETED and a.status is Status.DIVERGED for a, b in zip(bare, boxed, strict=True)]
    limit = BOX["control.allocation.upper"][0]
    numbers, region = [], UNMAPPED
    if evidence.maps:
        numbers, region = _boxed_map(evidence)
    return Finding(
        "A3",
        "Ours: a box for kappa ends the ratchet.",
        f"The two runs of A2 again, kappa projected onto a box (kappa_0 up to {limit:g}, three times exact).",
        (
            Number("dead_peak", boxed[0].metrics["tip_peak"], "m", "peak, dead, ten times the rates, boxed"),
            Number("long_peak", boxed[1].metrics["tip_peak"], "m", "peak, no fault, 400 s, boxed"),
            *numbers,
        ),
        decide(all(saved), any(saved)),
        f"{saved.count(True)} of 2 come to their end that did not; the peaks are "
        f"{short(boxed[0].metrics['tip_peak'])} and {short(boxed[1].metrics['tip_peak'])} m. The box must lie below "
        "the gain at which the loop runs away (C7a); it stops the ratchet and does not make the adaptation find the "
        "exact value.",
        region,
    )


def _boxed_map(evidence: Evidence) -> tuple[list[Number], str]:
    """What the box changes over start and rate of the adaptation (map-rates)."""
    arms = {"bare": "with", "boxed": BOXED}
    lost = {name: diverged(evidence.maps["map-rates"], arm) for name, arm in arms.items()}
    cells = lost["bare"][1]
    better = {
        f"{name}_{obs}": _better(evidence, obs, "map-rates", arm) for name, arm in arms.items() for obs in OBSERVERS
    }
    numbers = [
        *(
            Number(f"diverged_{name}", count, "1", f"cells of map-rates that diverged, {name}, of {cells}", Kind.COUNT)
            for name, (count, _) in lost.items()
        ),
        *(
            Number(f"better_{name}", share, "1", f"share of map-rates better than known factors, {name}", Kind.SHARE)
            for name, share in better.items()
        ),
    ]
    return numbers, (
        f"Over start and rate (map-rates), {lost['boxed'][0]} of {cells} runs diverge in the box and {lost['bare'][0]} "
        f"without it; the box is better than known factors in {percent(better['boxed_on'])} of the cells with the "
        f"disturbance observer ({percent(better['bare_on'])} without the box) and in "
        f"{percent(better['boxed_off'])} ({percent(better['bare_off'])}) without the observer."
    )

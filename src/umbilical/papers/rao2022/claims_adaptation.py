"""A1 to A3, beyond the paper: where the adaptive law (27) helps, where it harms, and what a box changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from umbilical import Run, Status
from umbilical.papers.rao2022.experiments import FAR, GRIDS, OBSERVERS
from umbilical.papers.rao2022.ledger import (
    UNMAPPED,
    Evidence,
    Finding,
    Kind,
    Number,
    count_kind,
    decide,
    percent,
    short,
)
from umbilical.papers.rao2022.maps import BOXED, EXACT, RIM
from umbilical.papers.rao2022.regions import better, diverged, row, runaways, without_repeats

if TYPE_CHECKING:
    import xarray

HELPS = 0.5
"""Ratio of peaks below which we say that adaptation clearly helps."""
Shares = Mapping[tuple[str, ...], float]


def a1(evidence: Evidence) -> Finding:
    """A setting in which adaptation clearly helps, and where in it it does not."""
    runs = evidence.runs
    without, misjudged, with_control = (
        runs[f"blind, dead, {name}"].metrics["tip_peak_after_fault"] for name in ("without", "misjudged", "with")
    )
    ratio, far, far_known = with_control / without, runs["blind, stuck, with"], runs["blind, stuck, without"]
    helps = [ratio < HELPS, _helps(far, far_known)]
    numbers, region, when = _where_it_helps(evidence) if evidence.maps else ([], UNMAPPED, "")
    return Finding(
        "A1",
        "Ours: without the disturbance observer the adaptive law clearly helps after a fault.",
        f"Peak after the fault, with over without fault control, motor 2 dead and stuck at {FAR:g} rad2/s2; clearly: "
        f"below {HELPS:g}.",
        (
            Number("without_peak", without, "m", "peak without fault control"),
            Number("with_peak", with_control, "m", "peak with fault control"),
            Number("ratio", ratio, "1", "their ratio"),
            Number("ratio_misjudged", with_control / misjudged, "1", "to factors believed four times too large"),
            Number("far_end", far.end_time, "s", f"stuck at {FAR:g}, with fault control: ends at", Kind.INSTANT),
            *numbers,
        ),
        decide(all(helps), any(helps)),
        f"Dead, it leaves {percent(ratio)} of the peak ({short(with_control)} of {short(without)} m), and "
        f"{percent(with_control / misjudged)} of that of factors believed four times too large. Its offsets integrate "
        f"u_a: they do, slowly, what the disturbance observer does fast. Stuck at {FAR:g} rad2/s2 it diverges "
        f"{_when(far)}, known factors {_when(far_known)}.",
        region,
        when or f"the motor is not stuck as far away as {FAR:g} rad2/s2",
    )


def _helps(run: Run, known: Run) -> bool:
    """Whether a run is clearly better than the one with known factors; one that diverges never is."""
    peaks = [one.metrics["tip_peak_after_fault"] for one in (run, known)]
    return run.status is Status.COMPLETED and peaks[0] < HELPS * peaks[1]


def _where_it_helps(evidence: Evidence) -> tuple[list[Number], str, str]:
    """Shares of two maps in which it is better, and the stuck values at which it clearly is."""
    shares = _shares(evidence, ("time", "factors"))
    known = row(evidence.maps["map-factors"], "stuck_value")
    count, size = int(better(known, "with", "on").sum()), known.sizes["stuck_value"]
    low, high = _range_of_help(known)
    numbers = [
        *_share_numbers(shares),
        Number("better_known", count, "1", f"of {size} stuck values: better, factors exact, observer on", Kind.FEW),
        Number("stuck_low", low, "rad2/s2", "least stuck value at which it clearly helps, no observer", Kind.EDGE),
        Number("stuck_high", high, "rad2/s2", "the largest", Kind.EDGE),
    ]
    region = (
        f"Better than known factors over effectiveness and instant (map-time) in {_both(shares, 'time')}; over stuck "
        f"value and error of the belief (map-factors) in {_both(shares, 'factors')}. With the observer and exact "
        f"factors it is better at {count} of {size} stuck values."
    )
    return numbers, region, f"the motor loses thrust, or is stuck between {short(low)} and {short(high)} rad2/s2"


def _shares(evidence: Evidence, names: Sequence[str], arm: str = "with") -> Shares:
    """Share of the cells of some maps in which an arm is better than known factors, by map and observer."""
    places = product(names, OBSERVERS)
    return {(name, obs): float(better(evidence.maps[f"map-{name}"], arm, obs).mean()) for name, obs in places}


def _share_numbers(shares: Shares, prefix: str = "better", of: str = "it") -> list[Number]:
    return [
        Number(
            f"{prefix}_{name}_{obs}",
            share,
            "1",
            f"cells of map-{name} where {of} is better, observer {obs}",
            Kind.SHARE,
        )
        for (name, obs), share in shares.items()
    ]


def _both(shares: Shares, name: str) -> str:
    without, with_observer = (percent(shares[name, obs]) for obs in ("off", "on"))
    return f"{without} of the cells without the disturbance observer and in {with_observer} with it"


def _range_of_help(known: xarray.Dataset) -> tuple[float, float]:
    """The stuck values around zero at which it clearly helps without the observer, factors known exactly."""
    peaks = known["peak"].sel(observer="off")
    values = known["stuck_value"].values
    lost = values[~(peaks.sel(arm="with") < HELPS * peaks.sel(arm="without")).values]
    low, high = lost[lost < 0.0].max(initial=-np.inf), lost[lost > 0.0].min(initial=np.inf)
    between = values[(values > low) & (values < high)]
    return float(between.min()), float(between.max())


def a2(evidence: Evidence) -> Finding:
    """A setting in which adaptation harms: the ratchet."""
    runs = evidence.runs
    fast, long, seen = runs["blind, dead, fast"], runs["blind, none, with, long"], runs["none, with, endless"]
    grids = [*(runs[f"blind, dead, fast, {elements}"] for elements in GRIDS[:-1]), fast]
    lost = [run.status is Status.DIVERGED for run in (fast, long)]
    before = _kappa(long, long.end_time - 10.0)
    slow, slowly = _ratchet(seen, EXACT * evidence.edges["none", "with", "on"].gain)
    found = runaways(evidence.edges, "with")
    rates, over_rates = _first_lost(evidence) if evidence.maps else ([], UNMAPPED)
    return Finding(
        "A2",
        "Ours: the published adaptation drives the loop apart by itself (the ratchet).",
        "Whether the run diverges: motor 2 dead with ten times the rates, and no fault, the preset's rates, 400 s, "
        f"both without the disturbance observer; and no fault, {seen.scenario.duration:g} s, with it.",
        (
            Number("fast_end", fast.end_time, "s", "dead, ten times faster, no observer: diverges at", Kind.INSTANT),
            *(
                Number(f"fast_end_{elements}", run.end_time, "s", f"the same on {elements} elements", Kind.INSTANT)
                for elements, run in zip(GRIDS[:-1], grids, strict=False)
            ),
            Number("long_end", long.end_time, "s", "no fault, rates of the preset, no observer: at", Kind.INSTANT),
            Number(
                "long_kappa", before, "rad2/(N s2)", f"kappa_0 ten seconds before; exact is {EXACT:g}", Kind.INSTANT
            ),
            *slow,
            *found.numbers,
            *rates,
        ),
        decide(all(lost) and seen.status is Status.DIVERGED, any(lost)),
        f"Without the disturbance observer it diverges {_when(fast)} with ten times the rates (on "
        f"{', '.join(map(str, GRIDS))} elements {', '.join(map(_when, grids))}), and with the preset's rates "
        f"and no fault {_when(long)}. Any motion pushes kappa_0 up, to {short(before)} ten seconds before that, where "
        f"{EXACT:g} is exact.",
        f"{slowly} {over_rates} {found.words}",
        "there is no disturbance observer, or "
        + "".join(f"the rates are {short(number.value)} times those of the preset, or " for number in rates[:1])
        + f"kappa_0 starts at {short(found.numbers[0].value)} times its exact value",
    )


def _kappa(run: Run, instant: float) -> float:
    return float(run["kappa"].isel(kappa_index=0).sel(time=instant, method="nearest"))


def _ratchet(run: Run, edge: float) -> tuple[list[Number], str]:
    """Where kappa_0 gets with the disturbance observer, whether it still rises, and where the loop runs away."""
    end = run.end_time
    early, last, rise = _kappa(run, 400.0), _kappa(run, end), _kappa(run, end) - _kappa(run, 0.9 * end)
    unit = "rad2/(N s2)"
    numbers = [
        Number("observer_kappa", early, unit, "kappa_0 after 400 s with the observer"),
        Number("observer_end", last, unit, f"kappa_0 after {end:g} s"),
        Number("observer_rise", rise, unit, "its rise in the last tenth of that", Kind.ERROR),
        Number("edge_kappa", edge, unit, "kappa_0 at which that loop runs away", Kind.EDGE),
    ]
    return numbers, (
        f"With the disturbance observer u_a is small and the ratchet slow: kappa_0 goes from {short(_kappa(run, 0.0))} "
        f"to {short(early)} in 400 s and to {short(last)} in {end:g} s, by {short(rise)} in the last tenth of that; "
        f"the loop runs away from {short(edge)} on."
    )


def _first_lost(evidence: Evidence) -> tuple[list[Number], str]:
    """The least rates at which the dead loop diverges within its run, with the observer and without."""
    rates = row(evidence.maps["map-rates"], "rate_ratio")
    lost = {obs: np.isnan(rates["peak"].sel(arm="with", observer=obs).values) for obs in OBSERVERS}
    least = {obs: float(rates["rate_ratio"].values[where].min(initial=np.inf)) for obs, where in lost.items()}
    numbers = [
        Number(f"rate_{obs}", ratio, "1", f"dead: times the rates at which it diverges, observer {obs}", Kind.EDGE)
        for obs, ratio in least.items()
    ]
    return numbers, (
        f"Motor 2 dead, it diverges within {_duration(evidence):g} s from {short(least['on'])} times the rates on with "
        f"the observer, from {short(least['off'])} times on without (map-rates)."
    )


def _duration(evidence: Evidence) -> float:
    return evidence.runs["dead, with"].scenario.duration


def _when(run: Run) -> str:
    return f"at {short(run.end_time)} s" if run.status is Status.DIVERGED else f"not within {short(run.end_time)} s"


def a3(evidence: Evidence) -> Finding:
    """What projection changes."""
    runs = evidence.runs
    boxed = [runs["blind, dead, boxed"], runs["blind, none, boxed, long"]]
    bare = [runs["blind, dead, fast"], runs["blind, none, with, long"]]
    saved = [b.status is Status.COMPLETED and a.status is Status.DIVERGED for a, b in zip(bare, boxed, strict=True)]
    peaks = [run.metrics["tip_peak"] for run in boxed]
    kept = _kappa(boxed[1], boxed[1].end_time)
    below = {obs: 1.0 - RIM / (EXACT * evidence.edges["none", "with", obs].gain) for obs in OBSERVERS}
    numbers, region = _boxed_maps(evidence) if evidence.maps else ([], UNMAPPED)
    return Finding(
        "A3",
        "Ours: a box for kappa ends the ratchet.",
        f"The two runs of A2 again, kappa projected onto a box (kappa_0 up to {RIM:g}, {RIM / EXACT:g} times exact).",
        (
            Number("dead_peak", peaks[0], "m", "peak, dead, ten times the rates, boxed"),
            Number("long_peak", peaks[1], "m", "peak, no fault, 400 s, boxed"),
            Number("long_kappa", kept, "rad2/(N s2)", "kappa_0 at the end of that"),
            *(
                Number(f"below_{obs}", share, "1", f"how far below the edge the box ends, observer {obs}", Kind.SHARE)
                for obs, share in below.items()
            ),
            *numbers,
        ),
        decide(all(saved), any(saved)),
        f"{saved.count(True)} of 2 come to their end that did not; the peaks are {short(peaks[0])} and "
        f"{short(peaks[1])} m. The box ends {percent(below['on'])} below the gain at which the loop runs away "
        f"({percent(below['off'])} without the disturbance observer). It stops the ratchet, no more: after "
        f"{boxed[1].end_time:g} s kappa_0 is {short(kept)}, where {EXACT:g} is exact.",
        region,
        "one of the two runs is asked for",
    )


def _boxed_maps(evidence: Evidence) -> tuple[list[Number], str]:
    """What the box changes over two maps, and what it costs at the rates of the preset."""
    names, arms = ("rates", "factors"), {"bare": "with", "boxed": BOXED}
    maps = {name: without_repeats(evidence.maps[f"map-{name}"]) for name in names}
    lost = {(name, arm): diverged(maps[name], of) for name in names for arm, of in arms.items()}
    shares = {arm: _shares(evidence, names, of) for arm, of in arms.items()}
    price = {obs: _price(maps["rates"], obs) for obs in OBSERVERS}
    numbers = [
        *(
            Number(f"diverged_{name}_{arm}", count, "1", f"of {size} of map-{name} diverged, {arm}", count_kind(size))
            for (name, arm), (count, size) in lost.items()
        ),
        *(number for arm in arms for number in _share_numbers(shares[arm], f"better_{arm}", arm)),
        *(
            Number(f"price_{obs}", ratio, "1", f"dead, the preset's rates: peak boxed over bare, observer {obs}")
            for obs, ratio in price.items()
        ),
    ]
    told = (
        f"{name_words}: {lost[name, 'boxed'][0]} of {lost[name, 'boxed'][1]} runs diverge in the box, "
        f"{lost[name, 'bare'][0]} without it; better than known factors in {_both(shares['boxed'], name)} (bare in "
        f"{percent(shares['bare'][name, 'off'])} and {percent(shares['bare'][name, 'on'])})"
        for name, name_words in (("rates", "Start and rate (map-rates)"), ("factors", "stuck value (map-factors)"))
    )
    return numbers, (
        f"{'; '.join(told)}. Its price, motor 2 dead at the preset's rates: {percent(price['off'])} of the bare peak "
        f"without the observer, {percent(price['on'])} with it."
    )


def _price(rates: xarray.Dataset, observer: str) -> float:
    """Peak in the box over that without it, at the start and rates of the preset."""
    at = {rates.attrs[axis]: rates.attrs[f"paper_{axis}"] for axis in ("x", "y")}
    peaks = rates["peak"].sel(observer=observer).sel(at, method="nearest")
    return float(peaks.sel(arm=BOXED) / peaks.sel(arm="with"))

"""A1 to A3, beyond the paper: where the adaptive law (27) helps, where it harms, and what a box changes."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical import Run, Status
from umbilical.papers.rao2022.experiments import FAR, GRIDS, OBSERVERS
from umbilical.papers.rao2022.ledger import BOUNDS, Evidence, Judged, metric_values, short
from umbilical.papers.rao2022.maps import BOXED, EXACT, RIM
from umbilical.papers.rao2022.regions import better, diverged, preset_row, runaways, without_repeats

if TYPE_CHECKING:
    import xarray


def a1(evidence: Evidence) -> Judged:
    """A setting in which adaptation clearly helps, and where in it it does not."""
    far, known = (evidence.runs[f"blind, stuck, {arm}"] for arm in ("with", "without"))
    far_ratio = far.metrics["tip_peak_after_fault"] / known.metrics["tip_peak_after_fault"]
    ratios = metric_values("A1", evidence.runs)["ratio"], far_ratio if far.status is Status.COMPLETED else np.inf
    helps = [ratio < BOUNDS["helps"] for ratio in ratios]
    values = {"far_end": far.end_time, "far": FAR, "far_when": _when(far), "known_when": _when(known)}
    more = _where_it_helps(evidence) if evidence.maps else {}
    return Judged(values | more, all(helps), any(helps))


def _where_it_helps(evidence: Evidence) -> dict[str, Any]:
    """Shares of two maps in which it is better, and the stuck values at which it clearly is, factors known exactly."""
    known = preset_row(evidence.maps["map-factors"], "stuck_value")
    values, peaks = known["stuck_value"].values, known["peak"].sel(observer="off")
    lost = values[~(peaks.sel(arm="with") < BOUNDS["helps"] * peaks.sel(arm="without")).values]
    low, high = lost[lost < 0.0].max(initial=-np.inf), lost[lost > 0.0].min(initial=np.inf)
    between = values[(values > low) & (values < high)]
    return {
        "better": _shares(evidence, ("time", "factors"), "with"),
        "better_known": int(better(known, "with", "on").sum()),
        "size": values.size,
        "stuck_low": float(between.min()),
        "stuck_high": float(between.max()),
    }


def _shares(evidence: Evidence, names: tuple[str, ...], arm: str) -> dict[str, float]:
    """Share of the cells of some maps in which an arm is better than known factors, by map and observer."""
    places = product(names, OBSERVERS)
    return {f"{name}/{obs}": float(better(evidence.maps[f"map-{name}"], arm, obs).mean()) for name, obs in places}


def a2(evidence: Evidence) -> Judged:
    """A setting in which adaptation harms: the ratchet."""
    runs = evidence.runs
    fast, long, seen = runs["blind, dead, fast"], runs["blind, none, with, long"], runs["none, with, endless"]
    coarse = {str(elements): runs[f"blind, dead, fast, {elements}"] for elements in GRIDS[:-1]}
    lost = [run.status is Status.DIVERGED for run in (fast, long)]
    end, last = seen.end_time, _kappa(seen, seen.end_time)
    edges = runaways(evidence.edges, "with")
    values = {
        "fast_end": fast.end_time,
        "coarse": {elements: run.end_time for elements, run in coarse.items()},
        "long_end": long.end_time,
        "long_kappa": _kappa(long, long.end_time - 10.0),
        "start": _kappa(seen, 0.0),
        "observer_kappa": _kappa(seen, 400.0),
        "observer_end": last,
        "observer_rise": last - _kappa(seen, 0.9 * end),
        "edge_kappa": EXACT * edges["edge_on"],
        "end": end,
        "exact": EXACT,
        "fast_when": _when(fast),
        "grids": list(map(str, GRIDS)),
        "grids_when": [_when(run) for run in (*coarse.values(), fast)],
        "long_when": _when(long),
        "duration": runs["dead, with"].scenario.duration,
        **edges,
        **({"rate": _first_lost(evidence)} if evidence.maps else {}),
    }
    return Judged(values, all(lost) and seen.status is Status.DIVERGED, any(lost))


def _kappa(run: Run, instant: float) -> float:
    return float(run["kappa"].isel(kappa_index=0).sel(time=instant, method="nearest"))


def _first_lost(evidence: Evidence) -> dict[str, float]:
    """The least rates at which the dead loop diverges within its run, with the observer and without."""
    rates = preset_row(evidence.maps["map-rates"], "rate_ratio").sel(arm="with")
    lost = {obs: np.isnan(rates["peak"].sel(observer=obs).values) for obs in OBSERVERS}
    return {obs: float(rates["rate_ratio"].values[where].min(initial=np.inf)) for obs, where in lost.items()}


def _when(run: Run) -> str:
    return f"at {short(run.end_time)} s" if run.status is Status.DIVERGED else f"not within {short(run.end_time)} s"


def a3(evidence: Evidence) -> Judged:
    """What projection changes."""
    runs = evidence.runs
    boxed = [runs["blind, dead, boxed"], runs["blind, none, boxed, long"]]
    bare = [runs["blind, dead, fast"], runs["blind, none, with, long"]]
    saved = [b.status is Status.COMPLETED and a.status is Status.DIVERGED for a, b in zip(bare, boxed, strict=True)]
    edges = runaways(evidence.edges, "with")
    values = {
        "long_kappa": _kappa(boxed[1], boxed[1].end_time),
        "below": {obs: 1.0 - RIM / (EXACT * edges[f"edge_{obs}"]) for obs in OBSERVERS},
        "saved": saved.count(True),
        "end": boxed[1].end_time,
        "exact": EXACT,
        "rim": RIM,
        "rim_times": RIM / EXACT,
        **(_boxed_maps(evidence) if evidence.maps else {}),
    }
    return Judged(values, all(saved), any(saved))


def _boxed_maps(evidence: Evidence) -> dict[str, Any]:
    """What the box changes over two maps, and what it costs at the rates of the preset."""
    names, arms = ("rates", "factors"), {"bare": "with", "boxed": BOXED}
    maps = {name: without_repeats(evidence.maps[f"map-{name}"]) for name in names}
    lost = {name: {arm: diverged(data, of) for arm, of in arms.items()} for name, data in maps.items()}
    shares = {arm: _shares(evidence, names, of) for arm, of in arms.items()}
    return {
        **{f"lost_{name}": {arm: count for arm, (count, _) in counts.items()} for name, counts in lost.items()},
        "cells": {name: counts["bare"][1] for name, counts in lost.items()},
        "better": {f"{arm}/{place}": share for arm, of in shares.items() for place, share in of.items()},
        "price": {obs: _price(maps["rates"], obs) for obs in OBSERVERS},
    }


def _price(rates: xarray.Dataset, observer: str) -> float:
    """Peak in the box over that without it, at the start and rates of the preset."""
    at = {rates.attrs[axis]: rates.attrs[f"paper_{axis}"] for axis in ("x", "y")}
    peaks = rates["peak"].sel(observer=observer).sel(at, method="nearest")
    return float(peaks.sel(arm=BOXED) / peaks.sel(arm="with"))

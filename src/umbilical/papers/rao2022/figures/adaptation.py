"""Where the adaptive law helps, where it harms, and what a box changes."""

from __future__ import annotations

import xarray

from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.figures.picture import Picture, abreast, allocation_weights
from umbilical.papers.rao2022.figures.style import Panel, lines_of, over_time

EXPERIMENTS = {
    "without": "blind, dead, without",
    "with": "blind, dead, with",
    "fast": "blind, dead, fast",
    "boxed": "blind, dead, boxed",
}
"""Arms by the experiments that show them."""
LARGEST_KAPPA = 5.0
"""rad2/(N s2), ten times the exact value: beyond, the loop has gone."""


def _data(runs: Runs) -> xarray.Dataset:
    """The ROV and kappa_0 without the disturbance observer, motor 2 dead."""
    size = {"units": "m", "symbol": "|y(l,t)|", "long_name": "size of the ROV's displacement"}
    chosen = {arm: runs[name] for arm, name in EXPERIMENTS.items()}
    tips = {arm: abs(run["tip_displacement"]).assign_attrs(size) for arm, run in chosen.items()}
    gains = {arm: allocation_weights(run)["kappa_0"] for arm, run in chosen.items()}
    return xarray.Dataset({"tip_size": abreast(tips, "arm"), "kappa_0": abreast(gains, "arm")})


def _panels(data: xarray.Dataset) -> list[Panel]:
    """An arm ends where its run diverged."""
    tip, kappa = ((data[name].attrs["long_name"], lines_of(data, name, "arm")) for name in ("tip_size", "kappa_0"))
    return [Panel(*tip, bottom=1e-3, log=True), Panel(*kappa, bottom=0.0, top=LARGEST_KAPPA)]


PICTURE = Picture(
    "adaptation",
    "Where adaptation helps and harms",
    "Motor 2 dead, no disturbance observer. The adaptive law helps; ten times faster it runs away (the line "
    "ends); in a box it does not.",
    "C11 A1 A2 A3",
    over_time(_panels, 1.6, 2),
    tuple(EXPERIMENTS.values()),
    _data,
    EXPERIMENTS["with"],
)

"""Maps and a scan of the right shape with made-up peaks."""

from __future__ import annotations

import numpy as np
import xarray

from umbilical.papers.rao2022.experiments import ARMS, OBSERVERS
from umbilical.papers.rao2022.maps import GAIN_CASES, GAINS, SLICES, Axis


def made_up_maps(diverging: float = 0.1) -> dict[str, xarray.Dataset]:
    """All scans by name, in which a share of the cells diverged."""
    rng = np.random.default_rng(0)
    found = {}
    for one in SLICES:
        axes = {axis.name: axis.coordinate() for axis in (one.y, one.x)}
        words = {"title": one.title, "x": one.x.name, "y": one.y.name, "paper_x": one.x.paper, "paper_y": one.y.paper}
        coordinates = {"observer": list(OBSERVERS), "arm": list(one.arms), **axes}
        found[one.name] = _random(rng, coordinates, diverging).assign_attrs(words)
    axis = Axis("gain", "gain", GAINS, 1.0, scale="log")
    names = {"observer": list(OBSERVERS), "case": list(GAIN_CASES), "arm": list(ARMS)}
    return found | {"gain": _random(rng, {**names, "gain": axis.coordinate()}, diverging)}


def _random(rng: np.random.Generator, coordinates: dict, diverging: float) -> xarray.Dataset:
    sizes = [len(c[1]) if isinstance(c, tuple) else len(c) for c in coordinates.values()]
    peaks = rng.uniform(1e-3, 1.0, sizes)
    peaks[rng.uniform(size=sizes) < diverging] = np.nan
    words = {"units": "m", "long_name": "peak", "symbol": "y"}
    return xarray.Dataset({"peak": (tuple(coordinates), peaks, words)}, coordinates)

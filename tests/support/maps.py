"""Maps and a scan of the right shape with made-up peaks."""

from __future__ import annotations

import numpy as np
import xarray

from umbilical.papers.rao2022.maps import SCANS


def made_up_maps(diverging: float = 0.1) -> dict[str, xarray.Dataset]:
    """All scans by name, in which a share of the cells diverged."""
    rng = np.random.default_rng(0)

    def cells(size: tuple[int, ...]) -> np.ndarray:
        return np.where(rng.uniform(size=size) < diverging, np.nan, rng.uniform(1e-3, 1.0, size))

    found = {
        name: one.dataset(*(cells(tuple(len(values) for _, values, _ in one.coordinates.values())) for _ in "xy"))
        for name, one in SCANS.items()
    }
    return {name: data.drop_vars("end_time") for name, data in found.items()}

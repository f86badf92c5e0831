"""Dimensions of the channels of a run, and what stands along each of them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from umbilical.quantities import CHANNELS, PARAMETERS, Quantity

SECOND_DIMENSION = {name: q.over for name, q in CHANNELS.items() if q.over}
"""What a channel depends on besides time; a channel not named here depends on time alone."""


def dimensions(name: str) -> tuple[str, ...]:
    """Dimensions of a channel, time first.

    >>> dimensions("position"), dimensions("length")
    (('time', 'axis', 'sigma'), ('time',))
    """
    return ("time", *SECOND_DIMENSION.get(name, "").split())


def attributes(word: Quantity) -> dict[str, str]:
    """Unit, meaning and symbol, as a dataset has them."""
    return {"units": word.unit, "long_name": word.meaning, "symbol": word.symbol}


def coordinates(channels: Mapping[str, np.ndarray], time: np.ndarray, sigma: np.ndarray | None) -> dict[str, tuple]:
    """Values of every dimension that occurs: instants, positions, numbers of the motors from 1, of kappa from 0."""
    sizes = {
        dim: size for name, values in channels.items() for dim, size in zip(dimensions(name), values.shape, strict=True)
    }
    found: dict[str, tuple] = {"time": ("time", time, {"units": "s", "long_name": "time", "symbol": "t"})}
    if "sigma" in sizes:
        nodes = np.linspace(0.0, 1.0, sizes["sigma"]) if sigma is None else sigma
        comment = {"comment": "distance from the vessel x = sigma * length"}
        found["sigma"] = ("sigma", nodes, attributes(PARAMETERS["sigma"]) | comment)
    if "motor" in sizes:
        found["motor"] = ("motor", np.arange(1, sizes["motor"] + 1), attributes(Quantity("1", "i", "motor")))
    if "axis" in sizes:
        axes = {"comment": "0: x, along the string's displacement; 1: y, across it; 2: z, up"}
        found["axis"] = ("axis", np.arange(sizes["axis"]), attributes(Quantity("1", "", "axis")) | axes)
    if "kappa_index" in sizes:
        found["kappa_index"] = ("kappa_index", np.arange(sizes["kappa_index"]), attributes(Quantity("1", "", "entry")))
    return found

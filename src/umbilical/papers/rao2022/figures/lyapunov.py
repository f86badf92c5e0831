"""The Lyapunov function of the proof along two runs."""

from __future__ import annotations

from collections.abc import Iterator

import xarray

from umbilical.papers.rao2022.experiments import Runs, cell
from umbilical.papers.rao2022.figures.picture import HEALTHY, Picture
from umbilical.papers.rao2022.figures.style import LOOKS, Look, Panel, over_time
from umbilical.papers.rao2022.lyapunov import lyapunov
from umbilical.plots.figure import COLOURS

CASES = {"no fault": HEALTHY, "motor 2 dead": cell("dead", "without")}
PARTS = {
    "V": Look("$V$", COLOURS[5], width=3.0),
    "V_1": LOOKS["proposed"]._replace(text="$V_1$"),
    "V_2": LOOKS["load"]._replace(text="$|V_2|$"),
    "V_3": LOOKS["pd"]._replace(text="$V_3$"),
}
"""Looks of V and its parts; V_2 changes sign, its size is drawn."""


def _data(runs: Runs) -> xarray.Dataset:
    """V(t) and its parts without a fault and with a dead motor, known factors."""
    found = {case: lyapunov(runs[name]) for case, name in CASES.items()}
    values = [[parts[part] for part in PARTS] for parts in found.values()]
    words = {"units": "J", "symbol": "V", "long_name": "Lyapunov function of the proof, gamma = 1"}
    coordinates = {"case": list(CASES), "part": list(PARTS), "time": runs[HEALTHY]["time"]}
    return xarray.Dataset({"lyapunov": (tuple(coordinates), values, words)}, coordinates)


def _panels(data: xarray.Dataset) -> Iterator[Panel]:
    values = data["lyapunov"]
    shown = xarray.where(values["part"] == "V_2", abs(values), values, keep_attrs=False).assign_attrs(values.attrs)
    for case, name in CASES.items():
        lines = [(shown.sel(case=case, part=part), look) for part, look in PARTS.items()]
        top = 2.0 * float(values.max())
        yield Panel(case, lines, marked=name != HEALTHY, bottom=1e-9, top=top, log=True)


PICTURE = Picture(
    "lyapunov",
    "V(t)",
    "The Lyapunov function of the proof along two runs, and its parts. It falls between pushes of the load; V3 "
    "jumps at the fault, because D does.",
    "T1",
    over_time(_panels, 1.5, 5),
    tuple(CASES.values()),
    _data,
    CASES["motor 2 dead"],
)

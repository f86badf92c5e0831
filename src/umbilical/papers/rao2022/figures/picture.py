"""What a figure is: name, caption, its data from runs, its drawing; and what the data of several share."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

from umbilical import Run, __version__
from umbilical.papers.rao2022.experiments import ARMS, Runs, cell

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOI = "10.3390/jmse10111772"
SOURCE = f"Rao, Wang, Du, J. Mar. Sci. Eng. 2022, 10(11), 1772, doi {DOI}"
CONTROLLERS = {"none": "free", "pd": "pd", "proposed": cell("none", "without")}
"""The three controllers of Figs. 3 and 4, by the experiments that show them."""
HEALTHY = CONTROLLERS["proposed"]


@dataclass(frozen=True)
class Picture:
    """One figure.

    Attributes:
        name: of its files, and on the command line.
        title: the paper's number, or what it is; empty number for ours.
        caption: what is seen.
        claims: that can be seen in it, by their names in the ledger.
        draw: from its dataset to a figure.
        experiments: names of the runs it is made from.
        collect: from these runs to its dataset; None where it shows a scan, whose dataset has the figure's name.
        faulty: experiment whose fault is marked.
    """

    name: str
    title: str
    caption: str
    claims: str
    draw: Callable[[xarray.Dataset], Figure]
    experiments: Sequence[str] = ()
    collect: Callable[[Runs], xarray.Dataset] | None = None
    faulty: str = ""

    @property
    def scanned(self) -> bool:
        """Whether it shows a map or the scan of the gain."""
        return self.collect is None

    def data(self, runs: Runs, scans: Mapping[str, xarray.Dataset]) -> xarray.Dataset:
        """The dataset behind it, with title, source and the fault it marks: when, and of which motor."""
        found = scans[self.name] if self.collect is None else self.collect(runs)
        about: dict[str, Any] = {"title": f"{self.title}: {self.caption}", "source": SOURCE}
        about["version_umbilical"] = __version__
        if self.faulty:
            fault = runs[self.faulty].scenario.faults[0]
            about |= {"fault_time": fault.start, "fault_motor": fault.motor}
        return found.assign_attrs(about)


def abreast(arrays: Mapping[str, xarray.DataArray], dim: str) -> xarray.DataArray:
    """Arrays side by side under their names; where one ended early its rest is not a number."""
    joined = xarray.concat(list(arrays.values()), dim=dim, join="outer", coords="minimal", compat="override")
    return joined.assign_coords({dim: list(arrays)}).assign_attrs(next(iter(arrays.values())).attrs)


def by_controller(runs: Runs, of: Callable[[Run], xarray.DataArray]) -> xarray.DataArray:
    """Something of the runs of the three controllers."""
    return abreast({who: of(runs[name]) for who, name in CONTROLLERS.items()}, "controller")


def by_case(runs: Runs, channel: str, cases: Sequence[str]) -> xarray.Dataset:
    """A channel of every case in both arms."""
    arms = {case: abreast({arm: runs[cell(case, arm)][channel] for arm in ARMS}, "arm") for case in cases}
    return xarray.Dataset({channel: abreast(arms, "case")})


def with_estimates(run: Run, *names: str) -> xarray.Dataset:
    """Channels with what the observers make of them."""
    return xarray.Dataset({name: run[name] for base in names for name in (base, f"{base}_estimate")})


def allocation_weights(run: Run) -> Mapping[str, xarray.DataArray]:
    """kappa_0 and the sum of the others, each with its ideal value (after (30)); constant where nothing adapts."""
    scenario, like = run.scenario, run["tip_displacement"]
    signed = np.array([motor.thrust_coefficient for motor in scenario.motors])
    stuck = np.zeros(signed.size)
    for fault in reversed(scenario.faults):
        if fault.kind == "stuck":
            stuck[fault.motor - 1] = fault.value
    working = run["effectiveness"].values @ abs(signed)
    lost = (run["effectiveness"].values == 0.0) @ (signed * stuck)
    adapted = run["kappa"].values
    if scenario.control.allocation.method == "known":
        adapted = np.zeros_like(adapted)
        adapted[:, 0] = 1.0 / abs(signed).sum()
    first = {"units": "rad2/(N s2)", "symbol": r"\kappa_0", "long_name": "gain of the allocation"}
    rest = {"units": "rad2/s2", "symbol": r"\Sigma\kappa_j", "long_name": "sum of the offsets of the allocation"}
    return {
        "kappa_0": like.copy(data=adapted[:, 0]).assign_attrs(first),
        "kappa_0_ideal": like.copy(data=1.0 / working).assign_attrs(first),
        "kappa_sum": like.copy(data=adapted[:, 1:].sum(axis=1)).assign_attrs(rest),
        "kappa_sum_ideal": like.copy(data=-lost / working).assign_attrs(rest),
    }

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
THREE = tuple(CONTROLLERS.values())
HEALTHY = (cell("none", "without"),)
STUCK = tuple(cell(case, arm) for case in ("none", "stuck") for arm in ARMS)
FAILED = tuple(cell(case, arm) for arm in ARMS for case in ("dead", "stuck"))


@dataclass(frozen=True)
class Picture:
    """One figure.

    Attributes:
        name: of its files, and on the command line.
        title: the paper's number, or what it is; empty number for ours.
        caption: what is seen.
        draw: from its dataset to a figure.
        experiments: names of the runs it is made from.
        collect: from these runs to its dataset; None where it shows a scan, whose dataset has the figure's name.
        faulty: experiment whose fault is marked.
    """

    name: str
    title: str
    caption: str
    draw: Callable[[xarray.Dataset], Figure]
    experiments: tuple[str, ...] = ()
    collect: Callable[[Runs], xarray.Dataset] | None = None
    faulty: str = ""

    @property
    def scanned(self) -> bool:
        """Whether it shows a map or the scan of the gain."""
        return self.collect is None

    def data(self, runs: Runs, scans: Mapping[str, xarray.Dataset]) -> xarray.Dataset:
        """The dataset behind it, with title, source and the fault it marks."""
        found = scans[self.name] if self.collect is None else self.collect(runs)
        marks: dict[str, Any] = about_fault(runs[self.faulty]) if self.faulty else {}
        about = {"title": f"{self.title}: {self.caption}", "source": SOURCE, "version_umbilical": __version__}
        return found.assign_attrs({**about, **marks})


def along(arrays: Sequence[xarray.DataArray], dim: str, names: Sequence[str]) -> xarray.DataArray:
    """Arrays side by side under names; where one ended early its rest is not a number."""
    joined = xarray.concat(list(arrays), dim=dim, join="outer", coords="minimal", compat="override")
    return joined.assign_coords({dim: list(names)}).assign_attrs(arrays[0].attrs)


def by_case(runs: Runs, channel: str, cases: Sequence[str]) -> xarray.Dataset:
    """A channel of every case in both arms."""
    arms = [along([runs[cell(case, arm)][channel] for arm in ARMS], "arm", list(ARMS)) for case in cases]
    return xarray.Dataset({channel: along(arms, "case", list(cases))})


def with_estimates(run: Run, *names: str) -> xarray.Dataset:
    """Channels with what the observers make of them."""
    return xarray.Dataset({name: run[name] for base in names for name in (base, f"{base}_estimate")})


def weights(run: Run) -> Mapping[str, xarray.DataArray]:
    """kappa_0 and the sum of the others, each with its ideal value (after (30)); constant where nothing adapts."""
    scenario = run.scenario
    factors = np.array([abs(m.thrust_coefficient) for m in scenario.motors])
    signed = np.array([m.thrust_coefficient for m in scenario.motors])
    stuck = np.array(
        [
            next((f.value for f in scenario.faults if f.motor == k and f.kind == "stuck"), 0.0)
            for k in run["motor"].values
        ]
    )
    working = run["effectiveness"].values @ factors
    lost = (run["effectiveness"].values == 0.0) @ (signed * stuck)
    weights = run["kappa"].values
    if scenario.control.allocation.method == "known":
        weights = np.zeros_like(weights)
        weights[:, 0] = 1.0 / factors.sum()
    first = {"units": "rad2/(N s2)", "symbol": r"\kappa_0", "long_name": "gain of the allocation"}
    rest = {"units": "rad2/s2", "symbol": r"\Sigma\kappa_j", "long_name": "sum of the offsets of the allocation"}
    like = run["tip_displacement"]
    return {
        "kappa_0": like.copy(data=weights[:, 0]).assign_attrs(first),
        "kappa_0_ideal": like.copy(data=1.0 / working).assign_attrs(first),
        "kappa_sum": like.copy(data=weights[:, 1:].sum(axis=1)).assign_attrs(rest),
        "kappa_sum_ideal": like.copy(data=-lost / working).assign_attrs(rest),
    }


def about_fault(run: Run) -> dict[str, Any]:
    """When and which motor fails, for the marks in figures."""
    fault = run.scenario.faults[0]
    return {"fault_time": fault.start, "fault_motor": fault.motor}

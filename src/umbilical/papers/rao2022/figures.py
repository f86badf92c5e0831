"""The catalogue of figures: name, caption, the data behind each and how they are drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from umbilical import __version__
from umbilical.papers.rao2022 import datasets, drawing
from umbilical.papers.rao2022.experiments import ARMS, CASES, EXPERIMENTS, Runs, cell

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

MARKS = "Dots: better than known factors; empty cells with a small x: diverged; white cross: the preset."
DOI = "10.3390/jmse10111772"
SOURCE = f"Rao, Wang, Du, J. Mar. Sci. Eng. 2022, 10(11), 1772, doi {DOI}"
THREE = tuple(datasets.CONTROLLERS.values())
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
        marks: dict[str, Any] = datasets.about_fault(runs[self.faulty]) if self.faulty else {}
        about = {"title": f"{self.title}: {self.caption}", "source": SOURCE, "version_umbilical": __version__}
        return found.assign_attrs({**about, **marks})


_ALL = (
    Picture(
        "fig3",
        "Fig. 3",
        "Displacement at l/4, l/2, 3l/4 and l without control, with PD and with the proposed law, which is the line "
        "at zero.",
        drawing.draw_positions,
        THREE,
        datasets.positions,
    ),
    Picture(
        "fig4",
        "Fig. 4",
        "Size of the displacement at the midpoint; logarithmic, so that all three controllers show.",
        drawing.draw_midpoint,
        THREE,
        datasets.midpoint,
    ),
    Picture(
        "fig5",
        "Fig. 5",
        "ROV velocity x2 and slope rate z2 with the estimates of the high-gain observers, (c) z2 "
        "near its largest value after the start; proposed law, no fault.",
        drawing.draw_states,
        HEALTHY,
        datasets.states,
    ),
    Picture(
        "fig6",
        "Fig. 6",
        "The ROV (a) with a fault of motor 2, three kinds of it, and (b) without one; thrust factors known, and fault "
        "control.",
        drawing.draw_boundary,
        tuple(cell(case, arm) for case in CASES for arm in ARMS),
        datasets.boundary,
        cell("stuck", "with"),
    ),
    Picture(
        "fig7",
        "Fig. 7",
        "Motor speeds (a) with motor 2 stuck from 10 s on and (b) without a fault. The fault acts on the thrust: the "
        "motor still turns.",
        drawing.draw_speeds,
        STUCK,
        datasets.speeds,
        cell("stuck", "with"),
    ),
    Picture(
        "fig8",
        "Fig. 8",
        "Motor voltages (a) with motor 2 stuck from 10 s on and (b) without a fault.",
        drawing.draw_voltages,
        STUCK,
        datasets.voltages,
        cell("stuck", "with"),
    ),
    Picture(
        "fig9",
        "Fig. 9",
        "What the controller sees as disturbance of the ROV, and the voltage disturbance of each motor, with "
        "estimates.",
        drawing.draw_disturbances,
        HEALTHY,
        datasets.disturbances,
    ),
    Picture(
        "spacetime",
        "The cable over time",
        "Displacement of the whole cable, vessel at the top; each panel has its own scale.",
        drawing.draw_spacetime,
        THREE,
        datasets.spacetime,
    ),
    Picture(
        "energy",
        "Power balance",
        "Energy of cable and ROV, and the work on it since the start. What the balance leaves open is in the data.",
        drawing.draw_energy,
        THREE,
        datasets.balance,
    ),
    Picture(
        "lyapunov",
        "V(t)",
        "The Lyapunov function of the proof along two runs, and its parts. It falls between pushes of the load; V3 "
        "jumps at the fault, because D does.",
        drawing.draw_lyapunov,
        (cell("none", "without"), cell("dead", "without")),
        datasets.lyapunov_parts,
        cell("dead", "without"),
    ),
    Picture(
        "kappa",
        "kappa(t)",
        "The adaptive allocation: kappa_0 and the sum of the offsets, with the values that would deliver what is "
        "commanded.",
        drawing.draw_kappa,
        FAILED,
        datasets.kappa,
        cell("dead", "with"),
    ),
    Picture(
        "absorption",
        "Why nothing diverges",
        "After a fault, without fault control: the estimate follows load and lost thrust together.",
        drawing.draw_absorption,
        FAILED,
        datasets.absorption,
        cell("dead", "without"),
    ),
    Picture(
        "adaptation",
        "Where adaptation helps and harms",
        "Motor 2 dead, no disturbance observer. The adaptive law helps; ten times faster it runs away (the line "
        "ends); in "
        "a box it does not.",
        drawing.draw_adaptation,
        tuple(datasets.ADAPTATION.values()),
        datasets.adaptation,
        "blind, dead, with",
    ),
    Picture(
        "gain",
        "Where the loop runs away",
        "Peak of the ROV over the gain of the allocation at the start; motor 2 healthy, or dead from 0.1 s on. Crosses "
        "at the top: diverged.",
        drawing.draw_gain,
    ),
    Picture(
        "map-time",
        "Loss of thrust by the instant of the fault",
        f"Peak of the ROV after the fault. {MARKS}",
        drawing.draw_map,
    ),
    Picture(
        "map-factors",
        "Stuck value by the error of the known factors",
        f"Peak of the ROV after the fault. Fault control uses no factors, so its columns are equal. {MARKS}",
        drawing.draw_map,
    ),
    Picture(
        "map-rates",
        "Start of the adaptation by its rate",
        f"Peak of the ROV after motor 2 has died. With known factors nothing adapts, so all cells are equal. {MARKS}",
        drawing.draw_map,
    ),
)
PICTURES: dict[str, Picture] = {picture.name: picture for picture in _ALL}
"""Every figure by name, in the order of the report."""

SEEN_IN: dict[str, tuple[str, ...]] = {
    "C1": ("fig3", "spacetime"),
    "C2": ("fig3", "spacetime", "energy"),
    "C3": ("fig3",),
    "C4": ("fig4",),
    "C5": ("fig5",),
    "C6": ("fig6", "gain"),
    "C7a": ("fig6", "absorption", "gain", "map-time", "map-factors"),
    "C7b": ("fig6", "kappa", "map-time", "map-factors"),
    "C7c": ("fig6",),
    "C8": ("fig7", "fig8"),
    "C9": ("fig9", "absorption"),
    "C10": ("fig5",),
    "C11": ("fig6", "adaptation"),
    "T1": ("fig6", "lyapunov"),
    "T2a": ("fig7", "fig8"),
    "T2b": ("fig7",),
    "T3": ("fig6", "fig7", "gain"),
    "A1": ("adaptation", "map-time", "map-factors"),
    "A2": ("adaptation", "gain", "map-rates"),
    "A3": ("adaptation", "map-rates", "map-factors"),
}
"""Figures in which a claim can be seen."""


def needed(pictures: tuple[Picture, ...]) -> tuple[str, ...]:
    """Names of the experiments behind some figures, in the order of the catalogue."""
    wanted = {name for picture in pictures for name in picture.experiments} | {p.faulty for p in pictures if p.faulty}
    return tuple(name for name in EXPERIMENTS if name in wanted)

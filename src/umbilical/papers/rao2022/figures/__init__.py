"""Figures for reading in a paper, one column wide: a file each, with its data and its drawing.

Whatever a figure shows is in its dataset, with units and names; so a figure can be drawn again from its file.
"""

from umbilical.papers.rao2022.experiments import EXPERIMENTS
from umbilical.papers.rao2022.figures import (
    absorption,
    adaptation,
    energy,
    fig3,
    fig4,
    fig5,
    fig6,
    fig7,
    fig8,
    fig9,
    gain,
    kappa,
    lyapunov,
    maps,
    spacetime,
)
from umbilical.papers.rao2022.figures.picture import DOI, SOURCE, Picture

__all__ = ["DOI", "PICTURES", "SEEN_IN", "SOURCE", "Picture", "needed"]

_FILES = (fig3, fig4, fig5, fig6, fig7, fig8, fig9, spacetime, energy, lyapunov, kappa, absorption, adaptation, gain)
PICTURES: dict[str, Picture] = {p.name: p for p in (*(file.PICTURE for file in _FILES), *maps.PICTURES)}
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

"""Figures for reading in a paper, one column wide: a file each, with its data, its drawing and its caption.

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
    fig9,
    gain,
    kappa,
    lyapunov,
    maps,
    motors,
    spacetime,
)
from umbilical.papers.rao2022.figures.picture import DOI, SOURCE, Picture

__all__ = ["DOI", "PICTURES", "SOURCE", "Picture", "needed"]

_LAST = (fig9, spacetime, energy, lyapunov, kappa, absorption, adaptation, gain)
_FIRST = (fig3, fig4, fig5, fig6)
PICTURES: dict[str, Picture] = {
    one.name: one
    for one in (
        *(file.PICTURE for file in _FIRST),
        *motors.PICTURES,
        *(file.PICTURE for file in _LAST),
        *maps.PICTURES,
    )
}
"""Every figure by name, in the order of the report."""


def needed(pictures: tuple[Picture, ...]) -> tuple[str, ...]:
    """Names of the experiments behind some figures, in the order of the catalogue."""
    wanted = {name for picture in pictures for name in (*picture.experiments, picture.faulty)}
    return tuple(name for name in EXPERIMENTS if name in wanted)

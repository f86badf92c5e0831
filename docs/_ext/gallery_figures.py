"""The gallery's pictures: every figure that a block of an example leaves in a name, which pyplot does not know of."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst


def scrape(block: Any, variables: dict[str, Any], settings: dict[str, Any]) -> str:
    """Store new figures of a block; the text that shows them."""
    found = variables["example_globals"]
    shown = found.setdefault("__shown__", set())
    paths = []
    for value in list(found.values()):
        figure = value.get_figure(root=True) if isinstance(value, Axes) else value
        if isinstance(figure, Figure) and id(figure) not in shown:
            shown.add(id(figure))
            paths.append(next(variables["image_path_iterator"]))
            figure.savefig(paths[-1], dpi=110)
    return figure_rst(paths, settings["src_dir"])

"""Formulas as drawings inside the page, by matplotlib: no TeX, no script, no network."""

from __future__ import annotations

import base64
import io
from html import escape
from typing import Any

from matplotlib import mathtext
from matplotlib.font_manager import FontProperties

_FONT = FontProperties(family="DejaVu Serif", size=11)


def picture(formula: str) -> str:
    """An ``img`` of a formula that stands on the line of the text around it."""
    svg = io.BytesIO()
    depth = mathtext.math_to_image(f"${formula}$", svg, prop=_FONT, format="svg")
    data = base64.b64encode(svg.getvalue()).decode()
    style = f"vertical-align:-{depth:.1f}pt;background:#fff;border-radius:2px"
    return f'<img class="math" alt="{escape(formula)}" style="{style}" src="data:image/svg+xml;base64,{data}">'


def _inline(self: Any, node: Any) -> None:
    self.body.append(picture(node.astext()))
    raise _skip()


def _block(self: Any, node: Any) -> None:
    self.body.append(f'<p class="math">{picture(node.astext())}</p>')
    raise _skip()


def _skip() -> Exception:
    from docutils.nodes import SkipNode

    return SkipNode()


def setup(app: Any) -> dict[str, bool]:
    app.add_html_math_renderer("mathtext", (_inline, None), (_block, None))
    app.config.html_math_renderer = "mathtext"
    return {"parallel_read_safe": True, "parallel_write_safe": True}

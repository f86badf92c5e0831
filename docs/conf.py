"""How Sphinx makes the site of the Markdown pages, the docstrings and the gallery: `python3 do.py docs`."""

from __future__ import annotations

import sys
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any

from docutils import nodes
from pygments.lexers.special import TextLexer

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

import gallery_figures  # noqa: E402

import umbilical  # noqa: E402

project, author, copyright = "Umbilical", "the Umbilical maintainers", "the Umbilical maintainers"
version = release = umbilical.__version__
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_gallery.gen_gallery",
    "mathtext",
]
html_theme = "furo"
html_title = f"Umbilical {version}"
html_copy_source = False
smartquotes = False  # --out shall stay --out
exclude_patterns = [
    "_ext",
    "gallery/*.ipynb",
    "gallery/*.py",
    "gallery/*.md5",
    "gallery/*.json",
    "sg_execution_times.rst",
]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["config.cache"]  # the gallery's settings hold a function
nitpick_ignore_regex = [
    # Types of other packages, and of ours that are not public: named, without a page to link to.
    (r"py:.*", r"(?!umbilical\.\w+$).*"),
]
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
napoleon_use_rtype = False
napoleon_use_ivar = True  # attributes are described once, in the class

sphinx_gallery_conf = {
    "examples_dirs": str(HERE.parent / "examples" / "gallery"),
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "image_scrapers": (gallery_figures.scrape,),
    "capture_repr": (),
    "download_all_examples": False,
    "show_memory": False,
    "write_computation_times": False,  # its page would load scripts from elsewhere
    "show_signature": False,
    "abort_on_example_error": True,
    "remove_config_comments": True,
}


def _no_long_signature(app: Any, what: str, name: str, thing: Any, *rest: Any) -> tuple[str, str] | None:
    """Results and scenarios are not made by hand: their fields stand below, once."""
    return ("", "") if what == "class" and is_dataclass(thing) and name != "umbilical.Command" else None


def _not_shown(app: Any, what: str, name: str, *rest: Any) -> bool | None:
    return True if name in ("shown_by", "drawn_by") else None


def _dashes(app: Any, doctree: nodes.document) -> None:
    """Between a parameter and its text, which smart quotes would do, had they not taken --out for a dash as well."""
    for node in [node for node in doctree.findall(nodes.Text) if node.astext() == " -- "]:
        node.parent.replace(node, nodes.Text(" \N{EN DASH} "))


def setup(app: Any) -> None:
    """Show CSV as text, which Pygments does not know, and of records what a reader needs."""
    app.add_lexer("csv", TextLexer)
    app.connect("autodoc-process-signature", _no_long_signature)
    app.connect("autodoc-skip-member", _not_shown)
    app.connect("doctree-read", _dashes)

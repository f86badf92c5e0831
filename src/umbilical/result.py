"""Faces that every result has: a text, data, a picture, and what a notebook shows.

What the command line prints of a result, everybody can call: ``summary()`` is its text, ``to_dict()`` what stands in
its ``--json``, ``plot()`` its picture.
"""

from __future__ import annotations

from html import escape
from importlib import import_module
from typing import Any, ClassVar


class ResultFaces:
    """Base of results.

    Attributes:
        shown_by: module whose ``FACE`` (:class:`umbilical.faces.conclusion.Face`) shows such a result.
        drawn_by: name of its picture, in ``umbilical.plots``.
    """

    shown_by: ClassVar[str]
    drawn_by: ClassVar[str]

    @property
    def face(self) -> Any:
        """What shows such a result."""
        return import_module(self.shown_by).FACE

    def summary(self) -> str:
        """The verdict and what it rests on, as the command line prints it."""
        return self.face.summary(self)

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as ``--json`` prints it, the verdict first."""
        return self.face.to_dict(self)

    def plot(self, **options: Any) -> Any:
        """Draw it; options as for the function of ``umbilical.plots`` that draws such results."""
        return call_plot(self.drawn_by, self, **options)

    def _repr_html_(self) -> str:
        headline, _, rest = self.summary().partition("\n")
        return f"<details><summary><b>{escape(headline)}</b></summary><pre>{escape(rest)}</pre></details>"


def call_plot(name: str, *shown: Any, **options: Any) -> Any:
    """Call a function of ``umbilical.plots``, which is above all results and loaded when a picture is asked for."""
    return getattr(import_module("umbilical.plots"), name)(*shown, **options)

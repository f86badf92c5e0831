"""What the seas of a place leave of the time as a verdict, a text and data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from umbilical.faces import operability
from umbilical.faces.conclusion import Conclusion, Face

if TYPE_CHECKING:
    from umbilical.screening.weather import Weather


def _conclusion(found: Weather) -> Conclusion:
    """Nothing is judged."""
    return Conclusion("NOT_ASKED", found.summary())


def _text(found: Weather) -> str:
    return operability.FACE.text(found.found)


def _document(found: Weather) -> dict[str, Any]:
    return found.to_dict()


FACE = Face(_conclusion, _text, _document)

"""What an operation must keep to: a level that is passed within a time with a small probability at most."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from umbilical.errors import Problem, ScenarioError

NAMES = {
    "slack": "the cable stays taut",
    "top_tension": "tension at the sheave, N",
    "body_heave": "heave of the body, m",
}
_TIMES = {"s": 1.0, "min": 60.0, "h": 3600.0}
_FORM = re.compile(r"(?P<name>\w+)(:(?P<level>[^=]+))?=(?P<probability>[^/]+)/(?P<time>[^a-z]+)(?P<unit>s|min|h)")


USUAL = ("slack=1e-2/3h",)
"""What must hold unless something else is said."""


@dataclass(frozen=True)
class Criterion:
    """A level that may be passed within ``duration``, s, with ``probability`` at most.

    Attributes:
        name: one of :data:`NAMES`.
        level: N or m; slack has none.
        probability, duration: how seldom, within which time.
    """

    name: str
    level: float
    probability: float
    duration: float

    def __str__(self) -> str:
        level = "" if self.name == "slack" else f":{self.level:g}"
        return f"{self.name}{level}={self.probability:g}/{self.duration / 3600.0:g}h"


def read_criteria(criteria: Sequence[Criterion | str]) -> tuple[Criterion, ...]:
    """Criteria of texts; raises as :func:`parse_criterion`.

    >>> [str(criterion) for criterion in read_criteria(["slack=1e-2/3h"])]
    ['slack=0.01/3h']
    """
    return tuple(parse_criterion(one) if isinstance(one, str) else one for one in criteria)


def parse_criterion(text: str) -> Criterion:
    """Criterion of a text such as ``slack=1e-2/3h`` or ``top_tension:250e3=1e-2/3h``.

    Raises:
        ScenarioError: it has another form, or a number that cannot be.

    >>> parse_criterion("top_tension:250e3=0.01/30min").duration
    1800.0
    """
    found = _FORM.fullmatch(text.strip().replace("-tension", "_tension").replace("-heave", "_heave"))
    try:
        if found is None or found["name"] not in NAMES or (found["level"] is None) != (found["name"] == "slack"):
            raise ValueError
        level = float(found["level"] or 0.0)
        probability, duration = float(found["probability"]), float(found["time"]) * _TIMES[found["unit"]]
        if not (isfinite(level) and level >= 0.0 and 0.0 < probability < 1.0 and 0.0 < duration <= 1e7):
            raise ValueError
    except ValueError as error:
        forms = "slack=P/TIME, top_tension:NEWTON=P/TIME or body_heave:METRE=P/TIME, TIME with s, min or h"
        reason = "a probability P between 0 and 1, within a time above 0"
        problem = Problem("--criterion", text, forms, reason, "e.g. slack=1e-2/3h")
        raise ScenarioError([problem], "criterion") from error
    return Criterion(found["name"], level, probability, duration)

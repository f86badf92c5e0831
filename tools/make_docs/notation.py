"""docs/notation.md: the table of words."""

from __future__ import annotations

from scenario import keys_by_meaning
from writing import code, page, table

from umbilical.coordinates import SECOND_DIMENSION
from umbilical.quantities import CERTIFICATE, CHANNELS, METRICS, PARAMETERS, STATES, Quantity


def notation() -> str:
    """The table of words: symbols of the paper, names of this software, units."""
    places = keys_by_meaning()
    rows = ((code(", ".join(places.get(q.meaning, [name])).replace(", ", "`, `")), q) for name, q in PARAMETERS.items())
    head = ("symbol", "name", "unit", "meaning", "in the paper", "take care")
    channels = ((f"`{name}`", q) for name, q in CHANNELS.items())
    metrics = ((f"`{name}`", q) for name, q in METRICS.items())
    return page(
        "Notation",
        "SI units and radians throughout. `x` runs along the cable from the vessel (0) down to the ROV (`l`), `y` is "
        "the transverse displacement, paying out is positive. A number in parentheses is an equation of the paper; "
        "[theory.md](theory.md) says which file holds it. *Take care* names the other thing the paper writes with "
        "the same symbol. The source of this page is `src/umbilical/quantities.py`, which also feeds the units in "
        "result files and the labels of the axes.",
        "## Parameters: what a scenario says",
        "Names are keys of a scenario; [scenario.md](scenario.md) gives their bounds and defaults.",
        table(head, (described(name, q) for name, q in rows)),
        "## Channels: what a run holds",
        f"Every channel is over `time`; {dimensions()}",
        table(head, (described(name, q) for name, q in channels)),
        "## States: what plant, sensors and controller hold",
        "Fields of the records that the loop works on (`src/umbilical/frames.py`), beside channels and parameters.",
        table(head, (described(f"`{name}`", q) for name, q in STATES.items())),
        "## Metrics: single numbers of a run",
        "Peaks and root mean squares are taken over every control sample, not over the stored ones.",
        table(("name", "unit", "meaning"), ((name, q.unit, q.meaning) for name, q in metrics)),
        "## Certificate: what `umbilical certify` says",
        "Weights are over `gamma`, which is 1, so V is an energy; see [certificates.md](certificates.md).",
        table(head, (described(f"`{name}`", q) for name, q in CERTIFICATE.items())),
    )


def described(name: str, q: Quantity) -> tuple[str, ...]:
    """One row of a table of words."""
    return (f"${q.symbol}$" if q.symbol else "", name, q.unit, q.meaning, q.source, q.clash)


def dimensions() -> str:
    """Which channels have a second dimension."""
    of = {second: [n for n, d in SECOND_DIMENSION.items() if d == second] for second in SECOND_DIMENSION.values()}
    return "; ".join(f"over `{second}` too: {', '.join(map(code, names))}" for second, names in of.items()) + "."

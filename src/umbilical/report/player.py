"""One HTML file that plays a run: shape of the cable, signals, faults. No network, no library.

The page computes nothing: what it shows was computed here.

Displacements travel as 16-bit integers, everything else as 32-bit floats, both in base64. A rope is seen along y and
along x, a string in its one plane.
"""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Sequence
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.analysis.comparison import distinct_names
from umbilical.errors import expect
from umbilical.relations.tension import hanging_of, net_gravity, tension

if TYPE_CHECKING:
    from umbilical.run import Run

RATE = 20.0
"""Frames per second of simulated time, at most."""
NODES = 65
"""Places along the cable that are drawn."""
BUDGET = 5_000_000
"""Bytes of the data in a file; longer runs have fewer frames, and the page says so."""
SLACK = 1.0
"""N; a rope is drawn slack where less pulls."""
_MOST_EVENTS = 400
_ENDS = {"at the vessel": "top", "at the ROV": "end"}
_PLACE = "ROV position [m]"
_PANELS = (
    ("ROV displacement [m]", {"": "tip_displacement"}),
    ("thrust [N]", {"commanded": "thrust_command", "delivered": "thrust"}),
)


def player(run: Run, compare: Run | None = None, *, names: Sequence[str] = ()) -> str:
    """Make a page that plays a run, or two side by side on one clock.

    Args:
        run: a run of two stored samples or more.
        compare: another one, drawn into the same views.
        names: what each is called; the names of the runs, numbered where equal, if left out.

    Returns:
        A whole HTML page: at most :data:`BUDGET` bytes, with no address of anything outside it.

    Raises:
        ValueError: a run has fewer than two stored samples.

    >>> import umbilical
    >>> page = player(umbilical.simulate(umbilical.load("crosscheck-none", {"duration": 2.0})))
    >>> page.count("http"), len(page) < 100_000
    (1, True)
    """
    runs = [run] if compare is None else [run, compare]
    if short := [r.name for r in runs if r["time"].size < 2]:
        raise ValueError(f"{', '.join(short)}: the run ended before there was anything to play")
    rate = min(RATE, _affordable_rate(runs))
    called = names or distinct_names(runs)
    reels = _one_place([_reel(r, name, rate) for r, name in zip(runs, called, strict=True)])
    film = {
        "views": 1 + any(map(_in_space, runs)),
        "runs": reels,
        "panels": list(dict.fromkeys(panel["title"] for reel in reels for panel in reel["panels"])),
        "events": [event for r in runs for event in _events(r)],
        "thinned": f"The run is long: thinned to {rate:.2g} frames a second." if rate < RATE else "",
    }
    template = (resources.files("umbilical.report") / "player.html").read_text(encoding="utf-8")
    # Inside a script element only "<" can end it.
    return template.replace("/*DATA*/", json.dumps(film, allow_nan=False).replace("<", "\\u003c"))


class Show:
    """A run that plays where it is shown: in a notebook in place, elsewhere as a line of text."""

    def __init__(self, page: str, words: str) -> None:
        self.page, self._words = page, words

    def __repr__(self) -> str:
        return f"<{self._words}: {len(self.page) / 1e3:.0f} kB; shows itself in a notebook>"

    def _repr_html_(self) -> str:
        style = "width: 100%; height: 780px; border: 0"
        return f'<iframe sandbox="allow-scripts" style="{style}" srcdoc="{html.escape(self.page)}"></iframe>'


def show(run: Run, compare: Run | None = None) -> Show:
    """Play a run, or two on one clock, in a notebook.

    Args:
        run, compare: as for :func:`player`; what cannot be played is refused alike.

    Returns:
        An object whose HTML is the page of :func:`player`, in a frame that reaches nothing outside itself; ``page``
        is the page.

    >>> import umbilical
    >>> umbilical.show(umbilical.simulate(umbilical.load("crosscheck-none", {"duration": 1.0})))  # doctest: +ELLIPSIS
    <plays crosscheck-none: ... kB; shows itself in a notebook>
    """
    expect(run, "Run", "open_run")
    names = distinct_names([r for r in (run, compare) if r is not None])
    return Show(player(run, compare), f"plays {' and '.join(names)}")


def _affordable_rate(runs: Sequence[Run]) -> float:
    """Frames per second that keep the file below its budget."""
    lines = sum(len(lines) for r in runs for _, lines in _lines(r))
    shapes = sum(2 * NODES * (4 if _in_space(r) else 1) + 16 for r in runs)
    each = 4.0 / 3.0 * (shapes + 4 * lines)
    return 0.9 * BUDGET / each / max(float(r["time"].values[-1]) for r in runs)


def _reel(run: Run, name: str, rate: float) -> dict[str, Any]:
    """What the page needs of one run."""
    kept = _frames(run["time"].values, rate)
    shape = _rope(run, kept) if _in_space(run) else _string(run, kept)
    return shape | {
        "name": name,
        "status": f"{name}: {run.status.name} at t = {run.end_time:g} s",
        "time": _packed(run["time"].values[kept]),
        "panels": [
            {"title": title, "lines": [{"name": name, "values": _packed(v[kept])} for name, v in lines.items()]}
            for title, lines in _lines(run)
        ],
    }


def _one_place(reels: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Where a string meets a rope, both places of the ROV share a panel."""
    places = {reel["panels"][0]["title"] for reel in reels}
    for reel in reels:
        reel["panels"][0]["title"] = _PLACE if _PLACE in places else reel["panels"][0]["title"]
    return reels


def _in_space(run: Run) -> bool:
    return "position" in run.data


def _string(run: Run, kept: np.ndarray) -> dict[str, Any]:
    """The shape of a string: sideways only, its depth follows from the length."""
    nodes = np.unique(np.linspace(0.0, 1.0, NODES))
    shape = _along(run, nodes, run["displacement"].values[kept])
    widest = float(np.abs(shape).max()) or 1.0
    top, end = _tensions(run, kept)
    length = run["length"].values[kept]
    return {
        "nodes": int(nodes.size),
        "step": widest / 32767.0,
        "widest": widest,
        "deepest": float(length.max()),
        "y": _integers(shape, widest),
        "length": _packed(length),
        "top": _packed(top),
        "end": _packed(end),
        "low": float(min(top.min(), end.min())),
        "high": float(max(top.max(), end.max())),
    }


def _rope(run: Run, kept: np.ndarray) -> dict[str, Any]:
    """The shape of a rope in space, seen along y and along x, and the tension at every node."""
    nodes = np.unique(np.linspace(0.0, 1.0, NODES))
    x, y, z = (_along(run, nodes, run["position"].values[kept, axis]) for axis in range(3))
    pull = _along(run, nodes, run["tension"].values[kept])
    widest = float(max(np.abs(x).max(), np.abs(y).max())) or 1.0
    deepest, high = float(np.abs(z).max()) or 1.0, float(pull.max()) or 1.0
    return {
        "nodes": int(nodes.size),
        "step": widest / 32767.0,
        "widest": widest,
        "deepest": deepest,
        "depth_step": deepest / 32767.0,
        "pull_step": high / 32767.0,
        "y": _integers(x, widest),
        "across": _integers(y, widest),
        "z": _integers(z, deepest),
        "pull": _integers(np.maximum(pull, 0.0), high),
        "low": 0.0 if float(pull.min()) < SLACK else float(pull.min()),
        "high": high,
        "slack": SLACK,
    }


def _along(run: Run, nodes: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Values along the cable at these nodes, shape (frames, nodes)."""
    return np.array([np.interp(nodes, run["sigma"].values, row) for row in rows])


def _frames(time: np.ndarray, rate: float) -> np.ndarray:
    """Stored samples to show: the first at or after each tick, and the last."""
    ticks = np.arange(time[0], time[-1], 1.0 / rate)
    return np.unique(np.append(np.searchsorted(time, ticks - 1e-9), time.size - 1))


def _tensions(run: Run, kept: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tension at the vessel and at the ROV, N; it is linear between them."""
    scenario = run.scenario
    if "top_tension" in run.data:
        return run["top_tension"].values[kept], run["end_tension"].values[kept]
    hung = hanging_of(scenario.cable, scenario.payload, scenario.environment)
    net = net_gravity(scenario.environment.gravity, run["payout_acceleration"].values[kept])
    return tension(run["length"].values[kept], net, hung), tension(np.zeros(kept.size), net, hung)


def _lines(run: Run) -> list[tuple[str, dict[str, np.ndarray]]]:
    """Panels of signals over time; of a rope its tension too; voltages where there are motors."""
    found = [(title, {name: run[channel].values for name, channel in lines.items()}) for title, lines in _PANELS]
    if _in_space(run):
        x, y, _ = np.moveaxis(run["body_position"].values, 1, 0)
        found[0] = (_PLACE, {"x": x, "y": y})
        found.insert(1, ("tension [N]", {name: run[f"{key}_tension"].values for name, key in _ENDS.items()}))
    if "motor_voltage" in run.data and run["motor_voltage"].sizes.get("motor", 0):
        motors = run["motor_voltage"]
        voltages = {f"motor {m}": motors.sel(motor=m).values for m in motors["motor"].values.tolist()[:4]}
        found.append(("motor voltage [V]", voltages))
    return found


def _events(run: Run) -> list[dict[str, Any]]:
    """Where faults begin and end, and where a rope goes slack and snaps taut in the stored samples."""
    last, found = float(run["time"].values[-1]), []
    for fault in run.scenario.faults:
        found.append({"time": fault.start, "text": f"motor {fault.motor}: {fault.kind}"})
        if fault.end is not None:
            found.append({"time": fault.end, "text": f"motor {fault.motor}: healthy"})
    if "slack_length" in run.data:
        found += _slack_events(run)
    return sorted((event for event in found if event["time"] <= last), key=lambda event: event["time"])


def _slack_events(run: Run) -> list[dict[str, Any]]:
    time, slack = run["time"].values, run["slack_length"].values > 0.0
    changes = np.flatnonzero(np.diff(slack.astype(int), prepend=0))
    words = {True: "the cable goes slack", False: "the cable is taut again: snap"}
    found = ((float(time[k]), bool(slack[k])) for k in changes[:_MOST_EVENTS])
    return [{"time": t, "text": words[begins], "quiet": begins} for t, begins in found]


def _integers(values: np.ndarray, largest: float) -> str:
    return _packed(np.round(values / largest * 32767.0), "<i2")


def _packed(values: np.ndarray, kind: str = "<f4") -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")

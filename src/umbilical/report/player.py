"""One HTML file that plays a run: shape of the cable, signals, faults. No network, no library.

The page computes nothing: what it shows was computed here.

Displacements travel as 16-bit integers, everything else as 32-bit floats, both in base64.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.relations.tension import hanging_of, net_gravity, tension

if TYPE_CHECKING:
    from umbilical.run import Run

RATE = 20.0
"""Frames per second of simulated time, at most."""
NODES = 65
"""Places along the cable that are drawn."""
BUDGET = 5_000_000
"""Bytes of the data in a file; longer runs have fewer frames, and the page says so."""
_PANELS = (
    ("ROV displacement [m]", {"": "tip_displacement"}),
    ("thrust [N]", {"commanded": "thrust_command", "delivered": "thrust"}),
)


def player(run: Run, compare: Run | None = None) -> str:
    """Make a page that plays a run, or two side by side on one clock.

    Args:
        run: a run of two stored samples or more.
        compare: another one, drawn into the same views.

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
    if short := [r.scenario.name for r in runs if r["time"].size < 2]:
        raise ValueError(f"{', '.join(short)}: the run ended before there was anything to play")
    rate = min(RATE, _affordable_rate(runs))
    film = {
        "runs": [_reel(r, rate) for r in runs],
        "events": [event for r in runs for event in _events(r)],
        "thinned": f"The run is long: thinned to {rate:.2g} frames a second." if rate < RATE else "",
    }
    template = (resources.files("umbilical.report") / "player.html").read_text(encoding="utf-8")
    # Inside a script element only "<" can end it.
    return template.replace("/*DATA*/", json.dumps(film, allow_nan=False).replace("<", "\\u003c"))


def _affordable_rate(runs: Sequence[Run]) -> float:
    """Frames per second that keep the file below its budget."""
    lines = sum(len(lines) for r in runs for _, lines in _lines(r))
    each = 4.0 / 3.0 * (len(runs) * (2 * NODES + 16) + 4 * lines)
    return 0.9 * BUDGET / each / max(float(r["time"].values[-1]) for r in runs)


def _reel(run: Run, rate: float) -> dict[str, Any]:
    """What the page needs of one run."""
    kept = _frames(run["time"].values, rate)
    nodes = np.unique(np.linspace(0.0, 1.0, NODES))
    place, y = run["sigma"].values, run["displacement"].values[kept]
    shape = np.array([np.interp(nodes, place, row) for row in y])
    widest = float(np.abs(shape).max()) or 1.0
    top, end = _tensions(run, kept)
    return {
        "name": run.scenario.name,
        "status": f"{run.scenario.name}: {run.status.name} at t = {run.end_time:g} s",
        "nodes": int(nodes.size),
        "step": widest / 32767.0,
        "widest": widest,
        "y": _packed(np.round(shape / widest * 32767.0), "<i2"),
        "time": _packed(run["time"].values[kept]),
        "length": _packed(run["length"].values[kept]),
        "top": _packed(top),
        "end": _packed(end),
        "low": float(min(top.min(), end.min())),
        "high": float(max(top.max(), end.max())),
        "panels": [
            {"title": title, "lines": [{"name": name, "values": _packed(v[kept])} for name, v in lines.items()]}
            for title, lines in _lines(run)
        ],
    }


def _frames(time: np.ndarray, rate: float) -> np.ndarray:
    """Stored samples to show: the first at or after each tick, and the last."""
    ticks = np.arange(time[0], time[-1], 1.0 / rate)
    return np.unique(np.append(np.searchsorted(time, ticks - 1e-9), time.size - 1))


def _tensions(run: Run, kept: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tension at the vessel and at the ROV, N; it is linear between them."""
    scenario = run.scenario
    hung = hanging_of(scenario.cable, scenario.payload, scenario.environment)
    net = net_gravity(scenario.environment.gravity, run["payout_acceleration"].values[kept])
    return tension(run["length"].values[kept], net, hung), tension(np.zeros(kept.size), net, hung)


def _lines(run: Run) -> list[tuple[str, dict[str, np.ndarray]]]:
    """Panels of signals over time; voltages where there are motors."""
    found = [(title, {name: run[channel].values for name, channel in lines.items()}) for title, lines in _PANELS]
    if "motor_voltage" in run.data and run["motor_voltage"].sizes.get("motor", 0):
        motors = run["motor_voltage"]
        voltages = {f"motor {m}": motors.sel(motor=m).values for m in motors["motor"].values.tolist()[:4]}
        found.append(("motor voltage [V]", voltages))
    return found


def _events(run: Run) -> list[dict[str, Any]]:
    """Where faults begin and end."""
    last, found = float(run["time"].values[-1]), []
    for fault in run.scenario.faults:
        found.append({"time": fault.start, "text": f"motor {fault.motor}: {fault.kind}"})
        if fault.end is not None:
            found.append({"time": fault.end, "text": f"motor {fault.motor}: healthy"})
    return sorted((event for event in found if event["time"] <= last), key=lambda event: event["time"])


def _packed(values: np.ndarray, kind: str = "<f4") -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")

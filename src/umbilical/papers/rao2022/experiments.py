"""The runs behind figures and claims: a preset each, and what of it is changed.

Names of the two arms are the paper's: *without* fault control (thrust factors known) and *with* it (adaptive).
Whatever is not the paper's setting says so in ``what`` and in ``changes``; nothing is changed silently.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from umbilical import Run, Scenario, load

FAULTS = ("dead", "stuck", "partial")
CASES = ("none", *FAULTS)
ARMS = ("without", "with")
OBSERVERS = ("on", "off")
GRIDS = (8, 16, 64)
"""Numbers of elements on which a runaway must be the same; the last is that of the presets."""
PLACES = ("l/4", "l/2", "3l/4", "l")

OBSERVER = "control.disturbance_observer.enabled"
RATES = "control.allocation.rates"
START = "control.allocation.initial"
BELIEVED = "control.nominal.thrust_coefficients"
BOX = {"control.allocation.lower": (0.0, -1000.0, -1000.0), "control.allocation.upper": (1.5, 1000.0, 1000.0)}
"""Projection: kappa_0 from 0 to three times its exact value, the offsets to a thousand rad2/s2."""
BLIND = {OBSERVER: False}
FAR = 700.0
"""rad2/s2, a motor stuck at seven times the value of the presets."""
FAST = {RATES: [1.0, 1000.0, 1000.0]}
"""Ten times the adaptation rates of the presets."""


@dataclass(frozen=True)
class Experiment:
    """One run.

    Attributes:
        name: short name, by which figures and claims ask for its run.
        preset: the scenario it starts from.
        what: what it is, in words.
        changes: what differs from the preset, by dotted key; empty for the paper's own experiments.
    """

    name: str
    preset: str
    what: str
    changes: Mapping[str, Any] = field(default_factory=dict)

    def scenario(self) -> Scenario:
        """What is simulated, stored finely enough for the figures."""
        return load(self.preset, {"output.interval": 0.02, **self.changes})


def preset(case: str, arm: str) -> str:
    """Name of the preset of a fault case and an arm.

    >>> preset("none", "without"), preset("dead", "with")
    ('paper', 'paper-dead-adaptive')
    """
    return "-".join(["paper", *([] if case == "none" else [case]), *(["adaptive"] if arm != "without" else [])])


def cell(case: str, arm: str) -> str:
    """Name of the experiment of a fault case and an arm.

    >>> cell("dead", "with")
    'dead, with'
    """
    return f"{case}, {arm}"


def _of_the_paper() -> Iterable[Experiment]:
    yield Experiment("free", "paper-none", "no control")
    yield Experiment("pd", "paper-pd", "PD, with the velocity sensor the paper grants it")
    words = {"none": "no fault", "dead": "a motor dies", "stuck": "a motor sticks", "partial": "a motor loses half"}
    for case in CASES:
        for arm in ARMS:
            yield Experiment(cell(case, arm), preset(case, arm), f"proposed law, {words[case]}, {arm} fault control")


def _beyond_the_paper() -> Iterable[Experiment]:
    long = {"duration": 400.0, "output.interval": 0.5}
    haul = {"winch.start_length": 500.0, "winch.end_length": 450.0}
    yield Experiment("free, long", "paper-none", "no control, eight times as long", long)
    endless = {"duration": 4000.0, "output.interval": 2.0, "grid.elements": GRIDS[0]}
    yield Experiment("none, with, endless", "paper-adaptive", "no fault, with fault control, 80 times as long", endless)
    yield Experiment("free, hauling in", "paper-none", "no control, hauling in", haul)
    yield Experiment("pd, hauling in", "paper-pd", "PD, hauling in", haul)
    yield Experiment("proposed, hauling in", "paper", "proposed law, hauling in", haul)
    sines = load("paper").to_dict()["environment"]["payload_force"][1:]
    smooth = {"environment.payload_force": sines}
    yield Experiment("proposed, no jump", "paper", "proposed law, the load's steady part left out", smooth)
    sampled = smooth | {"duration": 10.0, "output.interval": 0.001, "grid.elements": 32}
    yield Experiment("proposed, no jump, sampled", "paper", "the same, every sample of the sensors stored", sampled)
    lasting = {"duration": 1000.0, "output.interval": 0.5, "grid.elements": GRIDS[0]}
    yield Experiment(
        "dead, with, lasting", "paper-dead-adaptive", "dead, with fault control, 20 times as long", lasting
    )
    yield Experiment("ringdown", "ringdown", "vibration already in the cable, no loads")
    for arm in ARMS:
        yield Experiment(f"blind, none, {arm}", preset("none", arm), f"no fault, {arm}; no disturbance observer", BLIND)
        yield Experiment(f"blind, dead, {arm}", preset("dead", arm), f"dead, {arm}; no disturbance observer", BLIND)
    quarter = {BELIEVED: [4.8, 3.2]}
    yield Experiment(
        "blind, dead, misjudged",
        preset("dead", "without"),
        "dead, without; no disturbance observer, thrust factors believed four times too large",
        BLIND | quarter,
    )
    fast = BLIND | FAST
    yield Experiment("blind, dead, fast", preset("dead", "with"), "dead, with, ten times faster; no observer", fast)
    yield Experiment("blind, dead, boxed", preset("dead", "with"), "the same with kappa in a box", fast | BOX)
    for elements in GRIDS[:-1]:
        grid = fast | {"grid.elements": elements}
        yield Experiment(f"blind, dead, fast, {elements}", preset("dead", "with"), "the same on another grid", grid)
    blind = BLIND | long
    yield Experiment("blind, none, with, long", preset("none", "with"), "no fault, with; no observer, long", blind)
    yield Experiment("blind, none, boxed, long", preset("none", "with"), "the same with kappa in a box", blind | BOX)
    for arm in ARMS:
        far = BLIND | {"faults.1.value": FAR}
        yield Experiment(f"blind, stuck, {arm}", preset("stuck", arm), f"stuck far, {arm}; no observer", far)


EXPERIMENTS: dict[str, Experiment] = {e.name: e for e in (*_of_the_paper(), *_beyond_the_paper())}
"""Every experiment by name."""

Runs = Mapping[str, Run]
"""Runs by the names of their experiments."""

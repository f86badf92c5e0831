"""The runs behind figures and claims, by name; experiments.toml has them.

Names of the two arms are the paper's: *without* fault control (thrust factors known) and *with* it (adaptive).
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import resources
from typing import Any

from umbilical import Run, Scenario, load

FAULTS = ("dead", "stuck", "partial")
CASES = ("none", *FAULTS)
ARMS = ("without", "with")
OBSERVERS = ("on", "off")
GRIDS = (8, 16, 64)
"""Numbers of elements on which a runaway must be the same; the last is that of the presets."""

OBSERVER = "control.disturbance_observer.enabled"
RATES = "control.allocation.rates"
START = "control.allocation.initial"
BELIEVED = "control.nominal.thrust_coefficients"


def read_data(name: str) -> dict[str, Any]:
    """What a TOML file beside this one holds."""
    return tomllib.loads((resources.files("umbilical.papers.rao2022") / name).read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Experiment:
    """One run.

    Attributes:
        preset: the scenario it starts from.
        what: what it is, in words.
        changes: what differs from the preset, by dotted key; empty for the paper's own experiments.
    """

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


EXPERIMENTS = {name: Experiment(**entry) for name, entry in read_data("experiments.toml").items()}
"""Every experiment by name."""
LOWER, UPPER = "control.allocation.lower", "control.allocation.upper"
BOX = {key: EXPERIMENTS["blind, dead, boxed"].changes[key] for key in (LOWER, UPPER)}
"""Projection: kappa_0 from 0 to three times its exact value, the offsets to a thousand rad2/s2."""
FAR = EXPERIMENTS["blind, stuck, with"].changes["faults.1.value"]
"""rad2/s2, a motor stuck at seven times the value of the presets."""

Runs = Mapping[str, Run]
"""Runs by the names of their experiments."""

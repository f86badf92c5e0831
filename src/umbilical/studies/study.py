"""A study: one scenario, what varies in it, and the arms that are compared on the same draws."""

from __future__ import annotations

from collections.abc import Mapping
from math import exp, log
from typing import Any, Literal

from pydantic import Field

from umbilical.scenario.base import Number, Record, fingerprint
from umbilical.scenario.scenario import Scenario
from umbilical.studies.distributions import Distribution

FaultKind = Literal["none", "partial", "dead", "stuck", "ramp", "intermittent"]
Method = Literal["random", "latin", "sobol", "grid", "saltelli", "morris"]


class Factor(Record):
    """A value of the scenario that is not known, or that is varied to see what it does."""

    key: str = Field(min_length=1, description="dotted key of the scenario, lists numbered from 1")
    relative: bool = Field(default=False, description="what is drawn multiplies the scenario's value")
    distribution: Distribution


class Campaign(Record):
    """Faults: for each member one is drawn, or none, and added to the scenario's own."""

    name: str = Field(default="fault", min_length=1, max_length=40, description="of its columns: name.kind, name.motor")
    kinds: tuple[FaultKind, ...] = Field(min_length=1, description="kinds to draw from; 'none' is a member without")
    motors: tuple[int, ...] = Field(min_length=1, description="motors to draw from, numbered from 1")
    target: Literal["thrust", "voltage"] = Field(default="thrust", description="what the fault spoils")
    start: Distribution = Field(description="instant it begins, s")
    effectiveness: Distribution | None = Field(default=None, description="share left: partial, ramp, intermittent")
    value: Distribution | None = Field(default=None, description="where a stuck motor is stuck, rad2/s2 or V")
    over: Distribution | None = Field(default=None, description="time a ramp takes, s")
    cycle: Distribution | None = Field(default=None, description="cycle of an intermittent fault, s")
    duty: Distribution | None = Field(default=None, description="share of the cycle it is present")


class Arm(Record):
    """One of the things compared: the scenario with some values changed. All arms see the same draws."""

    name: str = Field(min_length=1, max_length=60, description="its name in tables and pictures")
    changes: dict[str, Any] = Field(default_factory=dict, description="values by dotted key of the scenario")
    controller: str | None = Field(
        default=None, description="'module:function' that makes a Python controller from a scenario; run if trusted"
    )


class Trajectories(Record):
    """Which members are kept as complete runs, in a folder beside the result."""

    keep: Literal["none", "worst", "all"] = Field(default="none", description="which members")
    count: int = Field(default=5, ge=1, le=100_000, description="how many of the worst, in each arm")
    metric: str = Field(default="tip_peak", description="metric that says which are the worst")


class Gain(Record):
    """A number that tuning may choose."""

    key: str = Field(min_length=1, description="dotted key of the scenario")
    low: Number = Field(description="smallest value tried")
    high: Number = Field(description="largest value tried")
    scale: Literal["linear", "log"] = Field(default="linear", description="how values are spread between the bounds")

    def at(self, share: float) -> float:
        """The value at a share, 0 to 1, of the way from low to high."""
        if self.scale == "log":
            return exp(log(self.low) + share * (log(self.high) - log(self.low)))
        return self.low + share * (self.high - self.low)


class Objective(Record):
    """What is made small: a statistic, over all members, of a metric."""

    metric: str = Field(description="name of a metric")
    statistic: Literal["mean", "quantile", "worst"] = Field(default="quantile", description="over the members")
    share: float = Field(default=0.95, gt=0.0, lt=1.0, description="which quantile")


class Tuning(Record):
    """The search of ``umbilical tune``."""

    arm: str = Field(description="arm whose gains are tuned")
    trials: int = Field(default=60, ge=1, le=1_000_000, description="sets of gains tried")
    gains: tuple[Gain, ...] = Field(min_length=1, max_length=100)
    objectives: tuple[Objective, ...] = Field(min_length=1, max_length=2)
    constraints: tuple[str, ...] = Field(default=(), description="conditions on the arm's scenario, by name")


class Study(Record):
    """Everything the answer to a question about many runs depends on, frozen.

    >>> from umbilical.studies.load import load_study
    >>> load_study("paper-robustness").members
    1000
    """

    schema_version: Literal[1] = Field(default=1, description="version of this format")
    name: str = Field(min_length=1, max_length=60, description="short name, also of the folder of results")
    description: str = Field(default="", description="the question it answers")
    scenario: Scenario
    changes: dict[str, Any] = Field(default_factory=dict, description="values changed in every arm, by dotted key")
    design: Method = Field(default="latin", description="how the draws are spread")
    members: int = Field(default=100, ge=1, le=10_000_000, description="how many draws; a grid counts its own")
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="seed of every draw")
    factors: tuple[Factor, ...] = Field(default=(), max_length=1000)
    campaigns: tuple[Campaign, ...] = Field(default=(), max_length=100)
    arms: tuple[Arm, ...] = Field(default=(Arm(name="as it is"),), min_length=1, max_length=100)
    limits: dict[str, Number] = Field(default_factory=dict, description="metric: value it should stay below")
    trajectories: Trajectories = Trajectories()
    tuning: Tuning | None = None
    assumed: dict[str, str] = Field(default_factory=dict, description="what no source gives, each with the reason")

    @property
    def hash(self) -> str:
        """SHA-256 of the canonical text; equal exactly when studies are."""
        return fingerprint(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """Plain data, the scenario included."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Complete TOML text, the scenario included; reading it back gives an equal study."""
        import tomlkit

        return tomlkit.dumps(self.to_dict())

    def replace(self, changes: Mapping[str, Any]) -> Study:
        """The same study with some values changed, by dotted keys; ``scenario.`` leads into its scenario.

        Raises:
            ScenarioError: with every problem.
        """
        from umbilical.studies.load import override_study

        return override_study(self.to_dict(), changes, self.name)

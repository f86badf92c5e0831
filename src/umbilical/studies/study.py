"""A study: one scenario, what varies in it, and the arms that are compared on the same draws."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

import tomlkit
from pydantic import Field, ValidationError

from umbilical.errors import Problem, ScenarioError
from umbilical.scenario.base import Number, Record, fingerprint
from umbilical.scenario.document import Data, freeze, look_up, override, try_override
from umbilical.scenario.problems import problems_of
from umbilical.scenario.scenario import Scenario, validate
from umbilical.studies.checks import problems_across
from umbilical.studies.distributions import Choice, Distribution, Drawn, DrawnVariable, between

FaultKind = Literal["none", "partial", "dead", "stuck", "ramp", "intermittent"]
Method = Literal["random", "latin", "sobol", "grid", "saltelli", "morris"]
_NEEDED: dict[str, tuple[str, ...]] = {
    "none": (),
    "partial": ("effectiveness",),
    "dead": (),
    "stuck": ("value",),
    "ramp": ("effectiveness", "over"),
    "intermittent": ("effectiveness", "cycle", "duty"),
}
"""What each kind of fault is made of, beside its start."""


class Factor(Record):
    """A value of the scenario that is not known, or that is varied to see what it does."""

    key: str = Field(min_length=1, description="dotted key of the scenario, lists numbered from 1")
    relative: bool = Field(default=False, description="what is drawn multiplies the scenario's value")
    distribution: Distribution

    def given(self, base: Mapping[str, Any], value: Any) -> Any:
        """What a scenario gets for a drawn value: a relative one multiplies, and a whole number stays one.

        Args:
            base: plain data of the scenario.
            value: what was drawn.
        """
        try:
            stated = look_up(base, self.key)
        except KeyError:
            return value
        drawn = value * stated if self.relative else value
        return int(drawn) if type(stated) is int and isinstance(drawn, float) and drawn.is_integer() else drawn


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

    @property
    def variables(self) -> tuple[DrawnVariable, ...]:
        """What is drawn of a fault."""
        units = {"start": "s", "effectiveness": "1", "value": "V" if self.target == "voltage" else "rad2/s2"}
        units |= {"over": "s", "cycle": "s", "duty": "1"}
        parts = [("kind", Choice(kind="choice", values=self.kinds), "")]
        parts += [("motor", Choice(kind="choice", values=self.motors), "")]
        parts += [(part, getattr(self, part), unit) for part, unit in units.items()]
        return tuple(
            DrawnVariable(f"{self.name}.{part}", drawn, unit, f"{part} of the {self.name}")
            for part, drawn, unit in parts
            if drawn is not None
        )

    @property
    def lacking(self) -> list[tuple[str, str]]:
        """Kinds of fault and parts of them, of those that are needed and not given."""
        return [(kind, part) for kind in self.kinds for part in _NEEDED[kind] if getattr(self, part) is None]

    def fault(self, values: Mapping[str, Drawn]) -> dict[str, Any] | None:
        """The fault a member has, as plain data, if it has one."""
        kind = str(values[f"{self.name}.kind"])
        if kind == "none":
            return None
        parts = ("kind", "motor", "start", *_NEEDED[kind])
        return {"target": self.target, **{part: values[f"{self.name}.{part}"] for part in parts}}


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
        return between(self.low, self.high, share, logarithmic=self.scale == "log")


class Objective(Record):
    """What is made small: a statistic, over all members, of a metric."""

    metric: str = Field(description="name of a metric")
    statistic: Literal["mean", "quantile", "worst"] = Field(default="quantile", description="over the members")
    share: float = Field(default=0.95, gt=0.0, lt=1.0, description="which quantile")

    def __str__(self) -> str:
        return (
            f"{f'{100 * self.share:g} % quantile' if self.statistic == 'quantile' else self.statistic} of {self.metric}"
        )


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

    @property
    def variables(self) -> tuple[DrawnVariable, ...]:
        """Everything that is drawn, in the order of the design's columns."""
        factors = (DrawnVariable(factor.key, factor.distribution) for factor in self.factors)
        return (*factors, *(variable for campaign in self.campaigns for variable in campaign.variables))

    @property
    def gains(self) -> tuple[Gain, ...]:
        """What tuning may choose."""
        return self.tuning.gains if self.tuning else ()

    def scenario_data(self, changes: Mapping[str, Any]) -> Data:
        """Plain data of the scenario with the study's changes and these."""
        return override(override(self.scenario.to_dict(), self.changes, self.name), changes, self.name)

    def scenario_with(self, changes: Mapping[str, Any]) -> Scenario:
        """The scenario with the study's changes and these, checked field by field.

        Raises:
            ScenarioError: with every problem.
        """
        return validate(self.scenario_data(changes), self.name)

    def to_dict(self) -> dict[str, Any]:
        """Plain data, the scenario included."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Complete TOML text, the scenario included; reading it back gives an equal study."""
        return tomlkit.dumps(self.to_dict())

    def replace(self, changes: Mapping[str, Any]) -> Study:
        """The same study with some values changed, by dotted keys; ``scenario.`` leads into its scenario.

        Raises:
            ScenarioError: with every problem.
        """
        return override_study(self.to_dict(), changes, self.name)


def override_study(data: Mapping[str, Any], overrides: Mapping[str, Any], origin: str) -> Study:
    """Study of plain data with some values changed, by dotted keys.

    What is said of the scenario here is the last word on it: the study's own ``changes`` of the same keys go.

    Raises:
        ScenarioError: with every problem.
    """
    said = tuple(f"{key.removeprefix('scenario.')}." for key in overrides if key.startswith("scenario."))
    if said and isinstance(own := data.get("changes"), Mapping):
        data = {**data, "changes": {key: value for key, value in own.items() if not f"{key}.".startswith(said)}}
    changed, lost = try_override(data, overrides)
    return admit_study(changed, origin, lost)


def admit_study(data: Mapping[str, Any], origin: str, problems: list[Problem] | None = None) -> Study:
    """Study of plain data, after all checks.

    Raises:
        ScenarioError: with every problem.
    """
    found = list(problems or [])
    try:
        study = Study.model_validate(freeze(data))
    except ValidationError as error:
        raise ScenarioError([*found, *problems_of(error, Study), *_beside(data, error)], origin) from error
    if found := [*found, *problems_across(study)]:
        raise ScenarioError(found, origin)
    return study


def _beside(data: Mapping[str, Any], error: ValidationError) -> list[Problem]:
    """What is wrong across the fields that are sound one by one, so that all problems come at once."""
    places = [place for complaint in error.errors(include_url=False) if (place := complaint["loc"])]
    kept = {key: value for key, value in data.items() if key not in {str(place[0]) for place in places}}
    if "arms" not in kept:
        kept.pop("tuning", None)  # which speaks of them
    for key, stub in (("factors", []), ("arms", [{"name": "wrong"}])):  # an arm keeps its number, a factor has its key
        if wrong := {place[1] for place in places if len(place) > 1 and place[0] == key}:
            kept[key] = [part for k, own in enumerate(data[key]) for part in (stub if k in wrong else [own])]
    try:
        return problems_across(Study.model_validate(freeze(kept)))
    except ValidationError:  # without its scenario or its name nothing more can be said
        return []

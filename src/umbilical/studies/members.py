"""Members: one draw each of everything that varies, and the scenario it makes of every arm."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from umbilical.scenario import Scenario
from umbilical.scenario.document import look_up, override
from umbilical.scenario.scenario import validate
from umbilical.studies.designs import child_seed, design_size, points
from umbilical.studies.distributions import Choice, Distribution, Drawn, count, draw_value
from umbilical.studies.study import Campaign, Factor, Study

_NUMBERS_OF_A_FAULT = ("start", "effectiveness", "value", "over", "cycle", "duty")
_BELONGS_TO = {
    "partial": ("effectiveness",),
    "dead": (),
    "stuck": ("value",),
    "ramp": ("effectiveness", "over"),
    "intermittent": ("effectiveness", "cycle", "duty"),
}
"""What each kind of fault is made of, beside its start."""


class DrawnVariable(NamedTuple):
    """Something drawn: its column's name and its distribution."""

    name: str
    distribution: Distribution


class Member(NamedTuple):
    """One member: its number, from 1, and its point of the unit cube."""

    number: int
    point: tuple[float, ...]


def variables(study: Study) -> tuple[DrawnVariable, ...]:
    """Everything that is drawn, in the order of the design's columns."""
    factors = [DrawnVariable(factor.key, factor.distribution) for factor in study.factors]
    return (*factors, *(variable for campaign in study.campaigns for variable in _of_campaign(campaign)))


def _of_campaign(campaign: Campaign) -> Iterator[DrawnVariable]:
    yield DrawnVariable(f"{campaign.name}.kind", Choice(kind="choice", values=campaign.kinds))
    yield DrawnVariable(f"{campaign.name}.motor", Choice(kind="choice", values=campaign.motors))
    for name in _NUMBERS_OF_A_FAULT:
        if (distribution := getattr(campaign, name)) is not None:
            yield DrawnVariable(f"{campaign.name}.{name}", distribution)


def needed_of_a_fault(kind: str) -> tuple[str, ...]:
    """Distributions a campaign needs for a kind of fault."""
    return _BELONGS_TO.get(kind, ())


def units_of_a_fault(campaign: Campaign) -> dict[str, str]:
    """Unit of each part of a campaign's faults."""
    stuck = "V" if campaign.target == "voltage" else "rad2/s2"
    return {
        "kind": "",
        "motor": "",
        "start": "s",
        "effectiveness": "1",
        "value": stuck,
        "over": "s",
        "cycle": "s",
        "duty": "1",
    }


@dataclass(frozen=True)
class Draws:
    """All draws of a study; those that go to another process travel as their study, which is unpacked there once."""

    study: Study

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpacked, (self._packed,)

    @cached_property
    def _packed(self) -> bytes:
        return pickle.dumps(self.study)

    @cached_property
    def variables(self) -> tuple[DrawnVariable, ...]:
        """What is drawn."""
        return variables(self.study)

    @cached_property
    def points(self) -> np.ndarray:
        """Points of the unit cube, shape (members, variables)."""
        study = self.study
        return points(study.design, study.members, [count(v.distribution) for v in self.variables], study.seed)

    def __len__(self) -> int:
        return design_size(self.study.design, self.study.members, [count(v.distribution) for v in self.variables])

    def member(self, number: int) -> Member:
        """Member of a number, from 1."""
        return Member(number, tuple(self.points[number - 1].tolist()))

    def column(self, variable: int) -> list[Drawn]:
        """What was drawn of one variable, from 0, for every member."""
        distribution = self.variables[variable].distribution
        return [draw_value(distribution, share) for share in self.points[:, variable].tolist()]

    def values(self, member: Member) -> dict[str, Drawn]:
        """What was drawn for a member, by column; relative factors as they are drawn."""
        return {
            v.name: draw_value(v.distribution, share) for v, share in zip(self.variables, member.point, strict=True)
        }

    @cached_property
    def _arms(self) -> tuple[Mapping[str, Any], ...]:
        """Plain data of the scenario of each arm, before anything is drawn."""
        return tuple(arm_data(self.study, arm.changes) for arm in self.study.arms)

    @cached_property
    def _base(self) -> Mapping[str, Any]:
        """The scenario that relative factors multiply."""
        return arm_data(self.study, {})

    def scenario(self, member: Member, arm: int) -> Scenario:
        """The scenario of one member in one arm, from 0; checked field by field.

        Raises:
            ScenarioError: with every problem; such a member is a row of its own.
        """
        study = self.study
        name = f"{study.name}-{member.number}-{study.arms[arm].name}"[:80]
        changes = self.changes(self.values(member)) | {"name": name, "seed": child_seed(study.seed, member.number)}
        return validate(override(self._arms[arm], changes, name), name)

    def undrawn(self) -> Iterator[Scenario]:
        """The scenario of each arm before anything is drawn."""
        return (validate(data, self.study.name) for data in self._arms)

    def changes(self, values: Mapping[str, Drawn]) -> dict[str, Any]:
        """What a draw changes in the scenario, by dotted key."""
        changes: dict[str, Any] = {}
        for factor in self.study.factors:
            value: Any = values[factor.key]
            changes[factor.key] = given_by(self._base, factor, value)
        faults = [fault for campaign in self.study.campaigns if (fault := _fault(campaign, values))]
        return changes | ({"faults": [*self._base.get("faults", ()), *faults]} if faults else {})


@lru_cache(maxsize=4)
def _unpacked(packed: bytes) -> Draws:
    return Draws(pickle.loads(packed))


def given_by(base: Mapping[str, Any], factor: Factor, value: Any) -> Any:
    """What a scenario gets for a drawn value: relative ones multiply, and a whole number stays one."""
    try:
        stated = look_up(base, factor.key)
    except KeyError:
        return value
    drawn = value * stated if factor.relative else value
    return int(drawn) if type(stated) is int and isinstance(drawn, float) and drawn.is_integer() else drawn


def arm_data(study: Study, changes: Mapping[str, Any]) -> Mapping[str, Any]:
    """Plain data of the study's scenario with its changes and these."""
    return override(override(study.scenario.to_dict(), study.changes, study.name), changes, study.name)


def _fault(campaign: Campaign, values: Mapping[str, Drawn]) -> dict[str, Any] | None:
    """The fault a member has, if it has one."""
    kind = values[f"{campaign.name}.kind"]
    if kind == "none":
        return None
    numbers = {name: values[f"{campaign.name}.{name}"] for name in ("start", *needed_of_a_fault(str(kind)))}
    return {"kind": kind, "motor": values[f"{campaign.name}.motor"], "target": campaign.target, **numbers}

"""Members: one draw each of everything that varies, and the scenario it makes of every arm."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from umbilical.scenario.document import override
from umbilical.scenario.scenario import Scenario, validate
from umbilical.studies.designs import child_seed, design_size, points
from umbilical.studies.distributions import Drawn, DrawnVariable, count

if TYPE_CHECKING:
    from umbilical.studies.study import Study


class Member(NamedTuple):
    """One member: its number, from 1, and its point of the unit cube."""

    number: int
    point: tuple[float, ...]


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
        return self.study.variables

    @cached_property
    def _counts(self) -> list[int | None]:
        return [count(variable.distribution) for variable in self.variables]

    @cached_property
    def points(self) -> np.ndarray:
        """Points of the unit cube, shape (members, variables)."""
        return points(self.study.design, self.study.members, self._counts, self.study.seed)

    def __len__(self) -> int:
        return design_size(self.study.design, self.study.members, self._counts)

    def member(self, number: int) -> Member:
        """Member of a number, from 1."""
        return Member(number, tuple(self.points[number - 1].tolist()))

    def column(self, variable: int) -> list[Drawn]:
        """What was drawn of one variable, from 0, for every member."""
        return [self.variables[variable].distribution.at(share) for share in self.points[:, variable].tolist()]

    def values(self, member: Member) -> dict[str, Drawn]:
        """What was drawn for a member, by column; relative factors as they are drawn."""
        return {v.name: v.distribution.at(share) for v, share in zip(self.variables, member.point, strict=True)}

    @cached_property
    def _arms(self) -> tuple[Mapping[str, Any], ...]:
        """Plain data of the scenario of each arm, before anything is drawn."""
        return tuple(self.study.scenario_data(arm.changes) for arm in self.study.arms)

    @cached_property
    def _base(self) -> Mapping[str, Any]:
        """The scenario that relative factors multiply."""
        return self.study.scenario_data({})

    def scenario(self, member: Member, arm: int) -> Scenario:
        """The scenario of one member in one arm, from 0; checked field by field.

        Raises:
            ScenarioError: with every problem; such a member is a row of its own.
        """
        study = self.study
        name = f"{study.name}-{member.number}-{study.arms[arm].name}"[:80]
        changes = self._changes(self.values(member)) | {"name": name, "seed": child_seed(study.seed, member.number)}
        return validate(override(self._arms[arm], changes, name), name)

    def undrawn(self) -> Iterator[Scenario]:
        """The scenario of each arm before anything is drawn."""
        return (validate(data, self.study.name) for data in self._arms)

    def _changes(self, values: Mapping[str, Drawn]) -> dict[str, Any]:
        """What a draw changes in the scenario, by dotted key."""
        changes = {factor.key: factor.given(self._base, values[factor.key]) for factor in self.study.factors}
        faults = [fault for campaign in self.study.campaigns if (fault := campaign.fault(values))]
        return changes | ({"faults": [*self._base.get("faults", ()), *faults]} if faults else {})


@lru_cache(maxsize=4)
def _unpacked(packed: bytes) -> Draws:
    return Draws(pickle.loads(packed))

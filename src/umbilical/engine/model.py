"""The string behind what simulate and Episode ask of a model, and which model a scenario names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from umbilical.analysis.energy import energy, tension_at_ends
from umbilical.control import cascade
from umbilical.engine import loop
from umbilical.engine.base import Model
from umbilical.engine.ending import base_metrics
from umbilical.engine.recording import STEEPEST, channels, inside
from umbilical.engine.rope.model import SpatialModel
from umbilical.engine.sensing import Side
from umbilical.engine.setup import set_up
from umbilical.plant.exogenous import STRETCHING, Outside
from umbilical.plant.forces.table import IN_WATER, WORKS
from umbilical.plant.seaway import may_heave
from umbilical.scenario.findings import Notice
from umbilical.scenario.scenario import Scenario

GRID_TOOK, UNBALANCED = 0.1, 0.01
"""Shares of ``grid_loss`` and ``energy_balance_residual`` from which on a run tells them: the presets stay below 0.002
and 1e-4, on four elements below 0.02 and 1e-3; a vessel whose velocity jumps every second has 0.5 and 0.1."""


class StringModel(Model):
    """The string of the paper, in one plane."""

    _works = sorted(WORKS, key={force.work for force in IN_WATER}.__contains__)
    """Works of water last, so that where they are zero all sums round as in air."""

    def __init__(self, scenario: Scenario, *, stored: bool = True, held: bool = False) -> None:
        setup = set_up(scenario, stored=stored, held=held)
        self._scenario, self._elements, self._sampler = scenario, scenario.grid.elements, Outside(scenario)
        self.clock, self._record, self._dice, self._memories = setup.clock, setup.record, (setup.dice,), (setup.memory,)
        self._world, self.state, self._sides = setup.world, setup.world.state, (Side(*setup.world[2:]),)
        self._built_in, self._settings = setup.settings, cascade.with_known_factors(setup.settings)

    def run(self, inputs: Any, first: np.ndarray, noise: Any, begin: int) -> int:
        run = loop.run_steps if self._world.plant.forces.wet else loop.run_dry_steps
        return run(self._world, self._built_in, *self._memories, self._record, inputs, first, *noise, begin)

    def observe(self, inputs: Any, first: np.ndarray, noise: Any, j: int) -> None:
        loop.observe(self._world, inputs, first, *noise, j)

    def hold(
        self, inputs: Any, first: np.ndarray, noise: Any, begin: int, periods: tuple[int, int], driven: bool,
        decided: bool,
    ) -> int:  # fmt: skip
        controller = self._settings, *self._memories
        return loop.run_held(
            self._world, *controller, self._record, inputs, first, *noise, begin, periods, driven, decided
        )

    def _cause(self) -> str:
        steepest = float(self._record.tally.slopes.max())
        words = f"the cable's slope reached {steepest:.3g}: beyond 1 the model of small angles has ended"
        return words if steepest > STEEPEST else ""

    def _measures(self) -> dict[str, float]:
        tally = self._record.tally
        return base_metrics(tally, self.state.now[0].ends.tip_displacement, slope_peak=tally.slopes.max())

    def _channels(self, samples: int) -> dict[str, np.ndarray]:
        return channels(self._record.log, samples, bool(self._scenario.motors), self._world.plant.forces.wet)

    def _energy(self, samples: int, named: dict[str, np.ndarray]) -> np.ndarray:
        """Where the sheave may heave also the tension at the ends, into ``named``."""
        scenario, log, length = self._scenario, self._record.log, named["length"]
        outside = {name: log.outside[name][:samples] for name in ("net_gravity", "sink_speed", *STRETCHING[:2])}
        if may_heave(scenario.environment):
            named["top_tension"], named["end_tension"] = tension_at_ends(scenario, length=length, **outside)
        return energy(scenario, *inside(log, samples), tip_velocity=named["tip_velocity"], length=length, **outside)

    def _of_the_balance(self, metrics: Mapping[str, float]) -> Iterator[Notice]:
        """Waves that were too short for the grid."""
        lost, residual = metrics["grid_loss"], metrics["energy_balance_residual"]
        if lost > GRID_TOOK or residual > UNBALANCED:
            words = f"the grid took {100.0 * lost:.2g} % of the energy and work, and their balance closes to "
            words += f"{100.0 * residual:.2g} %: waves or jumps too sharp for it; compare with a finer grid and "
            yield Notice("grid.elements", words + "smoother inputs")


def make_model(scenario: Scenario, *, stored: bool = True, held: bool = False) -> Model:
    """The model a scenario names, ready for its first step; ``held``: commands will come from outside."""
    if scenario.model == "rope":
        return SpatialModel(scenario, stored=stored)
    return StringModel(scenario, stored=stored, held=held)

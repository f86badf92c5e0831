"""The true state of a running episode: what no sensor gives, for teachers, rewards and pictures."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.engine.episode import Episode
from umbilical.engine.model import StringModel
from umbilical.errors import Problem, ScenarioError
from umbilical.plant.cable import PRESENT
from umbilical.plant.layout import integrate


class Truth(NamedTuple):
    """The present instant of an episode.

    Attributes:
        tip_displacement: y(l,t), m.
        tip_velocity: Dy/Dt(l,t), m/s.
        tip_slope: y_x(l,t).
        payload_force: external force on the ROV, N.
        displacement: y at equal distances from the vessel to the ROV, m, shape (4 elements + 1,).
    """

    tip_displacement: float
    tip_velocity: float
    tip_slope: float
    payload_force: float
    displacement: np.ndarray


def truth(episode: Episode) -> Truth:
    """Read the true state of an episode, where it stands.

    Raises:
        ScenarioError: the model is another than the string.

    >>> import umbilical
    >>> episode = umbilical.Episode(umbilical.load("crosscheck-pd", {"duration": 1.0}), period=0.1)
    >>> measurement = episode.step(umbilical.Command(thrust=50.0))
    >>> truth(episode).tip_displacement == measurement.tip_displacement
    True
    """
    if not isinstance(episode.model, StringModel):
        reason, fix = "the state of a rope is in space", 'set model = "string"'
        raise ScenarioError([Problem("model", episode.scenario.model, "string", reason, fix)], "truth")
    state = episode.model.state
    ends, outside = state.now[0].ends, state.now[0].outside
    slopes = state.blocks[PRESENT]
    displacement = outside.vessel_displacement + integrate(slopes[:, : slopes.shape[1] // 2])
    displacement[-1] = ends.tip_displacement
    tip = float(ends.tip_displacement), float(ends.tip_velocity), float(ends.tip_slope)
    return Truth(*tip, float(outside.payload_force), displacement)

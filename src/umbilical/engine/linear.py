"""The engine's own step as a matrix: what frequencies, margins and spectra are read from.

The step of cable and ROV is linear, so applying it to unit vectors gives its Jacobian to round-off: no
second discretisation that could differ from the one that runs.
"""

from __future__ import annotations

import numpy as np

from umbilical.engine.loop import World, advance_period
from umbilical.engine.simulate import set_up
from umbilical.engine.stepping import enter_step
from umbilical.plant import winch
from umbilical.plant.cable import ACCELERATION, DISPLACEMENT, VELOCITY
from umbilical.plant.exogenous import Inputs, Outside, Steps
from umbilical.plant.layout import to_field, to_nodal
from umbilical.scenario.scenario import Scenario

_FIELDS = (DISPLACEMENT, VELOCITY, ACCELERATION)


def step_matrix(scenario: Scenario, time: float = 0.0) -> np.ndarray:
    """One step of cable and ROV with the winch stopped, no load and no thrust, eqs. (6)-(8).

    Args:
        scenario: its cable, ROV, gravity, grid and step are used; loads, vessel and controller are left out.
        time: the winch stops at the length it has then, s.

    Returns:
        The step from y, Dy/Dt and the acceleration kept from the last step, node by node from below the
        vessel to the ROV, to the same one step later: shape (12 n, 12 n) for n elements. An eigenvalue z of
        a mode of the cable stands for the pole ``s = log(z)/dt``, 1/s; the kept acceleration adds
        eigenvalues near 0 that stand for none.

    >>> import umbilical
    >>> step_matrix(umbilical.load("paper", {"grid.elements": 4})).shape
    (48, 48)
    """
    still = _stopped(scenario, time)
    world = set_up(still).world
    inputs = Outside(still).sample(Steps(np.zeros(1), np.full(1, still.grid.step), np.zeros(0)))
    size = len(_FIELDS) * 4 * still.grid.elements
    columns = [_step(world, inputs, unit) for unit in np.eye(size)]
    return np.stack(columns, axis=1)


def _stopped(scenario: Scenario, time: float) -> Scenario:
    """The scenario with its winch stopped and nothing that acts from outside."""
    quiet = {"payload_force": [], "cable_load": [], "vessel_motion": []}
    return scenario.replace(
        {
            "winch": {"law": "constant", "length": float(winch.evaluate(scenario.winch, time).length)},
            "initial": {"shape": "straight"},
            "motors": [],
            "faults": [],
            "ideal_thruster": True,
            "control": {"period": scenario.control.period, "law": {"kind": "none"}},
        }
        | {f"environment.{name}": value for name, value in quiet.items()}
    )


def _step(world: World, inputs: Inputs, start: np.ndarray) -> np.ndarray:
    """One step from the fields in ``start``, all nodes but the vessel's, one field after the other."""
    fields = world.state.fields
    values = np.pad(start.reshape(len(_FIELDS), -1), ((0, 0), (1, 0)))
    for place in (DISPLACEMENT, VELOCITY):
        fields[place, :4] = to_field(values[_FIELDS.index(place)])
    enter_step(world.plant, world.state, inputs, 0)
    fields[ACCELERATION, :4] = to_field(values[_FIELDS.index(ACCELERATION)])
    advance_period(world, inputs, 0, 1)
    return np.concatenate([to_nodal(fields[place, :4])[1:] for place in _FIELDS])

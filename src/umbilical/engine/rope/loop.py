"""The two loops of the rope, as those of the string in ``engine/loop.py``: decided inside, or held from outside."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import entry_kernel, glue
from umbilical.control.allocation.table import Directions, allocate_both
from umbilical.control.cascade import CascadeSettings, CascadeState, start, update_motors, update_outer
from umbilical.control.outer.table import NONE
from umbilical.engine.loop import FINISHED, RunRecord
from umbilical.engine.rope.recording import measure_rope, store_rope
from umbilical.engine.rope.world import RopeWorld, advance_rope_plant, enter_rope_step, sense_rope
from umbilical.plant.rope.outside import RopeInputs


class RopeControl(NamedTuple):
    """Settings of the built-in controller, its memory for both directions, and the allocation to directed motors.

    Attributes:
        settings: of the direction x, and of what both share.
        settings_across: of the outer law in the direction y.
        along, across: memory.
        directions: where the motors push.
    """

    settings: CascadeSettings
    settings_across: CascadeSettings
    along: CascadeState
    across: CascadeState
    directions: Directions


@glue
def allocate_rope(control: RopeControl, world: RopeWorld) -> None:
    """Demands on the motors from the commanded thrusts of both directions."""
    motors, along, across = control.settings.motors, world.along.decision, world.across.decision
    allocate_both(
        motors.allocation, motors.nominal, control.directions, (control.along.kappa, control.across.kappa),
        along.outer[0], across.outer[0], along.motors, control.along.outer[0].updates > 0,
    )  # fmt: skip


@glue
def decide_rope(control: RopeControl, world: RopeWorld) -> None:
    """One update of the built-in controller: the outer law per direction, then the motors."""
    settings, along, across = control.settings, world.along, world.across
    if settings.outer.laws.kind != NONE:
        if control.along.outer[0].updates % settings.outer_every == 0:
            update_outer(settings.outer, control.along, along.readings, along.decision)
            update_outer(control.settings_across.outer, control.across, across.readings, across.decision)
            if settings.motors.driven:
                allocate_rope(control, world)
        if settings.motors.driven:
            update_motors(settings.motors, control.along, along.readings, along.decision)
    control.along.outer[0].updates += 1
    control.across.outer[0].updates += 1


@glue
def actuate_rope(world: RopeWorld) -> None:
    """An ideal thruster delivers the new command at once; motors take their time."""
    if world.plant.ideal:
        now = world.state.now[0]
        now.body_thrust[0] = world.along.decision.outer[0].thrust_command
        now.body_thrust[1] = world.across.decision.outer[0].thrust_command
        now.thrust = now.body_thrust[0]


@glue
def keep_rope(world: RopeWorld, record: RunRecord, update: int, kappa: np.ndarray) -> bool:
    """Take one control sample into the record; False if the model has ended."""
    good = measure_rope(record.tally, world, update >= record.fault_update, update * record.period)
    if good and (update % record.every == 0 or update == record.last_update):
        store_rope(record.log, (update + record.every - 1) // record.every, record.tally, world, kappa)
    return good


@glue
def observe_rope(
    world: RopeWorld, inputs: RopeInputs, first: np.ndarray, noise: np.ndarray, across: np.ndarray, j: int
) -> None:
    """The outside world after a jump, then the sensors."""
    if first[j] < first[j + 1] and inputs.plane.refresh[first[j]]:
        enter_rope_step(world.plant, world.state, inputs, first[j])
    sense_rope(world, noise, across, j)


@glue
def advance_rope_period(world: RopeWorld, inputs: RopeInputs, begin: int, end: int) -> None:
    """All plant steps of one control period."""
    for i in range(begin, end):
        if i > begin and inputs.plane.refresh[i]:
            enter_rope_step(world.plant, world.state, inputs, i)
        advance_rope_plant(world.plant, world.state, inputs, i, world.along.decision.motors)


@entry_kernel
def run_rope_steps(
    world: RopeWorld, control: RopeControl, record: RunRecord, inputs: RopeInputs, first: np.ndarray,
    noise: np.ndarray, across: np.ndarray, begin: int, periods: tuple[int, int], inside: bool, driven: bool,
    decided: bool,
) -> int:  # fmt: skip
    """Control periods ``periods`` of the stretch that begins at ``begin``.

    ``inside``: the built-in controller decides, and each period is observed first. Else a command from outside is
    held: the first period is observed already, ``driven`` and ``decided`` as in ``engine.loop.run_held``, and in the
    end what follows the last period is observed, if it is in the stretch. Returns as ``engine.loop.run_steps``.
    """
    for j in range(periods[0], periods[1]):
        if inside or j > periods[0]:
            observe_rope(world, inputs, first, noise, across, j)
        if inside and begin + j == 0:
            start(control.settings, control.along, world.along.readings)
            start(control.settings_across, control.across, world.across.readings)
        if inside:
            decide_rope(control, world)
        else:
            if driven:
                if decided and j == periods[0]:
                    allocate_rope(control, world)
                update_motors(control.settings.motors, control.along, world.along.readings, world.along.decision)
            control.along.outer[0].updates += 1
        actuate_rope(world)
        if not keep_rope(world, record, begin + j, control.along.kappa):
            return begin + j
        advance_rope_period(world, inputs, first[j], first[j + 1])
    if not inside and periods[1] < first.size - 1:
        observe_rope(world, inputs, first, noise, across, periods[1])
    return FINISHED


@entry_kernel
def observe_once(
    world: RopeWorld, inputs: RopeInputs, first: np.ndarray, noise: np.ndarray, across: np.ndarray, j: int
) -> None:
    """:func:`observe_rope` from Python."""
    observe_rope(world, inputs, first, noise, across, j)

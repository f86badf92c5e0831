"""All checks across fields, from every room. Each is a function whose parameters name the sections it needs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from umbilical.control import nominal
from umbilical.control.allocation.table import METHODS
from umbilical.control.motor import backstepping
from umbilical.control.observers import disturbance, high_gain
from umbilical.control.outer import table as outer
from umbilical.control.outer.table import LAWS
from umbilical.library import inherited
from umbilical.plant.checks import equipment, motion, seas, sizes, statics, steps, stretch, timeline, water, weights
from umbilical.plant.checks import rope as of_a_rope

Check = Callable[..., Any]

CHECKS: tuple[Check, ...] = (
    timeline.grid_of_time, timeline.size_of_the_run, sizes.large_result, sizes.stored_instants,
    timeline.signals_of_the_environment, timeline.signals_of_the_motors, timeline.tables_of_the_winch,
    timeline.shapes, timeline.smooth_signals, timeline.winch_is_smooth, timeline.smooth_shape,
    timeline.jumps_after_the_end, weights.cable_in_water, weights.payload_in_water, weights.believed_in_water,
    water.only_the_rope, water.water_is_there, water.cable_displaces, water.payload_displaces, water.current_profile,
    water.heave_is_smooth, motion.length, motion.tension_above_zero, motion.wave_speed, statics.static_slope,
    motion.vessel_is_continuous, motion.vessel_moves_like_one, seas.systems, seas.vessel_of_the_sea, seas.repetition,
    stretch.heave_has_its_model, stretch.bears_what_hangs, stretch.heave_of_a_cable_that_stretches,
    seas.orbital_motion, seas.regular_waves, motion.vessel_at_the_start, equipment.motors_are_there,
    equipment.thrust_coefficients, equipment.faults_have_a_motor, equipment.faults_end_after_they_start,
    equipment.intermittent_faults, equipment.stuck_once_at_a_time, equipment.latencies, outer.sections_of_the_law,
    outer.ideal_sensors, backstepping.motor_loop, inherited.gains_of_other_motors,
    *(check for method in METHODS.values() for check in method), nominal.nominal, steps.grid_of_a_rope,
    steps.grid_near_the_payload, high_gain.high_gain_observers, *(check for law in LAWS.values() for check in law),
    disturbance.disturbance_observer, backstepping.sampled_gains, steps.step_for_waves, steps.step_for_damping,
    steps.waves_that_leave, steps.motors, timeline.marks, equipment.rope_is_read,
)  # fmt: skip

OF_THE_STRING = (
    motion.tension_above_zero, motion.wave_speed, statics.static_slope, stretch.bears_what_hangs,
    steps.grid_near_the_payload, steps.step_for_waves, steps.step_for_damping, steps.waves_that_leave,
)  # fmt: skip
"""Those of :data:`CHECKS` that a rope does not need: it may be slack, and steep, and takes the step it needs."""


def checks_for(model: str) -> tuple[Check, ...]:
    """The checks of a scenario with this model of the cable."""
    if model == "rope":
        return (*(check for check in CHECKS if check not in OF_THE_STRING), *of_a_rope.CHECKS)
    return CHECKS

"""All checks across fields. Each is a function whose parameters name the sections of the scenario it needs."""

from __future__ import annotations

from umbilical.admission import controller, equipment, motion, sampling, steps, timeline

CHECKS = (
    timeline.grid_of_time,
    timeline.size_of_the_run,
    timeline.signals_of_the_environment,
    timeline.signals_of_the_motors,
    timeline.tables_of_the_winch,
    timeline.shapes,
    timeline.jumps_after_the_end,
    motion.length,
    motion.tension,
    motion.wave_speed,
    motion.vessel_is_continuous,
    motion.vessel_at_the_start,
    equipment.motors_are_there,
    equipment.thrust_coefficients,
    equipment.faults_have_a_motor,
    equipment.faults_end_after_they_start,
    equipment.intermittent_faults,
    equipment.stuck_once_at_a_time,
    equipment.latencies,
    controller.sections_of_the_law,
    controller.ideal_sensors,
    controller.motor_loop,
    controller.adaptation,
    controller.adaptation_has_its_error,
    controller.nominal,
    controller.grid_near_the_payload,
    sampling.high_gain_observers,
    sampling.boundary_law,
    sampling.proportional_derivative,
    sampling.disturbance_observer,
    sampling.adaptation,
    sampling.motor_loop,
    steps.cable,
    steps.damping,
    steps.motors,
    timeline.marks,
)

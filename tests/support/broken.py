"""Deliberately wrong models: each breaks one thing on its way into the kernels, at a seam that no kernel knows of."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from tests.support.scenarios import sine
from umbilical import Scenario
from umbilical.control.allocation import adaptive
from umbilical.control.motor import backstepping
from umbilical.control.motor import disturbance as of_motor
from umbilical.control.observers import disturbance as of_payload
from umbilical.control.observers import high_gain
from umbilical.control.outer import boundary
from umbilical.plant import cable, faults, signals, winch
from umbilical.plant.forces import drag
from umbilical.relations import tension
from umbilical.scenario.document import look_up
from umbilical.stability import impedance
from umbilical.verify import engine

Break = Callable[[pytest.MonkeyPatch], None]


def another_scenario(change: Callable[[Scenario], Mapping[str, Any]]) -> Break:
    """The engine solves another problem than the one the reference solves."""

    def apply(patch: pytest.MonkeyPatch) -> None:
        for name in ("simulate", "step_matrix"):
            right = getattr(engine, name)
            patch.setattr(engine, name, lambda scenario, right=right: right(scenario.replace(change(scenario))))

    return apply


def half_the_inertia_at_the_tip(scenario: Scenario) -> Mapping[str, Any]:
    """Half the mass under twice the gravity pulls as before and weighs half: T is right, m is not."""
    return {
        "payload.mass": 0.5 * scenario.payload.mass,
        "cable.wet_line_density": 0.5 * scenario.cable.line_density,
        "environment.gravity": 2.0 * scenario.environment.gravity,
    }


def forget() -> None:
    """Drop what the engine keeps from run to run: it depends on the functions that are broken here."""
    for name, module in tuple(sys.modules.items()):
        if name.startswith(("umbilical.plant.", "umbilical.sea.", "umbilical.relations.")):
            for kept in tuple(vars(module).values()):
                getattr(kept, "cache_clear", nothing_kept)()


def nothing_kept() -> None:
    """There is no cache to clear."""


def nothing(patch: pytest.MonkeyPatch) -> None:
    """The model as it is."""


def twice(key: str) -> Callable[[Scenario], Mapping[str, Any]]:
    """A number of the scenario."""
    return lambda scenario: {key: 2.0 * look_up(scenario.to_dict(), key)}


def a_fifth_less_weight_of_the_cable(scenario: Scenario) -> Mapping[str, Any]:
    wet = scenario.cable.wet_line_density
    return {"cable.wet_line_density": 0.8 * (scenario.cable.line_density if wet is None else wet)}


def a_trace_of_damping(scenario: Scenario) -> Mapping[str, Any]:
    """Too little to move a frequency."""
    return {"cable.damping": scenario.cable.damping + 1e-3}


def twice_the_vessels_motion(scenario: Scenario) -> Mapping[str, Any]:
    motion = scenario.to_dict()["environment"]["vessel_motion"]
    return {"environment.vessel_motion": [*motion, *motion]}


def twice_the_damping(scenario: Scenario) -> Mapping[str, Any]:
    return {"cable.damping": 2.0 * scenario.cable.damping, "payload.damping": 2.0 * scenario.payload.damping}


def a_tenth_more(key: str) -> Callable[[Scenario], Mapping[str, Any]]:
    """Of a constant of the first motor."""
    return lambda scenario: {f"motors.1.{key}": 1.1 * getattr(scenario.motors[0], key)}


def a_force_nobody_ordered(scenario: Scenario) -> Mapping[str, Any]:
    """1 N on the ROV, whatever else there is."""
    return {"environment.payload_force": [*scenario.to_dict()["environment"]["payload_force"], sine(1.0, 3.0, 1.0)]}


def a_fault_that_ends_late(scenario: Scenario) -> Mapping[str, Any]:
    end = scenario.faults[0].end
    assert end is not None
    return {"faults.1.end": end + 1e-3}


def tension_that_never_gets_constant(scenario: Scenario) -> Mapping[str, Any]:
    return {"cable.wet_line_density": scenario.cable.wet_line_density or 1e-3}


def a_rov_that_depends_on_the_grid(scenario: Scenario) -> Mapping[str, Any]:
    return {"payload.mass": scenario.payload.mass * (1.0 + 64.0 / scenario.grid.elements)}


def twice_the_gain_of_the_disturbance_observer(scenario: Scenario) -> Mapping[str, Any]:
    observer = scenario.control.disturbance_observer
    assert observer is not None
    return {"control.disturbance_observer.gain": 2.0 * observer.gain}


def twice_the_gain_on_damping(scenario: Scenario) -> Mapping[str, Any]:
    return {"control.law.damping_gain": 2.0 * getattr(scenario.control.law, "damping_gain")}  # noqa: B009


def twice_the_gain_on_position(scenario: Scenario) -> Mapping[str, Any]:
    return {"control.law.position_gain": 2.0 * getattr(scenario.control.law, "position_gain")}  # noqa: B009


def _winch(change: Callable[[winch.WinchMotion], winch.WinchMotion]) -> Break:
    def apply(patch: pytest.MonkeyPatch) -> None:
        right = winch.evaluate
        patch.setattr(winch, "evaluate", lambda *arguments: change(right(*arguments)))

    return apply


wrong_sign_of_the_winch_speed = _winch(lambda motion: motion._replace(speed=-motion.speed))
dropped_acceleration = _winch(lambda motion: motion._replace(acceleration=0.0 * motion.acceleration))
dropped_jerk = _winch(lambda motion: motion._replace(jerk=0.0 * motion.jerk))


def loads_a_percent_too_large(patch: pytest.MonkeyPatch) -> None:
    right = signals.evaluate
    patch.setattr(signals, "evaluate", lambda *arguments: 1.01 * right(*arguments))


def faults_one_step_late(patch: pytest.MonkeyPatch) -> None:
    right = faults.effect

    def wrong(timeline: Any, motor: int, target: Any, t: Any, side: Any = "right") -> Any:
        return right(timeline, motor, target, np.asarray(t) - 1e-3, side)

    patch.setattr(faults, "effect", wrong)


def motors_that_never_quite_die(patch: pytest.MonkeyPatch) -> None:
    right = faults.effect

    def wrong(*arguments: Any) -> Any:
        share, stuck = right(*arguments)
        return np.maximum(share, 0.01), stuck

    patch.setattr(faults, "effect", wrong)


def jumps_that_nobody_publishes(patch: pytest.MonkeyPatch) -> None:
    patch.setattr("umbilical.engine.setup.published_jumps", lambda scenario: ())


def high_gain_observer_off_by_two(patch: pytest.MonkeyPatch) -> None:
    right = high_gain.make_high_gain

    def wrong(record: Any, period: float) -> high_gain.HighGain:
        return right(
            record.model_copy(update={"time_constant": 2.0 * record.time_constant}) if record else None, period
        )

    patch.setattr(high_gain, "make_high_gain", wrong)
    patch.setattr("umbilical.control.observers.table.make_high_gain", wrong)


def disturbance_observer_off_by_two(patch: pytest.MonkeyPatch) -> None:
    right = of_payload.make_disturbance
    patch.setattr(
        of_payload,
        "make_disturbance",
        lambda record, h: right(record.model_copy(update={"gain": 2.0 * record.gain}), h),
    )


def motor_observer_off_by_two(patch: pytest.MonkeyPatch) -> None:
    right = of_motor.advance_motor_disturbance

    def wrong(constants: Any, gain: float, decay: float, *rest: float) -> float:
        return right(constants, 2.0 * gain, decay * decay, *rest)

    patch.setattr(of_motor, "advance_motor_disturbance", wrong)


def cross_term_of_the_inner_law(patch: pytest.MonkeyPatch) -> None:
    """- e1 of (60) with the other sign."""
    right = backstepping.backstepping_drive

    def wrong(constants: Any, gains: Any, speed: float, current: float, reference: Any) -> float:
        return right(constants, gains, speed, current, reference) + 2.0 * (speed - reference.speed_reference)

    patch.setattr(backstepping, "backstepping_drive", wrong)


def inertia_forgotten(patch: pytest.MonkeyPatch) -> None:
    """Without - beta m z2 of (22)."""
    right = boundary.boundary_thrust
    patch.setattr(
        boundary, "boundary_thrust", lambda k, beta, mass, error, rate, *rest: right(k, beta, mass, error, 0.0, *rest)
    )


def wrong_sign_of_the_adaptive_law(patch: pytest.MonkeyPatch) -> None:
    """The ratchet turns the other way: kappa_0 falls where (27) makes it grow."""
    right = adaptive.make_adaptation

    def wrong(*arguments: Any) -> adaptive.KappaStep:
        law = right(*arguments)
        law["kappa_gain"] *= -1.0
        return law

    patch.setattr("umbilical.control.allocation.table.make_adaptation", wrong)


def _cable(**wrong: float) -> Break:
    """Other constants of the cable than those of the scenario."""

    def apply(patch: pytest.MonkeyPatch) -> None:
        right = cable.make_cable
        patch.setattr("umbilical.engine.stepping.make_cable", lambda scenario: right(scenario)._replace(**wrong))

    return apply


added_mass_that_slides_along = _cable(added=0.0, coupling=0.0)
"""rho + rho_a in place of rho in rho D2y/Dt2, and nothing else."""
tension_for_what_sliding_leaves = _cable(coupling=0.0)
"""T in place of Tt."""


def tangential_term_omitted(patch: pytest.MonkeyPatch) -> None:
    """The drag along the cable lowers the tension, and its lateral part is forgotten."""
    right = drag.make
    patch.setattr(drag, "make", lambda scenario: right(scenario)._replace(tangential=0.0))


def buoyancy_that_accelerates(patch: pytest.MonkeyPatch) -> None:
    """T = (m + rho_wet s) (g - a) less what carries the ROV."""
    right = tension.hanging

    def wrong(mass: float, density: float, gravity: float, weight: float, wet: float) -> tension.Hanging:
        return right(mass, wet, gravity, weight)

    patch.setattr(tension, "hanging", wrong)


def more_added_mass(scenario: Scenario) -> Mapping[str, Any]:
    """Of the cable, where it is in water."""
    water = scenario.cable.water
    return {"cable.water.added_mass": water.added_mass + 0.5} if water else {}


def less_displaced_by_the_rov(scenario: Scenario) -> Mapping[str, Any]:
    """Froude-Krylov force of half the ROV."""
    water = scenario.payload.water
    return {"payload.water.displaced_mass": 0.5 * water.displaced_mass} if water else {}


def drag_by_the_square_of_the_diameter(scenario: Scenario) -> Mapping[str, Any]:
    water = scenario.cable.water
    return {"cable.water.normal_drag": water.normal_drag * water.diameter / 0.03} if water else {}


def drag_linearised_once(patch: pytest.MonkeyPatch) -> None:
    """k |u| in place of its slope 2 k |u|."""
    right = impedance.dampings
    patch.setattr(impedance, "dampings", lambda *arguments: [0.5 * found for found in right(*arguments)])


def twice_the_drag(scenario: Scenario) -> Mapping[str, Any]:
    """Of cable and ROV."""
    cable, payload = scenario.cable.water, scenario.payload.water
    found = {"cable.water.normal_drag": 2.0 * cable.normal_drag} if cable else {}
    return found | ({"payload.water.quadratic_drag": 2.0 * payload.quadratic_drag} if payload else {})


def twice_the_heave(scenario: Scenario) -> Mapping[str, Any]:
    motion = scenario.to_dict()["environment"]["vessel_heave"]
    return {"environment.vessel_heave": [*motion, *motion]}

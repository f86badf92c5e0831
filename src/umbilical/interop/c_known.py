"""What the C controller knows of a scenario; whatever else is set is refused by name: nothing differs silently."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from umbilical.errors import Problem, ScenarioError
from umbilical.scenario.base import Record
from umbilical.scenario.scenario import Scenario
from umbilical.stability.judgement import law_that_works

KNOWN: dict[str, frozenset[str]] = {
    name: frozenset(keys.split())
    for name, keys in {
        "Control": "period outer_period law velocity_observer slope_observer disturbance_observer allocation motor_loop"
        " nominal",
        "NoControl": "kind",
        "ProportionalDerivative": "kind position_gain velocity_gain velocity",
        "BoundaryLaw": "kind damping_gain slope_gain rates station_gain station washout_time drag_feedforward",
        "HighGainObserver": "time_constant damping",
        "DisturbanceObserver": "enabled gain coupling",
        "KnownFactors": "method",
        "AdaptiveAllocation": "method rates leak initial lower upper",
        "MotorLoop": "speed_gain current_gain robust_factor speed_width current_width speed_bound current_bound"
        " observer_gain filter_frequency root_width",
        "Nominal": "payload_mass payload_wet_weight payload_damping gravity thrust_coefficients motors",
        "Motor": "inertia viscous_friction torque_constant load_coefficient resistance inductance back_emf_constant"
        " thrust_coefficient voltage_limit torque_disturbance voltage_disturbance",
    }.items()
}
"""Records below ``control`` and their keys, as the templates follow them."""
MODELS = ("string",)
"""Models of the cable whose controller it is, where a scenario says which."""


def check_known(scenario: Scenario) -> None:
    """Refuse a controller that is not one of these.

    Raises:
        ScenarioError: no law, or a law, an observer or an option that the C does not have, each by its key.
    """
    problems = [*_unknown_model(scenario), *_unknown(scenario.control, "control")]
    if scenario.control.law.kind == "none":
        reason = "without a law there is no controller to write"
        problems.append(Problem("control.law.kind", "none", "a law", reason, law_that_works(scenario)))
    if problems:
        raise ScenarioError(problems, scenario.name)


def _unknown_model(scenario: Scenario) -> Iterator[Problem]:
    model = getattr(scenario, "model", MODELS[0])
    if model not in MODELS:
        yield _problem("model", model, " or ".join(MODELS), f'use model = "{MODELS[0]}", or a controller of your own')


def _unknown(record: Record, key: str) -> Iterator[Problem]:
    kind = type(record).__name__
    if kind not in KNOWN:
        yield _problem(key, getattr(record, "kind", kind), "what the C controller has", "choose another")
        return
    for name, field in type(record).model_fields.items():
        value, place = getattr(record, name), f"{key}.{name}"
        if name in KNOWN[kind]:
            for part, where in _records(value, place):
                yield from _unknown(part, where)
        elif value != (default := field.get_default(call_default_factory=True)):
            yield _problem(place, value, f"its default ({default})", "leave it out")


def _records(value: Any, place: str) -> Iterator[tuple[Record, str]]:
    """The records in a value, with their keys; a signal of a motor is nothing that a controller sees."""
    if isinstance(value, Record):
        yield value, place
    elif isinstance(value, tuple) and not place.endswith("_disturbance"):
        yield from ((part, f"{place}.{i}") for i, part in enumerate(value, 1) if isinstance(part, Record))


def _problem(key: str, value: Any, bound: str, fix: str) -> Problem:
    return Problem(key, str(value), bound, "the C controller does not have it, and would differ", fix)

"""What the sea may not be: refused before the first step, by key, with what is allowed and why."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from umbilical import Scenario
from umbilical.errors import ScenarioError
from umbilical.library.admit import admit
from umbilical.plant.equilibrium import equilibrium
from umbilical.relations.tension import AxialDrag, across, hanging, sinking, tension
from umbilical.verify.engine import open_loop, sine

SEA: dict[str, Any] = {
    "environment.gravity": 9.81,
    "environment.water": {"density": 1025.0, "current": {"depths": [0.0, 200.0], "speeds": [0.5, 0.1]}},
    "cable.line_density": 5.412, "cable.wet_line_density": 4.124, "cable.water": {"diameter": 0.04},
    "payload.mass": 9000.0, "payload.wet_weight": 35e3,
    "payload.water": {"added_mass": 8000.0, "vertical_added_mass": 8000.0, "quadratic_drag": 3000.0,
                      "vertical_drag": 4500.0},
}  # fmt: skip


def at_sea(**more: Any) -> Scenario:
    return open_loop(winch={"law": "constant", "length": 100.0}).replace({**SEA, **more})


FAST_UP = {"winch": {"law": "speed", "start_length": 100.0, "speed": -90.0}, "duration": 0.5,
           "payload.water.vertical_drag": 0.0, "cable.water.tangential_drag": 0.0}  # fmt: skip
WEAK = {"environment.water.current.speeds": [1.9, 1.5], "payload.wet_weight": 20000.0}
REFUSED: list[tuple[dict[str, Any], str, str]] = [
    # weights: the string's own, and what is not one
    ({"cable.wet_line_density": -0.1}, "cable.wet_line_density", 'or model = "rope"'),
    ({"payload.wet_weight": 0.0}, "payload.wet_weight", 'the full model, model = "rope"'),
    ({"payload.wet_weight": -10.0}, "payload.wet_weight", 'the full model, model = "rope"'),
    ({"cable.line_density": 1.0, "cable.wet_line_density": 0.5}, "cable.line_density", "a full model of the cable"),
    ({"cable.wet_line_density": 6.0}, "cable.wet_line_density", "at most cable.line_density"),
    ({"cable.wet_line_density": 40.4}, "cable.wet_line_density", "40.4 N/m of weight are 4.11825 kg/m"),
    ({"cable.wet_line_density": None}, "cable.wet_line_density", "4.12395 kg/m"),
    ({"payload.wet_weight": 1e6}, "payload.wet_weight", "water bears weight"),
    ({"payload.wet_weight": None}, "payload.wet_weight", "load cell"),
    ({"control.nominal.payload_wet_weight": 1e6}, "control.nominal.payload_wet_weight", "water bears weight"),
    # coefficients and sizes
    ({"environment.water": None}, "cable.water", "needs|need the density"),
    ({"environment.water.density": 0.0}, "environment.water.density", "1025 kg/m3"),
    ({"cable.water.diameter": 0.6}, "cable.water.diameter", "metres, not millimetres"),
    ({"cable.water.diameter": 40.0}, "cable.water.diameter", "metres, not millimetres"),
    ({"cable.water.diameter": 0.0}, "cable.water.diameter", "above 0"),
    ({"cable.water.normal_drag": -1.0}, "cable.water.normal_drag", "drag brakes"),
    ({"cable.water.tangential_drag": -0.01}, "cable.water.tangential_drag", "drag brakes"),
    ({"cable.water.added_mass": -1.0}, "cable.water.added_mass", "water moves along"),
    ({"cable.water.strumming": -0.5}, "cable.water.strumming", "an amplitude over the diameter"),
    ({"payload.water.linear_drag": -1.0}, "payload.water.linear_drag", "drag brakes"),
    ({"payload.water.quadratic_drag": -1.0}, "payload.water.quadratic_drag", "drag brakes"),
    ({"payload.water.vertical_drag": -1.0}, "payload.water.vertical_drag", "drag brakes"),
    ({"payload.water.added_mass": -1.0}, "payload.water.added_mass", "water moves along"),
    ({"payload.water.vertical_added_mass": -1.0}, "payload.water.vertical_added_mass", "water moves along"),
    ({"payload.water.displaced_mass": -1.0}, "payload.water.displaced_mass", "water moves along"),
    ({"cable.axial_stiffness": 3e5}, "cable.axial_stiffness", "ten times the static tension"),
    # the current
    ({"environment.water.current.depths": [0.0, 50.0]}, "environment.water.current.depths", "reaches 100 m"),
    ({"environment.water.current.depths": [200.0, 0.0]}, "environment.water.current.depths.2", "increasing"),
    ({"environment.water.current.speeds": [0.5]}, "environment.water.current.speeds", "2 or more"),
    ({"environment.water.current.speeds": [9.0, 0.1]}, "environment.water.current.speeds", "a knot is 0.514"),
    ({"environment.water.current.upwards": [0.1, 0.1]}, "environment.water.current.upwards", "no such key"),
    ({**WEAK, "duration": 60.0}, "environment", "a current below 0.658 times this one"),
    ({**WEAK, "duration": 1.0, "initial": {"shape": "equilibrium"}}, "environment", "a static slope of 0.69"),
    # what moves: tension above 0, S above rho |v|
    ({"environment.vessel_heave": [sine(5.0, 1.0)]}, "environment.vessel_heave", 'model = "rope"'),
    ({"environment.vessel_heave": [{"kind": "step", "value": 1.0, "time": 1.0}]},
     "environment.vessel_heave.1.kind", "acceleration of the sheave"),
    ({"winch": {"law": "speed", "start_length": 100.0, "speed": 3.0}, "duration": 10.0},
     "winch.speed", "less its drag"),
    (FAST_UP, "winch.speed", "slower than the waves"),
]  # fmt: skip
"""Every row of the string in water and the words that stand in its message, one of those between bars."""


@pytest.mark.parametrize(("change", "key", "words"), REFUSED, ids=[f"{k} {i}" for i, (_, k, _) in enumerate(REFUSED)])
def test_it_is_refused(change: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        admit(at_sea(**change))
    found = {problem.key: str(problem) for problem in caught.value.problems}
    assert key in found, found
    assert any(word in found[key] for word in words.split("|")), found[key]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"cable.wet_line_density": 2.0}, "is the cable flooded"),
        ({"payload.water.across_drag": 1.0}, "payload.water.across_drag: nothing across the plane"),
        ({"environment.water.current.speeds_across": [0.1, 0.0]}, "nothing across the plane counts"),
        ({"payload.water.displaced_mass": 2000.0}, "is one of the three a slip"),
        ({"payload.wet_weight": 3500.0}, "if 3500 kg was meant"),
        ({**WEAK, "duration": 1.0}, "the run is too short for the cable to come to rest there"),
        ({"cable.axial_stiffness": 3e6}, "the static stretch reaches 1.30%"),
    ],
)
def test_it_is_told(change: dict[str, Any], words: str) -> None:
    assert words in "; ".join(map(str, admit(at_sea(**change))))


def test_the_sea_is_admitted() -> None:
    assert admit(at_sea()) == ()


def test_tension_of_what_floats_and_sinks() -> None:
    """T = W - (m + rho s) a for a cable without weight; drag carries, and sliding takes mu v^2."""
    s, a = np.linspace(0.0, 700.0, 50), 0.3
    light = hanging(500.0, 2.0, 9.81, 4000.0, 0.0)
    np.testing.assert_allclose(tension(s, 9.81 - a, light), 4000.0 - (500.0 + 2.0 * s) * a, rtol=1e-12)
    moved = hanging(500.0, 2.0, 9.81, 4000.0, 0.0, added=300.0)
    np.testing.assert_allclose(tension(s, 9.81 - a, moved), 4000.0 - (800.0 + 2.0 * s) * a, rtol=1e-12)
    drags = across(sinking(light, AxialDrag(50.0, 0.5), -2.0), 0.4, -2.0)
    np.testing.assert_allclose(
        tension(s, 9.81, drags), tension(s, 9.81, light) + 4.0 * (50.0 + 0.5 * s) - 1.6, rtol=1e-12
    )


def test_offset_in_a_uniform_current() -> None:
    """65.228 m on 1000 m of cable, in small angles."""
    scenario = open_loop().replace({
        **SEA, "winch": {"law": "constant", "length": 1000.0},
        "environment.water": {"current": {"depths": [0.0, 1000.0], "speeds": [0.5, 0.5]}},
    })  # fmt: skip
    w, load, force, weight = 4.124 * 9.81, 0.5 * 1025.0 * 1.2 * 0.04 * 0.25, 3000.0 * 0.25, 35e3
    share = np.log(1.0 + w * 1000.0 / weight) / w
    exact = force * share + load * (1000.0 / w - weight / w * share)
    found = equilibrium(scenario)
    assert found.displacement[-1] == pytest.approx(exact, rel=1e-6)
    assert found.displacement[-1] == pytest.approx(65.228, abs=0.001)
    held = equilibrium(scenario, tip=0.0)
    assert held.displacement[-1] == pytest.approx(0.0, abs=1e-9)
    assert held.thrust < 0.0

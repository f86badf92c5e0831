"""A sea state that moves the vessel: its terms, its statistics, what does not change, what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical.certificate.loads import jumps_of, largest_rate, largest_value
from umbilical.errors import ScenarioError
from umbilical.library.admit import admit
from umbilical.plant import regular, signals
from umbilical.plant.rope.outside import vessel_in_space
from umbilical.plant.seaway import sheave, spectrum_of
from umbilical.scenario.environment import Environment
from umbilical.scenario.signals import Table, Waves
from umbilical.sea import BoxVessel, Spectrum, motion_of_point

BOX = {"kind": "box", "length": 93.0, "breadth": 20.0, "draught": 6.6, "block_coefficient": 0.75}
WIND = {"significant_height": 2.5, "peak_period": 8.0, "heading": 2.0}
SWELL = {"significant_height": 1.0, "peak_period": 14.0, "heading": 1.0, "peakedness": 5.0}


def sea(*systems: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"systems": list(systems), "vessel": BOX | {"sheave_forward": 10.0, "sheave_up": 8.0}} | more


def environment(*systems: dict[str, Any], **more: Any) -> Environment:
    return Environment.model_validate(
        umbilical.scenario.document.freeze({"gravity": 9.81, "sea": sea(*systems, **more)})
    )


def rms(signal: Any) -> float:
    return float(np.sqrt(np.sum(np.array(signal[0].amplitudes) ** 2) / 2.0))


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_the_table_of_waves_is_the_sum_of_waves(order: int) -> None:
    term: Any = sheave(environment(WIND)).along[0]
    t = np.random.default_rng(1).uniform(-5.0, 400.0, 300)
    omega, a, phase = (np.array(part) for part in (term.frequencies, term.amplitudes, term.phases))
    exact = np.cos(np.outer(t, omega) + phase + order * np.pi / 2.0) @ (a * omega**order)
    assert abs(regular.waves(term, t, order) - exact).max() < 1e-9


def test_motion_has_the_spectrum_of_the_vessel() -> None:
    omega, heading = np.linspace(0.05, 6.0, 20001), WIND["heading"]
    ship = BoxVessel(93.0, 20.0, 6.6, 0.75)
    motion = abs(motion_of_point(ship.motions(omega, heading), (10.0, 0.0, 8.0))) ** 2
    exact = np.sqrt(np.trapezoid(motion * Spectrum(2.5, 8.0).density(omega), omega, axis=1))
    found = sheave(environment(WIND | {"components": 400}, plane=0.0))
    assert [rms(part) for part in found] == pytest.approx(exact.tolist(), rel=0.02)


def test_vessel_at_is_the_sea_faded_in() -> None:
    calm = environment(WIND).model_copy(update={"vessel_ramp": 10.0})
    t = np.linspace(0.5, 30.0, 100)
    place, speed = signals.vessel(calm, t)
    step = 1e-4
    assert speed == pytest.approx(
        (signals.vessel(calm, t + step)[0] - signals.vessel(calm, t - step)[0]) / (2 * step), abs=1e-7
    )
    assert place[t > 10.0] == pytest.approx(signals.evaluate(sheave(calm).along, t[t > 10.0]))


def test_a_swell_leaves_the_wind_sea_as_it_is() -> None:
    alone: Any
    both: Any
    alone, both = (sheave(environment(*systems)).along[0] for systems in ((WIND,), (WIND, SWELL)))
    count = len(alone.phases)
    assert both.phases[:count] == alone.phases
    assert both.amplitudes[:count] == alone.amplitudes
    calm = sheave(environment(WIND, SWELL | {"significant_height": 0.0})).along[0]
    assert calm == alone


def test_planes_a_right_angle_apart_change_places() -> None:
    here, there = (sheave(environment(WIND, plane=p)) for p in (0.4, 0.4 + np.pi / 2.0))
    t = np.linspace(0.0, 50.0, 100)
    assert signals.evaluate(here.across, t) == pytest.approx(signals.evaluate(there.along, t), abs=1e-9)
    assert signals.evaluate(here.up, t) == pytest.approx(signals.evaluate(there.up, t), abs=1e-9)


def test_a_full_turn_and_twice_the_height() -> None:
    once = rms(sheave(environment(WIND)).up)
    assert rms(sheave(environment(WIND | {"heading": 2.0 - 2.0 * np.pi})).up) == pytest.approx(once, rel=1e-9)
    assert rms(sheave(environment(WIND | {"significant_height": 5.0})).up) == pytest.approx(2.0 * once, rel=1e-9)
    many = rms(sheave(environment(WIND | {"components": 200})).up)
    assert many == pytest.approx(once, rel=0.03)


def test_each_of_the_three_periods_is_the_same_sea() -> None:
    peak = spectrum_of(environment(WIND).sea.systems[0])  # type: ignore[union-attr]
    for name, kind in (("zero_crossing_period", "zero_crossing"), ("mean_period", "mean")):
        other = {k: v for k, v in WIND.items() if k != "peak_period"} | {name: peak.period(kind)}  # type: ignore[arg-type]
        found = spectrum_of(environment(other).sea.systems[0])  # type: ignore[union-attr]
        assert found.peak_period == pytest.approx(8.0, rel=1e-12)


def test_spreading_in_a_narrow_cone_is_nearly_long_crested() -> None:
    narrow = WIND | {"spreading": 100.0, "directions": 9, "components": 20}
    wide = narrow | {"spreading": 1.0}
    long_crested = rms(sheave(environment(WIND | {"components": 20})).up)
    assert rms(sheave(environment(narrow)).up) == pytest.approx(long_crested, rel=0.1)
    assert abs(rms(sheave(environment(wide)).up) / long_crested - 1.0) > abs(
        rms(sheave(environment(narrow)).up) / long_crested - 1.0
    )


def test_bounds_for_certificates() -> None:
    term = Waves(kind="waves", frequencies=(1.0, 2.0), amplitudes=(0.5, -0.25), phases=(0.0, 1.0))
    assert (largest_value((term,)), largest_rate((term,))) == (0.75, 1.0)


def test_the_rope_gets_all_three_directions() -> None:
    scenario = umbilical.load(
        "ringdown", {"model": "rope", "environment.sea": sea(WIND), "environment.vessel_ramp": 5.0}
    )
    assert "heave is left out" not in " ".join(map(str, admit(scenario)))
    t = np.array([20.0])
    waves = sheave(scenario.environment)
    place, _ = vessel_in_space(scenario, t)
    assert place[0] == pytest.approx([signals.evaluate(part, t)[0] for part in waves])


def test_a_scenario_with_a_sea_is_stored_whole_and_says_what_it_leaves_out() -> None:
    scenario = umbilical.load("ringdown", {"environment.sea": sea(WIND, SWELL), "environment.vessel_ramp": 5.0})
    assert umbilical.scenario.scenario.parse_document(scenario.to_toml()) == scenario
    said = " ".join(map(str, admit(scenario)))
    assert "heave is left out" in said
    assert "surge and sway" in said
    long = umbilical.load("ringdown", {"environment.sea": sea(WIND), "environment.vessel_ramp": 5.0, "duration": 4000.0,
                                       "output.interval": 1.0})  # fmt: skip
    assert "repeat themselves" in " ".join(map(str, admit(long)))


@pytest.mark.parametrize(
    ("system", "key", "words"),
    [
        (WIND | {"mean_period": 7.0}, "systems.1", "exactly one"),
        ({"significant_height": 2.0, "heading": 0.0}, "systems.1", "no period"),
        (WIND | {"peak_period": 1.5}, "systems.1.peak_period", "2 to 30 s"),
        (WIND | {"significant_height": 19.0}, "systems.1.significant_height", "a seventh"),
        (WIND | {"peakedness": 9.0}, "systems.1.peakedness", "at most 7"),
        (WIND | {"components": 5}, "systems.1.components", "20"),
    ],
)
def test_a_sea_that_cannot_be_is_refused(system: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        umbilical.load("ringdown", {"environment.sea": sea(system), "environment.vessel_ramp": 5.0})
    found = refused.value.problems[0]
    assert found.key == f"environment.sea.{key}"
    assert words in str(found)


def test_bounds_of_monotone_and_jumping_tables() -> None:
    """What a certificate takes for a load's size, slope and jumps holds of the curve that runs."""
    fine = np.linspace(0.0, 3.0, 3001)
    steep = (Table(kind="table", times=(0.0, 1.0, 1.1, 3.0), values=(0.0, 0.0, 1.0, 1.0), interpolation="pchip"),)
    slopes = abs(signals.derivative(steep, fine))
    assert slopes.max() <= largest_rate(steep) <= 1.001 * slopes.max()
    assert largest_value(steep) == 1.0
    jumping = (Table(kind="table", times=(0.0, 1.0, 1.0, 3.0), values=(0.0, 1.0, 4.0, 4.0), interpolation="linear"),)
    assert largest_rate(jumping) == 1.0
    assert jumps_of(jumping) == ((1.0, 3.0),)

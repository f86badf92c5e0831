"""Weights in water: what is refused, what is asked about, and what the string model ends at."""

from __future__ import annotations

from typing import Any

import pytest

import umbilical
from tests.library.test_bad_input import problems
from umbilical.library import admit

HARD = {"law": "cosine", "start_length": 450.0, "amplitude": 40.0, "frequency": 0.3}


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"payload.wet_weight": 5001.0}, "payload.wet_weight", "at most the weight in air, 500 kg * 10 m/s2 = 5000 N"),
        ({"payload.wet_weight": 0.0}, "payload.wet_weight", "the full model"),
        ({"payload.wet_weight": -50.0}, "payload.wet_weight", "the full model"),
        ({"cable.wet_line_density": 2.1}, "cable.wet_line_density", "2.1 N/m of weight are 0.21 kg/m"),
        ({"cable.wet_line_density": 30.0}, "cable.wet_line_density", "check both densities"),
        ({"control.nominal.payload_wet_weight": 6e3}, "control.nominal.payload_wet_weight", "5000 N"),
        ({"payload.wet_weight": 1700.0, "winch": HARD}, "winch.frequency", "below 3.4 m/s2"),
        ({"cable.wet_line_density": 0.0, "winch": HARD}, "winch.frequency", "below 3.57"),
        ({"cable.wet_line_density": 0.0, "winch": HARD, "control.law": {"kind": "none"}}, "winch.frequency", "3.57"),
        ({"payload.wet_weight": 1000.0, "winch": {"law": "speed", "start_length": 450.0, "speed": 23.0}}, "winch.speed",
         "slower than the waves, 22.3607 m/s where the tension is smallest"),
    ],
)  # fmt: skip
def test_refused(changes: dict[str, Any], key: str, words: str) -> None:
    assert any(words in str(problem) for problem in problems(changes)[key])


def test_a_weight_that_looks_like_a_mass_is_asked_about() -> None:
    (notice,) = admit(umbilical.load("paper", {"payload.wet_weight": 500.0}))
    assert str(notice).startswith("payload.wet_weight")
    assert "if 500 kg was meant, that is 5000 N" in str(notice)
    assert admit(umbilical.load("paper", {"payload.wet_weight": 4800.0})) == ()


def test_the_weight_in_air_written_out_changes_no_bit() -> None:
    short = {"duration": 0.5}
    plain = umbilical.simulate(umbilical.load("paper", short))
    written = umbilical.simulate(
        umbilical.load("paper", short | {"payload.wet_weight": 5000.0, "cable.wet_line_density": 2.0})
    )
    assert (plain["displacement"].values == written["displacement"].values).all()
    assert (plain["motor_voltage"].values == written["motor_voltage"].values).all()

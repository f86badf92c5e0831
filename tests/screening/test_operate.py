"""Limits of an operation: what moves them, what they say of themselves, what is refused."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy import integrate

from umbilical import load_operation, lower, operate
from umbilical.errors import FileError, ScenarioError
from umbilical.relations.axial import Bar, equivalent_damping, mean_drag
from umbilical.screening import axial_period, respond
from umbilical.screening.criteria import parse_criterion
from umbilical.screening.operation import Operation
from umbilical.sea import Spectrum

SLACK = parse_criterion("slack=1e-2/3h")
BOW = np.radians([135.0])


def limit(operation: Operation, *criteria: str, depth: float = 1500.0, period: float = 8.0) -> float:
    chosen = [parse_criterion(text) for text in criteria] or [SLACK]
    found = operate(operation, chosen, depth=np.array([depth]), period=np.array([period]), heading=BOW)
    return float(found.limit[0, 0, 0])


def test_at_the_limit_the_criterion_is_just_met() -> None:
    operation = load_operation("work-class")
    height = limit(operation)
    for share, fails in ((0.99, False), (1.01, True)):
        found = respond(operation, Spectrum(share * height, 8.0), depth=1500.0, heading=BOW[0])
        assert (found.slack_probability(3 * 3600.0) > 1e-2) is fails


@pytest.mark.parametrize(
    ("changes", "rises"),
    [
        ({"payload.wet_weight": 45e3}, True),
        ({"payload.quadratic_drag": 9000.0}, True),
        ({"payload.added_mass": 12000.0}, False),
        ({"compensation": {"lag": 0.05, "bandwidth": 6.0}}, True),
        ({"compensation": {"lag": 2.0, "bandwidth": 6.0}}, False),
        ({"cable.loss_factor": 0.05}, True),
    ],
)
def test_what_moves_the_limit(changes: dict[str, object], rises: bool) -> None:
    assert (limit(load_operation("work-class", changes)) > limit(load_operation("work-class"))) is rises


def test_compensation_that_follows_nothing_is_none() -> None:
    idle = load_operation("work-class", {"compensation": {"gain": 0.0, "lag": 0.3, "bandwidth": 6.0}})
    assert limit(idle) == limit(load_operation("work-class"))


def test_more_criteria_never_raise_the_limit() -> None:
    operation = load_operation("work-class")
    both = limit(operation, "slack=1e-2/3h", "top_tension:130e3=1e-2/3h")
    assert both == min(limit(operation, "slack=1e-2/3h"), limit(operation, "top_tension:130e3=1e-2/3h"))
    assert limit(operation, "top_tension:50e3=1e-2/3h") == 0.0  # less than what hangs there in a calm


def test_without_drag_the_limit_is_that_of_the_linear_bar() -> None:
    operation = load_operation("work-class", {"payload.quadratic_drag": 0.0, "cable.loss_factor": 0.05})
    height = limit(operation)
    found = respond(operation, Spectrum(height, 8.0), depth=1500.0, heading=BOW[0])
    assert found.slack_probability(3 * 3600.0) == pytest.approx(1e-2, rel=1e-6)


def test_a_limit_that_hangs_on_the_cables_own_damping_says_so() -> None:
    """A short cable in short beam seas meets the axial resonance of a cable that nothing damps."""
    operation = load_operation("work-class", {"payload.quadratic_drag": 1.0})
    found = operate(operation, [SLACK], depth=np.array([1500.0]), period=np.array([7.0]), heading=BOW)
    assert found.undamped.all()
    assert "cable.loss_factor" in " ".join(found.notices())
    damped = load_operation("work-class", {"payload.quadratic_drag": 1.0, "cable.loss_factor": 0.02})
    assert not operate(damped, [SLACK], depth=found.depth, period=found.period, heading=BOW).undamped.any()


@pytest.mark.parametrize("mean", [0.0, 0.4, -2.0])
def test_linearised_drag_is_that_of_a_gaussian(mean: float) -> None:
    def expected(value: Callable[[float], float]) -> float:
        density = lambda u: np.exp(-((u - mean) ** 2) / (2 * 0.5**2)) / (0.5 * np.sqrt(2.0 * np.pi))  # noqa: E731
        return integrate.quad(lambda u: value(u) * density(u), mean - 5.0, mean + 5.0, points=[0.0], limit=200)[0]

    assert equivalent_damping(3.0, mean, 0.5) == pytest.approx(6.0 * expected(abs), rel=1e-6)
    assert mean_drag(3.0, mean, 0.5) == pytest.approx(3.0 * expected(lambda u: abs(u) * u), rel=1e-6, abs=1e-9)


def test_still_water_drag_is_the_limit_of_calm() -> None:
    assert mean_drag(3.0, -2.0, 0.0) == -12.0
    assert equivalent_damping(3.0, -2.0, 0.0) == 12.0


@pytest.mark.parametrize(("length", "period"), [(500.0, 3.69), (1000.0, 5.35), (1500.0, 6.71), (3000.0, 10.17)])
def test_axial_periods_of_the_preset(length: float, period: float) -> None:
    assert axial_period(Bar(2.6e7, 5.412, 17000.0, length)) == pytest.approx(period, abs=5e-3)


def test_a_faster_winch_leaves_the_resonance_sooner_and_hangs_less() -> None:
    depth, speed = np.linspace(100.0, 3000.0, 8), np.array([0.2, 1.0, 3.0])
    found = lower(load_operation("work-class"), Spectrum(1.5, 8.0), heading=BOW[0], depth=depth, speed=speed)
    assert found.risk[1] < found.risk[0] < found.risk[2] == 1.0
    assert found.resonant.any()
    assert not found.resonant[np.searchsorted(depth, found.waiting_depth)]


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"payload.wet_weight": 1e5}, "payload.wet_weight", "adds none"),
        ({"payload.wet_weight": -10.0}, "payload.wet_weight", "above 0"),
        ({"cable.wet_line_density": 6.0}, "cable.wet_line_density", "adds none"),
        ({"cable.axial_stiffness": 1e5}, "cable.axial_stiffness", "strain"),
        ({"vessel.block_coefficient": 1.5}, "vessel.block_coefficient", "at most 1"),
        ({"sea.peakedness": 0.5}, "sea.peakedness", "at least 1"),
        ({"payload.wetweight": 1.0}, "payload.wetweight", "wet_weight"),
    ],
)
def test_what_cannot_be_is_refused(changes: dict[str, object], key: str, words: str) -> None:
    with pytest.raises(ScenarioError, match=words) as refused:
        load_operation("work-class", changes)
    assert [problem.key for problem in refused.value.problems] == [key]


def test_an_unknown_operation_names_its_neighbours() -> None:
    with pytest.raises(FileError, match="work-class"):
        load_operation("work-clas")


@pytest.mark.parametrize(
    "text", ["slack", "slack:3=1e-2/3h", "slack=2/3h", "top_tension=1e-2/3h", "slack=1e-2/0h", "slack=nan/3h"]
)
def test_a_criterion_of_another_form_is_refused(text: str) -> None:
    with pytest.raises(ScenarioError, match="slack=P/TIME"):
        parse_criterion(text)

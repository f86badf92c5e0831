"""What is drawn: distributions, designs, and that every arm sees the same draw."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from tests.support.studies import small_study
from umbilical.studies.designs import child_seed, design_size, points
from umbilical.studies.distributions import Choice, GridPoints, LogUniform, Normal, Uniform
from umbilical.studies.load import load_study
from umbilical.studies.members import Draws

SHARES = np.linspace(0.001, 0.999, 999)
CONTINUUM = [None, None, None]


@pytest.mark.parametrize(
    ("distribution", "truth"),
    [
        (Uniform(kind="uniform", low=-2.0, high=3.0), stats.uniform(-2.0, 5.0)),
        (LogUniform(kind="log-uniform", low=0.5, high=2.0), stats.loguniform(0.5, 2.0)),
        (Normal(kind="normal", mean=1.0, deviation=2.0, cut=1.5), stats.truncnorm(-1.5, 1.5, 1.0, 2.0)),
    ],
)
def test_quantiles_are_those_of_the_distribution(distribution, truth):
    assert np.allclose([distribution.at(share) for share in SHARES], truth.ppf(SHARES), rtol=1e-9)


def test_every_single_value_is_equally_likely():
    chosen = [Choice(kind="choice", values=("a", "b", "c")).at(share) for share in SHARES]
    assert {name: chosen.count(name) for name in "abc"} == {"a": 333, "b": 333, "c": 333}
    assert [GridPoints(kind="grid", low=0.0, high=1.0, count=3).at(share) for share in (0.1, 0.5, 0.9)] == [
        0.0,
        0.5,
        1.0,
    ]


@pytest.mark.parametrize(
    ("low", "high", "step", "expected"),
    [
        (0.0, 1.0, 0.25, {0.0, 0.25, 0.5, 0.75, 1.0}),
        (450.0, 700.0, 100.0, {450.0, 550.0, 650.0}),
        (0.1, 0.4, 0.1, {0.1, 0.2, 0.3, 0.4}),
    ],
)
def test_steps_begin_at_the_lowest_value_and_stay_below_the_highest(low, high, step, expected):
    assert {Uniform(kind="uniform", low=low, high=high, step=step).at(share) for share in SHARES} == expected


def intervals(distribution) -> dict[float, float]:
    """Probability of each value, exactly: the shares at which the quantile function changes, found by bisection."""
    found, below = {}, 0.0
    while below < 1.0:
        value, above = distribution.at(np.nextafter(below, 1.0)), 1.0
        if distribution.at(1.0) != value:
            low = below
            while above - low > 1e-12:
                middle = (low + above) / 2.0
                low, above = (middle, above) if distribution.at(middle) == value else (low, middle)
        found[value], below = above - below, above
    return found


@pytest.mark.parametrize(
    ("distribution", "values"),
    [
        (Uniform(kind="uniform", low=0.0, high=2.0, step=1.0), [0.0, 1.0, 2.0]),
        (Uniform(kind="uniform", low=0.0, high=2.9, step=1.0), [0.0, 1.0, 2.0]),
        (Uniform(kind="uniform", low=0.0, high=1.0, step=0.1), [0.1 * k for k in range(11)]),
        (Uniform(kind="uniform", low=-0.3, high=0.3, step=0.1), [-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3]),
        (Uniform(kind="uniform", low=0.0, high=1e-12, step=2e-13), [0.0, 2e-13, 4e-13, 6e-13, 8e-13, 1e-12]),
        (Uniform(kind="uniform", low=5.0, high=6.0, step=1.0), [5.0, 6.0]),
        (GridPoints(kind="grid", low=1.0, high=7.0, count=7), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]),
        (Choice(kind="choice", values=(3, 1, 2)), [3, 1, 2]),
    ],
)
def test_single_values_are_exactly_as_likely_as_each_other(distribution, values):
    """The first and the last bin too."""
    found = intervals(distribution)
    assert list(found) == pytest.approx(values, abs=1e-15)
    assert list(found.values()) == pytest.approx([1.0 / len(values)] * len(values), abs=1e-9)


@pytest.mark.parametrize("method", ["random", "latin", "sobol", "saltelli", "morris"])
def test_a_design_is_the_same_again_and_another_with_another_seed(method):
    first, again, other = (points(method, 40, CONTINUUM, seed) for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)
    assert first.shape == (design_size(method, 40, CONTINUUM), 3)
    assert first.min() >= 0.0
    assert first.max() <= 1.0


def test_random_draws_do_not_depend_on_how_many_there_are():
    assert np.array_equal(points("random", 10, CONTINUUM, 1), points("random", 1000, CONTINUUM, 1)[:10])


@pytest.mark.parametrize(("method", "even"), [("latin", True), ("sobol", True), ("random", False)])
def test_stratified_designs_cover_every_variable_evenly(method, even):
    """One draw in each of 64 equal strata; independent draws do not manage that."""
    strata = np.floor(64 * points(method, 64, CONTINUUM, 5)).astype(int)
    assert all(np.array_equal(np.sort(column), np.arange(64)) for column in strata.T) == even


def test_every_member_has_a_seed_of_its_own():
    seeds = {child_seed(seed, member) for seed in (0, 1) for member in range(1, 1001)}
    assert len(seeds) == 2000
    assert max(seeds) < 2**63


def test_all_arms_see_the_same_draw_and_nothing_else_differs():
    draws = Draws(small_study())
    member = draws.member(5)
    one, other = (draws.scenario(member, arm) for arm in (0, 1))
    for section in ("cable", "payload", "environment", "winch", "motors", "faults", "grid", "seed"):
        assert getattr(one, section) == getattr(other, section)
    assert one.control.law.kind != other.control.law.kind


def test_members_differ_in_all_that_is_drawn():
    draws = Draws(small_study())
    one, other = (draws.scenario(draws.member(number), 0) for number in (1, 2))
    assert one.payload.mass != other.payload.mass
    assert one.seed != other.seed
    assert one.faults != other.faults


def test_a_relative_factor_multiplies_and_the_controller_does_not_know():
    draws = Draws(small_study())
    member = draws.member(3)
    scenario = draws.scenario(member, 1)
    assert scenario.payload.mass == 500.0 * float(draws.values(member)["payload.mass"])
    assert scenario.control.nominal.payload_mass == 500.0


@pytest.mark.parametrize("kind", ["none", "partial", "dead", "stuck", "ramp", "intermittent"])
def test_every_kind_of_fault_can_be_drawn(kind):
    uniform = {"kind": "uniform", "low": 0.1, "high": 0.9}
    extra = {f"campaigns__1__{name}": uniform for name in ("cycle", "duty")}
    draws = Draws(small_study(campaigns__1__kinds=[kind], **extra))
    faults = draws.scenario(draws.member(1), 0).faults
    assert [fault.kind for fault in faults] == ([] if kind == "none" else [kind])


def test_what_is_set_of_the_scenario_is_the_last_word_on_it():
    study = load_study("paper-robustness")
    assert study.changes["grid.elements"] == 32
    coarse, kept = study.replace({"scenario.grid.elements": 8}), study.replace({"scenario.duration": 1.0})
    grids = [Draws(s).scenario(Draws(s).member(1), 0).grid.elements for s in (coarse, kept)]
    assert grids == [8, 32]
    assert load_study("paper-robustness", {"scenario.grid.elements": 8}) == coarse
    both = study.replace({"scenario.grid.elements": 8, "changes": {"grid.elements": 16}})
    assert Draws(both).scenario(Draws(both).member(1), 0).grid.elements == 16


@pytest.mark.parametrize(
    "distribution",
    ['{kind = "uniform", low = 0.0, high = 100.0, step = 1.0}', '{kind = "grid", low = 1.0, high = 5.0, count = 5}'],
)
def test_whole_numbers_such_as_seeds_of_a_sea_are_drawn_by_steps(distribution, tmp_path):
    text = f"""
name = "seas"
scenario = "work-class-3000m"
members = 3
factors = [
  {{key = "environment.sea.seed", distribution = {distribution}}},
  {{key = "grid.elements", relative = true, distribution = {{kind = "choice", values = [0.5, 2.0]}}}},
]
changes = {{duration = 10.0}}
arms = [{{name = "only"}}]
"""
    (tmp_path / "seas.toml").write_text(text)
    drawn = Draws(load_study(tmp_path / "seas.toml"))
    for number in (1, 2, 3):
        scenario = drawn.scenario(drawn.member(number), 0)
        assert scenario.environment.sea is not None
        assert type(scenario.environment.sea.seed) is int
        assert type(scenario.grid.elements) is int

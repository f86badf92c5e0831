"""The engine's own matrices and the cable without a grid are two ways to one loop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import umbilical
from umbilical.control.cascade import Cascade
from umbilical.errors import ScenarioError
from umbilical.faces.margins import FACE
from umbilical.interop.python_control import to_control
from umbilical.stability.grid import (
    GridDifference,
    GridJudgement,
    check_count,
    margins_on_grid,
    on_grid,
    resolved,
    with_grid_echo,
)
from umbilical.stability.impedance import hanging_cable
from umbilical.stability.judgement import margins_at
from umbilical.stability.limits import find_limits, gain_factor
from umbilical.stability.margins import margins as report
from umbilical.stability.matrix import Counted, MatrixCheck, unstable_eigenvalues
from umbilical.stability.nyquist import Stability, stability, sweep_loop
from umbilical.stability.period import linear_period
from umbilical.stability.sampled import loop_response, sampled_loop

LOW = np.array([0.05, 0.2, 0.4, 0.7, 1.3])


def both(scenario, length: float, thrust: float = 50.0):
    loop = sampled_loop(scenario, thrust)
    return linear_period(scenario, loop, length), loop_response(hanging_cable(scenario, length), loop, 1j * LOW).loop


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"ideal_thruster": True},
        {"control.law.slope_gain": 10.0, "cable.damping": 0.05, "payload.damping": 20.0},
        {"sensors.tip_displacement.latency": 0.002, "sensors.motor_speed.latency": 0.001},
        {"grid.step": 2.5e-4},
        {"cable.wet_line_density": 0.0},
    ],
)
def test_opened_loop_of_the_engine_is_that_of_the_exact_cable(changes):
    period, exact = both(umbilical.load("ringdown", {"grid.elements": 24} | changes), 300.0)
    np.testing.assert_allclose(period.transfer(LOW), exact, rtol=1e-5)


def test_with_an_outer_law_at_its_own_period():
    slow = {f"control.{name}_observer.time_constant": 0.01 for name in ("velocity", "slope")}
    scenario = umbilical.load("ringdown", {"grid.elements": 24, "control.outer_period": 0.004} | slow)
    period, exact = both(scenario, 300.0)
    np.testing.assert_allclose(period.transfer(LOW), exact, rtol=1e-5)


def test_another_length_would_be_noticed():
    scenario = umbilical.load("ringdown", {"grid.elements": 24})
    period, _ = both(scenario, 300.0)
    _, other = both(scenario, 303.0)
    assert np.abs(period.transfer(LOW) / other - 1.0).max() > 1e-2


def test_it_is_the_jacobian_of_the_engine_with_its_motors():
    """A pulse of force against none in two real runs, and the same from the matrix, motors at 100 N."""
    base = {
        "grid.elements": 4, "winch": {"law": "constant", "length": 100.0}, "duration": 40.5, "output.interval": 0.005,
        "initial": {"shape": "straight"}, "control.law.slope_gain": 2.0, "cable.damping": 2.0,
        "environment.payload_force": [{"kind": "constant", "value": 100.0}],
    }  # fmt: skip
    size, start = 1e-3, 40.0
    pulse = {"kind": "pulse", "value": size, "start": start, "end": start + 0.005}
    with_pulse = {"environment.payload_force": [*base["environment.payload_force"], pulse]}
    quiet, pushed = (umbilical.simulate(umbilical.load("ringdown", base | extra)) for extra in ({}, with_pulse))
    moved = ((pushed["tip_displacement"] - quiet["tip_displacement"]).values / size)[round(start / 0.005) :]
    scenario = umbilical.load("ringdown", base)
    period = linear_period(scenario, sampled_loop(scenario, 100.0), 100.0)
    n, size = period.a.shape[0], period.closed.shape[0]
    force = np.zeros(size)
    force[10 * 4] = 1e-3 / scenario.payload.mass
    state, expected = np.zeros(size), []
    for k in range(501):
        if k % 5 == 0:
            expected.append(period.c[0] @ state[:n])
        state = period.closed @ state + (force if k < 5 else 0.0)
    np.testing.assert_allclose(moved, expected, atol=0.01 * np.abs(expected).max())
    assert np.abs(expected).max() > 1e-9


def test_eigenvalues_count_what_nyquist_counts():
    """The closed matrix of a small grid against the count with that grid's echo, below and above its limit."""
    scenario = umbilical.load("ringdown", {"grid.elements": 12})
    loop = sampled_loop(scenario, 50.0)
    period = linear_period(scenario, loop, 100.0)
    echoed, _ = with_grid_echo(sweep_loop(hanging_cable(scenario, 100.0), loop), period, 12)
    limit = find_limits(echoed).gain_high.size
    for gain, stable in ((0.98 * limit, True), (1.02 * limit, False)):
        assert (unstable_eigenvalues(period.scaled(gain))[0] == 0) is stable
        assert (stability(echoed, gain_factor(gain)).unstable == 0) is stable


@pytest.mark.parametrize("gain", [2.0, 4.0])
def test_a_grids_false_echoes_at_the_rov_are_followed(gain):
    """They repeat with the modes and decide whether a mode grows by 1e-5 1/s; too few frequencies missed it."""
    scenario = on_grid(umbilical.load("paper"), 450.0, 25)
    exact = margins_at(scenario, 450.0)
    period = linear_period(scenario, exact.sweep.loop, 450.0)
    echoed, _ = with_grid_echo(exact.sweep, period, 25)
    assert stability(echoed, gain_factor(gain)).unstable == unstable_eigenvalues(period.scaled(gain))[0]


def test_later_readings_in_the_matrix_are_a_delay():
    period, _ = both(umbilical.load("ringdown", {"grid.elements": 8}), 100.0)
    delayed = np.exp(-1j * LOW * 3 * period.period) * period.transfer(LOW)
    np.testing.assert_allclose(period.later(3).transfer(LOW), delayed, rtol=1e-9)


def test_eigenvalues_of_the_closed_matrix_are_part_of_the_report():
    found = report(umbilical.load("ringdown"), elements=(8, 12, 16))
    assert found.check is not None
    assert found.check.elements == 8
    assert found.check.agrees
    assert {count.eigenvalues > 0 for count in found.check.counts} == {True, False}
    disagreeing = MatrixCheck(8, 100, (Counted("as it is", 0, 2, 0),))
    assert not disagreeing.agrees
    assert MatrixCheck(8, 100, (Counted("as it is", 2, 0, 2),)).agrees
    assert not replace(found, check=disagreeing).resolved
    assert FACE.conclusion(replace(found, check=disagreeing)).decision == "UNRESOLVED"


@pytest.mark.parametrize(("length", "damping"), [(100.0, 1.0), (1000.0, 0.4), (3000.0, 10.0)])
def test_on_a_damped_cable_a_grids_own_reflection_is_no_echo(length, damping):
    """Over the exact echo, which fades to nothing, it is as large as one likes: once counted as thousands of poles."""
    scenario = umbilical.load("ringdown", {"cable.damping": damping})
    exact = margins_at(scenario, length)
    grid = on_grid(scenario, length, 12)
    period = linear_period(grid, exact.sweep.loop, length)
    echoed, _ = with_grid_echo(exact.sweep, period, 12)
    assert np.abs(echoed.echo).max() < 1.001
    assert exact.stability.unstable == stability(echoed).unstable == unstable_eigenvalues(period)[0] == 0
    assert check_count(scenario, exact, (12,)).agrees


def test_the_finest_grid_must_agree_and_the_next_be_near():
    at = [GridJudgement(n, Stability(0, 0, None), None, GridDifference("delay", 1.0, 1.0, d), 1.0)
          for n, d in ((8, 0.5), (16, 0.07), (32, 0.019), (64, 0.03))]  # fmt: skip
    assert resolved(at[:3])
    assert not resolved(at[1:])
    assert not resolved((at[0], at[0], at[2]))
    assert resolved(at[1:3])
    assert not resolved(at[3:])


def test_few_grids_that_disagree_leave_margins_unresolved_and_few_that_agree_prove_nothing():
    found = report(umbilical.load("ringdown"), [100.0], elements=(8, 12))
    close, far = (replace(found.grids[-1], differs=GridDifference("delay", 1.0, 1.0, size)) for size in (0.01, 0.3))
    assert replace(found, grids=(close,)).resolved is None
    apart = replace(found, grids=(far,))
    assert (apart.resolved, FACE.conclusion(apart).decision) == (False, "UNRESOLVED")
    assert f"{far.elements} elements" in FACE.conclusion(apart).headline


def test_a_controller_in_the_place_of_lengths_is_told_where_it_goes():
    for wrong in (Cascade(umbilical.load("ringdown")), "long"):
        with pytest.raises(ScenarioError, match="goes in as controller="):
            report(umbilical.load("ringdown"), wrong)  # pyright: ignore[reportArgumentType]


def test_margins_of_a_controller_in_python_are_those_of_the_same_law_built_in():
    scenario = umbilical.load("ringdown", {"ideal_thruster": True})
    own, built_in = report(scenario, controller=Cascade(scenario)), report(scenario)
    assert own.controller == "Cascade"
    one, other = own.judgements[0].margins, built_in.judgements[0].margins
    assert one is not None
    assert other is not None
    assert one.gain_high.size == pytest.approx(other.gain_high.size, rel=1e-6)
    assert one.delay.size == pytest.approx(other.delay.size, rel=1e-6)


def test_a_controller_that_its_linearisation_does_not_speak_for_is_unresolved():
    found = report(umbilical.load("ringdown"), controller=Cascade(umbilical.load("ringdown")))
    assert (found.stable, found.resolved, found.judgements) == (False, False, ())
    assert "voltages itself" in found.doubt


def test_progress_is_told_after_every_part():
    shares: list[float] = []
    report(umbilical.load("ringdown"), [50.0, 100.0], elements=(8, 12), progress=shares.append)
    assert shares == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0])


def test_loops_that_are_unstable_both_ways_are_compared_by_poles_and_growth():
    """A short cable whose waves of 100 rad/s some grids carry: they grow there, too, but in fewer modes."""
    scenario = umbilical.load("ringdown", {"control.law.slope_gain": 20.0})
    exact = margins_at(scenario, 40.0)
    grids = tuple(margins_on_grid(scenario, exact, n) for n in (30, 40))
    assert not exact.stable
    for grid in grids:
        assert grid.stability.unstable > 0
        assert grid.differs.name == "unstable poles"
        assert grid.difference == pytest.approx(1.0 - grid.stability.unstable / exact.stability.unstable)
    assert not resolved((grids[0], *grids))


@pytest.mark.slow
@pytest.mark.parametrize("beta", [20.0, 35.0])
def test_what_is_the_cables_and_what_the_grids(beta):
    """At 100 and 400 nodes the loop seems stable; 1600 nodes carry the waves that the ROV feeds, as a cable does."""
    scenario = umbilical.load("ringdown", {"control.law.slope_gain": beta})
    exact = margins_at(scenario, 400.0)
    grids = tuple(margins_on_grid(scenario, exact, n) for n in (25, 100, 400))
    assert [grid.stability.unstable > 0 for grid in grids] == [False, False, True]
    assert not exact.stable
    assert not resolved(grids)
    worst, fine = exact.stability.worst, grids[-1].stability.worst
    assert worst is not None
    assert fine is not None
    assert fine.frequency == pytest.approx(worst.frequency, rel=0.1)
    assert fine.rate == pytest.approx(worst.rate, rel=0.1)
    assert [grid.heard < worst.frequency for grid in grids] == [True, True, False]


def test_margins_by_matrix_agree_where_the_grid_is_fine_enough():
    scenario = umbilical.load("ringdown")
    exact = margins_at(scenario, 400.0)
    grids = tuple(margins_on_grid(scenario, exact, n) for n in (16, 64, 128))
    assert grids[0].difference > 0.02
    assert grids[0].difference == pytest.approx(abs(grids[0].differs.grid / grids[0].differs.exact - 1.0))
    assert grids[-1].difference < 0.02
    assert resolved(grids)


def test_to_control_says_the_same():
    control = pytest.importorskip("control")
    scenario = umbilical.load("ringdown", {"grid.elements": 8})
    systems = to_control(scenario, length=100.0)
    period = linear_period(scenario, sampled_loop(scenario, 50.0), 100.0)
    theirs = control.frequency_response(systems["loop"], LOW).complex.ravel()
    np.testing.assert_allclose(theirs, period.transfer(LOW), rtol=1e-6)
    ours, closed = (np.sort(np.abs(x)) for x in (np.linalg.eigvals(period.closed), systems["closed"].poles()))
    np.testing.assert_allclose(closed, ours, atol=1e-6)
    assert systems["loop"].dt == 1e-3
    product = control.series(systems["plant"], systems["controller"])
    np.testing.assert_allclose(control.frequency_response(product, LOW).complex.ravel(), theirs, rtol=1e-6)


def test_gain_margin_of_python_control_is_ours():
    control = pytest.importorskip("control")
    scenario = umbilical.load("ringdown", {"grid.elements": 12})
    loop = sampled_loop(scenario, 50.0)
    period = linear_period(scenario, loop, 100.0)
    echoed, _ = with_grid_echo(sweep_loop(hanging_cable(scenario, 100.0), loop), period, 12)
    limit = find_limits(echoed).gain_high.size
    opened = to_control(scenario, length=100.0)["loop"]
    for gain, stable in ((0.99 * limit, True), (1.01 * limit, False)):
        closed = control.feedback(gain * opened, 1, sign=1)
        assert bool(np.abs(closed.poles()).max() <= 1.0 + 1e-9) is stable

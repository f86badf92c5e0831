"""Nyquist's count and the margins, against poles that are solved for and against classical limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import umbilical
from tests.support.spectra import tip_response
from umbilical.errors import ScenarioError
from umbilical.scenario.document import assignment
from umbilical.stability.impedance import hanging_cable
from umbilical.stability.judgement import check_loop, margins_at, margins_of, usual_lengths, usual_thrust
from umbilical.stability.limits import delay_factor, find_limits, gain_factor, phase_factor
from umbilical.stability.nyquist import resolved_ratio, stability, sweep_loop
from umbilical.stability.sampled import ALIASES, alias_sum, loop_response, sampled_loop

RINGDOWN = umbilical.load("ringdown")
CABLE, LOOP = hanging_cable(RINGDOWN, 400.0), sampled_loop(RINGDOWN, 50.0)


def boundary(beta: float, **changes):
    return umbilical.load("ringdown", {"control.law.slope_gain": beta, **changes})


@pytest.mark.parametrize("beta", [0.01, 1.0, 10.0, 20.0])
def test_ideal_reflection_at_low_frequency(beta):
    """(c_l - beta)/(c_l + beta), as long as observers, motors and the period are fast against the wave."""
    found = margins_at(boundary(beta, ideal_thruster=True), 400.0)
    ideal = (50.0 - beta) / (50.0 + beta)
    first_modes = found.reflection[(found.frequency > 0.3) & (found.frequency < 1.0)]
    np.testing.assert_allclose(first_modes, ideal, rtol=0.01)


def test_without_thrust_it_is_the_free_rov():
    response = loop_response(replace(CABLE, damping=0.0), LOOP, 1j * np.geomspace(0.1, 1000.0, 40))
    np.testing.assert_allclose(np.abs(response.reflection(0.0)), 1.0, rtol=1e-4)


def test_opened_loop_is_controller_times_cable():
    """At a frequency where the aliases are small: the parts multiplied by hand."""
    scenario = boundary(5.0, ideal_thruster=True)
    loop, p = sampled_loop(scenario, 50.0), np.array([0.31j])
    y, slope = tip_response(CABLE, p)
    law = loop.law.response(np.exp(p * 1e-3))[0, 0]
    hold = (1.0 - np.exp(-p * 1e-3)) / (p * 1e-3)
    assert loop_response(CABLE, loop, p).loop[0] == pytest.approx((hold * (law[0] * y + law[1] * slope))[0], rel=1e-3)


def test_alias_sum_has_its_tail(monkeypatch):
    """Twenty times as many aliases change nothing; without the tail they would."""
    loop, p = sampled_loop(boundary(5.0, ideal_thruster=True), 50.0), 1j * np.geomspace(1.0, 3000.0, 20)
    short = alias_sum(CABLE, loop, p)
    long = alias_sum(CABLE, loop, p, 20 * ALIASES)
    scale = np.abs(long).max(axis=0)
    np.testing.assert_allclose((short / scale)[:, :3], (long / scale)[:, :3], atol=2e-4)
    monkeypatch.setattr("scipy.special.polygamma", lambda n, x: 0.0)
    assert np.abs((alias_sum(CABLE, loop, p) - long) / scale)[:, 1].max() > 2e-3


def test_the_count_is_the_number_of_poles_that_grow():
    """At beta = 1 the poles next to every whole turn are solved for one by one."""
    from umbilical.stability.judgement import _polished
    from umbilical.stability.nyquist import near_poles

    swept = sweep_loop(replace(CABLE, length=60.0), sampled_loop(boundary(1.0), 50.0))
    poles = np.array([_polished(swept, p) for p in near_poles(swept, 120)])  # up to 300 rad/s
    found = stability(swept)
    assert found.endless == 0
    assert found.unstable == 2 * int((np.real(poles) > 0.0).sum()) > 50
    assert found.worst is not None
    assert found.worst.rate == pytest.approx(np.real(poles).max(), rel=0.02)


def test_a_loop_of_the_wrong_sign_is_unstable():
    wrong = replace(LOOP, drives=tuple(replace(d, weight=-d.weight) for d in LOOP.drives))
    assert stability(sweep_loop(CABLE, LOOP)).unstable == 0
    found = stability(sweep_loop(CABLE, wrong))
    assert found.endless > 0
    assert found.unstable > 0


def test_motor_gains_beyond_the_period_are_seen():
    """A filter of the motor's disturbance that the period cannot follow makes the inner loop unstable."""
    late = boundary(0.01, **{"sensors.motor_current.latency": 0.006, "control.motor_loop.current_gain": 850.0})
    assert stability(sweep_loop(CABLE, sampled_loop(late, 50.0))).endless > 0


@pytest.mark.parametrize("name", ["gain_high", "phase", "delay"])
def test_a_limit_separates_stable_from_unstable(name):
    swept = sweep_loop(CABLE, LOOP)
    limit = getattr(find_limits(swept), name).size
    change = {"gain_high": gain_factor, "phase": phase_factor, "delay": delay_factor}[name]
    sides = [change(share * limit) for share in (0.98, 1.03)]
    if name == "phase":
        sides += [change(-share * limit) for share in (0.98, 1.03)]
    counts = [stability(swept, side).unstable for side in sides]
    assert counts[0] == 0
    assert max(counts[1::2]) > 0


@pytest.mark.parametrize("offset", [1e-1, 1e-3, -1e-3, 1e-5])
def test_a_peak_between_two_frequencies_is_seen(offset):
    """1/(offset + j (w - w0)) between samples 0.5 apart: its largest value, and once around where that is right."""
    w = np.arange(0.0, 10.0, 0.5)
    at, ratio = resolved_ratio(w, np.ones_like(w, dtype=complex), offset + 1j * (w - 3.3))
    assert np.abs(ratio).max() == pytest.approx(1.0 / abs(offset), rel=0.05)
    np.testing.assert_allclose(ratio, 1.0 / (offset + 1j * (at - 3.3)), rtol=1e-6)
    assert (np.diff(at) > 0.0).all()


def test_close_to_the_limit_of_the_endless_cable_an_echo_is_counted():
    """Over the last milliseconds before the cable without an end is unstable, too, the count only grows."""
    swept = sweep_loop(replace(CABLE, damping=0.1, length=30.0), LOOP)
    limit = find_limits(swept).delay.size
    counts = [stability(swept, delay_factor(limit * (1.0 + share))) for share in np.geomspace(1e-3, 0.1, 40)]
    assert counts[0].endless == 0
    assert counts[-1].endless > 0
    assert all(found.unstable >= 2 for found in counts)


def test_delay_limit_is_that_of_late_sensors():
    """Both readings of the ROV n periods late is n periods of delay in the loop."""
    limit = find_limits(sweep_loop(CABLE, LOOP)).delay.size
    for extra, stable in ((-0.002, True), (0.002, False)):
        age = round(1e3 * (limit + extra)) * 1e-3
        late = {f"sensors.{name}.latency": age for name in ("tip_displacement", "tip_slope")}
        assert margins_of(CABLE, sampled_loop(boundary(0.01, **late), 50.0)).stable is stable


def test_an_outer_law_at_its_own_period():
    """With an ideal thruster it makes no difference which of the two periods is the longer one."""
    times = {f"control.{name}_observer.time_constant": 0.01 for name in ("velocity", "slope")}
    p = 1j * np.geomspace(0.1, 700.0, 30)
    slow = boundary(5.0, **times, **{"ideal_thruster": True, "control.outer_period": 0.004})
    same = boundary(5.0, **times, **{"ideal_thruster": True, "control.period": 0.004, "output.interval": 0.04})
    one, other, fast = (
        loop_response(CABLE, sampled_loop(s, 50.0), p).loop
        for s in (slow, same, boundary(5.0, **times, ideal_thruster=True))
    )
    np.testing.assert_allclose(one, other, rtol=1e-9)
    assert np.abs(fast / other - 1.0).max() > 0.1


def test_lengths_and_thrust_of_a_run():
    paper = umbilical.load("paper")
    assert usual_lengths(paper) == (450.0, 475.0, 500.0)
    assert usual_thrust(paper) == pytest.approx(100.0, rel=0.05)
    assert usual_thrust(RINGDOWN) == 50.0


def test_no_loop_no_margins():
    with pytest.raises(ScenarioError, match="closes a loop") as refused:
        check_loop(umbilical.load("paper-none"))
    keys, tried = refused.value.problems[0].fix.split(";")
    assert tried == " tried, stable"
    followed = umbilical.load("paper-none", dict(map(assignment, keys.split(" with "))))
    assert all(margins_at(followed, length).stable for length in usual_lengths(followed))

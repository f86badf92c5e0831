"""C10 and C11: observers against differences of the same noisy samples, and fault control against none."""

from __future__ import annotations

import numpy as np
import pytest

from tests.papers.test_claims import given
from umbilical.control.observers.high_gain import (
    HighGainMemory,
    advance_high_gain,
    derivative_estimate,
    make_high_gain,
    start_high_gain,
)
from umbilical.papers.rao2022 import claims_faults, claims_sensing, differentiation
from umbilical.papers.rao2022.differentiation import RIVALS, Errors, crossing, errors, noise_gain, observer, rival
from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.ledger import Evidence, Verdict
from umbilical.scenario.control import HighGainObserver

PERIOD, EPS = 1e-3, 5e-3
TIME = np.arange(40_000) * PERIOD


def by_the_controller(samples: np.ndarray) -> np.ndarray:
    """The estimate as the controller's own observer makes it."""
    made = make_high_gain(HighGainObserver(time_constant=EPS, damping=2.0), PERIOD)
    state, found = HighGainMemory.one(), np.zeros(samples.size)
    start_high_gain(state, samples[0])
    for k in range(1, samples.size):
        advance_high_gain(made, state, samples[k])
        found[k] = derivative_estimate(made, state)
    return found


def test_the_filter_is_the_controllers_observer() -> None:
    from scipy.signal import lfilter

    samples = np.random.default_rng(1).normal(size=500)
    ours = lfilter(*observer(EPS, PERIOD), samples - samples[0])
    assert ours[1:] == pytest.approx(by_the_controller(samples)[1:], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", ["observer", *RIVALS])
def test_errors_add_as_squares_of_lag_and_noise(name: str) -> None:
    """Held against an error that was made with noise, not composed."""
    from scipy.signal import lfilter

    filter_ = observer(EPS, PERIOD) if name == "observer" else rival(name, EPS, PERIOD)
    samples, rate, noise = np.sin(3.0 * TIME), 3.0 * np.cos(3.0 * TIME), 1e-3
    parts = errors(filter_, samples, rate)
    noisy = samples + noise * np.random.default_rng(2).normal(size=samples.size)
    found = np.sqrt(np.mean((lfilter(*filter_, noisy - noisy[0]) - rate) ** 2))
    assert found == pytest.approx(parts.at(noise), rel=0.05)
    assert parts.lag < 0.12


def test_gains_of_noise_are_those_of_theory() -> None:
    """White noise of density h: ``sqrt(h/(4 eps^3))`` for the observer; the sum of two samples for a difference."""
    assert noise_gain(rival("difference", EPS, PERIOD)) == pytest.approx(np.sqrt(2.0) / PERIOD)
    assert noise_gain(observer(0.05, PERIOD)) == pytest.approx(np.sqrt(PERIOD / (4.0 * 0.05**3)), rel=1e-3)
    pole = np.exp(-PERIOD / (2.0 * EPS))
    expected = (1.0 - pole) / PERIOD * np.sqrt(2.0 / (1.0 + pole))
    assert noise_gain(rival("one pole", EPS, PERIOD)) == pytest.approx(expected)


def test_rivals_lag_as_much_as_the_observer() -> None:
    """A slow cosine, which starts at rest: a lag near ``2 eps``, and the gain that the held sample takes."""
    w, r = 0.5, PERIOD / EPS
    gain = (0.5 * r / np.sinh(0.5 * r)) ** 2
    missed = {"observer": 1.0 - gain, "one pole": 0.0, "two poles": 0.0}
    for name, less in missed.items():
        filter_ = observer(EPS, PERIOD) if name == "observer" else rival(name, EPS, PERIOD)
        found = errors(filter_, np.cos(w * TIME), -w * np.sin(w * TIME)).lag
        assert found == pytest.approx(np.hypot(2.0 * EPS * w**2, less * w) / np.sqrt(2.0), rel=0.1), name


def test_where_errors_cross() -> None:
    late, loud = Errors(3.0, 1.0), Errors(1.0, 3.0)
    at = crossing(late, loud)
    assert late.at(at) == pytest.approx(loud.at(at))
    assert (crossing(loud, late), crossing(Errors(1.0, 1.0), loud)) == (np.inf, 0.0)
    assert crossing(Errors(1.0, 2.0), Errors(2.0, 2.0)) == 0.0


def test_an_observer_that_is_no_better_fails(evidence: Evidence, monkeypatch: pytest.MonkeyPatch) -> None:
    assert claims_sensing.c10(evidence).verdict is Verdict.CONDITIONAL
    with monkeypatch.context() as patch:
        patch.setattr(claims_sensing, "observer", lambda eps, h: rival("difference", eps, h))
        assert claims_sensing.c10(evidence).verdict is Verdict.FAILS
    with monkeypatch.context() as patch:
        patch.setattr(
            claims_sensing, "rival", lambda name, eps, h: differentiation.Filter(np.full(1, 1e-12), np.ones(1))
        )
        assert claims_sensing.c10(evidence).verdict is not Verdict.HOLDS
        patch.setattr(claims_sensing, "rival", lambda name, eps, h: differentiation.Filter(np.full(2, 1e9), np.ones(1)))
        assert claims_sensing.c10(evidence).verdict is Verdict.HOLDS


def test_fault_control_is_held_against_no_control(evidence: Evidence, runs: Runs) -> None:
    assert claims_faults.c11(evidence).verdict is Verdict.HOLDS
    idle = given(evidence, dead__with=runs["free"])
    assert claims_faults.c11(idle).verdict is Verdict.CONDITIONAL
    assert claims_faults.c11(idle).values["kept"] == ["none", "stuck", "partial"]
    cases = {f"{case}__with": runs["free"] for case in ("none", "dead", "stuck", "partial")}
    assert claims_faults.c11(given(evidence, **cases)).verdict is Verdict.FAILS
    lost = given(evidence, stuck__with=runs["blind, stuck, with"])
    assert claims_faults.c11(lost).verdict is Verdict.CONDITIONAL

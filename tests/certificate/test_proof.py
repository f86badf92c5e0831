"""The verifier: it says no to every certificate that is a little wrong, and its winch holds the true one."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from mpmath.ctx_iv import MPIntervalContext

import umbilical
from tests.support.certificates import GAIN, fixed, hauled_in
from umbilical.certificate import Certificate, Proof, Weights
from umbilical.certificate.conditions import ALONG, terms_of
from umbilical.certificate.proof import prove
from umbilical.certificate.proof_motion import motion_over
from umbilical.certificate.setting import Payout, ideal_constants, slab_edges
from umbilical.plant import winch as laws
from umbilical.scenario.winch import ConstantLength, ConstantSpeed, Cosine, Quintic, TabulatedLength, Trapezoid, Winch

LAWS: list[Winch] = [
    ConstantLength(law="constant", length=300.0),
    ConstantSpeed(law="speed", start_length=300.0, speed=-1.5),
    Quintic(law="quintic", start_length=400.0, end_length=350.0, start=3.0, duration=20.0),
    Trapezoid(law="trapezoid", start_length=400.0, end_length=430.0, top_speed=2.0, acceleration=0.3, start=2.0),
    Trapezoid(law="trapezoid", start_length=430.0, end_length=425.0, top_speed=2.0, acceleration=0.3, start=2.0),
    Cosine(law="cosine", start_length=300.0, amplitude=10.0, frequency=0.4),
    TabulatedLength(law="table", times=(0.0, 8.0, 15.0, 30.0), lengths=(300.0, 310.0, 305.0, 320.0)),
]


@pytest.fixture(scope="module")
def paying_out() -> Certificate:
    return umbilical.certify(umbilical.load("paper", {GAIN: 5.0}))


@pytest.fixture(scope="module")
def hauling_in() -> Certificate:
    return umbilical.certify(hauled_in(5.0))


def again(certificate: Certificate, rates: Any = None, **changes: float) -> Proof:
    """The proof with some numbers changed."""
    weights = certificate.weights._replace(**changes)
    winch = certificate.scenario.winch
    claimed = certificate.rates if rates is None else rates
    return prove(certificate.loop, winch, certificate.edges, claimed, weights, strict=False)


def opened(proof: Proof) -> set[str]:
    return {name for name, _, _ in proof.open}


def test_what_was_found_is_proved_again(paying_out: Certificate, hauling_in: Certificate) -> None:
    assert again(paying_out).holds
    assert again(hauling_in).holds


@pytest.mark.parametrize(
    ("changes", "condition"),
    [
        ({"cross": 1.002}, "K2"),
        ({"boundary": 0.998}, "K3"),
        ({"cross": 0.99}, "K5"),
    ],
)
def test_weights_a_little_wrong_are_noticed(paying_out: Certificate, changes: dict[str, float], condition: str) -> None:
    wrong = {name: getattr(paying_out.weights, name) * factor for name, factor in changes.items()}
    assert condition in opened(again(paying_out, **wrong))


def test_rates_a_little_too_large_are_noticed(paying_out: Certificate) -> None:
    assert opened(again(paying_out, paying_out.rates * 1.003)) == {"K5"}


def test_one_slab_a_little_too_large_is_noticed_where_it_is(paying_out: Certificate) -> None:
    rates = paying_out.rates.copy()
    rates[17] *= 1.01
    ((name, begin, end),) = again(paying_out, rates).open
    assert name == "K5"
    assert paying_out.edges[17] <= begin < end <= paying_out.edges[18]


def test_hauling_in_without_its_price_is_noticed(hauling_in: Certificate) -> None:
    assert opened(again(hauling_in, vessel=0.99)) == {"K4"}


def test_a_gain_of_the_observer_below_the_rate_is_noticed(paying_out: Certificate) -> None:
    loop = paying_out.loop._replace(k_s=0.01)
    found = prove(loop, paying_out.scenario.winch, paying_out.edges, paying_out.rates, paying_out.weights, strict=False)
    assert opened(found) == {"K6"}


def test_a_corner_of_zeros_does_not_let_the_other_corner_pass() -> None:
    """Without damping, lam and rate M is [[0, 0], [0, T j/2]]: its determinant is 0, and with j < 0 it is no sum of
    squares. The same with lam > 0 and a rate of lam, where only the far corner says no."""
    scenario = umbilical.load("paper", {GAIN: 5.0, "cable.damping": 0.0})
    loop, edges = ideal_constants(scenario), slab_edges(scenario.winch, scenario.duration)
    for cross, condition in ((0.0, "weights"), (1e-3, "K5")):
        rates = np.full(edges.size - 1, cross)
        proof = prove(loop, scenario.winch, edges, rates, Weights(cross, 0.0, 0.5), strict=False)
        assert condition in opened(proof)


@pytest.mark.parametrize("cross", [0.0, -1e-6])
def test_a_weight_that_is_not_positive_is_noticed(paying_out: Certificate, cross: float) -> None:
    """With a rate that asks for nothing, so that no other condition speaks."""
    rates = np.full(paying_out.rates.shape, -1.0)
    assert again(paying_out, rates).holds
    assert opened(again(paying_out, rates, cross=cross)) == {"weights"}


def test_a_rate_that_is_no_number_is_never_proved(paying_out: Certificate) -> None:
    assert not again(paying_out, np.full(paying_out.rates.shape, np.nan)).holds


def test_a_cable_of_fixed_length_takes_one_box() -> None:
    assert umbilical.certify(fixed(20.0)).proof == Proof(True, 1)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.law)
def test_boxes_hold_the_winch(law: Winch) -> None:
    """Random boxes between the jumps hold length and derivatives at every instant inside, and shrink onto them."""
    ctx: Any = MPIntervalContext()
    marks = np.unique(np.clip([0.0, *laws.jumps(law), 30.0], 0.0, 30.0))
    dice = np.random.default_rng(0)
    for begin, end in pairwise(marks):
        for width in (1.0, 1e-2, 1e-4):
            low = float(begin + dice.uniform(0.0, 1.0 - width) * (end - begin))
            high = float(low + width * (end - begin)) if width < 1.0 else float(end)
            low = low if width < 1.0 else float(begin)
            boxes = motion_over(ctx, law, low, high)
            inside = laws.evaluate(law, np.linspace(low, high, 41)[1:-1])
            for box, values in zip(boxes, inside, strict=True):
                floor, roof = float(box.a), float(box.b)
                reach = 1e-12 * max(abs(floor), abs(roof), 1e-3)
                assert floor - reach <= values.min()
                assert values.max() <= roof + reach
                if width == 1e-4:
                    assert roof - floor < 10.0 * np.ptp(values) + 1e-3


def test_a_wrong_winch_falls_out_of_the_boxes() -> None:
    ctx: Any = MPIntervalContext()
    law = LAWS[2]
    assert isinstance(law, Quintic)
    wrong = law.model_copy(update={"end_length": 350.5})
    box = motion_over(ctx, law, 12.0, 12.001)[1]
    assert not float(box.a) <= float(laws.evaluate(wrong, 12.0005).speed) <= float(box.b)


def test_a_winch_faster_than_the_waves_proves_nothing(paying_out: Certificate) -> None:
    """At the vessel the waves of 300 m of the paper's cable travel at 74 m/s."""
    loop, weights = paying_out.loop, paying_out.weights
    for speed, wave in ((70.0, False), (80.0, True)):
        winch = ConstantSpeed(law="speed", start_length=300.0, speed=speed)
        proof = prove(loop, winch, np.array([0.0, 0.01]), np.array([1e-3]), weights, strict=False)
        assert ("wave" in opened(proof)) is wave


@pytest.mark.parametrize("name", ["K0", "K5"])
def test_what_holds_at_both_ends_holds_between(paying_out: Certificate, name: str) -> None:
    """K0 and K5 at a point between, as the end of a cable cut off there: nowhere less than at both ends."""
    rng, loop, motion = np.random.default_rng(3), paying_out.loop, Payout(0.0, 400.0, 0.5, 0.1, 9.0, 0.2)
    for _ in range(50):
        weights = Weights(*rng.normal(0.0, (0.01, 3.0, 1.0)))
        rate = float(rng.normal(0.0, 0.02))
        at_ends = np.reshape(list(ALONG[name](terms_of(loop, weights, motion), rate)), (2, -1))
        for x in rng.uniform(0.0, motion.l, 20):
            cut = weights._replace(vessel=weights.vessel + weights.cross * x), motion._replace(l=motion.l - x)
            here = np.reshape(list(ALONG[name](terms_of(loop, *cut), rate)), (2, -1))[0]
            assert (here >= at_ends.min(axis=0) - 1e-9 * np.abs(at_ends).max(axis=0)).all()

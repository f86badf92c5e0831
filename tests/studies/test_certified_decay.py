"""No certified rate exceeds the decay that a simulation of the ideal loop shows: 200 random gains, winch at rest,
paying out and hauling in, starts compatible at the ROV."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import islice
from typing import Any, NamedTuple

import numpy as np
import pytest

import umbilical
from tests.support.certificates import GAIN
from umbilical import Certificate
from umbilical.certificate import bound
from umbilical.errors import ScenarioError
from umbilical.studies.audit import ideal_loop, largest_ratio, lyapunov_of_run

GAINS, DURATION, EXCESS = 200, 16.0, 1e-3
WORKERS = 2
NAMES = (GAIN, "control.law.damping_gain", "control.disturbance_observer.gain", "cable.damping")


def a_winch(dice: np.random.Generator, kind: int) -> dict[str, Any]:
    """At rest, at one speed, or with acceleration and jerk; in and out alike."""
    length, speed = float(dice.uniform(150.0, 600.0)), float(dice.uniform(-2.0, 2.0))
    if kind == 0:
        return {"law": "constant", "length": length}
    if kind == 1:
        return {"law": "speed", "start_length": length, "speed": speed}
    end = length + 0.4 * DURATION * speed
    return {"law": "quintic", "start_length": length, "end_length": end, "duration": DURATION}


def drawn() -> Iterator[Certificate]:
    """Certificates that hold, of random gains, cables and winches; those that do not are passed over.

    The start is a bump far from the ROV, so that u_a = 0 there, and D~ = 0.
    """
    dice, kind = np.random.default_rng(11), 0
    while True:
        kind = (kind + 1) % 3
        winch = a_winch(dice, kind)
        length = winch["length"] if kind == 0 else winch["start_length"]
        gains = 10.0 ** dice.uniform([-1.0, 3.3, -0.3, -4.0], [1.7, 4.3, 1.3, -1.5])
        change = dict(zip(NAMES, map(float, gains), strict=True))
        bump = {"shape": "gaussian", "amplitude": 1.0, "distance": length / 2.0, "width": length / 12.0}
        fixed = {"winch": winch, "initial": bump, "duration": DURATION, "grid.elements": 24, "output.interval": 0.05}
        try:
            scenario = umbilical.load("ringdown", fixed | change)
        except ScenarioError:  # gains that the observers of the real loop cannot carry
            continue
        certificate = umbilical.certify(scenario, fix=False)
        if certificate.holds:
            yield certificate


class Seen(NamedTuple):
    """What a simulation says of a certificate: V over its envelope at worst; mean decay, 1/s, over the certified
    rate; the same with five times the rate claimed; how the winch ran."""

    excess: float
    decay: float
    boast: float
    law: str
    speed: float


def seen(certificate: Certificate) -> Seen:
    perfect = ideal_loop(certificate.scenario).replace({"output.interval": 0.05})
    run = umbilical.simulate(perfect)
    assert run.status is umbilical.Status.COMPLETED
    time, value = lyapunov_of_run(run, certificate)
    start = float(value[0])
    decay = -np.log(value[-1] / start) / time[-1]
    boast = replace(certificate, rates=5.0 * certificate.rates)
    return Seen(
        largest_ratio(value, bound(certificate, time, start)),
        decay / certificate.rate,
        largest_ratio(value, bound(boast, time, start)),
        certificate.scenario.winch.law,
        float(run["payout_speed"].values.mean()),
    )


@pytest.fixture(scope="module")
def simulated() -> list[Seen]:
    with ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(seen, islice(drawn(), GAINS)))


@pytest.mark.slow
def test_no_simulation_decays_more_slowly_than_certified(simulated: list[Seen]) -> None:
    assert len(simulated) == GAINS
    assert max(each.excess for each in simulated) <= 1.0 + EXCESS
    assert min(each.decay for each in simulated) >= 1.0


@pytest.mark.slow
def test_they_pay_out_and_haul_in(simulated: list[Seen]) -> None:
    moving = [each.speed for each in simulated if each.law != "constant"]
    assert sum(speed > 0.1 for speed in moving) > 40
    assert sum(speed < -0.1 for speed in moving) > 40


@pytest.mark.slow
def test_five_times_the_rate_would_be_refuted(simulated: list[Seen]) -> None:
    """Negative control: on many of the same runs."""
    assert sum(each.boast > 1.0 + EXCESS for each in simulated) > GAINS // 4

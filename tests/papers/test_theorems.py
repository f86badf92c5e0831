"""T1 to T3: verdicts follow from numbers, and the numbers from the law itself."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
import sympy

from tests.papers.test_claims import given
from umbilical.control.motor.backstepping import Backstepping, backstepping_drive
from umbilical.control.motor.command_filter import Reference
from umbilical.library import load
from umbilical.papers.rao2022 import claims_theorems, motor_error, proofs
from umbilical.papers.rao2022.experiments import Runs
from umbilical.papers.rao2022.ledger import Evidence, Verdict
from umbilical.relations.formulas import motor_constants
from umbilical.run import Run
from umbilical.scenario.control import MotorLoop
from umbilical.stability.margins import margins

PAPER = load("paper")
FIELDS = Backstepping._fields


def loop() -> MotorLoop:
    found = PAPER.control.motor_loop
    assert found is not None
    return found


def rates_of_the_controller(e: np.ndarray, reference: np.ndarray, h: float = 1e-6) -> np.ndarray:
    """Rates of e1 and e2 of the motor under the controller's own voltage, without disturbances."""
    c, gains = motor_constants(PAPER.motors[0]), Backstepping(**{name: getattr(loop(), name) for name in FIELDS})

    def wanted(speed: float, at: np.ndarray) -> float:
        e1 = speed - at[0]
        robust = gains.speed_bound * gains.robust_factor * e1 / np.hypot(e1, gains.speed_width)
        return -gains.speed_gain * e1 - c.f11 * speed - c.f12 * speed * abs(speed) - robust + at[1]

    speed = reference[0] + e[0]
    current = wanted(speed, reference) + e[1]
    speed_rate = current + c.f11 * speed + c.f12 * speed * abs(speed)
    drive = backstepping_drive(c, gains, speed, current, Reference.one(*reference))
    current_rate = c.f21 * speed + c.f22 * current + drive
    ahead, behind = (
        wanted(speed + s * h * speed_rate, reference + s * h * np.array([reference[1], reference[2], 0.0]))
        for s in (1.0, -1.0)
    )
    return np.array([speed_rate - reference[1], current_rate - (ahead - behind) / (2.0 * h)])


@pytest.mark.nojit
@pytest.mark.parametrize("e", [(0.3, -2.0), (-0.05, 0.5), (2.0, 10.0)])
def test_the_error_equations_are_those_of_the_motor_under_its_controller(e: tuple[float, float]) -> None:
    found = rates_of_the_controller(np.array(e), np.array([12.0, 3.0, -7.0]))
    assert found == pytest.approx(motor_error.error_rate(loop(), 0.0, np.array(e)), rel=1e-5, abs=1e-5)


def test_the_rate_of_the_lyapunov_function_of_the_motor_loop() -> None:
    """(54), (55) and the last line of the proof of Theorem 2, derived from (46), (47), (52) and (60)."""
    k1, k2, mu, e0, bound1, bound2 = sympy.symbols("k1 k2 mu e0 bound1 bound2", positive=True)
    e1, e2, d1, missed = sympy.symbols("e1 e2 d1 missed", real=True)
    robust = bound1 * mu * e1 / sympy.sqrt(e1**2 + e0**2)
    rate1 = e1 * (-k1 * e1 - robust + d1 + e2)
    worst = rate1.subs(d1, bound1 * sympy.sign(e1))
    premise = mu * sympy.Abs(e1) / sympy.sqrt(e1**2 + e0**2) - 1
    assert sympy.simplify((worst - (-k1 * e1**2 + e1 * e2 - bound1 * sympy.Abs(e1) * premise)).rewrite(sympy.Abs)) == 0

    rate2 = e2 * (-k2 * e2 - e1 - bound2 * sympy.sign(e2) + missed)
    total = sympy.expand(rate1.subs({d1: 0, bound1: 0}) + rate2.subs({bound2: 0, missed: 0}))
    assert total == -k1 * e1**2 - k2 * e2**2, "k2 stands with e2, which the paper prints as e1"
    inside = {k1: 1, mu: sympy.Rational(3, 2), e0: 1, bound1: 10, e1: sympy.Rational(1, 10), e2: 0}
    assert worst.subs(inside) > (-k1 * e1**2).subs(inside), "(55) is false where its premise is"
    at_band = premise.subs({mu: 1.5, e0: 0.1, e1: motor_error.premise_band(loop())})
    assert float(at_band) == pytest.approx(0.0, abs=1e-9)


def test_an_exponential_decay_has_equal_decades_and_a_finite_one_shrinking_ones() -> None:
    straight = motor_error.decade_times(lambda t, e: -3.0 * e, decades=4)
    assert straight == pytest.approx(np.log(10.0) / 3.0, rel=1e-5)
    root = motor_error.decade_times(lambda t, e: -np.sign(e) * np.sqrt(abs(e)), decades=4)
    assert root[1:] / root[:-1] == pytest.approx(10.0**-0.5, rel=1e-3)
    assert np.isinf(motor_error.decade_times(lambda t, e: 0.0 * e, decades=2)[0])


def test_a_finite_time_would_be_seen(evidence: Evidence, monkeypatch: pytest.MonkeyPatch) -> None:
    assert claims_theorems.t2b(evidence).verdict is Verdict.FAILS

    def finite(loop: MotorLoop, t: float, e: np.ndarray) -> np.ndarray:
        return -np.sign(e) * np.sqrt(abs(e))

    monkeypatch.setattr(claims_theorems, "error_rate", finite)
    assert claims_theorems.t2b(evidence).verdict is Verdict.HOLDS


@pytest.mark.parametrize("left", [(0.0, 0.0), (2.0, 150.0), (2.0, 500.0)])
def test_the_ultimate_bound_holds_for_the_worst_constant_disturbance(left: tuple[float, float]) -> None:
    from scipy.integrate import solve_ivp

    bound = motor_error.ultimate_bound(loop(), left)
    found = solve_ivp(partial(motor_error.error_rate, loop(), left=left), (0.0, 1.0), (1.0, 0.0), method="Radau")
    assert abs(found.y[0, -1]) <= bound + 1e-6
    assert bound == pytest.approx(0.0) if left == (0.0, 0.0) else bound > 0.01


def spread(run: Run, factor: float) -> Run:
    """The run with the error of the motors' speed multiplied."""
    error = run["motor_speed"] - run["speed_reference"]
    return Run(run.data.assign(motor_speed=run["speed_reference"] + factor * error), run.scenario)


def test_motors_that_miss_their_speed_are_not_bounded(evidence: Evidence, runs: Runs) -> None:
    assert claims_theorems.t2a(evidence).verdict is Verdict.HOLDS
    wide = given(evidence, dead__with=spread(runs["dead, with"], 500.0))
    assert claims_theorems.t2a(wide).verdict is Verdict.FAILS
    assert claims_theorems.t2a(given(evidence, dead__with=runs["blind, dead, fast"])).verdict is Verdict.FAILS


def test_boundedness_is_asked_of_runs_and_of_the_proof(evidence: Evidence, runs: Runs) -> None:
    assert claims_theorems.t1(evidence).verdict is Verdict.CONDITIONAL
    proved = evidence._replace(proofs=evidence.proofs._replace(rate=1e-3, broken=()))
    assert claims_theorems.t1(proved).verdict is Verdict.HOLDS
    lost = given(proved, stuck__with=runs["blind, stuck, with"])
    assert claims_theorems.t1(lost).verdict is Verdict.FAILS
    growing = runs["dead, with, lasting"]
    tip = growing["tip_displacement"] * (1.0 + growing["time"] / 100.0)
    grown = given(proved, dead__with__lasting=Run(growing.data.assign(tip_displacement=tip), growing.scenario))
    assert claims_theorems.t1(grown).verdict is Verdict.FAILS


def test_a_stable_cascade_is_asked_for(evidence: Evidence) -> None:
    assert claims_theorems.t3(evidence).verdict is Verdict.CONDITIONAL
    assert evidence.proofs.unstable_from < evidence.proofs.certified, "no beta on the paper's winch meets both"
    unstable = evidence._replace(proofs=evidence.proofs._replace(stable=False))
    assert claims_theorems.t3(unstable).verdict is Verdict.FAILS
    everywhere = evidence._replace(proofs=evidence.proofs._replace(unstable_from=float("nan")))
    assert claims_theorems.t3(everywhere).verdict is Verdict.HOLDS


def test_the_edges_are_edges(evidence: Evidence) -> None:
    """A step of the search below the first edge nothing is certified, below the second the cascade is stable."""
    found = evidence.proofs
    assert not proofs.certify(PAPER.replace({proofs.BETA: 0.98 * found.certified}), fix=False).holds
    assert proofs.certify(PAPER.replace({proofs.BETA: found.certified}), fix=False).holds
    assert margins(PAPER.replace({proofs.BETA: 0.9 * found.unstable_from}), [450.0]).stable
    assert not margins(PAPER.replace({proofs.BETA: found.unstable_from}), [450.0]).stable
    assert proofs.edge_between(lambda x: x < 3.0, 1.0, 8.0, 12) == pytest.approx(3.0, rel=1e-3)
    assert np.isnan(proofs.edge_between(lambda x: x < 9.0, 1.0, 8.0, 3))


@pytest.mark.slow
def test_the_cascade_that_is_called_unstable_grows_on_a_grid_that_resolves_it() -> None:
    """beta = 20 m/s, a steady load: the linear loop has waves near 90 rad/s that grow, and 64 elements damp them."""
    from umbilical.engine.simulate import simulate

    steady = {
        "control.law.slope_gain": 20.0,
        "duration": 100.0,
        "winch": {"law": "constant", "length": 450.0},
        "environment.payload_force": [{"kind": "constant", "value": 100.0}],
        "output.interval": 0.01,
    }
    growth = {}
    for elements in (64, 512):
        velocity = simulate(PAPER.replace({**steady, "grid.elements": elements}))["tip_velocity"].values
        early, late = (fast_part(velocity[part]) for part in (slice(5000, 7500), slice(7500, 10000)))
        growth[elements] = late / early
    assert growth[512] > 1.5
    assert growth[64] < 1.1


def fast_part(velocity: np.ndarray) -> float:
    """Largest share of the motion between 80 and 130 rad/s, sampled every 10 ms."""
    w = 2.0 * np.pi * np.fft.rfftfreq(velocity.size, 0.01)
    return float(abs(np.fft.rfft(velocity * np.hanning(velocity.size)))[(w > 80.0) & (w < 130.0)].max())

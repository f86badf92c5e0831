"""Bounds of loads, of V at the start and of the displacement, against samples and runs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

import umbilical
from tests.support.certificates import FREE, GAIN, HALF_SINE, fixed, matrices
from tests.support.scenarios import constant, sine
from umbilical.certificate import Start, bound, cable_bound, displacement_bound, largest_bounds, lyapunov_of
from umbilical.certificate.cable_bound import error_bound, responses
from umbilical.certificate.loads import Loads, jumps_of, largest_rate, largest_value, loads_of
from umbilical.certificate.lyapunov import cable_function, loads_along
from umbilical.certificate.setting import ideal_constants
from umbilical.plant import signals, winch
from umbilical.relations.tension import tension
from umbilical.scenario.environment import Environment
from umbilical.studies.audit import ideal_loop, largest_ratio, lyapunov_of_run

TABLE = {"kind": "table", "times": [0.0, 3.0, 7.0, 10.0, 14.0, 17.0, 21.0, 25.0, 30.0],
         "values": [0.0, 2.5, 2.1, -1.0, -3.0, -1.2, 2.9, 4.0, 3.9]}  # fmt: skip
TERMS: dict[str, dict[str, Any]] = {
    "constant": constant(-2.0),
    "sine": sine(3.0, 0.7, 0.2),
    "bell": {"kind": "bell", "amplitude": -2.0, "center": 14.0, "width": 3.0, "exponent": 2.0},
    "sharp bell": {"kind": "bell", "amplitude": 2.0, "center": 14.0, "width": 3.0, "exponent": 0.5},
    "step": {"kind": "step", "value": 4.0, "time": 3.0},
    "pulse": {"kind": "pulse", "value": -4.0, "start": 3.0, "end": 8.0},
    "smooth table": TABLE,
    "linear table": TABLE | {"interpolation": "linear"},
}
TIME = np.linspace(0.0, 30.0, 300_001)


def environment(**parts: Any) -> Environment:
    change = {f"environment.{name}": value for name, value in parts.items()}
    return umbilical.load("paper", {"duration": 30.0} | change).environment


@pytest.mark.parametrize("name", TERMS)
def test_one_term_is_bounded_closely(name: str) -> None:
    signal = environment(payload_force=[TERMS[name]]).payload_force
    largest = np.abs(signals.evaluate(signal, TIME)).max()
    steepest = np.abs(signals.derivative(signal, TIME)).max()
    assert largest <= largest_value(signal) <= largest * 1.001
    assert steepest <= largest_rate(signal) * (1.0 + 1e-12)
    assert largest_rate(signal) <= steepest * 1.001 + 1e-12


def test_a_cusp_has_no_bound() -> None:
    cusp = environment(payload_force=[TERMS["sharp bell"] | {"exponent": 0.4}]).payload_force
    assert largest_rate(cusp) == np.inf


def test_jumps_add_up() -> None:
    signal = environment(payload_force=[TERMS["step"], TERMS["pulse"]]).payload_force
    assert jumps_of(signal) == ((3.0, 8.0), (8.0, 4.0))


def test_the_vessel_and_loads_along_the_cable_are_bounded() -> None:
    loads = [
        {"profile": {"shape": "gaussian", "center": 0.4, "width": 0.2}, "signal": [sine(2.0, 0.9)]},
        {"profile": {"shape": "sine", "half_waves": 3}, "signal": [sine(1.0, 0.3)]},
        {"profile": {"shape": "table", "positions": [0.0, 0.5, 1.0], "values": [0.0, 1.0, 0.5]},
         "signal": [sine(1.0, 0.5)]},
        {"profile": {"shape": "uniform"}, "signal": [constant(0.5)]},
    ]  # fmt: skip
    change = {
        "environment.cable_load": loads,
        "environment.vessel_motion": [sine(0.5, 0.6)],
        "environment.vessel_ramp": 5.0,
    }
    scenario = umbilical.load("paper", change)
    found = loads_of(scenario.environment, 400.0)
    t, sigma = np.linspace(0.0, 50.0, 2001), np.linspace(0.0, 1.0, 401)
    force = loads_along(scenario, t, np.broadcast_to(sigma, (t.size, sigma.size)))
    largest = (400.0 * np.trapezoid(force**2, sigma, axis=1)).max()
    assert largest <= found.cable <= 4.0 * largest
    e, e_rate = signals.vessel(scenario.environment, t)
    assert np.abs(e).max() <= found.vessel <= 1.001 * np.abs(e).max()
    assert np.abs(e_rate).max() <= found.vessel_velocity <= 3.0 * np.abs(e_rate).max()


@pytest.mark.parametrize(
    "initial",
    [
        {"shape": "straight"},
        {"shape": "sine", "amplitude": 1.0, "half_waves": 1.5},
        {"shape": "gaussian", "amplitude": 1.0, "distance": 150.0, "width": 30.0},
        {"shape": "static", "force": 80.0},
        {"shape": "table", "positions": [0.0, 0.3, 0.7, 1.0], "displacements": [0.0, 1.0, 0.5, 1.0]},
        {"shape": "equilibrium", "tip": 1.0},
    ],
    ids=lambda initial: initial["shape"],
)
def test_start_is_that_of_a_run(initial: dict[str, Any]) -> None:
    scenario = umbilical.load("paper", {GAIN: 5.0, "initial": initial, "duration": 0.05, "output.interval": 0.01})
    certificate = umbilical.certify(scenario)
    _, value = lyapunov_of_run(umbilical.simulate(ideal_loop(scenario)), certificate)
    assert lyapunov_of(certificate.loop, certificate.weights, certificate.start) == pytest.approx(value[0], rel=2e-3)


def test_response_of_the_law() -> None:
    """Against the integral of ``m u' = -k_a u + D~``, ``D~' = -k_s (D~ + vs u) + D'`` by scipy."""
    from scipy.integrate import solve_ivp

    loop = ideal_constants(fixed(5.0))._replace(k_a=4000.0, vs=3000.0)
    k_s = 5.0

    def law(t: float, z: np.ndarray) -> list[float]:
        u, missed = z
        return [(-loop.k_a * u + missed) / loop.m, -k_s * (missed + loop.vs * u) + 40.0 * np.cos(0.8 * t)]

    t = np.linspace(0.0, 10.0, 4001)
    exact = solve_ivp(law, (0.0, 10.0), [0.3, -90.0], t_eval=t, rtol=1e-10, atol=1e-12).y[0]
    free = solve_ivp(lambda s, z: np.array(law(s, z)) - [0.0, 40.0 * np.cos(0.8 * s)], (0.0, 10.0), [0.3, -90.0],
                     t_eval=t, rtol=1e-10, atol=1e-12).y[0]  # fmt: skip
    of_error, of_missed = responses(loop, t)
    np.testing.assert_allclose(0.3 * of_error - 90.0 * of_missed, free, atol=1e-9)
    limit = error_bound(loop, t, Start(0.0, 0.3, -90.0), Loads(50.0, 40.0, (), 0.0, 0.0, 0.0))
    assert (np.maximum(np.abs(exact[:-1]), np.abs(exact[1:])) <= limit + 1e-9).all()
    assert largest_ratio(np.abs(exact[2000:-1]), limit[2000:]) > 0.5, "and not far below"


@pytest.mark.parametrize("coupling", [1.0, 225.0, 90000.0], ids=["two poles", "a double one", "a pair"])
@pytest.mark.parametrize(("error", "missed"), [(0.3, -90.0), (0.0, 500.0), (0.1, -900.0)])
def test_response_between_the_steps_of_a_coarse_grid(coupling: float, error: float, missed: float) -> None:
    """It has turning points inside of steps, above both of their ends: held at the ends it would be exceeded."""
    loop = ideal_constants(fixed(5.0))._replace(k_a=4000.0, vs=coupling)
    coarse, inside = np.linspace(0.0, 4.0, 41), np.linspace(0.0, 4.0, 4001)
    limit = error_bound(loop, coarse, Start(0.0, error, missed), Loads(0.0, 0.0, (), 0.0, 0.0, 0.0))
    of_error, of_missed = responses(loop, inside)
    exact = np.abs(of_error * error + of_missed * missed)
    found = np.array([exact[k : k + 101].max() for k in range(0, 4000, 100)])
    assert (found <= limit).all()
    ends = np.maximum(exact[:-1:100], exact[100::100])
    assert (found > ends).any(), "the negative control"


WINCHES: list[dict[str, Any]] = [
    {"law": "quintic", "start_length": 400.0, "end_length": 350.0, "start": 3.0, "duration": 20.0},
    {"law": "trapezoid", "start_length": 400.0, "end_length": 430.0, "top_speed": 2.0, "acceleration": 0.3,
     "start": 2.0},
    {"law": "cosine", "start_length": 300.0, "amplitude": 10.0, "frequency": 0.4},
    {"law": "table", "times": [0.0, 8.0, 15.0, 30.0], "lengths": [300.0, 310.0, 305.0, 320.0]},
]  # fmt: skip


@pytest.mark.parametrize("law", WINCHES, ids=lambda law: law["law"])
def test_ranges_hold_the_winch_and_reach_its_worst_instant(law: dict[str, Any]) -> None:
    """At 10 000 instants that are in no sample of the search: length, speed, g - a and the reach in metres."""
    certificate = umbilical.certify(umbilical.load("paper", FREE | {GAIN: 10.0, "winch": law, "duration": 30.0}))
    loop, weights, ranges = certificate.loop, certificate.weights, certificate.ranges
    t = np.random.default_rng(3).uniform(0.0, 30.0, 10_000)
    motion = winch.evaluate(certificate.scenario.winch, t)
    slab = np.searchsorted(certificate.edges, t, side="right") - 1
    for span, values in zip(ranges, (motion.length, motion.speed, loop.g - motion.acceleration), strict=True):
        assert (span.low.min(axis=1)[slab] <= values).all()
        assert (values <= span.high.max(axis=1)[slab]).all()
    x = np.linspace(0.0, 1.0, 2001) * motion.length[::10, None]
    pull = tension(motion.length[::10, None] - x, loop.g - motion.acceleration[::10, None], loop.hanging)
    left = pull - loop.rho * (weights.vessel + weights.cross * x) ** 2
    largest = np.sqrt(2.0 * np.trapezoid(1.0 / left, x, axis=1).max())
    assert largest <= certificate.reach[1] <= 1.01 * largest


def test_the_tension_that_jumps_stretches_v() -> None:
    """``N_after <= k N_before`` at every x, by LAPACK, where the acceleration falls; closely at the ROV."""
    scenario = umbilical.load("paper", {GAIN: 10.0, "duration": 20.0} | LOADED["a trapezoid"])
    certificate = umbilical.certify(scenario)
    stretched = np.flatnonzero(certificate.stretch > 1.0)
    assert stretched.size >= 2
    for at in stretched:
        instant = float(certificate.edges[at])
        before, after = (winch.evaluate(scenario.winch, instant, side) for side in ("left", "right"))
        ratios = [
            eigh(
                *(
                    matrices(
                        certificate.loop,
                        *certificate.weights[:2],
                        x,
                        (float(m.length), 0.0, float(m.acceleration), 0.0),
                    )[0]
                    for m in (after, before)
                ),
                eigvals_only=True,
            )[-1]
            for x in np.linspace(0.0, float(before.length), 50)
        ]
        assert max(ratios) <= certificate.stretch[at] * (1.0 + 1e-12)
        assert max(ratios) - 1.0 > 0.9 * (certificate.stretch[at] - 1.0)


@pytest.mark.parametrize("name", ["the paper's loads", "a pulse on the ROV", "a trapezoid"])
def test_the_largest_bounds_are_those_of_all_instants(name: str) -> None:
    certificate = umbilical.certify(umbilical.load("paper", {GAIN: 10.0, "duration": 20.0} | LOADED[name]))
    found = largest_bounds(certificate)
    assert found is not None
    t = np.linspace(0.0, 20.0, 7919)
    assert bound(certificate, t).max() <= found.lyapunov_largest * (1.0 + 1e-12)
    _, farthest = displacement_bound(certificate, float(cable_bound(certificate, t).max()))
    assert farthest <= found.tip_largest * (1.0 + 1e-12)
    assert found.tip_largest <= 1.003 * farthest


def read(run: umbilical.Run) -> dict[str, np.ndarray]:
    return {name: run[name].values for name in ("sigma", "slope", "velocity", "length", "payout_acceleration")}


LOADED: dict[str, dict[str, Any]] = {
    "the paper's loads": {},
    "a pulse on the ROV": FREE | {"environment.payload_force": [TERMS["pulse"] | {"value": 300.0}]},
    "a load along the cable": FREE
    | {"environment.cable_load": [{"profile": {"shape": "sine", "half_waves": 2}, "signal": [sine(0.3, 0.8)]}]},
    "a moving vessel": FREE | {"environment.vessel_motion": [sine(0.3, 0.6)], "environment.vessel_ramp": 5.0},
    "a trapezoid": FREE
    | HALF_SINE
    | {"winch": {"law": "trapezoid", "start_length": 380.0, "end_length": 400.0, "top_speed": 4.0, "acceleration": 1.5,
                 "start": 1.0}},
    "no disturbance observer": {"control.disturbance_observer.enabled": False},
}  # fmt: skip


@pytest.mark.parametrize("name", LOADED)
def test_runs_of_the_ideal_loop_stay_below_their_bounds(name: str) -> None:
    scenario = umbilical.load("paper", {GAIN: 10.0, "duration": 20.0} | LOADED[name])
    certificate = umbilical.certify(scenario)
    assert certificate.holds
    run = umbilical.simulate(ideal_loop(scenario))
    time, value = lyapunov_of_run(run, certificate)
    start = lyapunov_of(certificate.loop, certificate.weights, certificate.start)
    assert largest_ratio(value, bound(certificate, time, max(start, float(value[0])))) <= 1.0 + 1e-3
    of_cable = cable_function(run.scenario, read(run), certificate.weights)
    limit = cable_bound(certificate, time)
    assert largest_ratio(of_cable[time > 0.5], limit[time > 0.5]) <= 1.0 + 1e-3
    _, farthest = displacement_bound(certificate, float(limit.max()))
    assert np.abs(run["displacement"].values).max() <= farthest


def test_without_its_jumps_the_bound_of_v_is_broken() -> None:
    """Negative control: the pulse reaches V through D~, at once."""
    from dataclasses import replace

    scenario = umbilical.load("paper", {GAIN: 10.0, "duration": 20.0} | LOADED["a pulse on the ROV"])
    certificate = umbilical.certify(scenario)
    deaf = replace(certificate, loads=certificate.loads._replace(force_jumps=()))
    time, value = lyapunov_of_run(umbilical.simulate(ideal_loop(scenario)), certificate)
    assert value.max() > 10.0 > bound(deaf, time).max()

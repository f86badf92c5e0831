"""The loop with the engine's own grid as matrices from sample to sample.

Cable and ROV are the Jacobian of the engine's rates (:func:`umbilical.engine.linear.linearise_plant`), advanced by
its multistep weights; motors by its Runge-Kutta step; the thrust enters as the mean that the engine takes of it.
Controller and motor loops are linearised from what runs (:mod:`umbilical.stability.laws`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import factorial
from typing import Any

import numpy as np
from scipy import sparse

from umbilical.engine.linear import LinearPlant, linearise_plant
from umbilical.engine.linearise import Linear
from umbilical.plant.multistep import EXPLICIT, IMPLICIT
from umbilical.scenario.scenario import Scenario
from umbilical.stability.sampled import Drive, SampledLoop

Sparse = Any  # scipy's sparse arrays, whose stubs do not know their own operators


@dataclass(frozen=True)
class LinearPeriod:
    """One outer period of plant, motors and motor loops: ``x+ = a x + b alpha_c, readings = c x``.

    Attributes:
        a: sparse, shape (n, n).
        b: shape (n, 1); commanded thrust.
        c: shape (4, n); y, y_x, Dy/Dt and D(y_x)/Dt as the law gets them.
        law: the outer law.
        period: s.
    """

    a: Sparse
    b: np.ndarray
    c: np.ndarray
    law: Linear
    period: float

    def plant(self, w: np.ndarray) -> np.ndarray:
        """Readings per commanded thrust at frequencies, rad/s, shape (len(w), 4): one sparse solve each."""
        from scipy.sparse.linalg import splu

        one: Sparse = sparse.eye_array(self.a.shape[0], format="csc")
        shifted = (sparse.csc_array(np.exp(1j * x * self.period) * one - self.a) for x in w)
        return np.array([self.c @ splu(s).solve(self.b[:, 0].astype(complex)) for s in shifted])

    def transfer(self, w: np.ndarray) -> np.ndarray:
        """L at frequencies, rad/s."""
        gains = self.law.response(np.exp(1j * w * self.period))[:, 0, :]
        return (gains * self.plant(w)).sum(axis=1)

    @cached_property
    def closed(self) -> np.ndarray:
        """The closed loop from sample to sample, dense: plant and motors, then the law's states."""
        a, b, c, k = self.a.toarray(), self.b, self.c, self.law
        return np.block([[a + b @ k.d @ c, b @ k.c], [k.b @ c, k.a]])

    def scaled(self, gain: float) -> LinearPeriod:
        """The same with another effectiveness of the thrusters."""
        return replace(self, b=gain * self.b)

    def later(self, periods: int) -> LinearPeriod:
        """The same with every reading so many periods later."""
        a, b, c = _aged(self.a, sparse.csc_array(self.b), self.c, [periods] * self.c.shape[0])
        return replace(self, a=sparse.csc_array(a), b=b.toarray(), c=c)


def linear_period(scenario: Scenario, loop: SampledLoop, length: float) -> LinearPeriod:
    """The loop on the scenario's grid at a frozen length, m."""
    still = scenario.replace({"winch": {"law": "constant", "length": length}})
    plant = linearise_plant(still)
    substeps = round(loop.period / plant.step)
    column = np.vstack([plant.b, np.zeros((2 * plant.a.shape[0], 1))]) * plant.step
    # What a force at the end of a step, at its start and one step before adds in the step.
    step, force = _cable_step(plant), [weight * column for weight in IMPLICIT[1]]
    if loop.drives:
        a, b = _driven(step, force, loop, plant.step, substeps)
    else:
        a, b = _power(step, sparse.csc_array(force[0] + force[1] + force[2]), substeps)
    a, b = _power(a, b, loop.every)
    c = np.zeros((4, a.shape[0]))
    c[:, : plant.a.shape[0]] = plant.c
    a, b, c = _aged(a, b, c, [round(age / loop.outer_period) for age in loop.ages])
    return LinearPeriod(sparse.csc_array(a), b.toarray(), c, loop.law, loop.outer_period)


def _cable_step(plant: LinearPlant) -> Sparse:
    """State and its last two rates to the same a step later, as :func:`umbilical.engine.linear.step_matrix`."""
    rates: Sparse = plant.a
    now, last, before = plant.step * EXPLICIT[2]
    one: Sparse = sparse.eye_array(plant.a.shape[0])
    blocks: Sparse = [[one + now * rates, last * one, before * one], [rates, None, None], [None, one, None]]
    return sparse.csc_array(sparse.block_array(blocks))


def _driven(
    step: Sparse, force: list[np.ndarray], loop: SampledLoop, dt: float, substeps: int
) -> tuple[Sparse, Sparse]:
    """One control period of the cable with closed motor loops: states are the cable's, two old thrusts, the drives'.

    The voltage is set from the readings at the start of the period, then held.
    """
    motors = [_runge_kutta(drive, dt) for drive in loop.drives]
    laws = [drive.law for drive in loop.drives]
    n, counts = step.shape[0], [law.a.shape[0] for law in laws]
    starts = n + 1 + np.cumsum([0, *(count + 3 for count in counts)])
    size = int(starts[-1])
    sub: Sparse = sparse.lil_array((size, size))
    enter: Sparse = sparse.lil_array((size, size))
    enter_demand = np.zeros((size, 1))
    end, start, before = force
    thrust_now = np.zeros((1, size))
    for (a, b), drive, law, place in zip(motors, loop.drives, laws, starts[:-1], strict=True):
        m = law.a.shape[0]
        own, x, volt = slice(place, place + m), slice(place + m, place + m + 2), place + m + 2
        sub[own, own] = np.eye(m)
        sub[x, x] = a
        sub[x, [volt]] = b
        sub[volt, volt] = 1.0
        thrust_now[0, place + m] = drive.weight
        enter[own, own], enter[own, x] = law.a, law.b[:, 1:3]
        enter[x, x] = np.eye(2)
        enter[[volt], own], enter[[volt], x] = law.c, law.d[:, 1:3]
        enter_demand[own], enter_demand[volt] = law.b[:, :1], law.d[:, :1]
    thrust_next = thrust_now @ sub.toarray()
    cable = slice(0, n)
    sub[cable, cable] = step
    sub[cable, n] = before[:, 0]
    for row in np.flatnonzero(end):
        sub[[row], :] = sub[[row], :].toarray() + end[row] * thrust_next + start[row] * thrust_now
    sub[[n], :] = thrust_now
    enter[cable, cable] = sparse.eye_array(n)
    enter[n, n] = 1.0
    whole, _ = _power(sparse.csc_array(sub), sparse.csc_array((size, 1)), substeps)
    return sparse.csc_array(whole @ sparse.csc_array(enter)), sparse.csc_array(whole @ enter_demand)


def _runge_kutta(drive: Drive, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """The classical step of order 4 of a linear system under a held voltage: the exponential's first terms."""
    block = dt * np.block([[drive.rates, drive.volts], [np.zeros((1, 3))]])
    step = np.sum([np.linalg.matrix_power(block, order) / factorial(order) for order in range(5)], axis=0)
    return step[:2, :2], step[:2, 2:]


def _power(a: Sparse, b: Sparse, times: int) -> tuple[Sparse, Sparse]:
    """Several steps under one held input."""
    whole, pushed = a, b
    for _ in range(times - 1):
        whole, pushed = sparse.csc_array(a @ whole), sparse.csc_array(a @ pushed + b)
    return sparse.csc_array(whole), sparse.csc_array(pushed)


def _aged(a: Sparse, b: Sparse, c: np.ndarray, ages: list[int]) -> tuple[Sparse, Sparse, np.ndarray]:
    """Readings that come late by whole periods: each keeps its last samples as states."""
    for row, age in enumerate(ages):
        for _ in range(age):
            none = sparse.csc_array((1, 1))
            a = sparse.csc_array(sparse.block_array([[a, None], [sparse.csc_array(c[[row]]), none]]))
            b = sparse.csc_array(sparse.vstack([b, none]))
            c = np.hstack([c, np.zeros((4, 1))])
            c[row] = 0.0
            c[row, -1] = 1.0
    return a, b, c

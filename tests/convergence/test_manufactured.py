"""Manufactured solutions of the full problem: observed orders and sizes; and their loads, derived again by sympy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy

from tests.support.verdicts import assert_holds, each
from umbilical.verify import manufactured
from umbilical.verify.cases import Case
from umbilical.verify.references import manufactured as exact
from umbilical.verify.references.manufactured import StringProblem


@each(manufactured.CASES)
def test_case(case: Case) -> None:
    assert_holds(case)


@pytest.mark.parametrize(
    "pr",
    [
        StringProblem(4.0),
        StringProblem(-4.0),
        StringProblem(3.0, steady=True),
        StringProblem(3.0, weight=400.0, cable_weight=13.0, vessel=0.4),
        StringProblem(4.0, sea=manufactured.AT_SEA),
    ],
    ids=["growing", "shrinking", "steady winch", "lighter in water", "at sea"],
)
def test_the_loads_are_those_of_the_equations(pr: StringProblem) -> None:
    """(A0), (A1) and (A2) of docs/theory.md applied to y by sympy, at points and instants of no meaning."""
    sea: Any = pr.sea
    x, t = sympy.symbols("x t", real=True)
    out = pr.speed * t if pr.steady else pr.swing * (1 - sympy.cos(pr.frequency * t))
    length = pr.start_length + out
    speed, acceleration = sympy.diff(length, t), sympy.diff(length, t, 2)
    angle = exact.WAVENUMBER * x / length
    p, q = pr.start - (1 - sympy.cos(2 * t)) / 3, pr.vessel * (1 - sympy.cos(1.3 * t))
    y = p * sympy.sin(angle) + q * sympy.cos(angle)
    below = length - x
    heave: Any = sea.heave * (1 - sympy.cos(exact.HEAVING * t))
    sinks = speed - sympy.diff(heave, t)
    sunk: Any = acceleration - sympy.diff(heave, t, 2)
    braked: Any = sinks * sympy.Abs(sinks)
    tension = pr.weight + pr.cable_weight * below - (pr.mass + sea.body_vertical + pr.line_density * below) * sunk
    tension -= (sea.body_axial + sea.tangential * below) * braked
    depth = sympy.Symbol("depth")
    profile = (sea.surface + sea.shear * depth) * (1 + sea.surge * sympy.sin(exact.SURGING * t))
    flow, change = (q.subs(depth, x - heave) for q in (profile, sympy.diff(profile, t)))

    def material(q: sympy.Expr) -> sympy.Expr:
        return sympy.diff(q, t) + speed * sympy.diff(q, x)

    def passing(q: sympy.Expr) -> sympy.Expr:
        return sympy.diff(q, t) + sympy.diff(heave, t) * sympy.diff(q, x)

    w, relative = material(y), flow - passing(y)
    load = pr.line_density * material(w) - sympy.diff(tension * sympy.diff(y, x), x) + pr.damping * w
    load += sea.added * passing(passing(y)) - (sea.displaced + sea.added) * change
    load -= sea.normal * sympy.Abs(relative) * relative - sea.tangential * braked * sympy.diff(y, x)
    force = (pr.mass + sea.body_added) * material(w) + tension * sympy.diff(y, x) + pr.tip_damping * w
    force -= (sea.body_linear + sea.body_quadratic * sympy.Abs(flow - w)) * (flow - w)
    force -= (sea.body_added + sea.body_displaced) * change
    derived = [sympy.lambdify((x, t), q, "numpy", cse=True) for q in (y, w, load, force)]
    sigma = np.array([0.0, 0.13, 0.5, 0.77, 1.0])
    for instant in (0.0, 0.37, 1.9):
        place = sigma * pr.winch(np.array(instant))[0]
        found = [
            exact.displacement(pr, sigma, instant),
            exact.velocity(pr, sigma, instant),
            exact.cable_load(pr, sigma, np.array(instant)),
        ]
        for ours, q in zip(found, derived[:3], strict=True):
            np.testing.assert_allclose(ours, q(place, instant), rtol=1e-11, atol=1e-11)
        tip = float(exact.tip_force(pr, np.array([instant]))[0])
        assert tip == pytest.approx(float(derived[3](place[-1], instant)), rel=1e-11)


@pytest.mark.parametrize("problem", manufactured.TERMS_OFF.values(), ids=manufactured.TERMS_OFF)
def test_the_start_is_at_rest(problem: StringProblem) -> None:
    assert not exact.velocity(problem, np.linspace(0.0, 1.0, 7), 0.0).any()

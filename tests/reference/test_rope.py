"""The rope against closed forms, shooting, characteristics and masses on springs."""

from __future__ import annotations

import numpy as np

from tests.support.verdicts import assert_holds, each
from umbilical.library import load, preset_names
from umbilical.verify import manufactured, rope, rope_pairs, rope_waves
from umbilical.verify.cases import Case
from umbilical.verify.references.manufactured import Jet, RopeProblem


@each((*rope.CASES, *manufactured.ROPE_CASES, *rope_waves.CASES, *rope_pairs.CASES))
def test_case(case: Case) -> None:
    assert_holds(case)


def test_every_preset_of_the_string_is_held_beside_the_rope() -> None:
    named = {name for group in rope_pairs.PRESETS.values() for name in group}
    assert named == {name for name in preset_names() if load(name).model == "string"}


def test_the_manufactured_fields_are_derivatives_of_the_place() -> None:
    """All of a jet, W and DW/Dt by differences at fixed and at material points."""
    problem, t, x = RopeProblem(-4.0), 0.7, np.array([3.0, 21.0, 48.0])

    def at(far: float, late: float) -> Jet:
        """At x, ``far`` metres on, ``late`` seconds later."""
        return problem.at((x + far) / problem.winch(t + late)[0], t + late)

    def slope(name: str, far: float, late: float) -> np.ndarray:
        return (getattr(at(far, late), name) - getattr(at(-far, -late), name)) / 2e-4

    here, (_, speed, change) = at(0.0, 0.0), problem.winch(t)
    for name, of, time in (
        ("x", "value", False), ("t", "value", True), ("xx", "x", False), ("xt", "x", True), ("tt", "t", True),
    ):  # fmt: skip
        found = slope(of, *((0.0, 1e-4) if time else (1e-4, 0.0)))
        np.testing.assert_allclose(getattr(here, name), found, rtol=1e-6, atol=1e-7)
    ends = []
    for late in (1e-4, -1e-4):
        out = problem.winch(t + late)[0] - problem.winch(t)[0]
        ends.append(at(out, late).along(*problem.winch(t + late)[1:])[0])
    np.testing.assert_allclose(here.along(speed, change)[1], (ends[0] - ends[1]) / 2e-4, rtol=1e-6, atol=1e-7)

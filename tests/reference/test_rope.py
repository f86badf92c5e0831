"""The rope against closed forms, shooting, characteristics and masses on springs."""

from __future__ import annotations

import numpy as np

from tests.support.verdicts import assert_holds, each
from umbilical.library import load, preset_names
from umbilical.verify import rope, rope_invariance, rope_manufactured, rope_pairs, rope_waves
from umbilical.verify.cases import Case
from umbilical.verify.references import manufactured_rope


@each((*rope.CASES, *rope_manufactured.CASES, *rope_waves.CASES, *rope_invariance.CASES, *rope_pairs.CASES))
def test_case(case: Case) -> None:
    assert_holds(case)


def test_every_preset_of_the_string_is_held_beside_the_rope() -> None:
    named = {name for group in rope_pairs.PRESETS.values() for name in group}
    assert named == {name for name in preset_names() if load(name).model == "string"}


def test_the_manufactured_fields_are_derivatives_of_the_place() -> None:
    """W, DW/Dt and what is differentiated along the cable, by differences at material and at fixed points."""
    problem, t, x = manufactured_rope.RopeProblem(-4.0), 0.7, np.array([3.0, 21.0, 48.0])

    def at(far: float, late: float) -> manufactured_rope.RopeFields:
        """Fields where the material is that is at x now, and ``far`` metres on."""
        length, now = problem.winch(t + late)[0], problem.winch(t)[0]
        return manufactured_rope.fields(problem, (x + far + length - now) / length, t + late)

    def slope(name: str, *, time: bool) -> np.ndarray:
        ends = [at(0.0, d) if time else at(d, 0.0) for d in (1e-4, -1e-4)]
        return (getattr(ends[0], name) - getattr(ends[1], name)) / 2e-4

    here = at(0.0, 0.0)
    for name, of, time in (
        ("slope", "place", False), ("velocity", "place", True), ("acceleration", "velocity", True),
        ("slope_x", "slope", False), ("velocity_x", "velocity", False),
    ):  # fmt: skip
        np.testing.assert_allclose(getattr(here, name), slope(of, time=time), rtol=1e-6, atol=1e-7)

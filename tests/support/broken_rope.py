"""Deliberately wrong ropes: each breaks one thing on its way into the kernels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from umbilical.plant.rope import assemble, model, outside
from umbilical.plant.rope.records import RopeConstants
from umbilical.plant.seaway import Sheave
from umbilical.scenario.environment import Environment
from umbilical.verify import manufactured

Break = Callable[[pytest.MonkeyPatch], None]


def another_rope(change: Callable[[RopeConstants], dict[str, Any]]) -> Break:
    """Other constants than those that are asked for."""

    def apply(patch: pytest.MonkeyPatch) -> None:
        right = model.make_rope

        def wrong(*arguments: Any, **named: Any) -> RopeConstants:
            rope = right(*arguments, **named)
            return rope._replace(**change(rope))

        for user in (model, assemble, manufactured):
            patch.setattr(user, "make_rope", wrong)

    return apply


gravity_of_another_planet = another_rope(lambda r: {"weight": 1.05 * r.weight, "body_weight": 1.05 * r.body_weight})
half_the_body = another_rope(lambda r: {"inertia": 0.5 * r.inertia})
half_the_cable = another_rope(lambda r: {"density": 0.5 * r.density})
four_times_the_cable = another_rope(lambda r: {"density": 4.0 * r.density})
axes_swapped = another_rope(
    lambda r: {"body_drag": np.ascontiguousarray(r.body_drag[::-1]), "normal_drag": 1.0 * r.normal_drag}
)
water_that_pushes_nothing = another_rope(lambda r: {"displaced": 0.0, "moved_water": 0.0 * r.moved_water})
drag_that_grows_with_the_diameter = another_rope(lambda r: {"normal_drag": r.normal_drag * (1.0 + r.displaced)})
drag_that_drives = another_rope(lambda r: {"normal_drag": -0.01 * r.normal_drag})
drag_that_nobody_ordered = another_rope(lambda r: {"body_drag": r.body_drag + 300.0, "wet": True})
a_fifth_more_drag = another_rope(lambda r: {"normal_drag": 1.2 * r.normal_drag})


def winch_that_runs_backwards(patch: pytest.MonkeyPatch) -> None:
    """The length grows, and the cable leaves."""
    right = model.RopeModel._outside

    def wrong(self: model.RopeModel, start: np.ndarray, dt: float) -> Any:
        found = right(self, start, dt)
        found["payout_speed"] *= -1.0
        return found

    patch.setattr(model.RopeModel, "_outside", wrong)


def winch_that_slips(patch: pytest.MonkeyPatch) -> None:
    """A little more cable is out than the winch counts, the later the more."""
    right = model.RopeModel._outside

    def wrong(self: model.RopeModel, start: np.ndarray, dt: float) -> Any:
        found = right(self, start, dt)
        found["length"] *= 1.0 + 2e-5 * start[:, None]
        return found

    patch.setattr(model.RopeModel, "_outside", wrong)


def stages_at_the_start(patch: pytest.MonkeyPatch) -> None:
    """Winch and vessel held over each step."""
    right = model.RopeModel._outside

    def wrong(self: model.RopeModel, start: np.ndarray, dt: float) -> Any:
        return right(self, start, 0.0)

    patch.setattr(model.RopeModel, "_outside", wrong)


def three_times_the_heave(patch: pytest.MonkeyPatch) -> None:
    """Of a vessel in an irregular sea."""
    right = outside.sheave

    def wrong(environment: Environment) -> Sheave:
        found = right(environment)
        return found._replace(up=3 * found.up)

    patch.setattr(outside, "sheave", wrong)

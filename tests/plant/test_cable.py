"""What weighs the jumps where elements meet, 1/c, follows the tension without a root."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.compile import plain
from umbilical.library import load
from umbilical.plant.cable import SLOWNESS, at_moment, look_up_slowness, make_blocks, make_cable, make_faces, meet
from umbilical.plant.exogenous import Exogenous

ELEMENTS = 8


@pytest.mark.parametrize(
    ("share", "steps", "left"),
    [(1e-2, 1, 0.4e-4), (1e-3, 1, 0.4e-6), (4.0, 8, 1e-9), (99.0, 10, 1e-9), (-0.99, 12, 1e-9)],
    ids=["1 in 100", "1 in 1000", "5 times", "100 times", "to a hundredth"],
)
def test_slowness_follows_the_tension(share: float, steps: int, left: float) -> None:
    """Of a change by the share s one step leaves 3/8 s^2; any change is made up for, and never by way of c < 0."""
    cable = make_cable(load("paper", {"grid.elements": ELEMENTS}))
    outside, faces, blocks = (
        Exogenous.one(length=500.0, net_gravity=10.0),
        make_faces(ELEMENTS),
        make_blocks(np.ones((5, 8))),
    )
    plain(look_up_slowness)(cable, faces, plain(at_moment)(cable, outside))
    outside.net_gravity *= 1.0 + share
    moment, exact = plain(at_moment)(cable, outside), make_faces(ELEMENTS)
    plain(look_up_slowness)(cable, exact, moment)
    for _ in range(steps):
        plain(meet)(cable, blocks[0], blocks[0].ravel(), faces, np.zeros(ELEMENTS + 1), moment)
        assert (faces[SLOWNESS, :ELEMENTS] > 0.0).all()
    assert faces[SLOWNESS, 1:ELEMENTS] == pytest.approx(exact[SLOWNESS, 1:ELEMENTS], rel=left)

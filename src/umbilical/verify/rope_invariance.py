"""What must hold between two motions of the rope: another frame or direction, the same products, there and back."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from umbilical.plant.rope.model import BodyData, CableData, Motion, RopeModel, SteadyCurrent, fixed
from umbilical.verify.cases import Case, Check, at_least, each_close, history_close, small
from umbilical.verify.invariance import TWO_RUNS
from umbilical.verify.rope import G, quintic_winch, recorded, steady, waving

Turn = Callable[[np.ndarray], np.ndarray]

LINE = CableData(2e6, 1.2, 8.0, 0.02, 1.2, 0.02)
BODY = BodyData(300.0, 1500.0, (100.0, 150.0, 200.0), (20.0, 30.0, 0.0), (200.0, 250.0, 300.0), 150.0)
SHEAR = np.array([(0.6, 0.1, 0.0), (0.3, -0.2, 0.0), (0.1, 0.1, 0.0)])
HEIGHTS = (0.0, -60.0, -400.0)
FORCE = np.array([100.0, -150.0, 50.0])
SWAYS = {0: (0.5, 0.7), 1: (0.8, 0.5), 2: (0.4, 0.9)}
ROUND_OFF = 1e-8
"""Share of the peak by which another order of sums may move a swing of 10 s."""


def _quarter_turn(vectors: np.ndarray) -> np.ndarray:
    """Vectors turned by 90 degrees about z, any shape (..., 3)."""
    return np.stack([-vectors[..., 1], vectors[..., 0], vectors[..., 2]], axis=-1)


def _mirrored(vectors: np.ndarray) -> np.ndarray:
    """Vectors seen in a mirror across y, any shape (..., 3)."""
    return vectors * np.array([1.0, -1.0, 1.0])


def _same(vectors: np.ndarray) -> np.ndarray:
    """The vectors."""
    return vectors


def _body_with(body: BodyData, turn: Turn) -> BodyData:
    """The body with what it has along x, y, z where the axes are then."""
    sizes = {name: tuple(np.abs(turn(np.array(getattr(body, name)))).tolist())
             for name in ("added_mass", "damping", "drag")}  # fmt: skip
    return replace(body, **sizes)


def _swinging(turn: Turn, carried: float = 0.0, cable: CableData = LINE) -> np.ndarray:
    """Place of the cable at 11 instants, m, shape (11, nodes, 3): paid out in a sheared current by a vessel that moves.

    Args:
        turn: of every vector.
        carried: velocity that vessel, water and cable have besides, in the direction x, m/s.
        cable: what is paid out.
    """
    sways, drift = waving(SWAYS, 2.0), np.array([carried, 0.0, 0.0])

    def vessel(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        place, speed = sways(t)
        return turn(place + np.multiply.outer(t, drift)), turn(speed + drift)

    current, body, force = SteadyCurrent(HEIGHTS, _levels(turn(SHEAR))), _body_with(BODY, turn), _vector(turn(FORCE))
    model = RopeModel(cable, body, Motion(quintic_winch(200.0, 215.0, 10.0), sways if not carried else None), current,
                      elements=4, force=force)  # fmt: skip
    if carried:
        model.water = RopeModel(cable, body, fixed(200.0), SteadyCurrent(HEIGHTS, _levels(turn(SHEAR + drift))),
                                elements=4, settled=False).water  # fmt: skip
        model.state.now[:, 12:24] += np.repeat(turn(drift), 4)
        model.state.body[0] += turn(drift)
    model.motion = Motion(model.motion.length, vessel)
    return np.array([model.position, *recorded(model, 1.0, 10, lambda: model.position)])


def _levels(velocities: np.ndarray) -> tuple[tuple[float, float, float], ...]:
    return tuple(_vector(row) for row in velocities)


def _vector(values: np.ndarray) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return x, y, z


def _frames() -> Iterator[Check]:
    """Everything turned, mirrored, or carried along by the water: the motion is, too."""
    here, t = _swinging(_same), np.arange(11.0)[:, None, None]
    turned, seen, along = _swinging(_quarter_turn), _swinging(_mirrored), _swinging(_same, 0.8)
    yield history_close("turned by 90 degrees: place, m", turned, _quarter_turn(here), ROUND_OFF, "round-off")
    yield history_close("in a mirror: place, m", seen, _mirrored(here), ROUND_OFF, "round-off")
    drift = t * np.array([0.8, 0.0, 0.0])
    yield history_close("carried along at 0.8 m/s: place, m", along - drift, here, ROUND_OFF, "round-off")


def _same_product() -> Iterator[Check]:
    """Twice the diameter at half the drag and a quarter of the added mass, in water that does not accelerate."""
    thick = replace(LINE, diameter=0.04, normal_drag=0.6, tangential_drag=0.01, added_mass=0.25)
    yield history_close("place, m", _swinging(_same, cable=thick), _swinging(_same), ROUND_OFF, "round-off")


def _summed(normal: float, quadratic: float) -> float:
    """How far the response to two inputs is from the sum of the responses, over its peak."""
    cable = CableData(2e7, 1.2, 8.0, 0.02, normal, 0.0)
    body = BodyData(300.0, 1500.0, 100.0, drag=quadratic)

    def respond(force: float, sway: float) -> np.ndarray:
        motion = Motion(steady(200.0), waving({0: (sway, 0.7)}, 2.0))
        model = RopeModel(cable, body, motion, elements=4)
        rows = []
        for k in range(40):
            model.step(0.25, force=(force * np.sin(0.175 * k), 0.0, 0.0))
            rows.append(model.position[:, 0])
        return np.array(rows)

    whole, parts = respond(5.0, 0.2), respond(5.0, 0.0) + respond(0.0, 0.2)
    return float(np.abs(whole - parts).max() / np.abs(parts).max())


def _superposed() -> Iterator[Check]:
    """Small motions in water are linear with its added mass, and not with its drag."""
    without, dragged = _summed(0.0, 0.0), _summed(1.2, 300.0)
    yield small("x of a sum less the sum of x, no drag, over its peak", without, 1e-4, "slopes of 1e-2, squared")
    yield at_least("the same with drag", dragged, 1e-2, "|u_n| u_n is not linear: it must be at least 1e-2")


def _out_and_in() -> Iterator[Check]:
    """A cable paid out and hauled in again hangs where it hung."""

    def law(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        omega = 2.0 * np.pi / 1200.0
        return 204.0 - 4.0 * np.cos(omega * t), 4.0 * omega * np.sin(omega * t)

    model = RopeModel(LINE, BODY, Motion(law), SteadyCurrent(HEIGHTS, _levels(SHEAR)), elements=4, force=_vector(FORCE))
    before = model.position
    model.step(600.0)
    out = np.abs(model.position - before).max()
    model.step(600.0)
    back = np.abs(model.position - before).max()
    yield small("place after 20 min, off over how far it was away", back / out, 1e-3, "what 2 cm/s of sliding leave")


def _drag_in_still_water() -> Iterator[Check]:
    """Drag only takes energy in still water, however the cable slides along itself."""
    motion = Motion(quintic_winch(200.0, 212.0, 20.0), waving(SWAYS, 2.0))
    model = RopeModel(LINE, BODY, motion, elements=4, booked=True)
    drags = ("work_drag", "work_body_drag")
    taken = np.diff(recorded(model, 0.05, 400, lambda: [model.works[name] for name in drags]), axis=0, prepend=0.0)
    yield small("largest work of drag in 50 ms, over its peak", max(taken.max(), 0.0) / -taken.min(), 0.0, "f.W <= 0")


def _slowed() -> Iterator[Check]:
    """Added mass slows the vibration of a cable whose body is held, and leaves it what it was along itself."""

    def modes(added: float) -> np.ndarray:
        line = CableData(2e7, 1.2, 1.2 * G, 0.02, 0.0, 0.0, added)
        return np.imag(RopeModel(line, BodyData(1e9, 5e3), fixed(200.0), elements=4).modes())

    free, wet = modes(0.0), modes(1.0)
    transverse = free[(free > 0.1) & (free < 3.0)]
    found = wet[(wet > 0.1) & (wet < 3.0 * 0.9)][: transverse.size]
    exact = transverse * np.sqrt(1.2 / (1.2 + 1025.0 * np.pi * 1e-4))
    yield each_close("frequencies across, rad/s", found[:4], exact[:4], 1e-5, "sqrt(rho/(rho + rho_a))")


CASES = (
    Case("rope, turned, mirrored and carried along", TWO_RUNS, "isotropy; Galilei", _frames),
    Case("rope, diameter for coefficients", TWO_RUNS, "only C d and C d^2 count", _same_product),
    Case("rope, superposition", "sum of two responses", "linear without drag", _superposed),
    Case("rope, out and in", TWO_RUNS, "the shape at rest", _out_and_in),
    Case("rope, drag in still water", "never above 0", "f.W <= 0", _drag_in_still_water),
    Case("rope, frequencies by added mass", "sqrt(rho/(rho + rho_a))", "closed form", _slowed),
)

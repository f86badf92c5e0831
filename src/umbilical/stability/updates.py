"""A controller written in Python as a linear system: differences of its own update, and whether they speak for it.

What it remembers is whatever number changes in its ``state``, or in the object itself, while it runs. Its linear
system is then held against the controller on small readings at random, at several times of the run: one that is not
smooth where it rests, that changes with time, or that reads or remembers something else, is not what is linearised.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from copy import deepcopy
from typing import Any, NamedTuple

import numpy as np

from umbilical.control.contract import Controller, Measurement
from umbilical.engine.linearise import SIZE, Linear, LinearisationPoint, Names, linearise
from umbilical.scenario.base import Record
from umbilical.stability.laws import READINGS

SETTLING = 2000
"""Updates within which a controller must come to rest on readings that do not change."""
STILL = 1e-9
REPLAYED = 60
"""Updates of one comparison."""
REPLAY_SIZE = 64.0 * SIZE
"""Size of the readings in a comparison: larger than the differences, so that a jump or a dead band is noticed."""
CLOSE = 1e-3
"""Largest difference of a comparison, relative to the largest thrust in it."""

Path = tuple[Any, ...]


class Doubt(Exception):
    """Why a controller has no linear system that speaks for it."""


class Rest(NamedTuple):
    """Where a controller is linearised.

    Attributes:
        seen: what it reads there.
        duration: of the run, s, over which it is compared.
    """

    seen: Measurement
    duration: float


def linearise_controller(controller: Controller, rest: Rest) -> Linear:
    """From the four readings at the ROV to the commanded thrust, once per ``controller.period``.

    Args:
        controller: anything with ``period``, ``start`` and ``update``; it is copied, and left as it is.
        rest: the operating point.

    Raises:
        Doubt: it has no linear system, or none that does what it does.
    """
    try:
        return _linearised(controller, rest)
    except Exception as error:
        if isinstance(error, Doubt):
            raise
        raise Doubt(f"it fails near the operating point: {type(error).__name__}: {error}") from error


def _linearised(controller: Controller, rest: Rest) -> Linear:
    settled = _settle(controller, rest)
    paths = _changing(settled, rest)

    def step(x: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        before = write_numbers(deepcopy(settled), dict(zip(paths, x, strict=True)))
        thrust, after = _update(before, 0.0, _read(rest.seen, u))
        return numbers(after), np.array([thrust])

    def numbers(pair: tuple[Any, Any]) -> np.ndarray:
        found = find_numbers(pair)
        return np.array([found[path] for path in paths])

    names = Names(tuple(".".join(map(str, path[1:])) for path in paths), READINGS, ("thrust_command",))
    law = linearise(step, LinearisationPoint(numbers(settled), np.zeros(len(READINGS)), names))
    if not (np.abs(law.c).any() or np.abs(law.d).any()):
        raise Doubt("its thrust answers no reading at the operating point")
    for share in (0.0, 0.5, 1.0):
        _compare(law, settled, rest, share * rest.duration)
    return law


def _settle(controller: Controller, rest: Rest) -> tuple[Any, Any]:
    """The controller and its state once they rest."""
    pair = (deepcopy(controller), None)
    pair = (pair[0], pair[0].start(rest.seen))
    before: dict[Path, float] = {}
    for k in range(SETTLING):
        _, pair = _update(pair, k * controller.period, rest.seen)
        now = find_numbers(pair)
        if k > 1 and now.keys() == before.keys() and all(_same(now[path], before[path], STILL) for path in now):
            return pair
        before = now
    raise Doubt(f"its memory does not come to rest within {SETTLING} updates on readings that do not change")


def _same(one: float, other: float, tolerance: float = 0.0) -> bool:
    return one == other or abs(one - other) <= tolerance * max(1.0, abs(one)) or (one != one and other != other)


def _changing(settled: tuple[Any, Any], rest: Rest) -> list[Path]:
    """Where the numbers are that change when the readings do."""
    first, pair = find_numbers(settled), deepcopy(settled)
    changed: set[Path] = set()
    for k, u in enumerate(_readings()):
        _, pair = _update(pair, k * pair[0].period, _read(rest.seen, u[:-1]))
        now = find_numbers(pair)
        if now.keys() != first.keys():
            raise Doubt("its memory changes its shape from update to update")
        changed |= {path for path, value in now.items() if not _same(value, first[path])}
    return [path for path in first if path in changed]


def _compare(law: Linear, settled: tuple[Any, Any], rest: Rest, begin: float) -> None:
    """Hold the linear system against the controller from a time on.

    Raises:
        Doubt: they differ.
    """
    steady, _ = _update(deepcopy(settled), begin, rest.seen)
    pair, x = deepcopy(settled), np.zeros(law.a.shape[0])
    said, linear = [], []
    for k, u in enumerate(_readings()):
        thrust, pair = _update(pair, begin + k * pair[0].period, _read(rest.seen, u[:-1], u[-1]))
        said.append(thrust - steady)
        linear.append((law.c @ x + law.d @ u[:-1])[0])
        x = law.a @ x + law.b @ u[:-1]
    apart, size = np.abs(np.subtract(said, linear)).max(), np.abs(said).max()
    if not apart <= CLOSE * size + STILL * abs(steady):
        share = f"{apart / max(size, 1e-300):.1%}"
        why = "it is not smooth at the operating point, changes with time, or reads or remembers something else"
        raise Doubt(f"what it commands from t = {begin:g} s on differs from its linearisation by {share}: {why}")


def _readings() -> np.ndarray:
    """Small readings at the ROV, and one more for the motors, update by update."""
    return REPLAY_SIZE * np.random.default_rng(1).standard_normal((REPLAYED, len(READINGS) + 1))


def _read(seen: Measurement, u: np.ndarray, motors: float = 0.0) -> Measurement:
    """The measurement at the operating point with other readings at the ROV; rates only where they are granted.

    ``motors`` is added to speeds and currents, which a law of the ROV's readings does not answer.
    """
    rates = {} if seen.tip_velocity is None else {"tip_velocity": float(u[2]), "tip_slope_rate": float(u[3])}
    driven = {"motor_speed": seen.motor_speed + motors, "motor_current": seen.motor_current + motors}
    return dataclasses.replace(seen, tip_displacement=float(u[0]), tip_slope=float(u[1]), **driven, **rates)


def _update(pair: tuple[Any, Any], t: float, seen: Measurement) -> tuple[float, tuple[Any, Any]]:
    """Thrust, and controller and state afterwards; they may be changed in place."""
    controller, state = pair
    command, state = controller.update(t, seen, state)
    if command.voltage is not None:
        raise Doubt("it sets the voltages itself, and the loop is opened at the commanded thrust")
    return float(command.thrust), (controller, state)


def find_numbers(tree: Any) -> dict[Path, float]:
    """Real numbers inside nested objects, each with the way to it; whole numbers count, they are no state.

    >>> find_numbers({"held": 1.5, "count": 3, "memory": (np.array([2.0]),)})
    {('held',): 1.5, ('memory', 0, (0,)): 2.0}
    """
    found: dict[Path, float] = {}
    _visit(tree, (), found.__setitem__)
    return found


def write_numbers(tree: Any, values: Mapping[Path, float]) -> Any:
    """Put numbers where :func:`find_numbers` found them: in place, but for what cannot be changed, which is new."""
    return _visit(tree, (), lambda path, number: values.get(path))


def _visit(tree: Any, path: Path, change: Callable[[Path, float], float | None]) -> Any:
    """The tree once every real number in it has been replaced by what ``change`` returns, unless that is None."""
    if isinstance(tree, (float, np.floating)):
        new = change(path, float(tree))
        return tree if new is None else new
    if isinstance(tree, np.ndarray) and tree.dtype.names is None:
        for place in np.ndindex(tree.shape) if tree.dtype.kind == "f" else ():
            if (new := change((*path, place), float(tree[place]))) is not None:
                tree[place] = new
        return tree
    parts = _parts(tree)
    new = {key: _visit(part, (*path, key), change) for key, part in parts.items()}
    changed = {key: part for key, part in new.items() if part is not parts[key]}
    if changed and isinstance(tree, tuple):
        return type(tree)(*new.values()) if hasattr(tree, "_fields") else type(tree)(new.values())
    for key, part in changed.items():
        if isinstance(tree, (dict, list)):
            tree[key] = part
        else:
            object.__setattr__(tree, key, part)
    return tree


def _parts(tree: Any) -> dict[Any, Any]:
    """What an object is made of, by index, key, field or attribute; nothing of a scenario, which never changes."""
    if isinstance(tree, np.ndarray):
        return {name: tree[name] for name in tree.dtype.names or ()}
    if isinstance(tree, dict):
        return dict(tree)
    if isinstance(tree, (tuple, list)):
        return dict(enumerate(tree))
    if isinstance(tree, (Record, type)) or callable(tree):
        return {}
    slots = [f.name for f in dataclasses.fields(tree)] if dataclasses.is_dataclass(tree) else []
    return {name: getattr(tree, name) for name in slots if hasattr(tree, name)} | dict(getattr(tree, "__dict__", {}))

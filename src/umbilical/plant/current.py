"""The current at the nodes of the cable: a profile over depth, linear between given depths, times a factor of time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import kernel
from umbilical.plant.layout import zeros
from umbilical.plant.orbital import LEVELS, RATE, VELOCITY, Levels, at_level, find_level
from umbilical.scenario.environment import Environment


class Flow(NamedTuple):
    """The water at the nodes of the cable, shape (5, n) each, and the waves' motion at their levels.

    Attributes:
        profile: of the current, m/s.
        speed: of the water, m/s: the profile times its factor of time, and the waves'.
        rate: of that, m/s2.
        orbit: speed and rate of the waves' motion, shape (2, 1, levels).
    """

    profile: np.ndarray
    speed: np.ndarray
    rate: np.ndarray
    orbit: np.ndarray


def make_flow(elements: int) -> Flow:
    """Water at rest."""
    at_nodes = zeros(3, 5, elements)
    return Flow(at_nodes[0], at_nodes[1], at_nodes[2], np.zeros((2, 1, LEVELS)))


class Profile(NamedTuple):
    """Speed at the first depth, m/s, and the pieces below it: their ends, m, and slopes, 1/s; none without a current.

    Attributes:
        surface: speed from the surface to the first depth, m/s.
        starts, spans, slopes: of each piece, shape (pieces,).
    """

    surface: float
    starts: np.ndarray
    spans: np.ndarray
    slopes: np.ndarray


def make_profile(environment: Environment) -> Profile:
    """The profile of a scenario's current."""
    current = environment.water.current if environment.water else None
    if current is None:
        return Profile(0.0, np.zeros(0), np.zeros(0), np.zeros(0))
    depths, speeds = np.array(current.depths), np.array(current.speeds)
    spans = np.diff(depths)
    return Profile(float(speeds[0]), depths[:-1].copy(), spans, np.diff(speeds) / spans)


@kernel
def fill(profile: Profile, above: np.ndarray, out: np.ndarray, length: float, heave: float) -> None:
    """Speed of the water at the nodes, m/s, shape (5, n) as ``above``: 1 - sigma; a node is ``l sigma - heave`` deep.

    A sum over the pieces of clipped lines, so that a row of nodes is worked out at once.
    """
    elements = out.shape[1]
    for j in range(5):
        row, share = out[j], above[j]
        for k in range(profile.starts.size):
            start, span, slope = profile.starts[k], profile.spans[k], profile.slopes[k]
            if k == 0:
                for e in range(elements):
                    depth = length * (1.0 - share[e]) - heave
                    row[e] = profile.surface + slope * min(max(depth - start, 0.0), span)
            else:
                for e in range(elements):
                    row[e] += slope * min(max(length * (1.0 - share[e]) - heave - start, 0.0), span)


@kernel
def scale(profile: np.ndarray, factor: float, out: np.ndarray) -> None:
    """out: a profile times its factor of time, or times the rate of that."""
    for j in range(5):
        row, scaled = profile[j], out[j]
        for e in range(row.size):
            scaled[e] = factor * row[e]


@kernel
def add_waves(levels: Levels, above: np.ndarray, flow: Flow, length: float, heave: float) -> None:
    """Add what the waves do, as ``flow.orbit`` has it; ``above`` as in :func:`fill`."""
    swift, quick = flow.orbit[VELOCITY, 0], flow.orbit[RATE, 0]
    for j in range(5):
        for e in range(above.shape[1]):
            level = find_level(levels, length * (1.0 - above[j, e]) - heave)
            if level >= 0.0:
                flow.speed[j, e] += at_level(swift, level)
                flow.rate[j, e] += at_level(quick, level)


def speeds_at(environment: Environment, depths: np.ndarray) -> np.ndarray:
    """The profile at any depths, m/s, same shape; zero without a current."""
    current = environment.water.current if environment.water else None
    if current is None:
        return np.zeros(np.shape(depths))
    return np.interp(depths, current.depths, current.speeds)

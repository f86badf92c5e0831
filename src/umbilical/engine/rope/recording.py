"""What a run of the rope leaves behind: stored samples of everything, and measures of every control sample."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.control.contract import MotorDecision, OuterDecision
from umbilical.engine.recording import (
    Measures,
    MotorDerived,
    MotorTally,
    Probe,
    make_probes,
    measure_loop,
    motor_log,
    motor_tallies,
    named_fields,
    note,
    store_loop,
)
from umbilical.engine.rope.world import RopeNow, RopeWorld
from umbilical.frames import Frame, integer, real
from umbilical.plant.layout import integrate, to_nodal
from umbilical.plant.motors import MotorState
from umbilical.plant.rope.records import POWERS, RopeConstants
from umbilical.quantities import CHANNELS
from umbilical.scenario.hardware import Motor

MOST_STRETCH = 2.0
"""A cable twice as long as it was made has parted long before."""
TAUT = 1.0
"""N; the cable is slack where less pulls."""
MOST_SNAPS = 1000
"""Snaps of which instant and peak are kept; all are counted."""


class SnapWatch(Frame):
    """Slack and snaps so far; ``snap_window`` is how long after slack a peak counts as its snap."""

    top_tension_peak = real()
    end_tension_peak = real()
    lowest_tension = real()
    slack_samples = integer()
    snaps = integer()
    largest_snap = real()
    watch_radius = real()
    smallest_stretch = real()
    was_slack = integer()
    snap_time = real()
    snap_window = real()


class RopeLog(NamedTuple):
    """Stored samples.

    Attributes:
        now, outer, across: records, shape (samples,).
        works: in the order of ``POWERS``, shape (samples, terms).
        motors, decisions, motors_derived: shape (samples, motors).
        kappa: shape (samples, motors + 1).
        nodes: l r_x and velocities at the nodes, shape (samples, 5, 6 n).
    """

    now: RopeNow
    outer: OuterDecision
    across: OuterDecision
    works: np.ndarray
    motors: MotorState
    decisions: MotorDecision
    motors_derived: MotorDerived
    kappa: np.ndarray
    nodes: np.ndarray


class RopeTally(NamedTuple):
    """Running measures over every control sample.

    Attributes:
        probes: at l/4, l/2 and 3l/4.
        measures, watch: one record each.
        motors: one record per motor.
        start: place of the body at the start, m, shape (3,).
        snaps: instant, s, and peak, N, of the first snaps, shape (MOST_SNAPS, 2).
    """

    probes: Probe
    measures: Measures
    watch: SnapWatch
    motors: MotorTally
    start: np.ndarray
    snaps: np.ndarray


def make_rope_log(samples: int, motors: int, elements: int) -> RopeLog:
    """Room for all samples of a run."""
    frames = (frame.many(samples) for frame in (RopeNow, OuterDecision, OuterDecision))
    works, nodes = np.zeros((samples, len(POWERS))), np.zeros((samples, 5, 6 * elements))
    return RopeLog._make((*frames, works, *motor_log(samples, motors), nodes))


def make_rope_tally(elements: int, motors: tuple[Motor, ...], window: float, start: np.ndarray) -> RopeTally:
    """Nothing seen yet; ``window`` as in :class:`SnapWatch`."""
    watch, snaps = SnapWatch.many(1), np.zeros((MOST_SNAPS, 2))
    watch["lowest_tension"], watch["smallest_stretch"] = np.inf, np.inf
    watch["snap_window"], watch["snap_time"] = window, -np.inf
    probes, tallies = make_probes(elements), motor_tallies(motors)
    return RopeTally(probes, Measures.many(1), watch, tallies, start.copy(), snaps)


@kernel
def displacement_at(tally: RopeTally, world: RopeWorld, k: int) -> float:
    """x of the cable at the k-th probe, m."""
    rope, e, w = world.state.rope, tally.probes[k].element, tally.probes[k].slope_weights
    total = rope.joints[0, e]
    for j in range(5):
        total += w[j] * rope.now[j, e]
    return total


@kernel
def watch_tension(tally: RopeTally, now: RopeNow, lowest: float, time: float) -> None:
    """Peaks of the tension, slack, and the snaps that follow it."""
    watch = tally.watch[0]
    watch.top_tension_peak = max(watch.top_tension_peak, now.top_tension)
    watch.end_tension_peak = max(watch.end_tension_peak, now.end_tension)
    watch.lowest_tension = min(watch.lowest_tension, now.lowest_tension)
    watch.smallest_stretch = min(watch.smallest_stretch, lowest)
    off_x, off_y = now.body_position[0] - tally.start[0], now.body_position[1] - tally.start[1]
    watch.watch_radius = max(watch.watch_radius, np.sqrt(off_x * off_x + off_y * off_y))
    if now.lowest_tension < TAUT:
        watch.slack_samples += 1
        watch.was_slack = 1
        return
    if watch.was_slack == 1:
        watch.was_slack = 0
        if time - watch.snap_time > watch.snap_window:
            watch.snaps += 1
            watch.snap_time = time
            if watch.snaps <= MOST_SNAPS:
                tally.snaps[watch.snaps - 1, 0] = time
    if time - watch.snap_time <= watch.snap_window:
        peak = max(now.top_tension, now.end_tension)
        watch.largest_snap = max(watch.largest_snap, peak)
        if watch.snaps <= MOST_SNAPS and peak > tally.snaps[watch.snaps - 1, 1]:
            tally.snaps[watch.snaps - 1, 0], tally.snaps[watch.snaps - 1, 1] = time, peak


@kernel
def stretches(world: RopeWorld) -> tuple[float, float]:
    """Smallest and largest |r_x| along the cable; the largest is not finite where one is not."""
    s = world.state.rope.stretch
    lowest, highest = np.inf, 0.0
    for j in range(5):
        for e in range(s.shape[1]):
            lowest = min(lowest, s[j, e])
            highest = s[j, e] if not s[j, e] <= highest else highest
            if not s[j, e] < np.inf:
                return lowest, np.inf
    return lowest, highest


@glue
def measure_rope(tally: RopeTally, world: RopeWorld, after_fault: bool, time: float) -> bool:
    """Take one control sample into the tally; False if the model has ended (not finite, or torn)."""
    state, decision = world.state, world.along.decision
    now, found = state.now[0], tally.measures[0]
    note(found.quarter, displacement_at(tally, world, 0))
    note(found.mid, displacement_at(tally, world, 1))
    note(found.three_quarter, displacement_at(tally, world, 2))
    finite = measure_loop(tally, now.tip_displacement, now.tip_velocity, now.thrust, state, decision, after_fault)
    lowest, highest = stretches(world)
    watch_tension(tally, now, lowest, time)
    return finite and highest < MOST_STRETCH


@kernel
def store_rope(log: RopeLog, row: int, tally: RopeTally, world: RopeWorld, kappa: np.ndarray) -> None:
    """Store one sample of everything."""
    state = world.state
    log.now[row] = state.now[0]
    log.across[row] = world.across.decision.outer[0]
    store_loop(log, row, tally, state, world.along.decision, kappa)
    for k in range(state.rope.work.size):
        log.works[row, k] = state.rope.work[k]
    for j in range(5):
        for k in range(state.rope.now.shape[1]):
            log.nodes[row, j, k] = state.rope.now[j, k]


def rope_channels(log: RopeLog, samples: int, driven: bool, rope: RopeConstants) -> dict[str, np.ndarray]:
    """The first ``samples`` stored samples by name, in the order of ``CHANNELS``."""
    named = named_fields(log, (log.now["outside"], log.now, log.outer), samples, driven)
    for name in ("thrust_command", "boundary_error", "disturbance_estimate"):
        named[f"{name}_across"] = log.across[name][:samples].copy()
    named |= {name: log.works[:samples, k].copy() for k, name in enumerate(POWERS)}
    named["disturbance"] = named["payload_force"] + named["thrust"] - named["thrust_command"]
    named["vessel_displacement"] = named["vessel_position"][:, 0].copy()
    named |= along_rope(log.nodes[:samples], named, rope)
    return {name: named[name] for name in CHANNELS if name in named}


def along_rope(nodes: np.ndarray, named: dict[str, np.ndarray], rope: RopeConstants) -> dict[str, np.ndarray]:
    """Place, tension and what the string has of the direction x, along the cable, (samples, 4 n + 1)."""
    samples, n = nodes.shape[0], nodes.shape[2] // 6
    parts = np.moveaxis(nodes.reshape(samples, 5, 6, n), 2, 1)
    position = named["vessel_position"][:, :, None] + integrate(parts[:, :3])
    stretch = np.sqrt((parts[:, :3] ** 2).sum(axis=1))
    pull = rope.stiffness * np.maximum(stretch / named["length"][:, None, None] - 1.0, 0.0)
    tension, slope, velocity = to_nodal(pull), to_nodal(parts[:, 0] / stretch), to_nodal(parts[:, 3])
    tension[:, 0], tension[:, -1] = named["top_tension"], named["end_tension"]
    slope[:, 0], slope[:, -1], velocity[:, -1] = named["vessel_slope"], named["tip_slope"], named["tip_velocity"]
    return {
        "position": position, "tension": tension, "displacement": position[:, 0].copy(), "slope": slope,
        "velocity": velocity,
    }  # fmt: skip

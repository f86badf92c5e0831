"""Checks of motors, faults and sensors, and of a section that belongs to another model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import inf

from umbilical.errors import Problem
from umbilical.plant.checks.timeline import MOST_JUMPS, ends_after_its_start, numbered
from umbilical.relations.instants import apart, is_multiple, nearest_count, slack
from umbilical.scenario.control import Control
from umbilical.scenario.faults import Dead, Fault, Intermittent, Stuck
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.hardware import Motor
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.sensors import Channel, Sensors


def motors_are_there(motors: Sequence[Motor], ideal_thruster: bool, control: Control) -> Iterator[Finding]:
    """A law that commands a thrust has something to deliver it."""
    if not motors and not ideal_thruster and control.law.closes_loop:
        yield Problem("motors", "none", "at least one", f"the law '{control.law.kind}' commands a thrust",
                      "add [[motors]], or set ideal_thruster = true")  # fmt: skip


def thrust_coefficients(motors: Sequence[Motor]) -> Iterator[Finding]:
    """A propeller pushes one way or the other."""
    for key, motor in numbered("motors", motors):
        if motor.thrust_coefficient == 0.0:
            yield Problem(f"{key}.thrust_coefficient", "0.0 N s2/rad2", "above or below 0", "the thrust is K_T |w| w",
                          "the sign says which way it pushes")  # fmt: skip


def faults_have_a_motor(faults: Sequence[Fault], motors: Sequence[Motor], ideal_thruster: bool) -> Iterator[Finding]:
    """A fault acts on a motor that is simulated."""
    for key, fault in numbered("faults", faults):
        if ideal_thruster:
            yield Problem(key, f'"{fault.kind}" of motor {fault.motor}', "none with ideal_thruster",
                          "an ideal thruster delivers what it is told, without the motors this fault acts on",
                          "set ideal_thruster = false, or leave the fault out")  # fmt: skip
        elif fault.motor > len(motors):
            bound = f"a motor from 1 to {len(motors)}" if motors else "a motor, and there is none"
            reason, fix = "motors are numbered from 1", "name a motor that exists"
            yield Problem(f"{key}.motor", str(fault.motor), bound, reason, fix)


def faults_end_after_they_start(faults: Sequence[Fault]) -> Iterator[Finding]:
    """Recovery follows failure."""
    for key, fault in numbered("faults", faults):
        fix = "a later end, or none for a fault that stays"
        yield from ends_after_its_start(key, fault, "recovery follows failure", fix)


def intermittent_faults(faults: Sequence[Fault], duration: float) -> Iterator[Finding]:
    """An intermittent fault switches a number of times that can be simulated."""
    for key, fault in numbered("faults", faults):
        present = max(min(fault.end or duration, duration) - fault.start, 0.0)
        if isinstance(fault, Intermittent) and 2.0 * present / fault.cycle > MOST_JUMPS:
            yield Problem(f"{key}.cycle", amount(fault.cycle, "s"),
                          f"at least {2.0 * present / MOST_JUMPS:g} s, for {MOST_JUMPS:g} switches",
                          "a step of the plant ends on each switch", "a longer cycle")  # fmt: skip


def stuck_once_at_a_time(faults: Sequence[Fault]) -> Iterator[Finding]:
    """A motor cannot be stuck at two values at once."""
    holding = [(key, fault) for key, fault in numbered("faults", faults) if isinstance(fault, Dead | Stuck)]
    for (first, a), (second, b) in combinations(holding, 2):
        same = (a.motor, a.target) == (b.motor, b.target)
        begin, end = max(a.start, b.start), min(a.end or inf, b.end or inf)
        if same and end - begin > slack(begin):
            yield Problem(second, f'"{b.kind}" from {apart(b.start, end)[0]} s',
                          f"not while {first} holds the {a.target} of motor {a.motor}",
                          "a motor is dead or stuck at one value at a time",
                          "end one before the other starts")  # fmt: skip


def latencies(sensors: Sensors, control: Control) -> Iterator[Finding]:
    """A reading is whole control periods old."""
    period = control.period
    for name, channel in ((name, getattr(sensors, name)) for name in Sensors.model_fields):
        if isinstance(channel, Channel) and channel.latency and not is_multiple(channel.latency, period):
            late = apart(channel.latency, nearest_count(channel.latency, period) * period)[0]
            yield Problem(f"sensors.{name}.latency", f"{late} s", f"0 or a multiple of control.period = {period:g} s",
                          "sensors are read once per period; an older reading is one of an earlier period",
                          "round it to whole periods")  # fmt: skip


def rope_is_read(scenario: Scenario) -> Iterator[Finding]:
    """A section that nobody reads is told."""
    if scenario.rope is not None and scenario.model != "rope":
        yield Notice("rope", 'nothing of this section counts for the string; model = "rope" reads it')

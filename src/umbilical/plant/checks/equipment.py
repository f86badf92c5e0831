"""Checks of motors, faults and sensors, and of a section that belongs to another model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import inf

from umbilical.errors import Problem
from umbilical.plant.checks.timeline import MOST_JUMPS
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
        yield Problem(
            "motors",
            "none",
            "at least one",
            f"the law '{control.law.kind}' commands a thrust",
            "add [[motors]], or set ideal_thruster = true",
        )


def thrust_coefficients(motors: Sequence[Motor]) -> Iterator[Finding]:
    """A propeller pushes one way or the other."""
    for number, motor in enumerate(motors, start=1):
        if motor.thrust_coefficient == 0.0:
            yield Problem(
                f"motors.{number}.thrust_coefficient",
                "0.0 N s2/rad2",
                "above or below 0",
                "the thrust is K_T |w| w",
                "the sign says which way it pushes",
            )


def faults_have_a_motor(faults: Sequence[Fault], motors: Sequence[Motor], ideal_thruster: bool) -> Iterator[Finding]:
    """A fault acts on a motor that is simulated."""
    for number, fault in enumerate(faults, start=1):
        if ideal_thruster:
            yield Problem(
                f"faults.{number}",
                f'"{fault.kind}" of motor {fault.motor}',
                "none with ideal_thruster",
                "an ideal thruster delivers what it is told, without the motors this fault acts on",
                "set ideal_thruster = false, or leave the fault out",
            )
        elif fault.motor > len(motors):
            bound = f"a motor from 1 to {len(motors)}" if motors else "a motor, and there is none"
            yield Problem(
                f"faults.{number}.motor",
                str(fault.motor),
                bound,
                "motors are numbered from 1",
                "name a motor that exists",
            )


def faults_end_after_they_start(faults: Sequence[Fault]) -> Iterator[Finding]:
    """Recovery follows failure."""
    for number, fault in enumerate(faults, start=1):
        if fault.end is not None and fault.end <= fault.start:
            end, start = apart(fault.end, fault.start)
            yield Problem(
                f"faults.{number}.end",
                f"{end} s",
                f"above start = {start} s",
                "recovery follows failure",
                "a later end, or none for a fault that stays",
            )


def intermittent_faults(faults: Sequence[Fault], duration: float) -> Iterator[Finding]:
    """An intermittent fault switches a number of times that can be simulated."""
    for number, fault in enumerate(faults, start=1):
        present = max(min(fault.end or duration, duration) - fault.start, 0.0)
        if isinstance(fault, Intermittent) and 2.0 * present / fault.cycle > MOST_JUMPS:
            yield Problem(
                f"faults.{number}.cycle",
                amount(fault.cycle, "s"),
                f"at least {2.0 * present / MOST_JUMPS:g} s, for {MOST_JUMPS:g} switches",
                "a step of the plant ends on each switch",
                "a longer cycle",
            )


def stuck_once_at_a_time(faults: Sequence[Fault]) -> Iterator[Finding]:
    """A motor cannot be stuck at two values at once."""
    holding = [(number, fault) for number, fault in enumerate(faults, start=1) if isinstance(fault, Dead | Stuck)]
    for (first, a), (second, b) in combinations(holding, 2):
        same = (a.motor, a.target) == (b.motor, b.target)
        begin, end = max(a.start, b.start), min(a.end or inf, b.end or inf)
        if same and end - begin > slack(begin):
            start, _ = apart(b.start, end)
            yield Problem(
                f"faults.{second}",
                f'"{b.kind}" from {start} s',
                f"not while faults.{first} holds the {a.target} of motor {a.motor}",
                "a motor is dead or stuck at one value at a time",
                "end one before the other starts",
            )


def latencies(sensors: Sensors, control: Control) -> Iterator[Finding]:
    """A reading is whole control periods old."""
    for name in Sensors.model_fields:
        channel = getattr(sensors, name)
        if isinstance(channel, Channel) and channel.latency and not is_multiple(channel.latency, control.period):
            yield Problem(
                f"sensors.{name}.latency",
                f"{apart(channel.latency, nearest_count(channel.latency, control.period) * control.period)[0]} s",
                f"0 or a multiple of control.period = {control.period:g} s",
                "sensors are read once per period; an older reading is one of an earlier period",
                "round it to whole periods",
            )


def rope_is_read(scenario: Scenario) -> Iterator[Finding]:
    """A section that nobody reads is told."""
    if scenario.rope is not None and scenario.model != "rope":
        yield Notice("rope", 'nothing of this section counts for the string; model = "rope" reads it')

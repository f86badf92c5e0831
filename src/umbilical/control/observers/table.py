"""The observers of the rates at the ROV, which every law reads; that of a force belongs to the law that meets it."""

from __future__ import annotations

from typing import NamedTuple

from umbilical.compile import glue
from umbilical.control.contract import OuterDecision, TipReadings
from umbilical.control.observers.high_gain import (
    HighGain,
    HighGainMemory,
    advance_high_gain,
    derivative_estimate,
    make_high_gain,
    start_high_gain,
)
from umbilical.frames import Frame, part
from umbilical.scenario.control import Control


class Observers(NamedTuple):
    """Observers of Dy/Dt and D(y_x)/Dt; ``ideal_rates``: both are measured."""

    ideal_rates: bool
    velocity: HighGain
    slope: HighGain


class ObserverMemory(Frame):
    """What the observers remember."""

    velocity = part(HighGainMemory)
    slope = part(HighGainMemory)


def make_observers(control: Control, period: float) -> Observers:
    """Observers for one period of the outer loop."""
    velocity, slope = (make_high_gain(o, period) for o in (control.velocity_observer, control.slope_observer))
    return Observers(control.law.reads_rates, velocity, slope)


@glue
def start_observers(memory: ObserverMemory, tip: TipReadings) -> None:
    """Rest on the first sample."""
    start_high_gain(memory.velocity, tip.tip_displacement)
    start_high_gain(memory.slope, tip.tip_slope)


@glue
def observe_rates(
    observers: Observers, memory: ObserverMemory, tip: TipReadings, out: OuterDecision, advance: bool
) -> None:
    """Estimate the rates; ``advance`` is False at the first update, before which no period has passed."""
    if advance:
        advance_high_gain(observers.velocity, memory.velocity, tip.tip_displacement)
        advance_high_gain(observers.slope, memory.slope, tip.tip_slope)
    if observers.ideal_rates:
        out.tip_velocity_estimate, out.tip_slope_rate_estimate = tip.tip_velocity, tip.tip_slope_rate
    else:
        out.tip_velocity_estimate = derivative_estimate(observers.velocity, memory.velocity)
        out.tip_slope_rate_estimate = derivative_estimate(observers.slope, memory.slope)

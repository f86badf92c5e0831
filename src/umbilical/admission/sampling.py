"""Checks of gains against the periods they are sampled at.

A gain is a rate, 1/s; held for a period it must move what it acts on by less than the whole way. The plant
in between is exact, so these bounds are about the controller alone. They are necessary, not sufficient: the
stability of the whole sampled loop is judged by its spectrum, not here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from umbilical.admission.controller import drives_motors, needs
from umbilical.admission.findings import Finding, amount
from umbilical.errors import Problem
from umbilical.scenario.control import AdaptiveAllocation, BoundaryLaw, Control, ProportionalDerivative
from umbilical.scenario.hardware import Motor, Payload


def outer_period(control: Control) -> float:
    """Period of the outer law, its observers and its adaptation, s."""
    return control.outer_period or control.period


def high_gain_observers(control: Control) -> Iterator[Finding]:
    """An observer that is sampled more rarely than it acts returns an estimate of the past."""
    period = outer_period(control)
    for name in ("velocity_observer", "slope_observer"):
        observer = getattr(control, name)
        if getattr(needs(control), name) and observer and observer.time_constant < 2.0 * period * (1.0 - 1e-9):
            yield Problem(
                f"control.{name}.time_constant",
                amount(observer.time_constant, "s"),
                f"at least {2.0 * period:g} s, two periods of the outer loop",
                "a sample older than half the observer's time makes its estimate lag more than it filters",
                "a larger time_constant, or a shorter control period",
            )


def boundary_law(control: Control, payload: Payload) -> Iterator[Finding]:
    """The boundary damping acts on an estimate that keeps up with the ROV."""
    law, observer, period = control.law, control.velocity_observer, outer_period(control)
    if not isinstance(law, BoundaryLaw):
        return
    yield from _product("control.law.damping_gain", law.damping_gain, "N s/m", 1.0 / payload.mass, period)
    if not observer or not needs(control).velocity_observer:
        return
    limit = observer.damping * payload.mass / law.damping_gain
    if observer.time_constant >= limit:
        yield Problem(
            "control.velocity_observer.time_constant",
            amount(observer.time_constant, "s"),
            f"below damping * mass / damping_gain = {limit:.6g} s",
            "with a slower observer the damping k_a arrives too late and drives the ROV instead",
            "a smaller time_constant or a smaller control.law.damping_gain",
        )


def proportional_derivative(control: Control, payload: Payload) -> Iterator[Finding]:
    """The PD baseline, sampled, still is a spring and a damper."""
    law, period = control.law, outer_period(control)
    if isinstance(law, ProportionalDerivative):
        yield from _product("control.law.velocity_gain", law.velocity_gain, "N s/m", 1.0 / payload.mass, period)
        yield from _product("control.law.position_gain", law.position_gain, "N/m", period / payload.mass, period)


def disturbance_observer(control: Control) -> Iterator[Finding]:
    """The estimate D^ moves towards D, not past it."""
    observer = control.disturbance_observer
    if isinstance(control.law, BoundaryLaw) and observer and observer.enabled:
        yield from _product("control.disturbance_observer.gain", observer.gain, "1/s", 1.0, outer_period(control))


def adaptation(control: Control) -> Iterator[Finding]:
    """The leak of the adaptive law forgets, and does not overshoot."""
    law = control.allocation
    if isinstance(law, AdaptiveAllocation):
        fastest = max(law.rates)
        yield from _product("control.allocation.leak", law.leak, "", max(fastest, 0.0), outer_period(control))


def motor_loop(control: Control, ideal_thruster: bool, motors: Sequence[Motor]) -> Iterator[Finding]:
    """The gains of the inner loop, robust terms included, at the controller's period."""
    loop, period = control.motor_loop, control.period
    if loop is None or not motors or not drives_motors(control, ideal_thruster):
        return
    # Near a zero error the smooth robust term is a gain of its own: bound * factor / width.
    robust_speed = loop.speed_bound * loop.robust_factor / loop.speed_width
    robust_current = loop.current_bound * loop.robust_factor / loop.current_width
    place = "control.motor_loop"
    yield from _sum(f"{place}.speed_gain", loop.speed_gain, robust_speed, "speed", period)
    yield from _sum(f"{place}.current_gain", loop.current_gain, robust_current, "current", period)
    yield from _product(f"{place}.observer_gain", loop.observer_gain, "1/s", 1.0, period)
    yield from _product(f"{place}.filter_frequency", loop.filter_frequency, "rad/s", 1.0, period)


def _product(key: str, gain: float, unit: str, factor: float, period: float) -> Iterator[Finding]:
    """The rate ``gain * factor``, 1/s, times the period stays below 1."""
    if gain * factor * period >= 1.0:
        yield Problem(
            key,
            amount(gain, unit),
            f"below {1.0 / (factor * period):.6g}{' ' * bool(unit)}{unit} at a period of {period:g} s",
            f"held for one period it moves what it acts on by {gain * factor * period:.3g} of the way, past its goal",
            "a smaller gain or a shorter period",
        )


def _sum(key: str, gain: float, robust: float, name: str, period: float) -> Iterator[Finding]:
    """The gain and the slope of its robust term together, 1/s, times the period stay below 1."""
    if (gain + robust) * period >= 1.0:
        yield Problem(
            key,
            amount(gain, "1/s"),
            f"{name}_gain + {name}_bound * robust_factor / {name}_width below {1.0 / period:.6g} 1/s, "
            f"and {gain:g} + {robust:g} = {gain + robust:.6g} 1/s",
            f"the voltage is held for {period:g} s; such a gain overshoots within it and the voltage alternates",
            f"a smaller {name}_gain or {name}_bound, a larger {name}_width, or a shorter control.period",
        )

"""From a scenario to a run."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import perf_counter
from typing import NamedTuple

import numpy as np

from umbilical.admission import admit
from umbilical.admission.steps import chosen_step
from umbilical.analysis.energy import energy, relative_residual, residual, scale_of
from umbilical.compile import announce
from umbilical.control import cascade
from umbilical.control.contract import Controller, make_decision, make_readings
from umbilical.engine import loop
from umbilical.engine.recording import WORKS, Log, Tally, channels, inside, make_log, make_tally, root_mean_square
from umbilical.engine.saturation import saturation, saturation_notices
from umbilical.engine.schedule import Clock, make_clock, stretch
from umbilical.engine.sensing import Dice, make_sensor_state, make_sensors
from umbilical.engine.stepping import make_plant, make_plant_state
from umbilical.errors import ControllerError, Problem, ScenarioError
from umbilical.plant import faults
from umbilical.plant.exogenous import Outside, published_jumps
from umbilical.plant.layout import positions
from umbilical.relations.instants import apart, count_up, is_multiple, nearest_count
from umbilical.run import Run, Status, assemble
from umbilical.scenario.scenario import Scenario

STEPS_AT_ONCE = 10000
"""Plant steps between two looks at the outside world, at progress and at Ctrl-C. No result depends on it."""


class Ending(NamedTuple):
    """How the loop came back: after how many updates, at what time, and why."""

    status: Status
    reason: str
    updates: int
    time: float
    error: ControllerError | None = None


class Outcome(NamedTuple):
    """What :func:`measure` keeps of a run: how it ended, when and why, and its metrics in SI units."""

    status: Status
    reason: str
    end_time: float
    metrics: dict[str, float]


class Setup(NamedTuple):
    """Everything a run needs, built from its scenario."""

    clock: Clock
    world: loop.World
    record: loop.Record
    dice: Dice
    decider: loop.BuiltIn | loop.Python


def simulate(
    scenario: Scenario,
    controller: Controller | None = None,
    *,
    progress: Callable[[float], None] | None = None,
) -> Run:
    """Simulate a scenario from start to end.

    Args:
        scenario: what to simulate; checked completely before the first step.
        controller: replaces the scenario's own. Anything with ``period``, ``start`` and ``update``
            (:class:`~umbilical.control.contract.Controller`).
        progress: called now and then with the share of the run that is done, 0 to 1.

    Returns:
        The run. A loop that diverges or is interrupted is a run too: ``status`` and ``reason`` say so,
        and the samples up to then are kept.

    Raises:
        ScenarioError: the scenario was refused, with every problem.
        ControllerError: the user's controller raised or broke its contract; ``error.run`` has the samples
            up to then.

    >>> import umbilical
    >>> scenario = umbilical.load("crosscheck-none").replace({"duration": 1.0})
    >>> run = simulate(scenario)
    >>> run.status.name, 0.05 < run.metrics["tip_peak"] < 0.15
    ('COMPLETED', True)
    """
    begun = perf_counter()
    notices = tuple(str(notice) for notice in admit(scenario))
    setup = set_up(scenario, controller)
    prepared = perf_counter()
    ending, sampling = _run(scenario, setup, progress)
    simulated = perf_counter()
    timing = {"prepare_s": prepared - begun, "simulate_s": simulated - prepared, "outside_s": sampling}
    notices += tuple(str(notice) for notice in saturation_notices(scenario, setup.record.tally))
    run = _assemble(scenario, setup, ending, notices, timing)
    if ending.error is not None:
        ending.error.run = run
        raise ending.error
    return run


def measure(scenario: Scenario, controller: Controller | None = None) -> Outcome:
    """Simulate for the metrics alone: the same numbers as :func:`simulate`, without storing or labelling a sample.

    What is read from stored fields, the power balance, is left out.

    Raises:
        ScenarioError, ControllerError: as :func:`simulate`.

    >>> import umbilical
    >>> scenario = umbilical.load("crosscheck-none").replace({"duration": 1.0})
    >>> measure(scenario).metrics["tip_peak"] == simulate(scenario).metrics["tip_peak"]
    True
    """
    admit(scenario)
    setup = set_up(scenario, controller, stored=False)
    ending, _ = _run(scenario, setup, None)
    if ending.error is not None:
        raise ending.error
    metrics = {name: float(value) for name, value in _all_metrics(scenario, setup).items()}
    return Outcome(ending.status, ending.reason, ending.time, metrics)


def rehearse(scenario: Scenario, controller: Controller) -> None:
    """Take the first two updates of a controller in an admitted scenario, and forget them.

    Raises:
        ScenarioError, ControllerError: as :func:`simulate`.
    """
    setup = set_up(scenario, controller, stored=False)
    count = min(round(controller.period / scenario.control.period) + 1, setup.clock.periods)
    part = stretch(setup.clock, 0, count)
    inputs = Outside(scenario).sample(part.steps)
    inputs.refresh[0] = True
    setup.decider.run(inputs, part.first, setup.dice.draw(count), 0)


def set_up(scenario: Scenario, controller: Controller | None = None, *, stored: bool = True) -> Setup:
    """The plant at rest with its sensors, record and controller, before the first step.

    With ``stored`` false the record holds the first and the last sample only, and no power is booked.
    """
    announce()
    period, every = scenario.control.period, 1
    if controller is not None:
        period, every = _periods(scenario, controller)
    clock = make_clock(scenario.duration, period, chosen_step(scenario), published_jumps(scenario))
    motors = len(scenario.motors)
    sensors, readings = make_sensors(scenario), make_readings(motors)
    world = loop.World(
        make_plant(scenario, booked=stored),
        make_plant_state(scenario),
        sensors,
        make_sensor_state(sensors, readings),
        readings,
        make_decision(motors),
    )
    record = _record(scenario, clock, stored)
    settings, memory = cascade.make_settings(scenario), cascade.make_state(scenario)
    if controller is None:
        decider: loop.BuiltIn | loop.Python = loop.BuiltIn(world, settings, memory, record)
    else:
        drive, ideal = cascade.with_known_factors(settings), scenario.sensors.ideal_velocity
        decider = loop.Python(world, drive, memory, record, controller, period, every, ideal)
    return Setup(clock, world, record, Dice(sensors, scenario.seed), decider)


def _periods(scenario: Scenario, controller: Controller) -> tuple[float, int]:
    """Period of the loop, and how many of them pass between two calls of a user's controller."""
    own, loops = float(controller.period), scenario.control.period
    if not np.isfinite(own) or not is_multiple(own, loops):
        raise ScenarioError(
            [
                Problem(
                    f"{type(controller).__name__}.period",
                    f"{apart(own, loops)[0]} s",
                    f"a multiple of control.period = {loops:g} s",
                    "the motor loops and the sensors run at control.period",
                    "set control.period to the controller's period or to a fraction of it",
                )
            ]
        )
    return loops, nearest_count(own, loops)


def _record(scenario: Scenario, clock: Clock, stored: bool) -> loop.Record:
    every = max(1, round(scenario.output.interval / clock.period) if stored else clock.periods)
    samples = clock.periods // every + 1 + (clock.periods % every > 0)
    first = faults.first_fault(scenario.faults)
    fault_update = clock.periods + 1 if first is None else count_up(first, clock.period)
    elements = scenario.grid.elements
    return loop.Record(
        make_log(samples, len(scenario.motors), elements),
        make_tally(elements, scenario.motors),
        every,
        fault_update,
        clock.periods,
    )


def _run(scenario: Scenario, setup: Setup, progress: Callable[[float], None] | None) -> tuple[Ending, float]:
    """The loop, stretch by stretch; also the seconds spent sampling the outside world."""
    clock, decider = setup.clock, setup.decider
    length = max(1, STEPS_AT_ONCE // clock.substeps)
    outside = Outside(scenario)
    sampling = 0.0
    begin = 0
    try:
        while begin < clock.periods:
            end = min(begin + length, clock.periods)
            before = perf_counter()
            part = stretch(clock, begin, end)
            inputs = outside.sample(part.steps)
            inputs.refresh[0] |= begin == 0
            sampling += perf_counter() - before
            stopped = decider.run(inputs, part.first, setup.dice.draw(end - begin), begin)
            if stopped != loop.FINISHED:
                return _diverged(setup, stopped), sampling
            begin = end
            if progress:
                progress(end / clock.periods)
        # The update at the end: a period without steps.
        if decider.run(inputs, np.zeros(2, dtype=np.int64), setup.dice.draw(1), clock.periods) != loop.FINISHED:
            return _diverged(setup, clock.periods), sampling
    except KeyboardInterrupt:
        updates, time = _so_far(setup)
        return Ending(Status.INTERRUPTED, f"interrupted at t = {time:g} s", updates, time), sampling
    except ControllerError as error:
        return Ending(Status.FAILED, str(error), *_so_far(setup), error), sampling
    return Ending(Status.COMPLETED, "the end of the run was reached", clock.periods + 1, scenario.duration), sampling


def _so_far(setup: Setup) -> tuple[int, float]:
    """Updates taken, and the time of the last one."""
    updates = int(setup.record.tally.measures[0].samples)
    return updates, max(updates - 1, 0) * setup.clock.period


def _diverged(setup: Setup, update: int) -> Ending:
    time = update * setup.clock.period
    steepest = float(setup.record.tally.slopes.max())
    if steepest > 1.0:
        why = f"the cable's slope reached {steepest:.3g}: beyond 1 the model of small angles has ended"
    else:
        why = "a state or a voltage is no longer finite"
    return Ending(Status.DIVERGED, f"at t = {time:g} s {why}", update, time)


def _assemble(
    scenario: Scenario, setup: Setup, ending: Ending, notices: tuple[str, ...], timing: dict[str, float]
) -> Run:
    every, period = setup.record.every, setup.clock.period
    samples = (ending.updates - 1) // every + 1
    times = np.arange(samples) * every * period
    if ending.status is Status.COMPLETED and setup.record.log.outside.size > samples:
        samples, times = samples + 1, np.append(times, scenario.duration)
    named = channels(setup.record.log, samples, bool(scenario.motors))
    metrics = _all_metrics(scenario, setup)
    if samples:
        metrics |= _balance(scenario, setup.record.log, named)
    return assemble(
        scenario,
        named,
        time=times,
        status=ending.status,
        reason=ending.reason,
        end_time=ending.time,
        metrics=metrics,
        timing=timing,
        notices=notices,
        sigma=positions(scenario.grid.elements),
    )


def _balance(scenario: Scenario, log: Log, named: dict[str, np.ndarray]) -> dict[str, float]:
    """Adds the energy and its residual to the channels; what they come to over the run, as metrics."""
    motion = {name: named[name] for name in ("tip_velocity", "length", "payout_acceleration")}
    works = np.stack([named[name] for name in WORKS], axis=1)
    named["energy"] = energy(scenario, *inside(log, works.shape[0]), **motion)
    named["energy_residual"] = residual(named["energy"], works)
    lost = float(np.abs(named["work_grid"][-1]))
    return {
        "energy_balance_residual": relative_residual(named["energy"], works),
        "grid_loss": lost / scale_of(named["energy"], works) if lost else 0.0,
    }


def _all_metrics(scenario: Scenario, setup: Setup) -> dict[str, float]:
    """Metrics of a run so far, without those of the power balance; what there was nothing to measure of is absent."""
    metrics = _metrics(setup.record.tally, float(setup.world.state.now[0].ends.tip_displacement))
    if not scenario.faults:
        del metrics["tip_peak_after_fault"]
    if np.isnan(metrics["effort_rms"]):
        del metrics["effort_rms"]
    return metrics | saturation(scenario, setup.record.tally)


def _metrics(tally: Tally, tip_end: float) -> dict[str, float]:
    """Metrics over every control sample."""
    found, rms = tally.measures[0], partial(root_mean_square, tally)
    return {
        "tip_peak": found.tip.peak,
        "tip_rms": rms(found.tip),
        "tip_end": tip_end,
        "tip_peak_after_fault": found.tip_after_fault.peak,
        "mid_peak": found.mid.peak,
        "mid_rms": rms(found.mid),
        "quarter_peak": found.quarter.peak,
        "quarter_rms": rms(found.quarter),
        "three_quarter_peak": found.three_quarter.peak,
        "three_quarter_rms": rms(found.three_quarter),
        "slope_peak": float(tally.slopes.max()),
        "effort_rms": rms(found.command),
        "thrust_peak": found.thrust.peak,
        "motor_speed_peak": found.speed.peak,
        "motor_voltage_peak": found.voltage.peak,
        "motor_voltage_rms": rms(found.voltage) / np.sqrt(max(tally.motors.size, 1)),
        "motor_current_peak": found.current.peak,
    }

"""Margins of a scenario over its lengths."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeVar

from umbilical.control.contract import Controller
from umbilical.engine.simulate import rehearse
from umbilical.errors import Problem, ScenarioError
from umbilical.result import ResultFaces
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.sensors import Channel
from umbilical.stability.grid import GridJudgement, check_count, margins_on_grid, resolved
from umbilical.stability.impedance import hanging_cable
from umbilical.stability.judgement import Judgement, check_loop, margins_of, usual_lengths, usual_thrust
from umbilical.stability.matrix import MatrixCheck
from umbilical.stability.sampled import sampled_loop
from umbilical.stability.updates import Doubt

T = TypeVar("T")


@dataclass(frozen=True)
class MarginReport(ResultFaces):
    """What a loop is worth over the lengths of its cable.

    Attributes:
        scenario: whose loop it is.
        operating_thrust: steady thrust at which the motors are linearised, N.
        judgements: one for each length, from the exact cable.
        grids: the longest length once more, with the echo of the engine's own grids, at several resolutions.
        check: the count on a coarse one of them against eigenvalues; None without grids.
        controller: what decides in place of the scenario's own law; empty for that.
        doubt: why a controller has no linear system that speaks for it; then there are no judgements.
    """

    shown_by: ClassVar[str] = "umbilical.faces.margins"
    drawn_by: ClassVar[str] = "plot_margins"

    scenario: Scenario
    operating_thrust: float
    judgements: tuple[Judgement, ...]
    grids: tuple[GridJudgement, ...] = ()
    check: MatrixCheck | None = None
    controller: str = ""
    doubt: str = ""

    def __repr__(self) -> str:
        if self.doubt:
            return f"<MarginReport {self.name}: unresolved, {self.doubt}>"
        lengths = ", ".join(f"{judgement.length:g}" for judgement in self.judgements)
        state = "stable" if self.stable else "unstable"
        return f"<MarginReport {self.name}: {state}, resolved {self.resolved}, at {lengths} m>"

    @property
    def name(self) -> str:
        """The scenario's name, and the controller's that decides in place of its own law."""
        return f"{self.scenario.name} with {self.controller}" if self.controller else self.scenario.name

    @property
    def stable(self) -> bool:
        """Whether the loop is stable at every length."""
        return not self.doubt and all(judgement.stable for judgement in self.judgements)

    @property
    def resolved(self) -> bool | None:
        """Whether the finest grids agree with the exact cable, and the check.

        None without grids, and for fewer than three that agree, which may do so by chance.

        False too where the linearised controller is not what runs.
        """
        if self.doubt:
            return False
        if not self.grids or self.check is None:
            return None
        agree = resolved(self.grids) and self.check.agrees
        return None if agree and len(self.grids) < 3 else agree

    @property
    def limits(self) -> tuple[str, ...]:
        """What this scenario has and its linearised loop has not."""
        scenario, motors = self.scenario, () if self.scenario.ideal_thruster else self.scenario.motors
        channels = [getattr(scenario.sensors, name) for name in type(scenario.sensors).model_fields]
        outside = {
            "the winch's motion, each length stands still": len(self.judgements) > 1,
            "voltage limits of the drives": any(motor.voltage_limit is not None for motor in motors),
            "noise, resolution and drop-outs of the sensors": any(map(_uncertain, channels)),
            "faults": bool(scenario.faults),
            "the adaptive law, which stays as it starts": scenario.control.allocation.method == "adaptive",
        }
        return tuple(name for name, present in outside.items() if present)


def margins(
    scenario: Scenario,
    lengths: Sequence[float] | None = None,
    operating_thrust: float | None = None,
    *,
    controller: Controller | None = None,
    elements: Sequence[int] = (),
    finest: int = 0,
    progress: Callable[[float], None] | None = None,
) -> MarginReport:
    """Stability, margins, modes and reflection of the linearised sampled loop, without a grid.

    Args:
        scenario: cable, ROV, motors, sensors and controller; adaptation is frozen at its start.
        lengths: m, the winch standing still; if left out, shortest, middle and longest of the run.
        operating_thrust: steady thrust at which the motors are linearised, N; if left out, the mean force on
            the ROV, at least the pull of a slope of 0.01.
        controller: decides in place of the scenario's own, as in :func:`umbilical.simulate`; it is linearised by
            differences of its ``update`` with the ROV at rest, and :attr:`MarginReport.doubt` says where that does not
            speak for it.
        elements: numbers of elements on which the engine's own matrices are asked, too; three or more give a
            verdict.
        finest: while that verdict is open, grids of twice as many elements follow, up to this number.
        progress: called with the share done, 0 to 1.

    Raises:
        ScenarioError: there is no loop, it cannot be linearised, or a length or the thrust is out of range.
        ControllerError: the controller breaks its contract in its first updates.

    >>> import umbilical
    >>> report = margins(umbilical.load("ringdown"))
    >>> report.stable, [judgement.length for judgement in report.judgements]
    (True, [400.0])
    """
    if controller is None:
        check_loop(scenario)
    else:
        rehearse(scenario, controller)
    chosen = usual_lengths(scenario) if lengths is None else _as_lengths(scenario, lengths)
    thrust = usual_thrust(scenario) if operating_thrust is None else float(operating_thrust)
    check_request(scenario, chosen, thrust, elements)
    done = _steps(progress, len(chosen) + len(elements) + bool(elements))
    name = type(controller).__name__ if controller else ""
    try:
        loops = [sampled_loop(scenario, thrust, controller, length) for length in chosen]
    except Doubt as doubt:
        return MarginReport(scenario, thrust, (), controller=name, doubt=str(doubt))
    pairs = zip(chosen, loops, strict=True)
    found = tuple(done(margins_of(hanging_cable(scenario, length), loop)) for length, loop in pairs)
    longest = max(found, key=lambda judgement: judgement.length)
    checked = done(check_count(scenario, longest, elements)) if elements else None
    grids = [done(margins_on_grid(scenario, longest, number)) for number in elements]
    # Where both are unstable they differ in how many waves a grid carries; a finer one costs much and differs, too.
    while grids and 2 * grids[-1].elements <= finest and not resolved(grids) and (longest.stable or grids[-1].margins):
        grids.append(margins_on_grid(scenario, longest, 2 * grids[-1].elements))
    return MarginReport(scenario, thrust, found, tuple(grids), checked, name)


def _uncertain(channel: Channel | bool) -> bool:
    """Whether a sensor errs in a way that has no linear part; a bias moves the loop, and latency is in it."""
    return isinstance(channel, Channel) and any((channel.noise, channel.resolution, channel.dropout))


def _as_lengths(scenario: Scenario, lengths: Sequence[float]) -> tuple[float, ...]:
    """Lengths as numbers, m.

    Raises:
        ScenarioError: they are something else, for example a controller.
    """
    try:
        return tuple(map(float, lengths))
    except (TypeError, ValueError) as error:
        given, fix = f"{lengths!r} ({type(lengths).__name__})", "a controller of your own goes in as controller="
        bound, reason = "a list of lengths, m, as in [300.0, 400.0]", "the second argument of margins"
        raise ScenarioError([Problem("lengths", given, bound, reason, fix)], scenario.name) from error


def _steps(progress: Callable[[float], None] | None, count: int) -> Callable[[T], T]:
    """Pass a result on and report that one more of ``count`` is there."""
    number = iter(range(1, count + 1))

    def done(result: T) -> T:
        if progress:
            progress(next(number) / count)
        return result

    return done


def check_request(scenario: Scenario, lengths: Sequence[float], thrust: float, elements: Sequence[int] = ()) -> None:
    """Refuse lengths, thrusts and grids that have no linear loop, all at once.

    Raises:
        ScenarioError: with every problem.
    """
    reason = "at no thrust a propeller has none to first order, and the loop is open"
    span, grid = (
        ("above 0, at most 20000 m", "a cable has a length"),
        ("4 to 1000 elements", "it needs elements, and memory"),
    )
    cases = [
        *((not 0.0 < x <= 2e4, "lengths", f"{x:g} m", *span, "e.g. 300,400") for x in lengths),
        (not lengths, "lengths", "none", "one or more", "a loop has a cable of some length", "e.g. 300,400"),
        (not 0.0 < abs(thrust) <= 1e9, "operating_thrust", f"{thrust:g} N", "not 0, at most 1e9 N", reason, "e.g. 50"),
        *((not 4 <= number <= 1000, "grid", f"{number}", *grid, "e.g. 32,64,128") for number in elements),
    ]
    if problems := [Problem(*problem) for wrong, *problem in cases if wrong]:
        raise ScenarioError(problems, scenario.name)

"""The ROV at the end of its cable as a Gymnasium environment.

::

    env = gymnasium.make("umbilical.interop.gymnasium:Umbilical/Tip-v0", scenario="paper", step=0.1)

``Umbilical/Tip-v0`` observes what the sensors read. ``Umbilical/TipPrivileged-v0`` observes the truth as well, which no
vehicle has: what is learnt on it needs an estimator, or is a teacher.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple

import numpy as np

from umbilical.control.contract import Command, Measurement
from umbilical.engine.episode import Episode
from umbilical.engine.saturation import thrust_capability
from umbilical.engine.truth import Truth, truth
from umbilical.errors import ControllerError, MissingPartnerError, Problem, ScenarioError
from umbilical.interop.picture import draw_cable
from umbilical.library import load
from umbilical.plant.signals import evaluate
from umbilical.relations.tension import weight_of_mass
from umbilical.run import Status
from umbilical.scenario.hardware import Motor
from umbilical.scenario.scenario import Scenario
from umbilical.studies.load import load_study
from umbilical.studies.members import Draws
from umbilical.studies.study import Study

try:
    import gymnasium
except ImportError as error:
    raise MissingPartnerError("the environment needs gymnasium: pip install 'umbilical[rl]'") from error

Array = np.ndarray
Reward = Callable[[Measurement, Command], float]

SCALES = {
    "tip_displacement": 0.1, "tip_slope": 0.01, "tip_velocity": 0.1, "tip_slope_rate": 0.01,
    "length": 1000.0, "payout_speed": 1.0, "payout_acceleration": 0.1, "motor_speed": 10.0, "motor_current": 10.0,
    "payload_force": 100.0, "mid_displacement": 0.1,
}  # fmt: skip
"""What an observation of 1 is of each quantity, in its unit. Assumed: round numbers of the size the presets reach."""
BOUND = 100.0
"""Observations are clipped to plus and minus this."""
DISPLACEMENT = 0.1
"""Displacement that costs 1 per second, m. Assumed."""
EFFORT = 0.01
"""Cost of a full action, per second. Assumed: small against a displacement of :data:`DISPLACEMENT`."""
FAILURE = BOUND**2
"""Cost per second of all the time that a run which diverged did not reach: more than any other way through it."""
_TRIES = 20
_UNKNOWN = ("there is no such option here, and none is ever ignored", 'options={"changes": {key: value}}')
_FORCES_SAMPLED = 2001


class Signal(NamedTuple):
    """A part of the observation: its name, and how many entries it has."""

    name: str
    size: int


class Tip(gymnasium.Env[Array, Array]):
    """Hold the ROV still, by the thrust of all motors or the voltage of each.

    Args:
        scenario: a scenario, or what :func:`umbilical.load` takes; ``paper`` if neither it nor a study is given. Its
            controller is not used, but for the motor loops and the allocation that turn a thrust into voltages.
        step: how long an action is held, s, a multiple of ``control.period``.
        mode: ``thrust`` (one action, through the scenario's allocation and motor loops) or ``voltage`` (one per motor).
        privileged: observe the truth too; :data:`Umbilical/TipPrivileged-v0` sets it.
        thrust_scale: the thrust of an action of 1, N. If left out, what the motors can hold at their voltage limits;
            without limits twice the largest force on the ROV during the run, and at least 1 % of its weight (assumed).
        voltage_scale: the voltage of an action of 1, V. If left out, each motor's limit; without one what holds its
            share of ``thrust_scale``.
        reward: reward per second, from the measurement after a step and the command during it; if left out minus
            ``(y / DISPLACEMENT)^2 + EFFORT mean(action^2)``, with y as it is measured.
        study: a study, or what :func:`umbilical.load_study` takes: every episode is a member of it, drawn by its seed.
        arm: the study's arm, by name; its first if left out.
        render_mode: None or ``rgb_array``.

    The action is in [-1, 1]. The observation holds the readings of the sensors over :data:`SCALES`, clipped to
    ``BOUND``; :attr:`signals` says which. An episode is terminated when the model ends (it diverged; a cost of
    :data:`FAILURE` per second is then due for the rest of the run), and truncated at the scenario's duration.

    ``reset(seed=...)``: one seed feeds the sensors' noise and the draw from the study. ``options={"changes": {key:
    value}}`` changes values of the scenario for one episode.

    Raises:
        ScenarioError: the scenario, the study or an argument was refused, with every problem.

    >>> env = gymnasium.make("umbilical.interop.gymnasium:Umbilical/Tip-v0", scenario="crosscheck-pd", step=0.1)
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
    >>> info["time"], terminated, truncated
    (0.1, False, False)
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}  # noqa: RUF012 (Gymnasium's own form)

    def __init__(
        self, scenario: Scenario | str | None = None, step: float = 0.1,
        mode: Literal["thrust", "voltage"] = "thrust", *, privileged: bool = False, thrust_scale: float | None = None,
        voltage_scale: float | None = None, reward: Reward | None = None, study: Study | str | None = None,
        arm: str | None = None, render_mode: str | None = None,
    ) -> None:  # fmt: skip
        own = "a study brings its own, of which every episode is a member"
        _refuse(
            (scenario and study, "scenario", "given", "none beside a study", own, "give one of them"),
            (arm and not study, "arm", arm, "none without a study", "an arm is one of a study's", "give the study too"),
        )
        self._draws = Draws(load_study(study) if isinstance(study, str) else study) if study else None
        self._arm = 0 if self._draws is None else _arm_number(self._draws.study, arm)
        self.scenario = _scenario(scenario, self._draws, self._arm)
        _check(self.scenario, mode, thrust_scale, voltage_scale, render_mode)
        self.step_length, self.mode, self.privileged, self.render_mode = step, mode, privileged, render_mode
        self.thrust_scale = usual_thrust_scale(self.scenario) if thrust_scale is None else float(thrust_scale)
        self.voltage_scale = _voltage_scales(self.scenario, self.thrust_scale, voltage_scale)
        self._reward = reward
        self._first = self.episode = Episode(self.scenario, step, stored=False, owner="step")
        self._start = self.episode.save()
        self._repeats = self._draws is None and not _is_noisy(self.scenario)
        self.signals = _signals(self.scenario, privileged)
        size = sum(signal.size for signal in self.signals)
        self.observation_space = gymnasium.spaces.Box(-BOUND, BOUND, (size,), np.float32)
        actions = len(self.scenario.motors) if mode == "voltage" else 1
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (actions,), np.float32)
        self.metadata = self.metadata | {"render_fps": 1.0 / step}

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Begin an episode; see the class for what seed and options do."""
        super().reset(seed=seed)
        options = options or {}
        _refuse(*((k != "changes", f"options.{k}", str(v), "changes", *_UNKNOWN) for k, v in options.items()))
        self._begin(options.get("changes", {}))
        return self._observation(), self._info()

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Hold an action for one step; the observation at its end, and the reward of it.

        Raises:
            ControllerError: the action is not finite, or the episode is over.
        """
        share = np.clip(np.asarray(action, dtype=np.float64).reshape(self.action_space.shape or ()), -1.0, 1.0)
        if not np.isfinite(share).all():
            raise ControllerError(f"the action at t = {self.episode.time:g} s is not finite: {action}")
        begun, command = self.episode.time, self.command(share)
        self.episode.step(command)
        reward = (self.episode.time - begun) * self._rate(command, share)
        terminated = self.episode.status is Status.DIVERGED
        if terminated:
            reward = -FAILURE * (self.episode.scenario.duration - begun)
        return self._observation(), float(reward), terminated, self.episode.over and not terminated, self._info()

    def render(self) -> Array | None:
        """The cable from vessel to ROV as a picture, shape (360, 240, 3); no other package is needed."""
        if self.render_mode is None:
            return None
        return draw_cable(truth(self.episode).displacement, 20.0 * DISPLACEMENT)

    def command(self, share: Array) -> Command:
        """The command that an action stands for."""
        if self.mode == "voltage":
            return Command(voltage=share * self.voltage_scale)
        return Command(thrust=float(share[0]) * self.thrust_scale)

    def readings(self, observation: Array) -> dict[str, Any]:
        """An observation in SI units, by name; of what motors have an array."""
        values, found, place = np.asarray(observation, dtype=np.float64), {}, 0
        for name, size in self.signals:
            part = values[place : place + size] * _scale(name)
            found[name], place = part if name.startswith("motor_") else float(part[0]), place + size
        return found

    def _begin(self, changes: Mapping[str, Any]) -> None:
        """A new episode; where nothing is drawn or changed, the first instant of the same one."""
        if self._repeats and not changes:
            self.episode = self._first
            self.episode.restore(self._start)
            return
        for tries_left in reversed(range(_TRIES if self._draws else 1)):  # some members of a study are refused
            try:
                self.episode = Episode(self._drawn(changes), self.step_length, stored=False, owner="step")
                return
            except ScenarioError:
                if not tries_left:
                    raise

    def _drawn(self, changes: Mapping[str, Any]) -> Scenario:
        """The scenario of an episode."""
        drawn = self.scenario
        if self._draws is not None:
            member = self._draws.member(int(self.np_random.integers(1, len(self._draws) + 1)))
            drawn = self._draws.scenario(member, self._arm)
        return drawn.replace({**changes, "seed": int(self.np_random.integers(2**63 - 1))})

    def _rate(self, command: Command, share: Array) -> float:
        """Reward per second."""
        measurement = self.episode.measurement
        if self._reward is not None:
            return self._reward(measurement, command)
        return -((measurement.tip_displacement / DISPLACEMENT) ** 2) - EFFORT * float(np.mean(share**2))

    def _observation(self) -> Array:
        """A new array, with nothing in it that is not finite."""
        present = truth(self.episode)
        scaled = [_value(self.episode.measurement, present, name) / _scale(name) for name, _ in self.signals]
        values = np.nan_to_num(np.concatenate(scaled), posinf=BOUND, neginf=-BOUND)
        return np.clip(values, -BOUND, BOUND).astype(np.float32)

    def _info(self) -> dict[str, Any]:
        """Time, the true displacement of the ROV, and the metrics so far."""
        info = {"time": self.episode.time, "tip_displacement": truth(self.episode).tip_displacement}
        if not self.episode.over:
            return info
        self.episode.end()  # the last sample counts, too
        return info | {"metrics": self.episode.metrics()}


_READINGS = ("tip_displacement", "tip_slope")
_RATES = ("tip_velocity", "tip_slope_rate")
_WINCH = ("length", "payout_speed", "payout_acceleration")
_MOTORS = ("motor_speed", "motor_current")
_TRUE = ("tip_displacement", "tip_velocity", "tip_slope", "payload_force", "mid_displacement")


def _signals(scenario: Scenario, privileged: bool) -> tuple[Signal, ...]:
    """What is observed, in order."""
    names = [*_READINGS, *(_RATES if scenario.sensors.ideal_velocity else ()), *_WINCH]
    motors = [Signal(name, len(scenario.motors)) for name in _MOTORS if scenario.motors]
    true = [Signal(f"true_{name}", 1) for name in _TRUE if privileged]
    return (*(Signal(name, 1) for name in names), *motors, *true)


def _scale(name: str) -> float:
    return SCALES[name.removeprefix("true_")]


def _value(measurement: Measurement, present: Truth, name: str) -> Array:
    """A signal in SI units, shape (size,)."""
    if not name.startswith("true_"):
        return np.ravel(getattr(measurement, name))
    if name == "true_mid_displacement":
        return np.ravel(present.displacement[present.displacement.size // 2])
    return np.ravel(getattr(present, name.removeprefix("true_")))


def _is_noisy(scenario: Scenario) -> bool:
    """Whether a sensor draws numbers, so that an episode depends on its seed."""
    sensors = [getattr(scenario.sensors, name) for name in (*_READINGS, *_RATES, *_MOTORS)]
    return any(sensor.noise > 0.0 or sensor.dropout > 0.0 for sensor in sensors)


def _scenario(given: Scenario | str | None, draws: Draws | None, arm: int) -> Scenario:
    """The scenario before anything is drawn."""
    if draws is not None:
        return list(draws.undrawn())[arm]
    return given if isinstance(given, Scenario) else load(given or "paper")


def _arm_number(study: Study, name: str | None) -> int:
    names = [arm.name for arm in study.arms]
    if name is None:
        return 0
    bound, reason = f"one of {', '.join(names)}", "an episode is a member of one arm"
    _refuse((name not in names, "arm", name, bound, reason, "give one, or none for the first"))
    return names.index(name)


def usual_thrust_scale(scenario: Scenario) -> float:
    """The thrust of a full action where none is given, N: what the motors can hold, or twice what there is to hold.

    >>> usual_thrust_scale(load("paper")) < 400.0
    True
    """
    capability = thrust_capability(scenario) if scenario.motors else np.inf
    if np.isfinite(capability) and not scenario.ideal_thruster:
        return capability
    times = np.linspace(0.0, scenario.duration, _FORCES_SAMPLED)
    force = float(np.abs(evaluate(scenario.environment.payload_force, times)).max())
    return max(2.0 * force, 0.01 * weight_of_mass(scenario.payload.mass, scenario.environment.gravity))


def _voltage_scales(scenario: Scenario, thrust: float, given: float | None) -> Array:
    """The voltage of a full action, V, shape (motors,)."""
    coefficients = [abs(motor.thrust_coefficient) for motor in scenario.motors]
    speed = np.sqrt(thrust / sum(coefficients)) if coefficients else 0.0

    def scale(motor: Motor) -> float:
        if given is not None:
            return float(given)
        holding = motor.viscous_friction * speed + motor.load_coefficient * speed**2
        steady = holding * motor.resistance / motor.torque_constant + motor.back_emf_constant * speed
        return steady if motor.voltage_limit is None else motor.voltage_limit

    return np.array([scale(motor) for motor in scenario.motors])


def _check(scenario: Scenario, mode: str, thrust: float | None, voltage: float | None, render: str | None) -> None:
    """Refuse arguments, all at once."""
    driven = bool(scenario.motors) and not scenario.ideal_thruster
    unturned = mode == "thrust" and driven and scenario.control.motor_loop is None
    scales = (("thrust_scale", thrust), ("voltage_scale", voltage))
    _refuse(
        (scenario.model != "string", "model", scenario.model, "string", "the environment is in one plane",
         "choose the string"),
        (mode not in ("thrust", "voltage"), "mode", mode, "thrust or voltage", "it says what an action is",
         "choose one"),
        (mode == "voltage" and not driven, "mode", mode, "thrust", "the scenario has no motors to drive",
         "choose thrust"),
        (unturned, "mode", mode, "voltage", "nothing turns a thrust into voltages",
         "add control.motor_loop, or choose voltage"),
        *((value is not None and not 0.0 < value < np.inf, name, f"{value or 0.0:g}", "above 0",
           "an action of 1 stands for it", "leave it out") for name, value in scales),
        (render not in (None, "rgb_array"), "render_mode", str(render), "None or rgb_array", "there is no window",
         "use rgb_array"),
    )  # fmt: skip


def _refuse(*cases: tuple[Any, ...]) -> None:
    """Raise all problems of an environment whose first entry says that they are there."""
    if found := [Problem(*problem) for wrong, *problem in cases if wrong]:
        raise ScenarioError(found, "environment")


for _id, _options in (("Tip", {}), ("TipPrivileged", {"privileged": True})):
    gymnasium.register(f"Umbilical/{_id}-v0", "umbilical.interop.gymnasium:Tip", kwargs=_options)

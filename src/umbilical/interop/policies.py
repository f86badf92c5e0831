"""Baselines for the Gymnasium environment: what anything that is learnt has to be better than."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from umbilical.control import cascade
from umbilical.control.contract import Measurement, make_decision
from umbilical.errors import Problem, ScenarioError
from umbilical.interop.gymnasium import Tip
from umbilical.scenario.scenario import Scenario


class Policy(Protocol):
    """From an observation to an action; ``reset`` before each episode."""

    def reset(self) -> None:
        """Forget the last episode."""
        ...

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """The action for an observation."""
        ...


class Nothing:
    """No thrust and no voltage, ever."""

    def __init__(self, env: Any) -> None:
        self._shape = env.action_space.shape

    def reset(self) -> None:
        """There is nothing to forget."""

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Zeros."""
        return np.zeros(self._shape, np.float32)


class OuterLaw:
    """The outer law of a scenario with its observers, sampled once per step of the environment.

    Args:
        env: an environment whose actions are thrusts.
        scenario: whose ``control`` is used; the environment's own if left out. The preset ``paper`` has the boundary
            law, ``paper-pd`` the paper's PD, whose velocity comes from a sensor unless that is changed.

    Raises:
        ScenarioError: the scenario has no law or needs rates that nothing measures, or actions are voltages.
    """

    def __init__(self, env: Any, scenario: Scenario | None = None) -> None:
        self._tip: Tip = env.unwrapped
        believed = scenario or self._tip.scenario
        if problem := _refusal(self._tip, believed):
            raise ScenarioError([problem], "OuterLaw")
        self._believed = believed.replace({"control.outer_period": self._tip.step_length})
        self._settings = cascade.make_settings(self._believed)
        self.reset()

    def reset(self) -> None:
        """Observers begin on the next observation."""
        self._state, self._decision = cascade.make_state(self._believed), make_decision(len(self._believed.motors))

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """The law's thrust, as far as an action reaches."""
        readings = cascade.to_readings(self._measurement(observation))
        if self._state.outer[0].updates == 0:
            cascade.start(self._settings, self._state, readings)
        cascade.update_outer(self._settings.outer, self._state, readings, self._decision)
        self._state.outer[0].updates += 1
        share = self._decision.outer["thrust_command"] / self._tip.thrust_scale
        return np.clip(share, -1.0, 1.0).astype(np.float32)

    def _measurement(self, observation: np.ndarray) -> Measurement:
        seen = self._tip.readings(observation)
        none = np.zeros(len(self._believed.motors))
        winch = (seen["length"], seen["payout_speed"], seen["payout_acceleration"])
        rates = (seen.get("tip_velocity"), seen.get("tip_slope_rate"))
        return Measurement(seen["tip_displacement"], seen["tip_slope"], none, none, *winch, *rates)


def play(env: Any, policy: Policy | Callable[[np.ndarray], np.ndarray], seed: int | None = None) -> float:
    """Play one episode, and return the sum of its rewards.

    >>> import gymnasium
    >>> env = gymnasium.make("umbilical.interop.gymnasium:Umbilical/Tip-v0", scenario="crosscheck-none", step=0.5)
    >>> play(env, Nothing(env)) < 0.0
    True
    """
    if hasattr(policy, "reset"):
        policy.reset()  # pyright: ignore[reportFunctionMemberAccess]
    observation, _ = env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        observation, reward, terminated, truncated, _ = env.step(policy(observation))
        total, over = total + float(reward), terminated or truncated
    return total


def _refusal(tip: Tip, scenario: Scenario) -> Problem | None:
    """What stands against a law in an environment."""
    law, seen = scenario.control.law, [name for name, _ in tip.signals]
    if tip.mode != "thrust":
        return Problem("mode", tip.mode, "thrust", "an outer law commands a thrust", "make the environment with thrust")
    if law.kind == "none":
        return Problem("control.law.kind", law.kind, "a law", "none decides nothing", "use Nothing(env)")
    if law.reads_rates and "tip_velocity" not in seen:
        reason, fix = "the environment has no sensor of the rates", "observer, or sensors.ideal_velocity = true"
        return Problem("control.law", "rates of a sensor", "rates of an observer", reason, fix)
    return None

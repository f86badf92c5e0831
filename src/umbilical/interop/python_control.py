"""Plant and loop as state-space objects of python-control (optional)."""

from __future__ import annotations

from typing import Any

import numpy as np

from umbilical.errors import expect, import_partner
from umbilical.scenario.scenario import Scenario
from umbilical.stability.judgement import check_loop, usual_lengths, usual_thrust
from umbilical.stability.laws import READINGS
from umbilical.stability.margins import check_request
from umbilical.stability.period import linear_period
from umbilical.stability.sampled import sampled_loop


def to_control(
    scenario: Scenario, length: float | None = None, operating_thrust: float | None = None
) -> dict[str, Any]:
    """The linearised sampled plant, controller and loop of a scenario on its own grid.

    Args:
        scenario: its grid, motors, sensors and controller are used.
        length: cable length, m, the winch standing still; if left out, the longest of the run.
        operating_thrust: as for :func:`umbilical.stability.margins.margins`.

    Returns:
        Discrete-time ``control.StateSpace`` objects at the period of the outer law:
        ``plant`` from ``thrust_command`` (N) through motors and cable to the four readings;
        ``controller`` from the readings to ``thrust_command``;
        ``loop``, opened at the thrusters: ``thrust_injected`` to ``thrust_command``; feedback is positive,
        the closed loop has its poles where this is 1;
        ``closed``, the same loop closed, from a force added to the commanded thrust to the readings.

    Raises:
        MissingPartnerError: python-control is not installed.
        ScenarioError: there is no loop to linearise.

    >>> import umbilical
    >>> systems = to_control(umbilical.load("ringdown", {"grid.elements": 4}))
    >>> systems["loop"].input_labels, systems["plant"].output_labels[:2]
    (['thrust_injected'], ['tip_displacement', 'tip_slope'])
    """
    expect(scenario, "Scenario", "load")
    control = import_partner("control", "to_control needs python-control: pip install 'umbilical[control]'")
    check_loop(scenario)
    chosen = max(usual_lengths(scenario)) if length is None else length
    thrust = usual_thrust(scenario) if operating_thrust is None else operating_thrust
    check_request(scenario, [chosen], thrust)
    p = linear_period(scenario, sampled_loop(scenario, thrust), chosen)
    a, b, c, k, n = p.a.toarray(), p.b, p.c, p.law, p.a.shape[0]
    memory = np.zeros((n, k.a.shape[0]))
    opened = np.block([[a, memory], [k.b @ c, k.a]])
    entry = np.vstack([b, np.zeros((k.a.shape[0], 1))])
    command = np.hstack([k.d @ c, k.c])
    readings = np.hstack([c, np.zeros((len(READINGS), k.a.shape[0]))])

    def system(name: str, parts: tuple[np.ndarray, ...], inputs: list[str], outputs: list[str]) -> Any:
        return control.ss(*parts, p.period, inputs=inputs, outputs=outputs, name=name)

    seen, none = list(READINGS), np.zeros((len(READINGS), 1))
    return {
        "plant": system("plant", (a, b, c, none), ["thrust_command"], seen),
        "controller": system("controller", (k.a, k.b, k.c, k.d), seen, ["thrust_command"]),
        "loop": system("loop", (opened, entry, command, np.zeros((1, 1))), ["thrust_injected"], ["thrust_command"]),
        "closed": system("closed", (opened + entry @ command, entry, readings, none), ["added_thrust"], seen),
    }

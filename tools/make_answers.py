"""Draw the pictures of docs/answers.md: `.venv/bin/python tools/make_answers.py`, in some minutes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import umbilical
from umbilical.plots.figure import ABOVE, COLOURS, QUIET, as_figure, at_sigma, dress, new_figure, save_figure
from umbilical.studies.audit import audit

IMAGES = Path(__file__).resolve().parents[1] / "docs" / "img"
LATE = (0.025, 0.04)
"""Delays of the readings, s, within and beyond the delay margin."""


def certified() -> None:
    """Energy of a vibration that rings down, under its proved bound."""
    tried = audit(umbilical.load("ringdown", {"control.law.slope_gain": 5.0}))
    ax = new_figure(8.0, 3.2).add_subplot()
    ax.plot(tried.time, tried.bound, color="black", label="proved: never above this line")
    ax.plot(tried.time, tried.ideal, color=COLOURS[0], label="simulated")
    dress(ax, "energy of the vibration", ABOVE, ylim=(0.0, None), xlabel="time [s]", ylabel="V [J]")
    save_figure(as_figure(ax), IMAGES / "answer-certify.png", force=True)


def survived() -> None:
    """The ROV with readings that are late, within the delay margin and beyond it."""
    scenario = umbilical.load("ringdown", {"duration": 30.0})
    found = umbilical.margins(scenario).judgements[0].margins
    assert found is not None
    assert LATE[0] < found.delay.size < LATE[1]
    ax = new_figure(8.0, 3.2).add_subplot()
    for late, colour in zip(LATE, COLOURS, strict=False):
        changes = {f"sensors.{name}.latency": late for name in ("tip_displacement", "tip_slope")}
        y = umbilical.simulate(scenario.replace(changes))["tip_displacement"]
        size = np.maximum(abs(y), 1e-6)
        ax.semilogy(y["time"], size, color=colour, linewidth=1.0, label=f"readings {1e3 * late:.0f} ms late")
    title = f"the ROV moves by; the delay margin is {1e3 * found.delay.size:.0f} ms"
    dress(ax, title, ABOVE, xlabel="time [s]", ylabel="|y(l,t)| [m]")
    save_figure(as_figure(ax), IMAGES / "answer-margins.png", force=True)


def designed() -> None:
    """The middle of the cable before and after a design."""
    found = umbilical.design(umbilical.load("ringdown"), inner=True)
    ax = new_figure(8.0, 3.2).add_subplot()
    for side, colour, name in (
        (found.before, QUIET, "gains of the paper"),
        (found.after, COLOURS[0], "designed gains"),
    ):
        assert side.trial is not None
        y = at_sigma(side.trial.run, 0.5)
        ax.plot(y["time"], y, color=colour, label=name)
    dress(ax, "displacement of the middle of the cable", ABOVE, xlabel="time [s]", ylabel="y(l/2,t) [m]")
    save_figure(as_figure(ax), IMAGES / "answer-design.png", force=True)


if __name__ == "__main__":
    certified()
    survived()
    designed()

"""Umbilical: simulate, certify and tune the vibration control of a vessel - cable - ROV system.

A scenario (frozen data) becomes a run (named arrays with units) by repeating
measure -> decide -> actuate -> advance; everything else prepares a scenario or reads a run.

    >>> import umbilical
    >>> run = umbilical.simulate(umbilical.load("paper").replace({"duration": 1.0}))
    >>> run.status.name
    'COMPLETED'
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from umbilical.analysis.comparison import Comparison, compare
    from umbilical.certificate import Certificate, certify
    from umbilical.control.contract import Command, Controller, Measurement
    from umbilical.engine.episode import Episode
    from umbilical.engine.simulate import simulate
    from umbilical.interop.c_code import to_c
    from umbilical.interop.fmu import to_fmu
    from umbilical.interop.python_control import to_control
    from umbilical.library import load, preset_names
    from umbilical.plots import (
        plot_cable,
        plot_certificate,
        plot_design,
        plot_energy,
        plot_lowering,
        plot_margins,
        plot_motors,
        plot_observers,
        plot_operability,
        plot_overview,
        plot_positions,
        plot_study,
        plot_tip,
        plot_weather,
        plot_winch,
    )
    from umbilical.report.player import show
    from umbilical.run import Run, Status
    from umbilical.scenario import Scenario
    from umbilical.screening import load_operation, lower, operate
    from umbilical.stability.margins import margins
    from umbilical.stored_runs import open_run
    from umbilical.studies.load import load_study
    from umbilical.studies.results import StudyResult, open_study
    from umbilical.studies.study import Study
    from umbilical.studies.sweep import sweep
    from umbilical.studies.tune import tune
    from umbilical.synthesis.design import design

__version__ = "0.1.0"

# Imported when first used, so that `import umbilical` costs milliseconds and compiles nothing.
_HOMES = {
    "Certificate": "umbilical.certificate",
    "Command": "umbilical.control.contract",
    "Comparison": "umbilical.analysis.comparison",
    "Controller": "umbilical.control.contract",
    "Episode": "umbilical.engine.episode",
    "Measurement": "umbilical.control.contract",
    "Run": "umbilical.run",
    "Scenario": "umbilical.scenario",
    "Status": "umbilical.run",
    "Study": "umbilical.studies.study",
    "StudyResult": "umbilical.studies.results",
    "certify": "umbilical.certificate",
    "compare": "umbilical.analysis.comparison",
    "design": "umbilical.synthesis.design",
    "load": "umbilical.library",
    "load_operation": "umbilical.screening",
    "load_study": "umbilical.studies.load",
    "lower": "umbilical.screening",
    "margins": "umbilical.stability.margins",
    "open_run": "umbilical.stored_runs",
    "open_study": "umbilical.studies.results",
    "operate": "umbilical.screening",
    "plot_cable": "umbilical.plots",
    "plot_certificate": "umbilical.plots",
    "plot_design": "umbilical.plots",
    "plot_energy": "umbilical.plots",
    "plot_lowering": "umbilical.plots",
    "plot_margins": "umbilical.plots",
    "plot_motors": "umbilical.plots",
    "plot_observers": "umbilical.plots",
    "plot_operability": "umbilical.plots",
    "plot_overview": "umbilical.plots",
    "plot_positions": "umbilical.plots",
    "plot_study": "umbilical.plots",
    "plot_tip": "umbilical.plots",
    "plot_weather": "umbilical.plots",
    "plot_winch": "umbilical.plots",
    "preset_names": "umbilical.library",
    "show": "umbilical.report.player",
    "simulate": "umbilical.engine.simulate",
    "sweep": "umbilical.studies.sweep",
    "to_c": "umbilical.interop.c_code",
    "to_control": "umbilical.interop.python_control",
    "to_fmu": "umbilical.interop.fmu",
    "tune": "umbilical.studies.tune",
}

__all__ = [
    "Certificate",
    "Command",
    "Comparison",
    "Controller",
    "Episode",
    "Measurement",
    "Run",
    "Scenario",
    "Status",
    "Study",
    "StudyResult",
    "certify",
    "compare",
    "design",
    "load",
    "load_operation",
    "load_study",
    "lower",
    "margins",
    "open_run",
    "open_study",
    "operate",
    "plot_cable",
    "plot_certificate",
    "plot_design",
    "plot_energy",
    "plot_lowering",
    "plot_margins",
    "plot_motors",
    "plot_observers",
    "plot_operability",
    "plot_overview",
    "plot_positions",
    "plot_study",
    "plot_tip",
    "plot_weather",
    "plot_winch",
    "preset_names",
    "show",
    "simulate",
    "sweep",
    "to_c",
    "to_control",
    "to_fmu",
    "tune",
]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'umbilical' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])

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
    "umbilical.analysis.comparison": "Comparison compare",
    "umbilical.certificate": "Certificate certify",
    "umbilical.control.contract": "Command Controller Measurement",
    "umbilical.engine.episode": "Episode",
    "umbilical.engine.simulate": "simulate",
    "umbilical.interop.c_code": "to_c",
    "umbilical.interop.fmu": "to_fmu",
    "umbilical.interop.python_control": "to_control",
    "umbilical.library": "load preset_names",
    "umbilical.plots": "plot_cable plot_certificate plot_design plot_energy plot_lowering plot_margins plot_motors "
    "plot_observers plot_operability plot_overview plot_positions plot_study plot_tip plot_weather "
    "plot_winch",
    "umbilical.report.player": "show",
    "umbilical.run": "Run Status",
    "umbilical.scenario": "Scenario",
    "umbilical.screening": "load_operation lower operate",
    "umbilical.stability.margins": "margins",
    "umbilical.stored_runs": "open_run",
    "umbilical.studies.load": "load_study",
    "umbilical.studies.results": "StudyResult open_study",
    "umbilical.studies.study": "Study",
    "umbilical.studies.sweep": "sweep",
    "umbilical.studies.tune": "tune",
    "umbilical.synthesis.design": "design",
}  # fmt: skip
_MODULES = {name: module for module, names in _HOMES.items() for name in names.split()}

__all__ = [
    "Certificate", "Command", "Comparison", "Controller", "Episode", "Measurement", "Run", "Scenario", "Status",
    "Study", "StudyResult", "certify", "compare", "design", "load", "load_operation", "load_study", "lower",
    "margins", "open_run", "open_study", "operate", "plot_cable", "plot_certificate", "plot_design",
    "plot_energy", "plot_lowering", "plot_margins", "plot_motors", "plot_observers", "plot_operability",
    "plot_overview", "plot_positions", "plot_study", "plot_tip", "plot_weather", "plot_winch", "preset_names",
    "show", "simulate", "sweep", "to_c", "to_control", "to_fmu", "tune",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return getattr(import_module(_MODULES[name]), name)
    raise AttributeError(f"module 'umbilical' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])

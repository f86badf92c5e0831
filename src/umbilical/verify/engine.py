"""What the engine says: the runs and poles that the cases compare with their references.

Everything a case knows of the engine passes here, through the public interface, so that a test can break the model
in one place and see the case fail.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from scipy.sparse import csc_array
from scipy.sparse.linalg import eigs

from umbilical.engine.linear import step_matrix
from umbilical.engine.simulate import simulate
from umbilical.library import load
from umbilical.plant.checks.steps import chosen_step
from umbilical.plant.layout import to_nodal
from umbilical.run import Run, Status
from umbilical.scenario.scenario import Scenario
from umbilical.verify.references import CaseError

UNDAMPED = {"cable.damping": 0.0, "payload.damping": 0.0}
STEADY_TENSION = {"cable.wet_line_density": 0.0}


def open_loop(**overrides: Any) -> Scenario:
    """Cable and ROV alone: no control, no load, 500 m. Overrides with ``__`` for the dot of a key."""
    return load("crosscheck-none", {"environment.payload_force": []} | dotted(overrides))


def dotted(overrides: dict[str, Any]) -> dict[str, Any]:
    """``cable__damping`` -> ``cable.damping``."""
    return {key.replace("__", "."): value for key, value in overrides.items()}


def sine(amplitude: float, frequency: float, phase: float = 0.0) -> dict[str, Any]:
    """One term of a signal."""
    return {"kind": "sine", "amplitude": amplitude, "frequency": frequency, "phase": phase}


def constant(value: float) -> dict[str, Any]:
    """One term of a signal."""
    return {"kind": "constant", "value": value}


def from_rest(size: float, frequency: float) -> list[dict[str, Any]]:
    """The terms of ``size (1 - cos w t)``."""
    return [constant(size), sine(-size, frequency, np.pi / 2.0)]


def gentle(size: float, frequency: float) -> list[dict[str, Any]]:
    """The terms of ``size (1 - cos w t)^2``, which starts so gently that the wave it sends has no front."""
    quarter = np.pi / 2.0
    terms = [constant(1.5 * size), sine(-2.0 * size, frequency, quarter), sine(0.5 * size, 2.0 * frequency, quarter)]
    return terms if size else []


def finished(scenario: Scenario) -> Run:
    """A run that came to its end.

    Raises:
        CaseError: it did not.
    """
    run = simulate(scenario)
    if run.status is not Status.COMPLETED:
        raise CaseError(f"{run.status.name} at t = {run.end_time:g} s: {run.reason}")
    return run


def modes(scenario: Scenario, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The slowest poles above the real axis, 1/s, of the engine's own step with the winch stopped, and their shapes.

    A pole s of the cable is an eigenvalue ``exp(s dt)`` of the step, and the slowest are the nearest to 1. Those of
    waves too short for the grid, and of what the integrator remembers, are far from it.

    Returns:
        Poles, shape (count,), and velocities along the cable over that of the ROV, the part in phase with it, shape
        (count, 4 n + 1).
    """
    step, elements = step_matrix(scenario), scenario.grid.elements
    nearest, vectors = cast(Any, eigs(csc_array(step), 2 * count + 8, sigma=1.0, v0=np.ones(len(step))))
    found = np.log(nearest) / chosen_step(scenario)
    upper = np.flatnonzero(found.imag > 1e-9)
    order = upper[np.argsort(found.imag[upper])][:count]
    velocities = vectors[: 10 * elements, order].T.reshape(-1, 5, 2 * elements)[..., elements:]
    return found[order], to_nodal(np.real(velocities / velocities[:, -1:, -1:]))

"""The formula of the tension in closed form, and that it has one owner whom everybody asks."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import umbilical
from umbilical.relations.tension import (
    hanging,
    inertial_tension,
    largest_tension,
    net_gravity,
    relative_jerk,
    slack_acceleration,
    smallest_tension,
    tension,
    tension_gain,
)

SOURCE = Path(umbilical.__file__).parent
OWNER = SOURCE / "relations" / "tension.py"
WATER = hanging(500.0, 2.0, 9.81, wet_weight=4000.0, wet_density=0.0)
HEAVE = 0.7


def test_buoyancy_does_not_accelerate() -> None:
    """m 500 kg, rho 2 kg/m, a cable that floats: T = W - (m + rho s) a."""
    s, a = np.linspace(0.0, 800.0, 9), np.array([[-1.5], [0.0], [0.3], [1.5]])
    found = tension(s, net_gravity(9.81, a), WATER)
    np.testing.assert_allclose(found, 4000.0 - (500.0 + 2.0 * s) * a, rtol=1e-12)


def test_in_air_nothing_is_carried() -> None:
    s, net = np.linspace(0.0, 800.0, 9), net_gravity(9.81, 0.3)
    assert (tension(s, net, hanging(500.0, 2.0, 9.81)) == (500.0 + 2.0 * s) * net).all()
    assert (tension(s, net, hanging(500.0, 2.0, 9.81, 500.0 * 9.81, 2.0)) == (500.0 + 2.0 * s) * net).all()


def test_its_derivatives() -> None:
    """dT/ds by differences, and DT/Dt along a particle, which keeps its s, while the acceleration changes."""
    acceleration, jerk, step = 0.4, 0.15, 1e-4
    net = net_gravity(9.81, acceleration)
    higher = tension(30.0, net_gravity(9.81, acceleration + jerk * step), WATER)
    lower = tension(30.0, net_gravity(9.81, acceleration - jerk * step), WATER)
    rate = -relative_jerk(jerk, net) * inertial_tension(30.0, net, WATER)
    assert rate == pytest.approx((higher - lower) / (2.0 * step), rel=1e-8)
    assert tension_gain(30.0, net, WATER) == pytest.approx(tension(30.0, net, WATER) - tension(0.0, net, WATER))


@pytest.mark.parametrize("a", [-2.0, 0.0, 1.2])
def test_bounds_over_the_cable(a: float) -> None:
    """A floating cable that sinks ever faster pulls least at the vessel."""
    along = tension(np.linspace(0.0, 700.0, 50), net_gravity(9.81, a), WATER)
    assert smallest_tension(700.0, net_gravity(9.81, a), WATER) == pytest.approx(along.min())
    assert largest_tension(700.0, net_gravity(9.81, a), WATER) == pytest.approx(along.max())


def test_slack_where_the_tension_vanishes() -> None:
    bound = slack_acceleration(500.0, 9.81, WATER)
    assert bound == pytest.approx(4000.0 / 1500.0)
    assert smallest_tension(500.0, net_gravity(9.81, bound), WATER) == pytest.approx(0.0, abs=1e-9)
    assert slack_acceleration(500.0, 9.81, hanging(500.0, 2.0, 9.81)) == 9.81


GRAVITY = {"gravity", "g", "net_gravity", "net"}


def arithmetic_with_gravity(source: str) -> list[int]:
    """Lines that add, subtract, multiply or divide something called gravity, or subtract from it."""
    return [
        node.lineno
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.BinOp)
        for side in (node.left, node.right)
        if name_of(side) in GRAVITY
    ]


def name_of(node: ast.expr) -> str:
    """The last part of a name, attribute or key; of a call nothing."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case ast.Subscript(slice=ast.Constant(value=str() as name)):
            return name
        case ast.Subscript(slice=ast.Name(id=name)):
            return name.lower()
        case ast.Subscript(value=value):
            return name_of(value)
        case _:
            return ""


def test_one_file_does_arithmetic_with_gravity() -> None:
    """But for references, which must know nothing of the engine, and for waves at sea, whose gravity pulls no cable."""
    elsewhere = {
        path.relative_to(SOURCE).as_posix(): lines
        for path in SOURCE.rglob("*.py")
        if path != OWNER and path.relative_to(SOURCE).parts[0] not in ("verify", "sea")
        if (lines := arithmetic_with_gravity(path.read_text(encoding="utf-8")))
    }
    assert elsewhere == {}
    assert arithmetic_with_gravity(OWNER.read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    "slip", ["a = s.gravity - b", "x = m * g", 'y = n["g"] - a', "z = motion.net * m", "w = now[NET_GRAVITY] * 2"]
)
def test_a_formula_of_ones_own_is_noticed(slip: str) -> None:
    assert arithmetic_with_gravity(slip) == [1]


QUESTIONS = """
import json, sys
import numpy as np
import umbilical
from umbilical.plant.checks.motion import tension_above_zero, wave_speed
from umbilical.plant.checks.moving import MovingCable
from umbilical.plant.checks.steps import chosen_step, grid_near_the_payload, wave_step, waves_that_leave
from umbilical.certificate.lyapunov import cable_function, cable_function_rates
from umbilical.certificate.records import Weights
from umbilical.stability.judgement import margins_at
from umbilical.stability.grid import on_grid
from umbilical.engine.linear import linearise_plant
from umbilical.plant.initial import initial_slopes
from umbilical.relations.tension import hanging_of, net_gravity
from umbilical.papers.rao2022.lyapunov import lyapunov

gravity = float(sys.argv[1])
base = {"environment.gravity": gravity, "grid.elements": 4, "control.law.slope_gain": 10.0}
short = base | {"duration": 0.03, "output.interval": 0.005, "initial": {"shape": "static", "force": 100.0}}
winch = {"law": "quintic", "start_length": 200.0, "end_length": 206.0, "duration": 3.0}
scenario = umbilical.load("paper", short | {"winch": winch, "cable.damping": 0.01})
paper = umbilical.load("paper", base)
s = scenario
run = umbilical.simulate(s)
read = {str(k): v.values for k, v in {**run.data.data_vars, **run.data.coords}.items()}
fast = {"law": "speed", "start_length": 450.0, "speed": 53.0}
hard = {"law": "cosine", "start_length": 450.0, "amplitude": 400.0, "frequency": 0.1630}
heavy = s.model_copy(update={"cable": s.cable.model_copy(update={"line_density": 4e8})})
jumping = umbilical.load("paper", base | {"winch": {"law": "trapezoid", "start_length": 450.0, "end_length": 460.0,
    "top_speed": 1.0, "acceleration": 0.5}, "duration": 20.0})
still = umbilical.load("ringdown", {"environment.gravity": gravity, "grid.elements": 4})
certificate = umbilical.certify(jumping)
weights = Weights(1e-3, 0.1, 1.0)

def found(check, **sections):
    return [str(finding) for finding in check(**sections)]

def winch_of(law):
    return umbilical.load("paper").replace({"winch": law}).winch

def numbers(values):
    return np.asarray(values, dtype=float).ravel().tolist()

moving = MovingCable.of(s)._replace(duration=1.0)
answers = {
    "plant": numbers(run["displacement"][-1]),
    "controller": numbers(run["thrust_command"]),
    "initial shape": numbers(initial_slopes(s)),
    "energy": numbers(run["energy"]),
    "work of the tension": numbers(run["work_tension"]),
    "step limit": [wave_step(MovingCable.of(s), s.grid)],
    "check: slack": found(tension_above_zero, moving=moving._replace(winch=winch_of(hard), duration=50.0)),
    "check: slower than the waves": found(wave_speed, moving=moving._replace(winch=winch_of(fast))),
    "check: waves that leave": found(waves_that_leave, control=s.control, grid=s.grid,
                                     moving=moving._replace(cable=heavy.cable)),
    "check: grid near the ROV": found(grid_near_the_payload, control=s.control, grid=s.grid, moving=moving),
    "linearisation": numbers(linearise_plant(still).a.data),
    "margins": numbers([(j := margins_at(still, 400.0)).margins.gain_high.size, j.margins.phase.size]),
    "step of the design's grids": [on_grid(s, 500.0, 2000).grid.step],
    "V along a run": numbers(cable_function(s, read, weights)),
    "rate of V along a run": numbers(list(cable_function_rates(s, read, weights).values())),
    "V of the paper": numbers(lyapunov(run)["V"]),
    "certificate: rates": numbers(certificate.rates),
    "certificate: weights": numbers(certificate.weights),
    "certificate: conditions": numbers([[i.left, i.right] for i in certificate.inequalities]),
    "certificate: the paper's conditions": numbers([i.right for i in certificate.paper]),
    "certificate: intervals of g - a": numbers(certificate.ranges.net),
    "certificate: growth at jumps": numbers(certificate.stretch),
    "certificate: exact rate": [certificate.exact_rate],
    "certificate: fixed length": [certificate.fixed_length_rate],
    "certificate: start": numbers(umbilical.certify(s, fix=False).start),
    "certificate: reach": numbers(certificate.reach),
    "certificate: proved": [certificate.proof.holds],
}
print(json.dumps(answers))
"""


def answers(source: Path, gravity: float) -> dict[str, list[Any]]:
    """What everyone who asks for the tension says, by the package in a folder, kernels as plain Python."""
    environment = os.environ | {"PYTHONPATH": str(source), "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-c", QUESTIONS, repr(gravity)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


@pytest.mark.slow
def test_everyone_follows_another_tension(tmp_path: Path) -> None:
    """A sheave that rises with 0.7 m/s2 pulls like a gravity larger by as much: so must all who ask for the tension."""
    shutil.copytree(SOURCE, tmp_path / "umbilical", ignore=shutil.ignore_patterns("__pycache__"))
    owner = tmp_path / "umbilical" / "relations" / "tension.py"
    text, was = owner.read_text(encoding="utf-8"), "return gravity - acceleration"
    assert text.count(was) == 1
    owner.write_text(text.replace(was, f"{was} + {HEAVE}"), encoding="utf-8")
    before, heaving = answers(SOURCE.parent, 10.0), answers(tmp_path, 10.0)
    expected = answers(SOURCE.parent, 10.0 + HEAVE)
    for who, said in heaving.items():
        if who != "certificate: proved":
            assert said != before[who], f"{who} does not ask for the tension"
        assert len(said) == len(expected[who]), who
        if not any(isinstance(part, str) for part in said):
            np.testing.assert_allclose(said, expected[who], rtol=1e-7, atol=1e-12, err_msg=who)

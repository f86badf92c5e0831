"""The example of a plant FMU: with the controller's FMU, in the order of docs/bridges.md, it is umbilical.simulate."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support import compilers
from umbilical import load, simulate, to_fmu

fmpy = pytest.importorskip("fmpy", reason="needs the extra `fmi`")
pytest.importorskip("pythonfmu3", reason="needs the extra `fmi`")
EXAMPLE = Path(__file__).parents[2] / "examples" / "plant_fmu.py"
PERIOD, STEPS = 1e-3, 500
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(compilers.CC is None, reason="no C compiler on this machine"),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("fmus")
    to_fmu(load("paper"), made / "controller.fmu")
    command = [sys.executable, "-m", "pythonfmu3", "build", "-f", EXAMPLE, "-d", made]
    subprocess.run([*map(str, command)], check=True, capture_output=True)
    return made


def slave(path: Path, kind: Any, unpacked: Path) -> tuple[Any, dict[str, int]]:
    description = fmpy.read_model_description(path)
    made = kind(
        guid=description.guid,
        unzipDirectory=fmpy.extract(path, unpacked),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName=path.stem,
    )
    made.instantiate()
    made.enterInitializationMode()
    made.exitInitializationMode()
    return made, {v.name: v.valueReference for v in description.modelVariables}


def coupled(folder: Path, unpacked: Path, *, controller_first: bool) -> np.ndarray:
    """The ROV's displacement at every period."""
    from fmpy.fmi2 import FMU2Slave
    from fmpy.fmi3 import FMU3Slave

    controller, of_controller = slave(folder / "controller.fmu", FMU2Slave, unpacked / "c")
    plant, of_plant = slave(folder / "Plant.fmu", FMU3Slave, unpacked / "p")
    names = ["tip_displacement", "tip_slope", "payout_acceleration"]
    motors = [f"motor_{what}" for what in ("speed", "current")]
    outputs = [of_plant[name] for name in (*names, *(f"{m}_{i}" for m in motors for i in (1, 2)))]
    inputs = [of_controller[name] for name in (*names, *(f"{m}[{i}]" for m in motors for i in (1, 2)))]
    voltages, seen = [of_controller[f"motor_voltage[{i}]"] for i in (1, 2)], []
    for k in range(STEPS):
        readings = plant.getFloat64(outputs)
        seen.append(readings[0])
        before = controller.getReal(voltages)
        controller.setReal(inputs, list(readings))
        controller.doStep(k * PERIOD, PERIOD)
        given = controller.getReal(voltages) if controller_first else before
        plant.setFloat64([of_plant["motor_voltage_1"], of_plant["motor_voltage_2"]], list(given))
        plant.doStep(k * PERIOD, PERIOD)
    return np.array([*seen, plant.getFloat64(outputs)[0]])


def test_the_controller_first_is_simulate_and_all_at_once_is_late(folder: Path, tmp_path: Path) -> None:
    run = simulate(load("paper", {"duration": STEPS * PERIOD, "output.interval": PERIOD}))
    expected = run["tip_displacement"].values
    found = coupled(folder, tmp_path / "first", controller_first=True)
    np.testing.assert_array_equal(found.view(np.int64), expected.view(np.int64))
    late = np.abs(coupled(folder, tmp_path / "late", controller_first=False) - expected).max()
    assert 0.0 < late < 1e-6


def test_fmpy_finds_no_problem(folder: Path) -> None:
    command = [sys.executable, "-m", "fmpy", "validate", str(folder / "Plant.fmu")]
    assert subprocess.run(command, check=False, capture_output=True).returncode == 0

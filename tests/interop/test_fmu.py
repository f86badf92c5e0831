"""The controller as an FMU: fmpy accepts, compiles and drives it, and it is the built-in controller to the bit."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

from tests.support import compilers
from umbilical import Command, Measurement, Scenario, load, simulate, to_fmu
from umbilical.errors import MissingPartnerError, OutputError, ScenarioError
from umbilical.interop import fmu as module
from umbilical.interop.units import base_units
from umbilical.quantities import CHANNELS

fmpy = pytest.importorskip("fmpy", reason="needs the extra `fmi`")
needs_cc = pytest.mark.skipif(compilers.CC is None, reason="no C compiler on this machine")
PERIOD = 1e-3


def tool(*words: object) -> str:
    """What the command line of fmpy says; it must succeed."""
    done = subprocess.run([sys.executable, "-m", "fmpy", *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


class Slave:
    """An FMU under fmpy behind the contract of a controller."""

    period = PERIOD

    def __init__(self, path: Path, folder: Path) -> None:
        from fmpy.fmi2 import FMU2Slave

        description = fmpy.read_model_description(path)
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=fmpy.extract(path, folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="controller",
        )
        self.said: list[str] = []
        self.fmu.instantiate(loggingOn=True)
        self.fmu.setupExperiment()
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def start(self, measurement: Measurement) -> None:
        return None

    def update(self, t: float, measurement: Measurement, state: None) -> tuple[Command, None]:
        given = {name: getattr(measurement, name) for name in ("tip_displacement", "tip_slope", "payout_acceleration")}
        for i in range(measurement.motor_speed.size):
            given[f"motor_speed[{i + 1}]"] = measurement.motor_speed[i]
            given[f"motor_current[{i + 1}]"] = measurement.motor_current[i]
        self.fmu.setReal([self.reference[name] for name in given], list(given.values()))
        self.fmu.doStep(t, PERIOD)
        voltages = [self.read(f"motor_voltage[{i + 1}]") for i in range(measurement.motor_speed.size)]
        return Command(self.read("thrust_command"), np.array(voltages)), None

    def read(self, name: str) -> float:
        return self.fmu.getReal([self.reference[name]])[0]


@needs_cc
@pytest.mark.parametrize("preset", ["paper", pytest.param("paper-adaptive", marks=pytest.mark.slow)])
def test_driven_by_fmpy_it_is_the_built_in_controller(preset: str, tmp_path: Path) -> None:
    scenario = load(preset, {"duration": 2.0})
    slave = Slave(to_fmu(scenario, tmp_path / "c.fmu").path, tmp_path / "unpacked")
    expected, found = simulate(scenario), simulate(scenario, slave)
    for name in ("tip_displacement", "thrust_command", "motor_voltage", "motor_speed", "thrust"):
        np.testing.assert_array_equal(found[name].values.view(np.int64), expected[name].values.view(np.int64), name)
    assert np.abs(expected["motor_voltage"].values).max() > 0.0


@needs_cc
def test_a_state_is_restored_and_serialised(tmp_path: Path) -> None:
    slave = Slave(to_fmu(load("paper-adaptive"), tmp_path / "c.fmu").path, tmp_path / "unpacked")

    def play(k: int) -> list[float]:
        slave.fmu.setReal([slave.reference["tip_displacement"], slave.reference["tip_slope"]], [0.01 * k, 1e-4 * k])
        slave.fmu.doStep(k * PERIOD, PERIOD)
        return [slave.read(name) for name in ("thrust_command", "motor_voltage[1]", "motor_voltage[2]")]

    for k in range(5):
        play(k)
    state = slave.fmu.getFMUstate()
    stored = slave.fmu.serializeFMUstate(state)
    expected = [play(k) for k in range(5, 9)]
    slave.fmu.setFMUstate(state)
    assert [play(k) for k in range(5, 9)] == expected
    slave.fmu.setFMUstate(slave.fmu.deSerializeFMUstate(stored))
    assert [play(k) for k in range(5, 9)] == expected
    slave.fmu.reset()
    assert [play(k) for k in range(5, 9)] != expected
    slave.fmu.freeFMUstate(state)
    slave.fmu.terminate()
    slave.fmu.freeInstance()


@needs_cc
def test_a_step_that_is_no_whole_number_of_periods_is_refused_in_words(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    slave = Slave(to_fmu(load("paper"), tmp_path / "c.fmu").path, tmp_path / "unpacked")
    slave.fmu.doStep(0.0, 3 * PERIOD)
    with pytest.raises(Exception, match="fmi2DoStep"):
        slave.fmu.doStep(3 * PERIOD, 0.5 * PERIOD)
    assert "no whole number of control periods" in capfd.readouterr().out


@needs_cc
def test_a_lost_reading_is_held_and_then_stopped(tmp_path: Path) -> None:
    slave = Slave(to_fmu(load("paper"), tmp_path / "c.fmu", hold=2 * PERIOD).path, tmp_path / "unpacked")
    status = [slave.reference["status"]]
    slave.fmu.setReal([slave.reference["tip_displacement"]], [0.1])
    slave.fmu.doStep(0.0, 3 * PERIOD)
    held = slave.read("motor_voltage[1]")
    slave.fmu.setBoolean([slave.reference["valid"]], [False])
    seen = []
    for k in range(3, 6):
        slave.fmu.doStep(k * PERIOD, PERIOD)
        seen.append((slave.fmu.getInteger(status)[0], slave.read("motor_voltage[1]")))
    assert held != 0.0
    assert seen == [(1, held), (1, held), (2, 0.0)]


@needs_cc
@pytest.mark.slow
def test_fmpy_finds_no_problem(tmp_path: Path) -> None:
    for preset in ("paper", "crosscheck-pd"):
        path = to_fmu(load(preset), tmp_path / f"{preset}.fmu").path
        assert "No problems found" in tool("validate", path)


@needs_cc
@pytest.mark.slow
def test_fmpy_simulates_it_and_compiles_it_anew(tmp_path: Path) -> None:
    path = to_fmu(load("paper"), tmp_path / "c.fmu").path
    simulated = tool("simulate", path, "--stop-time", "0.1", "--output-file", tmp_path / "a.csv")
    assert (tmp_path / "a.csv").exists(), simulated
    without_binaries(path)
    tool("compile", path)
    with zipfile.ZipFile(path) as archive:
        assert "binaries/linux64/umbilical_paper.so" in archive.namelist()
    scenario = load("paper", {"duration": 0.2})
    expected, found = simulate(scenario), simulate(scenario, Slave(path, tmp_path / "unpacked"))
    np.testing.assert_array_equal(found["motor_voltage"].values, expected["motor_voltage"].values)


def without_binaries(path: Path) -> None:
    """Leave an FMU with its sources alone."""
    with zipfile.ZipFile(path) as archive:
        kept = {name: archive.read(name) for name in archive.namelist() if not name.startswith("binaries/")}
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in kept.items():
            archive.writestr(name, data)


def test_the_same_scenario_gives_the_same_bytes(tmp_path: Path) -> None:
    a, b = (to_fmu(load("paper"), tmp_path / f"{name}.fmu").path.read_bytes() for name in "ab")
    assert a == b
    assert to_fmu(load("paper-pd"), tmp_path / "c.fmu").path.read_bytes() != a


def test_any_change_of_scenario_or_option_changes_the_guid(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    guids = {
        fmpy.read_model_description(to_fmu(scenario, tmp_path / f"{k}.fmu", hold=hold).path).guid
        for k, (scenario, hold) in enumerate(
            [(load("paper"), None), (load("paper"), 0.2), (load("paper", {"control.law.slope_gain": 0.02}), None)]
        )
    }
    assert len(guids) == 3


def test_headers_come_with_their_notice(tmp_path: Path) -> None:
    with zipfile.ZipFile(to_fmu(load("paper"), tmp_path / "c.fmu").path) as archive:
        for name in ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"):
            assert b"2-Clause BSD License" in archive.read(f"sources/{name}")


def test_without_a_compiler_there_are_sources_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    written = to_fmu(load("paper"), tmp_path / "c.fmu")
    assert written.binaries.startswith("sources only")
    with zipfile.ZipFile(written.path) as archive:
        assert not [name for name in archive.namelist() if name.startswith("binaries")]


@pytest.mark.parametrize("name", ['a "b" <c> & @GUID@ @HASH@', "7 */ ?"])
def test_any_name_will_do(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    path = to_fmu(load("paper", {"name": name}), tmp_path / "c.fmu").path
    assert fmpy.read_model_description(path).modelName == f"{name}: controller"


def test_refusals(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scenario: Scenario = load("paper")
    with pytest.raises(OutputError, match=r"\.fmu"):
        to_fmu(scenario, tmp_path / "c.zip")
    with pytest.raises(ScenarioError, match="kind = none"):
        to_fmu(load("paper-none"), tmp_path / "c.fmu")
    monkeypatch.setitem(sys.modules, "fmpy", None)
    with pytest.raises(MissingPartnerError, match=r"umbilical\[fmi\]"):
        to_fmu(scenario, tmp_path / "c.fmu")


def test_every_unit_has_base_units() -> None:
    assert [name for name, quantity in CHANNELS.items() if not isinstance(base_units(quantity.unit), dict)] == []
    assert base_units("N m/A") == {"kg": 1, "m": 2, "s": -2, "A": -1}
    assert base_units("rad2/(N s2)") == {"rad": 2, "kg": -1, "m": -1}

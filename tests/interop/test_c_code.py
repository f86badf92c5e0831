"""The controller as C99: the bits of the one in Python, on this machine and another; what it refuses and survives."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support import compilers
from tests.support.compilers import InC, Recorded, build, call
from umbilical import Scenario, load, preset_names, simulate
from umbilical.control.cascade import Cascade
from umbilical.errors import OutputError, ScenarioError
from umbilical.interop import c_known
from umbilical.interop.c_code import c_files, to_c
from umbilical.scenario.base import Record

needs_cc = pytest.mark.skipif(compilers.CC is None, reason="no C compiler on this machine")
STRINGS = [name for name in preset_names() if load(name).model == "string"]
WITH_LAW = [name for name in STRINGS if load(name).control.law.kind != "none"]
BOX = {
    "control.allocation.lower": [0.1, -5.0, -5.0],
    "control.allocation.upper": [0.3, 5.0, 5.0],
}
LIMIT = {"motors.1.voltage_limit": 2.0, "motors.2.voltage_limit": 3.0}
DRIVE_FAULT = {"faults": [{"kind": "partial", "target": "voltage", "motor": 1, "start": 0.5, "effectiveness": 0.3}]}
SLOW = {
    "control.outer_period": 0.005,
    "control.velocity_observer.time_constant": 0.02,
    "control.slope_observer.time_constant": 0.02,
}
STATION = {"control.law.station_gain": 0.05, "control.law.station": 0.3, "control.law.washout_time": 60.0}
IN_WATER = {
    "payload.wet_weight": 4000.0,
    "environment.water": {"density": 1025.0},
    "payload.water": {
        "displaced_mass": 100.0, "added_mass": 150.0, "vertical_added_mass": 120.0, "linear_drag": 5.0,
        "quadratic_drag": 200.0, "vertical_drag": 300.0,
    },
}  # fmt: skip
IDEAL = {"sensors.ideal_velocity": True, "control.law.rates": "sensor"}
CHANGED: dict[str, tuple[str, dict[str, Any]]] = {
    "a box of kappa": ("paper-adaptive", BOX),
    "a limit of the voltage": ("paper", LIMIT),
    "a drive that fails": ("paper-adaptive", DRIVE_FAULT | LIMIT),
    "an outer law at a fifth of the rate": ("paper-adaptive", SLOW),
    "rates from sensors": ("paper", IDEAL),
    "pd with a sensor": ("crosscheck-pd", {"sensors.ideal_velocity": True, "control.law.velocity": "sensor"}),
    "a believed ROV in water": ("paper", {"control.nominal.payload_mass": 450.0, "payload.wet_weight": 3000.0}),
    "a station": ("paper", STATION),
    "a station without washing out": (
        "paper-adaptive",
        {"control.law.station_gain": 0.05, "control.law.station": -0.2},
    ),
    "a slope washed out": ("paper", {"control.law.washout_time": 5.0}),
    "a ROV in water with its drag": ("paper", STATION | IN_WATER | {"control.law.drag_feedforward": True}),
    "no disturbance observer": ("paper", {"control.disturbance_observer.enabled": False}),
}


def difference(scenario: Scenario, folder: Path, edit: Any = None) -> np.ndarray:
    """Numbers of all updates, C and Python, that differ in a bit; both saw the same readings."""
    python, c = Recorded(Cascade(scenario)), InC(scenario, folder, edit=edit)
    expected, found = simulate(scenario, python), simulate(scenario, c)
    a, b = np.array(python.seen), np.array(c.seen)
    for name in {"tip_displacement", "thrust", "motor_voltage"} & set(expected.data.data_vars) if edit is None else ():
        np.testing.assert_array_equal(found[name].values.view(np.int64), expected[name].values.view(np.int64))
    assert np.abs(a).max() > 0.0
    return np.argwhere(a.view(np.int64) != b[: len(a)].view(np.int64))


@needs_cc
@pytest.mark.parametrize("preset", [pytest.param(n, marks=() if n == "paper" else pytest.mark.slow) for n in WITH_LAW])
def test_every_law_gives_the_bits_of_python(preset: str, tmp_path: Path) -> None:
    assert difference(load(preset, {"duration": 2.0}), tmp_path).size == 0


@needs_cc
@pytest.mark.slow
@pytest.mark.parametrize("name", CHANGED)
def test_every_option_gives_the_bits_of_python(name: str, tmp_path: Path) -> None:
    preset, changes = CHANGED[name]
    scenario = load(preset, {"duration": 2.0} | changes)
    assert difference(scenario, tmp_path).size == 0


def test_the_limited_scenario_reaches_its_limits() -> None:
    assert simulate(load("paper", {"duration": 2.0} | LIMIT)).metrics["saturated_share"] > 0.0


@needs_cc
@pytest.mark.slow
@pytest.mark.parametrize("preset", ["paper-stuck-adaptive", "paper-dead-adaptive"])
def test_over_a_fault(preset: str, tmp_path: Path) -> None:
    assert load(preset).faults[0].start == 10.0
    assert difference(load(preset, {"duration": 12.0}), tmp_path).size == 0


def last_bit(text: str) -> str:
    """The first coefficient of a filter, one unit in its last place away."""
    found = re.search(r"(?<=\.form = \{\n {16}\{)\S+(?=,)", text)
    assert found
    other = np.nextafter(float.fromhex(found[0]), 2.0).hex()
    return text.replace(found[0], other, 1)


def swapped(text: str) -> str:
    text = text.replace("advance_high_gain(&s->velocity, &memory->velocity, tip->tip_displacement)", "A")
    text = text.replace("advance_high_gain(&s->slope, &memory->slope, tip->tip_slope)", "B")
    text = text.replace("A;", "advance_high_gain(&s->velocity, &memory->velocity, tip->tip_slope);")
    return text.replace("B;", "advance_high_gain(&s->slope, &memory->slope, tip->tip_displacement);")


def one_more(text: str) -> str:
    return text.replace(".outer_every = 5", ".outer_every = 6")


@needs_cc
@pytest.mark.parametrize("broken", [last_bit, swapped, one_more])
def test_a_controller_that_is_not_the_same_is_noticed(broken: Any, tmp_path: Path) -> None:
    """By its own self-test and by the comparison with Python."""
    scenario = load("paper-adaptive", {"duration": 0.1} | SLOW)
    to_c(scenario, tmp_path)
    source = tmp_path / "umbilical_controller.c"
    text = broken(source.read_text())
    assert text != source.read_text()
    source.write_text(text)
    code, said = call(build(tmp_path))
    assert code == 1
    assert "FAILED: update" in said
    assert difference(scenario, tmp_path / "again", edit=broken).size > 0


@needs_cc
@pytest.mark.parametrize("options", [("-O0",), ("-O3", "-march=native", "-ffp-contract=fast")])
@pytest.mark.parametrize("preset", ["paper-adaptive", "crosscheck-pd"])
def test_the_self_test_passes_whatever_the_compiler_may_contract(
    preset: str, options: tuple[str, ...], tmp_path: Path
) -> None:
    to_c(load(preset), tmp_path)
    code, said = call(build(tmp_path, *options))
    assert (code, said.split(":")[0]) == (0, "selftest"), said


@needs_cc
def test_fast_math_is_refused(tmp_path: Path) -> None:
    to_c(load("paper"), tmp_path)
    command = [compilers.CC, "-std=c99", "-ffast-math", "-c", tmp_path / "umbilical_controller.c", "-o", "/dev/null"]
    code, said = call(*command)
    assert code != 0
    assert "do not compile with -ffast-math" in said


@needs_cc
def test_two_controllers_share_a_program_and_nothing_but_sqrt_is_missing(tmp_path: Path) -> None:
    to_c(load("paper"), tmp_path / "a", prefix="left_")
    to_c(load("paper-pd"), tmp_path / "b", prefix="right_", hold=0.0)
    assert "#define RIGHT_HOLD 0 " in (tmp_path / "b" / "umbilical_controller.h").read_text()
    for name in "ab":
        assert call(build(tmp_path / name))[0] == 0
        call(compilers.CC, "-std=c99", "-O2", "-fno-math-errno", "-c", tmp_path / name / "umbilical_controller.c",
             "-o", tmp_path / f"{name}.o")  # fmt: skip
    code, symbols = call("nm", tmp_path / "a.o", tmp_path / "b.o")
    assert code == 0
    assert set(re.findall(r" T (\w+)", symbols)) == {"left_start", "left_update", "right_start", "right_update"}
    assert set(re.findall(r" U (\w+)", symbols)) <= {"sqrt", "memcpy", "memset", "_GLOBAL_OFFSET_TABLE_"}


@pytest.mark.slow
@pytest.mark.skipif(
    None in (compilers.ARM_CC, compilers.ARM),
    reason="no ARM64 compiler or emulator (Debian: gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user)",
)
@pytest.mark.parametrize("preset", WITH_LAW)
def test_the_self_test_passes_on_arm64(preset: str, tmp_path: Path) -> None:
    """Where GCC would fuse multiply and add by itself."""
    to_c(load(preset), tmp_path)
    program = build(tmp_path, "-O2", "-static", compiler=compilers.ARM_CC)
    assert call(compilers.ARM, program)[0] == 0


def test_the_same_scenario_gives_the_same_files_without_date_or_path(tmp_path: Path) -> None:
    texts = c_files(load("paper-adaptive"))
    assert texts == c_files(load("paper-adaptive"))
    assert load("paper-adaptive").hash in texts["umbilical_controller.h"]
    assert not re.search(r"/home|/tmp|\b20\d\d-", "".join(texts.values()))


def test_units_come_with_the_names() -> None:
    header = c_files(load("paper"))["umbilical_controller.h"]
    for line in (
        "double motor_speed; /* rad/s, motor speed */",
        "double motor_voltage; /* V, commanded motor voltage */",
        "double tip_displacement; /* m, ",
    ):
        assert line in header


def test_a_name_cannot_end_a_comment() -> None:
    texts = c_files(load("paper", {"name": "*/ int main(void) { /* \\"}))
    assert "int main(void) {" not in texts["umbilical_controller.c"]
    assert "*/ int main" not in texts["umbilical_controller.h"] + texts["test_vectors.h"]


def test_what_the_c_does_not_have_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    known = {**c_known.KNOWN, "BoundaryLaw": frozenset({"kind", "damping_gain", "rates"})}
    monkeypatch.setattr(c_known, "KNOWN", {k: v for k, v in known.items() if k != "DisturbanceObserver"})
    with pytest.raises(ScenarioError) as refused:
        c_files(load("paper"))
    assert [p.key for p in refused.value.problems] == ["control.law.slope_gain", "control.disturbance_observer"]


def test_a_default_of_an_unknown_option_is_no_option(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(c_known.KNOWN, "BoundaryLaw", frozenset({"kind", "damping_gain", "slope_gain"}))
    c_known.check_known(load("paper"))
    with pytest.raises(ScenarioError, match=r"control\.law\.rates = sensor"):
        c_known.check_known(load("paper", IDEAL))


def test_records_named_as_known_exist() -> None:
    records = {cls.__name__: cls for cls in _subclasses(Record)}
    for name, keys in c_known.KNOWN.items():
        assert keys <= set(records[name].model_fields), name


def _subclasses(cls: type) -> list[type]:
    return [cls, *(c for sub in cls.__subclasses__() for c in _subclasses(sub))]


@pytest.mark.parametrize(
    ("options", "key"),
    [({"prefix": "2x"}, "prefix"), ({"hold": -1.0}, "hold"), ({"hold": float("nan")}, "hold"), ({"hold": 1e9}, "hold")],
)
def test_wrong_options_are_refused(options: dict[str, Any], key: str) -> None:
    with pytest.raises(ScenarioError) as refused:
        c_files(load("paper"), **options)
    assert [problem.key for problem in refused.value.problems] == [key]


def test_without_a_law_there_is_nothing_to_write(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match=r"control\.law\.kind"):
        to_c(load("paper-none"), tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_files_are_not_replaced_unasked(tmp_path: Path) -> None:
    to_c(load("paper"), tmp_path)
    with pytest.raises(OutputError, match="exists already"):
        to_c(load("paper"), tmp_path)
    assert len(to_c(load("paper"), tmp_path, force=True)) == 5

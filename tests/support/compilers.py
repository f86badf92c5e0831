"""C compilers, where there are any, and a controller in C behind the contract of one in Python."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

from umbilical import Command, Measurement, Scenario
from umbilical.control.cascade import to_readings
from umbilical.interop.c_code import to_c

CC = next((found for name in ("cc", "gcc", "clang") if (found := shutil.which(name))), None)
ARM_CC, ARM = shutil.which("aarch64-linux-gnu-gcc"), shutil.which("qemu-aarch64")
STRICT = ("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Wconversion", "-Werror")

_TIP = ("tip_displacement", "tip_slope", "tip_velocity", "tip_slope_rate")
_SHIM = """
#include "umbilical_controller.h"
#include <stdlib.h>
umb_state *make(void);
umb_state *make(void) { umb_state *s = calloc(1, sizeof *s); umb_start(s); return s; }
int update(umb_state *s, const double *in, double *out);
int update(umb_state *s, const double *in, double *out)
{
    umb_readings r = {0};
    int i, status;
    r.valid = 1;
    r.tip.tip_displacement = *in++; r.tip.tip_slope = *in++;
    r.tip.tip_velocity = *in++; r.tip.tip_slope_rate = *in++;
    r.winch.payout_acceleration = *in++;
    for (i = 0; i < UMB_MOTORS; i++) { r.motors[i].motor_speed = *in++; r.motors[i].motor_current = *in++; }
    status = (int)umb_update(s, &r);
    *out++ = s->decision.outer.thrust_command; *out++ = s->decision.outer.boundary_error;
    *out++ = s->decision.outer.tip_velocity_estimate; *out++ = s->decision.outer.tip_slope_rate_estimate;
    *out++ = s->decision.outer.disturbance_estimate;
    for (i = 0; i < UMB_MOTORS; i++) {
        *out++ = s->decision.motors[i].motor_voltage; *out++ = s->decision.motors[i].demand;
        *out++ = s->decision.motors[i].speed_reference; *out++ = s->decision.motors[i].motor_disturbance_estimate;
    }
    for (i = 0; i <= UMB_MOTORS; i++) *out++ = s->kappa[i];
    return status;
}
"""


def build(folder: Path, *options: str, compiler: str | None = CC) -> Path:
    """The self-test of a folder, compiled."""
    program = folder / "selftest"
    command = [str(compiler), *STRICT, *options, "-o", program, "selftest.c", "umbilical_controller.c", "-lm"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return program


def call(*command: object) -> tuple[int, str]:
    """Exit code and output of a program."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, timeout=300)
    return done.returncode, done.stdout + done.stderr


class InC:
    """The C controller of a scenario behind the Python contract; ``seen`` collects what it is given and decides."""

    def __init__(self, scenario: Scenario, folder: Path, *options: str, edit: Any = None) -> None:
        self.period, self._scenario, self.seen = scenario.control.period, scenario, []
        to_c(scenario, folder, force=True)
        source = folder / "umbilical_controller.c"
        if edit:
            source.write_text(edit(source.read_text()))
        (folder / "shim.c").write_text(_SHIM)
        library = folder / "controller.so"
        command = [str(CC), *STRICT, "-O2", "-fPIC", "-shared", *options, "-o", library, source, folder / "shim.c"]
        subprocess.run([*map(str, command), "-lm"], check=True)
        self._c = ctypes.CDLL(str(library))
        self._c.make.restype = ctypes.c_void_p
        self._state = ctypes.c_void_p(self._c.make())

    def start(self, measurement: Measurement) -> None:
        return None

    def update(self, t: float, measurement: Measurement, state: None) -> tuple[Command, None]:
        given = _packed(measurement)
        out = np.zeros(5 + 4 * measurement.motor_speed.size + measurement.motor_speed.size + 1)
        double = ctypes.POINTER(ctypes.c_double)
        status = self._c.update(self._state, given.ctypes.data_as(double), out.ctypes.data_as(double))
        assert status == 0, f"not a valid reading at t = {t}"
        self.seen.append(out)
        n = measurement.motor_speed.size
        voltage = None if self._scenario.ideal_thruster else out[5 : 5 + 4 * n : 4].copy()
        return Command(float(out[0]), voltage), None


class Recorded:
    """A Python controller with what it decided, in the order of :class:`InC`."""

    def __init__(self, controller: Any) -> None:
        self.period, self._controller, self.seen = controller.period, controller, []

    def start(self, measurement: Measurement) -> Any:
        return self._controller.start(measurement)

    def update(self, t: float, measurement: Measurement, state: Any) -> tuple[Command, Any]:
        command, state = self._controller.update(t, measurement, state)
        memory, decision, _ = state
        outer, motors = decision.outer.view(np.float64), decision.motors.view(np.float64)
        self.seen.append(np.concatenate([outer, motors, memory.kappa]))
        return command, state


def _packed(measurement: Measurement) -> np.ndarray:
    readings = to_readings(measurement)
    tip = [readings.tip[name][0] for name in _TIP]
    motors = np.stack([readings.motors["motor_speed"], readings.motors["motor_current"]], axis=1)
    return np.array([*tip, measurement.payout_acceleration, *motors.ravel()])

"""The kernels as plain Python, with numpy's records instead of compiled ones, say the same."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import numpy as np

from tests.support.scenarios import run, small

PLAIN = """
import json
import umbilical
import umbilical.engine.loop
from umbilical.verify.invariance import small

assert not hasattr(umbilical.engine.loop.run_steps, "signatures")
run = umbilical.simulate(small("paper-adaptive", duration=0.01, sensors__tip_slope={"bias": 1e-6, "latency": 0.002}))
print(json.dumps({str(name): values.values.tolist() for name, values in run.data.data_vars.items()}))
"""


def test_plain_python_is_the_compiled_loop() -> None:
    """To round-off only: a compiler may order the operations of a sum differently on another processor."""
    answer = subprocess.run(
        [sys.executable, "-c", PLAIN],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    sensors = {"bias": 1e-6, "latency": 0.002}
    compiled = run(small("paper-adaptive", duration=0.01, sensors__tip_slope=sensors))
    plain = json.loads(answer.stdout)
    assert set(plain) == {str(name) for name in compiled.data.data_vars}
    for name, values in plain.items():
        scale = np.abs(compiled[name].values).max() + 1e-300
        np.testing.assert_allclose(np.array(values) / scale, compiled[name].values / scale, atol=1e-9, err_msg=name)

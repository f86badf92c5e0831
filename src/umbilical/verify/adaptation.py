"""The adaptive allocation of eq. (27), as it runs in a closed loop, against its equation."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.library import load
from umbilical.verify import engine
from umbilical.verify.cases import Case, Check, history_close

RATES, LEAK, START, PERIOD = (0.1, 100.0, 50.0), 0.2, (0.25, 0.0, 0.5), 1e-3
UNTIL = 0.5
"""s: with the other sign of the law the loop would run away at 0.7 s, and nothing could be compared."""
TOLERANCE = 1e-9
WHY = "each step is exact for what is held: round-off; the other sign misses by 1"


def _followed() -> Iterator[Check]:
    """kappa of a run, from the commands and the boundary errors of that run, by the law written out again.

    ``kappa' = -Gamma (theta u_a + s_k kappa)``, theta = [alpha_c, 1, 1], both held over the period that ends.
    """
    allocation = {"method": "adaptive", "rates": RATES, "leak": LEAK, "initial": START}
    changes = {"control.allocation": allocation, "duration": UNTIL, "output.interval": PERIOD, "grid.elements": 8}
    run = engine.completed(load("paper-adaptive", changes))
    thrust, error = run["thrust_command"].values, run["boundary_error"].values
    gamma, kappa = np.array(RATES), np.array(START)
    wanted = [kappa]  # the first update starts, and advances nothing
    for alpha, u_a in zip(thrust[1:], error[1:], strict=True):
        steady = -np.array([alpha, 1.0, 1.0]) * u_a / LEAK
        kappa = steady + (kappa - steady) * np.exp(-gamma * LEAK * PERIOD)
        wanted.append(kappa)
    moved = np.array(wanted) - START
    for j in range(3):
        found = run["kappa"].values[:, j] - START[j]
        yield history_close(f"kappa_{j} less its start, over {UNTIL:g} s", found, moved[:, j], TOLERANCE, WHY)


CASES = (Case("adaptive law in the loop", "(27), solved for held theta u_a", "eq. (27)", _followed),)

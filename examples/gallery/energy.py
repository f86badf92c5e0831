"""
Where the energy goes
=====================

The power balance of a run: what each force did to the cable and the ROV.
"""

import umbilical

run = umbilical.simulate(umbilical.load("crosscheck-pd", {"duration": 10.0}))
axes = umbilical.plot_energy(run)
print(f"unexplained: {run.metrics['energy_balance_residual']:.1e} of the energy that moved")

"""
With control and without
========================

The same loads on the same cable and ROV: the paper's controller, and none.
"""

import umbilical

duration = {"duration": 20.0}
runs = [umbilical.simulate(umbilical.load(name, duration)) for name in ("paper-none", "paper")]
axes = umbilical.plot_tip(runs)
axes.legend(["without control", "the paper's controller"], frameon=False, loc="center left")
print(f"peak {runs[0].metrics['tip_peak']:.3g} m free, {runs[1].metrics['tip_peak']:.3g} m controlled")

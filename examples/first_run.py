"""Six lines: a scenario by name, a run, a picture, a file."""

import umbilical

scenario = umbilical.load("paper")
run = umbilical.simulate(scenario)
print(run.summary())
umbilical.plot_overview(run).savefig("paper.png")
run.save("paper.nc", force=True)

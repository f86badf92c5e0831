"""What acts on cable and ROV: one file a force, all of them named in :mod:`umbilical.plant.forces.table`."""

"""The loop with the rope as its plant: the same clock, sensors, faults, motors and controllers."""

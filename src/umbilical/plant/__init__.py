"""The truth: cable and ROV on a moving domain, motors and thrusters, faults, and what acts from outside."""

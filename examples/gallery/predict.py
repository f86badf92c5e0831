"""
Look ahead before each command
==============================

An episode is stepped from outside, and goes back to a mark: model predictive control in ten lines.
"""

import umbilical

episode = umbilical.Episode(umbilical.load("crosscheck-none", {"duration": 3.0}), period=0.1)


def displacement_after(thrust):
    """Where the ROV would be if a thrust were held for four steps, m."""
    mark = episode.save()
    for _ in range(4):
        if not episode.over:
            episode.step(umbilical.Command(thrust=thrust))
    found = abs(episode.measurement.tip_displacement)
    episode.restore(mark)
    return found


while not episode.over:
    episode.step(umbilical.Command(thrust=min((-50.0, 0.0, 50.0), key=displacement_after)))
axes = umbilical.plot_tip(episode.finish())

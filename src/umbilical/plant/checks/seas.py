"""Checks of a sea state: its periods, its steepness, what the vessel's table knows of it, and what it leaves out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from umbilical.errors import Problem
from umbilical.plant.checks.timeline import numbered, refuses, tables_of_the_winch
from umbilical.plant.orbital import moves_the_water
from umbilical.plant.seaway import directions_of, spectrum_of, waves_of
from umbilical.plant.top import top_at
from umbilical.scenario.environment import Environment
from umbilical.scenario.findings import Finding, Notice, amount
from umbilical.scenario.rope import Rope
from umbilical.scenario.scenario import Grid
from umbilical.scenario.ship import RaoShip
from umbilical.scenario.signals import Waves
from umbilical.scenario.winch import Winch
from umbilical.sea.rao import RaoVessel, vessel_of
from umbilical.sea.rao_checks import assumed_of_table, sea_problems, table_problems
from umbilical.sea.waves import wave_number

STEEPEST = 1.0 / 7.0
"""Hs over the deep-water wavelength of the peak period."""
_PERIODS = ("peak_period", "zero_crossing_period", "mean_period")
_FASTEST_WAVE = 30.0
_UNSEEN = 3.0
"""Lengths of an element over that on which waves fade."""


def systems(environment: Environment) -> Iterator[Finding]:
    """Each system has one period, and is no steeper than seas are."""
    if (sea := environment.sea) is None:
        return
    for key, system in numbered("environment.sea.systems", sea.systems):
        given = [name for name in _PERIODS if getattr(system, name) is not None]
        if len(given) != 1:
            reason = "each of them sets the spectrum's scale in time"
            bound = f"exactly one of {', '.join(_PERIODS)}"
            yield Problem(key, " and ".join(given) or "no period", bound, reason, "leave one")
            continue
        peak = spectrum_of(system).peak_period
        if not 2.0 <= peak <= 30.0:
            yield Problem(f"{key}.{given[0]}", f"a peak period of {amount(peak, 's')}", "from 2 to 30 s",
                          "shorter waves are ripples, longer ones tides", "seconds, and the right one")  # fmt: skip
        length = 2.0 * np.pi / float(wave_number(2.0 * np.pi / peak, environment.gravity))
        if system.significant_height > STEEPEST * length:
            yield Problem(f"{key}.significant_height", amount(system.significant_height, "m"),
                          f"at most {STEEPEST * length:.4g} m, a seventh of the wavelength at the peak",
                          "steeper seas do not exist", "a longer period, or metres for feet")  # fmt: skip


def vessel_of_the_sea(environment: Environment) -> Iterator[Finding]:
    """A table of RAOs is as declared and knows the sea; what it leaves out is told."""
    if (sea := environment.sea) is None or not sound(environment):
        return
    if not isinstance(sea.vessel, RaoShip):
        yield Notice("environment.sea.vessel", "surge and sway of the closed form are those of the water (assumed)")
        return
    key = "environment.sea.vessel"
    problems = [*table_problems(sea.vessel, key, environment.gravity)]
    yield from problems
    table = vessel_of(sea.vessel, environment.gravity) if not problems else None
    if isinstance(table, RaoVessel):
        asked = [(system, heading) for system in sea.systems for heading in directions_of(system).tolist()]
        found = {p.key: p for s, heading in asked for p in sea_problems(table, spectrum_of(s), heading, key)}
        yield from found.values()
        yield from (Notice(key, words) for words in assumed_of_table(sea.vessel))


def repetition(environment: Environment, duration: float) -> Iterator[Finding]:
    """A run that is longer than its waves take to be back in phase repeats itself."""
    if (sea := environment.sea) is None or not sound(environment) or not (waves := waves_of(sea)):
        return
    longest = max(components.repeat_period for _, components in waves)
    if duration > longest:
        need = int(np.ceil(max(system.components for system in sea.systems) * duration / longest))
        words = f"the waves repeat themselves after about {longest:.0f} s, and the run takes {duration:g} s; some "
        yield Notice("environment.sea.systems", f"{words}{need} components do not")


def orbital_motion(
    environment: Environment, winch: Winch, duration: float, grid: Grid, model: str, rope: Rope | None
) -> Iterator[Finding]:
    """Waves that move the water have water to move, and a grid that sees how it fades with depth."""
    if (sea := environment.sea) is None or not moves_the_water(environment) or not sound(environment):
        return
    key = "environment.sea.orbital_below"
    name, elements = ("rope", (rope or Rope()).elements) if model == "rope" else ("grid", grid.elements)
    if environment.water is None:
        yield Problem(key, "given", "together with environment.water", "drag and moved mass need water",
                      "[environment.water], [cable.water], [payload.water]")  # fmt: skip
    elif sea.systems and not refuses(tables_of_the_winch(winch, duration)):
        peak = max(float(wave_number(2.0 * np.pi / spectrum_of(system).peak_period, environment.gravity))
                   for system in sea.systems)  # fmt: skip
        element = float(top_at(winch, np.linspace(0.0, duration, 101)).length.max()) / elements
        if element > _UNSEEN / peak:
            yield Notice(key, f"the water's motion fades over {1.0 / peak:.3g} m and an element is {element:.3g} m "
                         f"long: more than {int(np.ceil(element * elements * peak / _UNSEEN))} {name}.elements "
                         "would see it")  # fmt: skip


def regular_waves(environment: Environment) -> Iterator[Finding]:
    """Waves given as numbers: equally many of each, and none too fast to be a wave."""
    for key, term in numbered("environment.vessel_motion", environment.vessel_motion):
        if isinstance(term, Waves):
            counts = {len(term.frequencies), len(term.amplitudes), len(term.phases)}
            if len(counts) > 1:
                yield Problem(f"{key}.amplitudes", f"{sorted(counts)} entries", "equally many", "a wave has all three",
                              "complete the lists")  # fmt: skip
            if max(term.frequencies) > _FASTEST_WAVE:
                yield Problem(f"{key}.frequencies", amount(max(term.frequencies), "rad/s"),
                              f"at most {_FASTEST_WAVE:g} rad/s",
                              "they are tabulated every 0.1 s", "sine terms for what is faster")  # fmt: skip


def sound(environment: Environment) -> bool:
    """Whether all wave systems are."""
    return not refuses(systems(environment))

"""Speed of the rope, and MoorDyn on the same cable at equal accuracy."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from benchmarks.rows import Row

if TYPE_CHECKING:
    from umbilical.scenario import Scenario

CONTROL: dict[str, Any] = {
    "control.law": {"kind": "boundary", "damping_gain": 2e4, "slope_gain": 1.0},
    "control.velocity_observer": {"time_constant": 0.05, "damping": 2.0},
    "control.slope_observer": {"time_constant": 0.05, "damping": 2.0},
    "control.disturbance_observer": {"enabled": True, "gain": 0.1, "coupling": 1.0},
    "sensors.tip_displacement.noise": 0.01,
    "sensors.tip_slope.noise": 1e-4,
}
"""The paper's law for both directions with all observers, and sensors with errors."""
RUNS = {
    "1000 m, control at 5 ms": (1000.0, 0.005, 60.0),
    "1000 m, control at 1 ms": (1000.0, 0.001, 30.0),
    "3000 m, control at 5 ms": (3000.0, 0.005, 120.0),
}
"""Length, m, control period, s, and duration, s."""
HEAVE, SWAY, RAMP, UNTIL, SETTLED = (0.8, 8.0), (1.0, 11.0), 20.0, 100.0, 40.0
"""Amplitude, m, and period, s, of the sheave beside MoorDyn; its fade-in; what is compared, s."""
LENGTH, ENOUGH = 1000.0, 1e-4
"""m; and the error of the body's heave over the heave itself, both rms, that both are held to."""
ELEMENTS, SEGMENTS, FINE = (2, 3, 4, 6, 8, 10), (10, 15, 20, 25, 35, 50, 70, 100), 40
COUPLING = 0.01
"""Seconds between two positions of the vessel that MoorDyn is given; the rope gets them at each stage of its steps."""


WATER, UNDER = 1025.0, 10.0
"""Density, kg/m3; depth of the sheave in MoorDyn, m."""
INPUT = """Written by Umbilical
---------------------- LINE TYPES ----------------------
TypeName  Diam  Mass/m  EA   BA/-zeta  EI  Cd  Ca  CdAx  CaAx
(name)    (m)   (kg/m)  (N)  (N-s/-)   (-) (-) (-) (-)   (-)
cable     {diameter:.17g} {density:.17g} {stiffness:.17g} 0 0 {across:.17g} {added:.17g} {along:.17g} 0
---------------------- POINTS ----------------------
ID   Type     X  Y  Z        Mass     Volume  CdA  CA
(#)  (-)      (m) (m) (m)    (kg)     (m3)    (m2) (-)
1    Coupled  0  0  {top:.17g}  0  0  0  0
2    Free     0  0  {bottom:.17g} {mass:.17g} {volume:.17g} {drag:.17g} {body_added:.17g}
---------------------- LINES ----------------------
ID   LineType  AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)  (name)    (#)      (#)      (m)       (-)      (-)
1    cable     2        1        {length:.17g} {segments} -
---------------------- SOLVER OPTIONS ----------------------
0     writeLog
RK4   tScheme
0.2   cfl
{gravity:.17g} g
{water:.17g} WtrDnsty
{depth:.17g} WtrDpth
200   TmaxIC
1e-7  threshIC
0.5   dtIC
10    CdScaleIC
---------------------- need this line ----------------------
"""
"""MoorDyn's fastest settings that were found to be stable here: its RK2 is not, nor RK4 at a larger cfl."""


def rope_rows(repeat: int) -> list[Row]:
    """Times of the rope in a sea with control, in turns, and of the rope beside MoorDyn where that is installed."""
    scenarios = {name: seaway(*how) for name, how in RUNS.items()}
    rounds = [{name: _seconds(each) for name, each in scenarios.items()} for _ in range(repeat + 1)][1:]
    taken = {name: median(times[name] for times in rounds) for name in scenarios}
    told = "50 nodes, sheared current, drag, 200 waves on the vessel, noisy sensors, boundary law in two directions"
    rows = [
        Row(f"rope, {name}, {each.duration:g} s", 1e3 * taken[name], "ms", each.duration / taken[name], told)
        for name, each in scenarios.items()
    ]
    return [*rows, *(beside_moordyn(repeat) if find_spec("moordyn") else [])]


def seaway(length: float, period: float, duration: float) -> Scenario:
    """The work-class preset under control."""
    from umbilical.library import load

    return load("work-class-3000m", {
        "winch.length": length, "control.period": period, "duration": duration, "grid.step": 0.01, **CONTROL,
    })  # fmt: skip


def _seconds(scenario: Scenario) -> float:
    from umbilical.engine.simulate import simulate

    return simulate(scenario).timing["simulate_s"]


class Swing(NamedTuple):
    """Heave of the body and tension at the sheave about their means, m and N, once settled, and the time it took."""

    heave: np.ndarray
    tension: np.ndarray
    seconds: float

    def off(self, exact: Swing) -> tuple[float, float]:
        """Errors of heave and tension over those themselves, rms."""
        pairs = ((self.heave, exact.heave), (self.tension, exact.tension))
        return tuple(float(np.sqrt(((a - b) ** 2).mean() / (b**2).mean())) for a, b in pairs)  # type: ignore[return-value]


def beside_moordyn(repeat: int) -> list[Row]:
    """Each on its coarsest grid on which the body heaves as on a fine grid of the rope, within :data:`ENOUGH`."""
    exact = ours(FINE)
    rows = []
    for who, swing, grids in (("rope", ours, ELEMENTS), ("MoorDyn", theirs, SEGMENTS)):
        count, off = _coarsest(swing, grids, exact)
        seconds = min(swing(count).seconds for _ in range(max(1, min(repeat, 5))))
        what = "elements" if who == "rope" else "segments"
        note = f"{count} {what}; error of the body's heave {off[0]:.1e}, of the top tension {off[1]:.1e}"
        rows.append(Row(f"{who}, taut heave, equal accuracy", 1e3 * seconds, "ms", UNTIL / seconds, note))
    ratio = rows[1].value / rows[0].value
    told = f"body's heave within {ENOUGH:g} of {FINE} elements; fixed length, still water, no control; fastest runs"
    return [*rows, Row("  MoorDyn over the rope", ratio, "x", note=told)]


def _coarsest(swing: Callable[[int], Swing], grids: tuple[int, ...], exact: Swing) -> tuple[int, tuple[float, float]]:
    """The first grid that is accurate enough, the finest where none is; and its errors."""
    off = (np.inf, np.inf)
    for count in grids:
        if (off := swing(count).off(exact))[0] <= ENOUGH:
            return count, off
    return grids[-1], off


def ours(elements: int) -> Swing:
    """The rope in still water under a sheave that heaves and sways."""
    from umbilical.engine.simulate import simulate
    from umbilical.library import load

    sines = [[{"kind": "sine", "amplitude": a, "frequency": 2.0 * np.pi / period}] for a, period in (HEAVE, SWAY)]
    run = simulate(load("work-class-3000m", {
        "winch.length": LENGTH, "duration": UNTIL, "environment.sea": None, "environment.vessel_ramp": RAMP,
        "environment.vessel_heave": sines[0], "environment.vessel_motion": sines[1], "environment.water.current": None,
        "rope.elements": elements, "control.period": 0.05, "grid.step": 0.05, "output.interval": 0.05,
    }))  # fmt: skip
    late = run.data.sel(time=slice(SETTLED, None))
    heave, tension = late["body_position"].values[:, 2], late["top_tension"].values
    return Swing(heave - heave.mean(), tension - tension.mean(), run.timing["simulate_s"])


def theirs(segments: int) -> Swing:
    """MoorDyn on the same cable, with the same water and body."""
    from umbilical.verify.references.lumped_mass import move

    place = sheave(COUPLING * np.arange(round(UNTIL / COUPLING) + 2))
    found = move(_input(segments), place[:-1], np.diff(place, axis=0) / COUPLING, COUPLING)
    kept = slice(round(SETTLED / COUPLING), None, round(0.05 / COUPLING))
    heave, tension = found.place[kept, 2], found.tension[kept]
    return Swing(heave - heave.mean(), tension - tension.mean(), found.seconds)


def _input(segments: int) -> str:
    """MoorDyn's input for the cable and body of the preset, hung 10 m under water so that no part of it comes out."""
    from umbilical.library import load

    scenario = load("work-class-3000m")
    cable, payload = scenario.cable, scenario.payload
    line, body = cable.water, payload.water
    assert line is not None
    assert body is not None
    assert cable.axial_stiffness is not None
    assert payload.wet_weight is not None
    displaced = payload.mass - payload.wet_weight / scenario.environment.gravity
    weight = (cable.line_density - WATER * np.pi * line.diameter**2 / 4.0) * scenario.environment.gravity
    stretch = (payload.wet_weight + weight * LENGTH / 2.0) * LENGTH / cable.axial_stiffness
    return INPUT.format(
        diameter=line.diameter, density=cable.line_density, stiffness=cable.axial_stiffness, across=line.normal_drag,
        added=line.added_mass, along=line.tangential_drag, top=-UNDER, bottom=-UNDER - LENGTH - stretch,
        mass=payload.mass, volume=displaced / WATER, drag=body.vertical_drag / (0.5 * WATER),
        body_added=body.vertical_added_mass / displaced, length=LENGTH, segments=segments,
        gravity=scenario.environment.gravity, water=WATER, depth=5.0 * LENGTH,
    )  # fmt: skip


def sheave(t: np.ndarray) -> np.ndarray:
    """Place of the sheave, m, shape (instants, 3): faded in as the engine does."""
    q = np.clip(t / RAMP, 0.0, 1.0)
    fade = 10.0 * q**3 - 15.0 * q**4 + 6.0 * q**5
    up, along = (a * np.sin(2.0 * np.pi / period * t) * fade for a, period in (HEAVE, SWAY))
    return np.stack([along, np.zeros_like(t), up - UNDER], axis=1)

"""The cable with the ROV at its end, on its moving domain: eqs. (6)-(8), by upwind discontinuous Galerkin elements.

On sigma = x/l(t), with A = 1 - sigma, the slope Q = Y_sigma = l y_x and the material velocity W = Dy/Dt::

    Q_t     = [ W - (v A/l) Q ]_sigma
    W_t     = [ (T/(rho l)) (Q/l) - (v A/l) W ]_sigma - (v/l + c/rho) W + f/rho
    ROV (sigma = 1):     m V' = -T p* - c_tip V + d + alpha,   V = Dy/Dt(l,t),  p* = y_x(l,t)
    vessel (sigma = 0):  W = e' + v y_x

Both lines are conservation laws: the brackets are fluxes. Inside an element they are differentiated at its
nodes (``elements.py``); where two elements meet, the flux is that of the two waves that run into the
interface, ``W - c y_x`` from the vessel's side and ``W + c y_x`` from the ROV's, c = sqrt(T/rho). The ROV is
met likewise: ``p* = y_x + (V - W)/c`` with the last element's own values, so that at every frequency, resolved
or not, it feels the resistance ``Z = sqrt(rho T)`` of a cable that carries its waves away. Waves too short for
the grid are damped, none is trapped or sent back. Stable hauling in as well as paying out.

Order in the element size: 5 for the velocity, 6 for the displacement, 7 at the ROV (``tests/convergence``).
Source of the method: Hesthaven, Warburton, *Nodal Discontinuous Galerkin Methods*, 2 and 6.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from umbilical.compile import glue, kernel
from umbilical.frames import Frame, real, vector
from umbilical.plant.elements import DERIVATIVE, W0, W1, W2
from umbilical.plant.exogenous import Exogenous
from umbilical.plant.layout import positions, to_elements
from umbilical.relations.tension import (
    AxialDrag,
    Hanging,
    across,
    axial_drag_of,
    hanging_of,
    sinking,
    stretched,
    tension,
    tension_gain,
)
from umbilical.relations.water import in_water, payload_inertia
from umbilical.scenario.scenario import Scenario

# Derivative on the reference element. Nodes lie symmetrically, so it turns even functions into odd ones and odd
# ones into even ones: kept as the two halves, it needs half the multiplications. Constants, for the compiler.
# Row j of the first half acts on ((f0 + f4)/2, (f1 + f3)/2, f2), of the second on ((f0 - f4)/2, (f1 - f3)/2).
D0_EVEN, D1_EVEN = ((float(r[0] + r[4]), float(r[1] + r[3]), float(r[2])) for r in DERIVATIVE[:2])
D0_ODD, D1_ODD, D2_ODD = ((float(r[0] - r[4]), float(r[1] - r[3])) for r in DERIVATIVE[:3])
TIP_ROW = tuple(float(d) for d in DERIVATIVE[4])
LIFT = 1.0 / W0

# Blocks of the cable (layout.py): slopes and velocities, their rates at the last three instants, their fluxes.
PRESENT, RATES, FLUX = 0, 1, 4
BLOCKS = 5
LEFT, RIGHT = range(2)  # rows of the faces, shape (2, 2 n): flux at the left and at the right end of each element


class Ends(Frame):
    """ROV and vessel's end of the cable; the ROV's velocity is a state of its own, with its last three rates."""

    tip_displacement = real()
    tip_velocity = real()
    tip_slope = real()
    vessel_slope = real()
    tip_rates = vector(3)
    slip = real()
    current_length = real()
    current_heave = real()
    current_factor = real()
    current_rate = real()


class Cable(NamedTuple):
    """Constants of cable and ROV, SI units."""

    line_inertia: float
    """M = rho + rho_a, dry and added mass of a metre across."""
    hanging: Hanging
    axial_drag: AxialDrag
    added: float
    """rho_a, kg/m."""
    coupling: float
    """mu = rho rho_a/M, kg/m."""
    payload_inertia: float
    """m + A_h, kg."""
    above: np.ndarray
    """A = 1 - sigma at the nodes, shape (5, n): distance from the ROV over l."""
    above_faces: np.ndarray
    """A at the interfaces, vessel and ROV included, shape (n + 1,)."""
    moving: np.ndarray
    """1 at the velocities of a block, 0 at its slopes, shape (5, 2 n): what damping acts on."""


class Moment(NamedTuple):
    """The cable as a whole at an instant.

    Attributes:
        length, speed: l, m, and v, m/s.
        net: g less the acceleration at which the cable sinks, m/s2.
        vessel: e', m/s.
        slip: v - vb = rho_a (v - zeta')/M, m/s: how fast the mass that moves across lags behind the cable that slides.
        hung: what hangs, carried by its drag, pulled by what the cable's stretch adds: T.
        across: the same less what sliding takes of it: Tt.
    """

    length: float
    speed: float
    net: float
    vessel: float
    slip: float
    hung: Hanging
    across: Hanging


def make_cable(scenario: Scenario) -> Cable:
    """Constants of a scenario's cable."""
    sections = scenario.cable, scenario.payload, scenario.environment
    added, density = in_water(*sections).added, scenario.cable.line_density
    above = 1.0 - positions(scenario.grid.elements)
    return Cable(
        line_inertia=density + added,
        hanging=hanging_of(*sections),
        axial_drag=axial_drag_of(*sections),
        added=added,
        coupling=density * added / (density + added),
        payload_inertia=payload_inertia(scenario.payload),
        above=np.ascontiguousarray(to_elements(above)),
        above_faces=np.ascontiguousarray(above[::4]),
        moving=np.tile(np.repeat([0.0, 1.0], scenario.grid.elements), (5, 1)),
    )


@glue
def at_moment(cable: Cable, outside: Exogenous) -> Moment:
    """What the kernels need of the outside world."""
    sinks = outside.sink_speed
    carried = sinking(cable.hanging, cable.axial_drag, sinks)
    hung = stretched(carried, outside.elastic_tension, outside.elastic_gradient)
    return Moment(
        outside.length,
        outside.payout_speed,
        outside.net_gravity,
        outside.vessel_velocity,
        cable.added * sinks / cable.line_inertia,
        hung,
        across(hung, cable.coupling, sinks),
    )


def make_blocks(slopes: np.ndarray) -> np.ndarray:
    """The cable at rest (Dy/Dt = 0) with the slopes Y_sigma, m, shape (5, n), as a state (5, 5, 2 n)."""
    elements = slopes.shape[1]
    blocks = np.zeros((BLOCKS, 5, 2 * elements))
    blocks[PRESENT, :, :elements] = slopes
    return blocks


@kernel
def meet(cable: Cable, x: np.ndarray, faces: np.ndarray, losses: np.ndarray, moment: Moment) -> None:
    """Flux at the interfaces inside the cable, from the two waves that run into each, and the power it takes, W.

    ``W* = (W- + W+)/2 + c (p+ - p-)/2`` and ``p* = (p- + p+)/2 + (W+ - W-)/(2 c)``, - on the vessel's side. With
    the jumps [W], [p] and Z = rho c the loss is ``Z/2 ([W]^2 + c^2 [p]^2) - v A Z [W] [p]``: never negative for
    |v| < c, and of the order of the error squared where the grid resolves the wave.
    """
    n = x.shape[1] // 2
    scale, above, speed, slip = 1.0 / moment.length, cable.above_faces, moment.speed, moment.slip
    foot = tension(0.0, moment.net, moment.across) / cable.line_inertia
    rise = tension_gain(moment.length, moment.net, moment.across) / cable.line_inertia
    before, w_before, after, w_after = x[4, :n], x[4, n:], x[0, :n], x[0, n:]
    flow, pull = faces[LEFT, :n], faces[LEFT, n:]
    for f in range(1, n):
        transport, square = speed * above[f] - slip, foot + rise * above[f]
        wave_speed = sqrt(square)
        p, q, u, w = before[f - 1] * scale, after[f] * scale, w_before[f - 1], w_after[f]
        step, w_step = q - p, w - u
        slope, velocity = 0.5 * (p + q + w_step / wave_speed), 0.5 * (u + w + step * wave_speed)
        impedance = cable.line_inertia * wave_speed
        losses[f] = impedance * (transport * step * w_step - 0.5 * (w_step * w_step + square * step * step))
        flow[f] = velocity - transport * slope
        pull[f] = scale * (square * slope - transport * velocity)
    # What flows into an element on its left has left its neighbour on the right. A loop of its own: fewer arrays in
    # one loop, and the compiler does several interfaces at once.
    flow_out, pull_out = faces[RIGHT, :n], faces[RIGHT, n:]
    for f in range(1, n):
        flow_out[f - 1] = flow[f]
    for f in range(1, n):
        pull_out[f - 1] = pull[f]


@kernel
def look_at_ends(cable: Cable, x: np.ndarray, ends: Ends, moment: Moment) -> None:
    """Slopes y_x at ROV and vessel, each from the wave that runs into it."""
    n = x.shape[1] // 2
    length, slip = moment.length, moment.slip
    foot = sqrt(tension(0.0, moment.net, moment.across) / cable.line_inertia)
    head = sqrt(tension(length, moment.net, moment.across) / cable.line_inertia)
    ends.slip = slip
    inside = x[4, n - 1] / length
    missed = ends.tip_velocity - x[4, 2 * n - 1]
    # The same as (V - W + c p)/(c - tau) with tau = -slip, written so that it is free of rounding where slip is 0.
    ends.tip_slope = inside + (missed - slip * inside) / (foot + slip)
    ends.vessel_slope = (x[0, n] - moment.vessel + head * x[0, 0] / length) / (head + (moment.speed - slip))


@kernel
def meet_ends(cable: Cable, x: np.ndarray, faces: np.ndarray, losses: np.ndarray, ends: Ends, moment: Moment) -> None:
    """Flux at the vessel and at the ROV, whose velocities are given, and the power it takes, W."""
    n = faces.shape[1] // 2
    length, slip = moment.length, moment.slip
    foot = tension(0.0, moment.net, moment.across) / cable.line_inertia
    head = tension(length, moment.net, moment.across) / cable.line_inertia
    enters = moment.speed - slip
    top, tip = moment.vessel + enters * ends.vessel_slope, ends.tip_velocity - slip * ends.tip_slope
    faces[LEFT, 0] = moment.vessel
    faces[LEFT, n] = (head * ends.vessel_slope - enters * top) / length
    faces[RIGHT, n - 1] = ends.tip_velocity
    faces[RIGHT, 2 * n - 1] = (foot * ends.tip_slope + slip * tip) / length
    top_step, tip_step = x[0, n] - top, x[4, 2 * n - 1] - tip
    losses[0] = -cable.line_inertia * (sqrt(head) + enters) * top_step * top_step
    losses[n] = -cable.line_inertia * (sqrt(foot) + slip) * tip_step * tip_step


@kernel
def flux(cable: Cable, x: np.ndarray, out: np.ndarray, moment: Moment) -> None:
    """The brackets of the two conservation laws at every node."""
    n = x.shape[1] // 2
    scale, speed, slip = 1.0 / moment.length, moment.speed, moment.slip
    foot = tension(0.0, moment.net, moment.across) / cable.line_inertia
    rise = tension_gain(moment.length, moment.net, moment.across) / cable.line_inertia
    for j in range(5):
        above, slope, velocity, flow, pull = cable.above[j], x[j, :n], x[j, n:], out[j, :n], out[j, n:]
        for e in range(n):
            p, w, transport = scale * slope[e], velocity[e], speed * above[e] - slip
            flow[e] = w - transport * p
            pull[e] = scale * ((foot + rise * above[e]) * p - transport * w)


@kernel
def differentiate(f: np.ndarray, faces: np.ndarray, out: np.ndarray) -> None:
    """out: d/dsigma of a flux with values ``f`` at the nodes and ``faces`` where elements meet, all columns alike."""
    columns = f.shape[1]
    f0, f1, f2, f3, f4 = f[0], f[1], f[2], f[3], f[4]
    out0, out1, out2, out3, out4 = out[0], out[1], out[2], out[3], out[4]
    left, right = faces[LEFT], faces[RIGHT]
    per_sigma = float(columns)  # 2 n: the reference element is 2 wide
    for k in range(columns):
        ends, inner, middle = 0.5 * (f0[k] + f4[k]), 0.5 * (f1[k] + f3[k]), f2[k]
        end_step, inner_step = 0.5 * (f0[k] - f4[k]), 0.5 * (f1[k] - f3[k])
        odd0 = D0_EVEN[0] * ends + D0_EVEN[1] * inner + D0_EVEN[2] * middle
        odd1 = D1_EVEN[0] * ends + D1_EVEN[1] * inner + D1_EVEN[2] * middle
        even0 = D0_ODD[0] * end_step + D0_ODD[1] * inner_step
        even1 = D1_ODD[0] * end_step + D1_ODD[1] * inner_step
        out0[k] = per_sigma * (even0 + odd0 - LIFT * (left[k] - f0[k]))
        out1[k] = per_sigma * (even1 + odd1)
        out2[k] = per_sigma * (D2_ODD[0] * end_step + D2_ODD[1] * inner_step)
        out3[k] = per_sigma * (even1 - odd1)
        out4[k] = per_sigma * (even0 - odd0 + LIFT * (right[k] - f4[k]))


@kernel
def march(
    x: np.ndarray, new: np.ndarray, old: np.ndarray, older: np.ndarray, moving: np.ndarray, loss: float,
    weights: np.ndarray,
) -> None:  # fmt: skip
    """Take ``loss`` times the velocity off the new rate; then x += weights . (new, old, older)."""
    w0, w1, w2 = weights[0], weights[1], weights[2]
    for j in range(5):
        for k in range(x.shape[1]):
            rate = new[j, k] - loss * moving[j, k] * x[j, k]
            new[j, k] = rate
            x[j, k] += w0 * rate + w1 * old[j, k] + w2 * older[j, k]


@glue
def evaluate(
    cable: Cable, blocks: np.ndarray, faces: np.ndarray, losses: np.ndarray, ends: Ends, slot: int, moment: Moment
) -> None:
    """Rates of the free cable at the present instant into block ``slot`` (0 to 2); forces are added to them."""
    x, rate = blocks[PRESENT], blocks[RATES + slot]
    meet(cable, x, faces, losses, moment)
    meet_ends(cable, x, faces, losses, ends, moment)
    flux(cable, x, blocks[FLUX], moment)
    differentiate(blocks[FLUX], faces, rate)


@kernel
def add_up_displacement(x: np.ndarray, starts: np.ndarray, vessel: float) -> None:
    """Displacement at every interface into ``starts``, shape (n + 1,), m, from the vessel's, ``vessel``."""
    n = x.shape[1] // 2
    half = 0.5 / n
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    gains = starts[1:]
    for e in range(n):
        gains[e] = half * (W0 * (x0[e] + x4[e]) + W1 * (x1[e] + x3[e]) + W2 * x2[e])
    total = vessel
    starts[0] = total
    for e in range(n):
        total += gains[e]
        gains[e] = total

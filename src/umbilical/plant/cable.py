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

from umbilical.compile import fma, glue, kernel, row_kernel
from umbilical.frames import Frame, real, vector
from umbilical.plant.elements import DERIVATIVE, NODES, W0, W1, W2
from umbilical.plant.exogenous import Exogenous
from umbilical.plant.layout import positions, to_elements, zeros
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

N1, N2, N3 = (float(x) for x in 0.5 * (NODES[1:4] + 1.0))  # places of the inner nodes in their element, 0 to 1
TIP_ROW = tuple(float(d) for d in DERIVATIVE[4])
LIFT = 1.0 / W0
# Blocks of the cable (layout.py): slopes and velocities, their rates at the last three instants.
PRESENT, RATES = 0, 1
BLOCKS = 4
FLOW, PULL, SLOWNESS = range(3)  # rows of the faces: two fluxes where elements meet, ends included; about 1/c inside
Two = tuple[float, float]
Three = tuple[float, float, float]
Five = tuple[float, float, float, float, float]


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


class Derivative(NamedTuple):
    """d/dsigma in an element, with the part that an element's own flux has in ``LIFT (f* - f)`` at its two ends.

    Nodes lie symmetrically, so it turns even functions into odd ones and odd ones into even ones: kept as the two
    halves, it needs half the multiplications. Row j of the first half acts on ``(f0 + f4, f1 + f3, f2)``, of the
    second on ``(f0 - f4, f1 - f3)``; rows 3 and 4 mirror rows 1 and 0.
    """

    even0: Three
    even1: Three
    odd0: Two
    odd1: Two
    odd2: Two
    lift: float


class CableConstants(NamedTuple):
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
    derivative: Derivative


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


def make_cable(scenario: Scenario) -> CableConstants:
    """Constants of a scenario's cable."""
    sections = scenario.cable, scenario.payload, scenario.environment
    added, density = in_water(*sections).added, scenario.cable.line_density
    above = 1.0 - positions(scenario.grid.elements)
    return CableConstants(
        line_inertia=density + added,
        hanging=hanging_of(*sections),
        axial_drag=axial_drag_of(*sections),
        added=added,
        coupling=density * added / (density + added),
        payload_inertia=payload_inertia(scenario.payload),
        above=np.ascontiguousarray(to_elements(above)),
        above_faces=np.ascontiguousarray(above[::4]),
        derivative=make_derivative(scenario.grid.elements),
    )


def make_derivative(elements: int) -> Derivative:
    """The derivative in elements of equal length; the reference element is 2 wide."""
    inside = 2.0 * elements * (DERIVATIVE + LIFT * np.diag([1.0, 0.0, 0.0, 0.0, -1.0]))
    even0, even1 = ((0.5 * float(r[0] + r[4]), 0.5 * float(r[1] + r[3]), float(r[2])) for r in inside[:2])
    odd0, odd1, odd2 = ((0.5 * float(r[0] - r[4]), 0.5 * float(r[1] - r[3])) for r in inside[:3])
    return Derivative(even0, even1, odd0, odd1, odd2, 2.0 * elements * LIFT)


@glue
def at_moment(cable: CableConstants, outside: Exogenous) -> Moment:
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
    """The cable at rest (Dy/Dt = 0) with the slopes Y_sigma, m, shape (5, n), as a state (4, 5, 2 n)."""
    elements = slopes.shape[1]
    blocks = zeros(BLOCKS, 5, 2 * elements)
    blocks[PRESENT, :, :elements] = slopes
    return blocks


def make_faces(elements: int) -> np.ndarray:
    """Room for what is kept where elements meet, shape (3, n + 1 or more, so that rows begin a line of the cache)."""
    return zeros(3, 8 * (elements // 8 + 1))


@row_kernel
def look_up_slowness(cable: CableConstants, faces: np.ndarray, moment: Moment) -> None:
    """1/c at the interfaces inside the cable, s/m, for :func:`meet` to start from."""
    foot = tension(0.0, moment.net, moment.across) / cable.line_inertia
    rise = tension_gain(moment.length, moment.net, moment.across) / cable.line_inertia
    above, slowness = cable.above_faces, faces[SLOWNESS]
    for f in range(above.size):
        slowness[f] = 1.0 / sqrt(fma(rise, above[f], foot))


@row_kernel
def meet(
    cable: CableConstants, x: np.ndarray, flat: np.ndarray, faces: np.ndarray, losses: np.ndarray, moment: Moment
) -> None:
    """Flux at the interfaces inside the cable, from the two waves that run into each, and the power it takes, W.

    ``W* = (W- + W+)/2 + c (p+ - p-)/2`` and ``p* = (p- + p+)/2 + (W+ - W-)/(2 c)``, - on the vessel's side. With
    the jumps [W], [p] and Z = rho c the loss is ``Z/2 ([W]^2 + c^2 [p]^2) - v A Z [W] [p]``: never negative for
    |v| < c, and of the order of the error squared where the grid resolves the wave.

    What weighs the jumps is free as long as it is positive, so c need not be exact: one step of Newton's method from
    the 1/c of the step before, without root or division. Where T changes by a share s in a step, 3/8 s^2 is left; a
    share above 1 (a cable that was all but slack) takes two steps or more.
    """
    n = x.shape[1] // 2
    scale, above, speed, slip = 1.0 / moment.length, cable.above_faces, moment.speed, moment.slip
    foot = tension(0.0, moment.net, moment.across) / cable.line_inertia
    rise = tension_gain(moment.length, moment.net, moment.across) / cable.line_inertia
    # One for every element, the vessel's end with what lies before in memory, so that no vector is left half full:
    # :func:`meet_ends` puts there what belongs there.
    after, w_after, before, w_before = x[0, :n], x[0, n:], flat[8 * n - 1 :], x[4, n - 1 :]
    flow, pull, slownesses = faces[FLOW], faces[PULL], faces[SLOWNESS]
    for f in range(n):
        transport, square = fma(speed, above[f], -slip), fma(rise, above[f], foot)
        last = slownesses[f]
        slowness = last * max(fma(-0.5 * square * last, last, 1.5), 0.5)
        slownesses[f] = slowness
        wave_speed = square * slowness
        p, q, u, w = before[f] * scale, after[f] * scale, w_before[f], w_after[f]
        step, w_step = q - p, w - u
        slope, velocity = 0.5 * fma(w_step, slowness, p + q), 0.5 * fma(step, wave_speed, u + w)
        flow[f] = fma(-transport, slope, velocity)
        pull[f] = scale * fma(square, slope, -transport * velocity)
        lost = 0.5 * fma(w_step, w_step, square * step * step)
        losses[f] = cable.line_inertia * wave_speed * fma(transport * step, w_step, -lost)


@kernel
def look_at_ends(cable: CableConstants, x: np.ndarray, ends: Ends, moment: Moment) -> None:
    """Slopes y_x at ROV and vessel, each from the wave that runs into it."""
    n = x.shape[1] // 2
    length, slip = moment.length, moment.slip
    foot = sqrt(tension(0.0, moment.net, moment.across) / cable.line_inertia)
    head = sqrt(tension(length, moment.net, moment.across) / cable.line_inertia)
    ends.slip = slip
    scale = 1.0 / length
    inside = x[4, n - 1] * scale
    missed = ends.tip_velocity - x[4, 2 * n - 1]
    # The same as (V - W + c p)/(c - tau) with tau = -slip, written so that it is free of rounding where slip is 0.
    ends.tip_slope = inside + (missed - slip * inside) / (foot + slip)
    ends.vessel_slope = (x[0, n] - moment.vessel + head * x[0, 0] * scale) / (head + (moment.speed - slip))


@kernel
def meet_ends(
    cable: CableConstants, x: np.ndarray, faces: np.ndarray, losses: np.ndarray, ends: Ends, moment: Moment
) -> None:
    """Flux at the vessel and at the ROV, whose velocities are given, and the power it takes, W."""
    n = losses.size - 1
    length, slip = moment.length, moment.slip
    foot = tension(0.0, moment.net, moment.across) / cable.line_inertia
    head = tension(length, moment.net, moment.across) / cable.line_inertia
    scale = 1.0 / length
    enters = moment.speed - slip
    top, tip = moment.vessel + enters * ends.vessel_slope, ends.tip_velocity - slip * ends.tip_slope
    faces[FLOW, 0] = moment.vessel
    faces[PULL, 0] = (head * ends.vessel_slope - enters * top) * scale
    faces[FLOW, n] = ends.tip_velocity
    faces[PULL, n] = (foot * ends.tip_slope + slip * tip) * scale
    top_step, tip_step = x[0, n] - top, x[4, 2 * n - 1] - tip
    losses[0] = -cable.line_inertia * (sqrt(head) + enters) * top_step * top_step
    losses[n] = -cable.line_inertia * (sqrt(foot) + slip) * tip_step * tip_step


@kernel
def differentiate(d: Derivative, f: Five, left: float, right: float) -> Five:
    """d/dsigma of a flux at the nodes of an element, with what it is where it meets its neighbours."""
    f0, f1, middle, f3, f4 = f
    ends, inner, end_step, inner_step = f0 + f4, f1 + f3, f0 - f4, f1 - f3
    odd0 = fma(d.even0[0], ends, fma(d.even0[1], inner, d.even0[2] * middle))
    odd1 = fma(d.even1[0], ends, fma(d.even1[1], inner, d.even1[2] * middle))
    even0 = fma(d.odd0[0], end_step, d.odd0[1] * inner_step)
    even1 = fma(d.odd1[0], end_step, d.odd1[1] * inner_step)
    even2 = fma(d.odd2[0], end_step, d.odd2[1] * inner_step)
    return even0 + fma(-d.lift, left, odd0), even1 + odd1, even2, even1 - odd1, even0 - fma(-d.lift, right, odd0)


@row_kernel
def rates_inside(
    cable: CableConstants, x: np.ndarray, faces: np.ndarray, out: np.ndarray, loss: float, moment: Moment
) -> None:
    """out: d/dsigma of the brackets of the two conservation laws, at every node, less ``loss`` times the velocity.

    A loop for each, because the addresses of all rows in one are more than a processor has registers for.
    """
    n = x.shape[1] // 2
    scale, d = 1.0 / moment.length, cable.derivative
    speed, slip = scale * moment.speed, -scale * moment.slip
    foot = scale * scale * tension(0.0, moment.net, moment.across) / cable.line_inertia
    rise = scale * scale * tension_gain(moment.length, moment.net, moment.across) / cable.line_inertia
    above, n1, n2, n3, n4 = cable.above_faces, N1 / n, N2 / n, N3 / n, 1.0 / n
    x0, x1, x2, x3, x4 = x[0, :n], x[1, :n], x[2, :n], x[3, :n], x[4, :n]
    w0, w1, w2, w3, w4 = x[0, n:], x[1, n:], x[2, n:], x[3, n:], x[4, n:]
    s0, s1, s2, s3, s4 = out[0, :n], out[1, :n], out[2, :n], out[3, :n], out[4, :n]
    r0, r1, r2, r3, r4 = out[0, n:], out[1, n:], out[2, n:], out[3, n:], out[4, n:]
    left, right = faces[FLOW, :n], faces[FLOW, 1 : n + 1]
    t1, t2, t3, t4 = speed * n1, speed * n2, speed * n3, speed * n4
    for e in range(n):
        t = fma(speed, above[e], slip)
        flows = (
            fma(-t, x0[e], w0[e]),
            fma(t1 - t, x1[e], w1[e]),
            fma(t2 - t, x2[e], w2[e]),
            fma(t3 - t, x3[e], w3[e]),
            fma(t4 - t, x4[e], w4[e]),
        )
        s0[e], s1[e], s2[e], s3[e], s4[e] = differentiate(d, flows, left[e], right[e])
    left, right = faces[PULL, :n], faces[PULL, 1 : n + 1]
    q1, q2, q3, q4 = rise * n1, rise * n2, rise * n3, rise * n4
    for e in range(n):
        t, q = fma(speed, above[e], slip), fma(rise, above[e], foot)
        pulls = (
            fma(q, x0[e], -t * w0[e]),
            fma(q - q1, x1[e], (t1 - t) * w1[e]),
            fma(q - q2, x2[e], (t2 - t) * w2[e]),
            fma(q - q3, x3[e], (t3 - t) * w3[e]),
            fma(q - q4, x4[e], (t4 - t) * w4[e]),
        )
        d0, d1, d2, d3, d4 = differentiate(d, pulls, left[e], right[e])
        r0[e], r1[e] = fma(-loss, w0[e], d0), fma(-loss, w1[e], d1)
        r2[e], r3[e], r4[e] = fma(-loss, w2[e], d2), fma(-loss, w3[e], d3), fma(-loss, w4[e], d4)


@row_kernel
def march(x: np.ndarray, new: np.ndarray, old: np.ndarray, older: np.ndarray, weights: np.ndarray) -> None:
    """x += weights . (new, old, older), all of them along a row."""
    w0, w1, w2 = weights[0], weights[1], weights[2]
    for k in range(x.size):
        x[k] += fma(w0, new[k], fma(w1, old[k], w2 * older[k]))


@glue
def evaluate(
    cable: CableConstants,
    x: np.ndarray,
    flat: np.ndarray,
    rate: np.ndarray,
    faces: np.ndarray,
    losses: np.ndarray,
    ends: Ends,
    loss: float,
    moment: Moment,
) -> None:
    """Rates of the cable at the present instant, with linear damping; other forces are added to them.

    Args:
        x, flat: the cable's block, and the same as one row.
        loss: share of its velocity that it loses, 1/s.
    """
    meet(cable, x, flat, faces, losses, moment)
    meet_ends(cable, x, faces, losses, ends, moment)
    rates_inside(cable, x, faces, rate, loss, moment)


@kernel
def add_up_displacement(x: np.ndarray, starts: np.ndarray, vessel: float) -> None:
    """Displacement at every interface into ``starts``, shape (n + 1,), m, from the vessel's, ``vessel``."""
    n = x.shape[1] // 2
    half = 0.5 / n
    x0, x1, x2, x3, x4 = x[0], x[1], x[2], x[3], x[4]
    gains = starts[1:]
    for e in range(n):
        gains[e] = half * fma(W0, x0[e] + x4[e], fma(W1, x1[e] + x3[e], W2 * x2[e]))
    total = vessel
    starts[0] = total
    for e in range(n):
        total += gains[e]
        gains[e] = total

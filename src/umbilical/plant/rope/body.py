"""The body: three translations, weight, added mass and drag per axis relative to the water, thrust and force.

::

    (m + A) V' = -N t - W z - c V + D_l (u - V) + D_q |u - V| (u - V) + (A + m_w) u_t + d + alpha

component by component.
"""

from __future__ import annotations

from umbilical.compile import kernel
from umbilical.plant.rope.records import (
    ADDED,
    BODY_DRAG,
    FORCE,
    FRICTION,
    THRUST,
    WEIGHT,
    RopeConstants,
    RopeOutside,
    RopeState,
)


@kernel
def accelerate_body(rope: RopeConstants, state: RopeState, outside: RopeOutside, booked: bool) -> None:
    """V' into the third row of ``body``."""
    drag, thrust, force, water, rubbed = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        velocity = state.body[0, i]
        relative = state.body_flow[i] - velocity
        braking = (rope.body_damping[i] + rope.body_drag[i] * abs(relative)) * relative
        friction = -rope.body_friction[i] * velocity
        moved = rope.moved_water[i] * state.body_flow[3 + i]
        pull = -state.ends[0].end_pull[i] - (rope.body_weight if i == 2 else 0.0)
        total = pull + friction + braking + moved + outside.body_force[i] + outside.body_thrust[i]
        state.body[2, i] = total / rope.inertia[i]
        drag += braking * velocity
        water += moved * velocity
        rubbed += friction * velocity
        thrust += outside.body_thrust[i] * velocity
        force += outside.body_force[i] * velocity
    if booked:
        state.power[BODY_DRAG], state.power[FRICTION] = drag, rubbed
        state.power[THRUST], state.power[FORCE] = thrust, force
        state.power[ADDED] += water
        state.power[WEIGHT] -= rope.body_weight * state.body[0, 2]

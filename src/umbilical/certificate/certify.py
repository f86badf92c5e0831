"""From a scenario to its certificate: search, then proof, then what follows from both."""

from __future__ import annotations

from umbilical.certificate.advice import best_rate, fixes
from umbilical.certificate.bounds import reach_of, residual_of, start_of
from umbilical.certificate.conditions import conditions, relative_margins, tightest
from umbilical.certificate.ideal_loop import energy_rate
from umbilical.certificate.loads import loads_of
from umbilical.certificate.paper_conditions import paper_conditions
from umbilical.certificate.ranges import growth_at_edges, ranges_of
from umbilical.certificate.records import Certificate
from umbilical.certificate.setting import ideal_constants, sampled, slab_edges, stopped
from umbilical.certificate.solve import ProofTask, find_and_prove
from umbilical.errors import expect
from umbilical.relations.water import in_water
from umbilical.scenario.control import Nominal
from umbilical.scenario.scenario import Scenario
from umbilical.scenario.sensors import Sensors


def certify(scenario: Scenario, *, fix: bool = True) -> Certificate:
    """Prove how fast the ideal loop of a scenario calms down, over its whole run.

    The ideal loop knows Dy/Dt and the rate of the slope at the ROV, acts continuously, and its thrusters deliver what
    is commanded. Observers, sampling, motors and adaptation are outside.

    Args:
        scenario: with the boundary law.
        fix: whether to look for gains that mend what does not hold, which takes longer than all the rest.

    Returns:
        The certificate. One that does not hold is a result, too, whose ``broken`` and ``fixes`` say why and what to do.

    Raises:
        ScenarioError: another law than the boundary law, or a slope gain of 0.

    >>> import umbilical
    >>> certificate = certify(umbilical.load("ringdown", {"control.law.slope_gain": 5.0}))
    >>> certificate.holds, round(certificate.rate, 4)
    (True, 0.0125)
    """
    expect(scenario, "Scenario", "load")
    loop = ideal_constants(scenario)
    edges = slab_edges(scenario.winch, scenario.duration)
    motion = sampled(scenario.winch, scenario.environment.gravity, edges)
    ranges = ranges_of(scenario.winch, loop.g, edges)
    dragged = in_water(scenario.cable, scenario.payload, scenario.environment).body_linear
    loads = loads_of(scenario.environment, float(ranges.length.high.max()), dragged)
    task = ProofTask(scenario.winch, edges, motion, loads.vessel_velocity > 0.0)
    weights, proved, proof = found = find_and_prove(loop, task)
    spent, residual, cable_residual = residual_of(loop, ranges, weights, float(proved.min()), loads)
    stated = conditions(loop, motion, weights, proved, task.vessel_moves)
    return Certificate(
        scenario=scenario, inequalities=tuple(tightest(condition, motion) for condition in stated),
        margins=relative_margins(stated), paper=paper_conditions(loop, motion, weights, loads.cable > 0.0), loop=loop,
        weights=weights, edges=edges, rates=proved, stretch=growth_at_edges(loop, scenario.winch, weights, edges),
        ranges=ranges, fixed_length_rate=best_rate(loop, stopped(motion, loop.g)),
        exact_rate=energy_rate(loop, float(motion.l.max())), loads=loads, spent=spent, residual=residual,
        cable_residual=cable_residual, start=start_of(loop, scenario),
        reach=(reach_of(loop, ranges, weights, 0.5), reach_of(loop, ranges, weights, 1.0)), proof=proof,
        fixes=fixes(loop, task) if fix and not found.certified else (), limits=_limits(scenario),
    )  # fmt: skip


def _limits(scenario: Scenario) -> tuple[str, ...]:
    """What stands between the ideal loop and this scenario."""
    control = scenario.control
    outside = {
        "the observers of velocity and slope rate": getattr(control.law, "rates", "") == "observer",
        f"sampling every {control.period:g} s": True,
        "the motors and what they fail to deliver": not scenario.ideal_thruster,
        "the adaptive law": control.allocation.method == "adaptive",
        "faults": bool(scenario.faults),
        "errors of the sensors": scenario.sensors != Sensors(ideal_velocity=scenario.sensors.ideal_velocity),
        "constants the controller believes and that are not true": control.nominal != Nominal(),
    }
    return tuple(name for name, present in outside.items() if present)

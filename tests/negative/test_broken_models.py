"""Deliberately wrong models fail the cases of the right one, by ten times the tolerance at least.

Every case of the verification stands in the table, so none of them is a test that cannot fail.
"""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatch
from typing import Any

import pytest

from tests.support import broken, broken_rope, broken_sea
from tests.support.broken import Break, another_scenario
from umbilical.verify import FAMILIES
from umbilical.verify.cases import UNFINISHED, Case, worst_ratio
from umbilical.verify.manufactured import TERMS_OFF, terms_off

MARGIN = 10.0
CASES = {case.name: case for cases in FAMILIES.values() for case in cases}
HALF = another_scenario(broken.half_the_inertia_at_the_tip)
UNORDERED = another_scenario(broken.a_force_nobody_ordered)
BREAKS: dict[str, tuple[Break, tuple[str, ...]]] = {
    "half the inertia at the tip": (
        HALF,
        ("hanging cable*", "release*", "reflection*", "moving end, fixed", "vessel in motion*", "crosscheck-none"),
    ),
    "twice the damping": (another_scenario(broken.twice_the_damping), ("damp*", "reflection*", "pulse back*")),
    "a trace of damping": (another_scenario(broken.a_trace_of_damping), ("hanging cable, [lm] =*",)),
    "loads a percent too large": (broken.loads_a_percent_too_large, ("static*", "cable settles*")),
    "wrong sign of the winch speed": (
        broken.wrong_sign_of_the_winch_speed,
        ("moving end, [pht]*", "moving end, ROV held*", "manufactured*", "power balance*"),
    ),
    "dropped acceleration of the winch": (broken.dropped_acceleration, ("manufactured*",)),
    "dropped jerk": (broken.dropped_jerk, ("power balance, *[!d]", "power balance, *refined")),
    "a tenth more inertia of the motor": (
        another_scenario(broken.a_tenth_more("inertia")),
        (
            "motor, step*",
            "motor, reversal*",
            "motor, poles",
            "motor, L*",
        ),
    ),
    "a tenth more resistance": (another_scenario(broken.a_tenth_more("resistance")), ("motor, steady*",)),
    "high-gain observer off by two": (broken.high_gain_observer_off_by_two, ("high-gain*", "whole cascade*")),
    "disturbance observer off by two": (broken.disturbance_observer_off_by_two, ("disturbance observer of the ROV",)),
    "cross term of the inner law": (broken.cross_term_of_the_inner_law, ("law of a motor*",)),
    "inertia that the outer law forgets": (broken.inertia_forgotten, ("law at the ROV*",)),
    "motor's observer off by two": (broken.motor_observer_off_by_two, ("disturbance observer of a motor",)),
    "disturbance observer off by two, in the loop": (
        another_scenario(broken.twice_the_gain_of_the_disturbance_observer),
        ("crosscheck-proposed*", "whole cascade*"),
    ),
    "damping gain off by two": (another_scenario(broken.twice_the_gain_on_damping), ("crosscheck-no-observer",)),
    "position gain off by two": (another_scenario(broken.twice_the_gain_on_position), ("crosscheck-pd",)),
    "wrong sign of the adaptive law": (broken.wrong_sign_of_the_adaptive_law, ("adaptive law*",)),
    "faults one step late": (broken.faults_one_step_late, ("a fault on*",)),
    "a fault that ends late": (another_scenario(broken.a_fault_that_ends_late), ("a fault that ends*",)),
    "jumps that nobody publishes": (broken.jumps_that_nobody_publishes, ("pulses*",)),
    "a force nobody ordered": (UNORDERED, ("superposition*", "mirror*", "shift*", "other units")),
    "motors that never quite die": (broken.motors_that_never_quite_die, ("all motors dead",)),
    "tension that never gets constant": (another_scenario(broken.tension_that_never_gets_constant), ("w -> 0*",)),
    "waves that repeat themselves": (broken_sea.waves_that_repeat_themselves, ("sea, waves of later",)),
    "the square of the amplitude": (
        broken_sea.squared_amplitude,
        ("sea, waves twice as high", "sea, twice as many waves"),
    ),
    "a vessel that follows the water": (broken_sea.vessel_that_follows_the_water, ("sea, ship without*",)),
    "headings of half a turn": (broken_sea.headings_of_half_a_turn, ("sea, headings*",)),
    "every phase a lag": (broken_sea.every_phase_a_lag, ("sea, tables*", "sea, one vessel*")),
    "a spectrum of both sides": (broken_sea.two_sided_spectrum, ("sea, wave spectra", "sea, screening")),
    "energy for amplitude": (broken_sea.energy_for_amplitude, ("sea, wave spectra",)),
    "degrees for radians": (broken_sea.degrees_for_radians, ("sea, screening",)),
    "lead for lag": (broken_sea.lead_for_lag, ("sea, vessel*",)),
    "a table of RAOs read with lead for lag": (broken_sea.table_read_with_lead_for_lag, ("sea, tables*",)),
    "phases of RAOs in degrees": (broken_sea.table_read_in_degrees, ("sea, tables*",)),
    "the body's added mass forgotten": (broken_sea.added_mass_forgotten, ("sea, screening",)),
    "half the body in heave": (broken_sea.half_the_body, ("sea, cable*", "sea, screening")),
    "stretch forgotten under heave": (broken_sea.stretch_forgotten, ("sea, heave in*",)),
    "stretch that leads the heave": (broken_sea.stretch_that_leads, ("sea, heave in*",)),
    "a drive that leads": (broken_sea.drive_that_leads, ("sea, heave compensation",)),
    "gravity of another planet": (
        broken_rope.gravity_of_another_planet,
        (
            "rope, elastic catenary",
            "rope, pendulum*",
            "rope, tow",
            "rope, free*",
            "rope, manufactured*",
            "rope beside*",
        ),
    ),
    "half the body of the rope": (
        broken_rope.half_the_body,
        ("rope, modes*", "rope, heave*", "rope, taut*", "rope, snaps"),
    ),
    "four times the cable of the rope": (broken_rope.four_times_the_cable, ("rope, impact*",)),
    "half the cable of the rope": (broken_rope.half_the_cable, ("rope, front*",)),
    "axes of the rope's body swapped": (broken_rope.axes_swapped, ("rope, tow", "rope, sheared*", "rope, turned*")),
    "a fifth more drag": (broken_rope.a_fifth_more_drag, ("rope, tow", "rope, sheared*")),
    "a winch that runs backwards": (
        broken_rope.winch_that_runs_backwards,
        ("rope, paying out", "rope, hauling in", "rope, momentum*"),
    ),
    "a winch that slips": (broken_rope.winch_that_slips, ("rope, out and in",)),
    "half the cable's inertia of the rope": (broken_rope.half_the_cable, ("rope, crosscheck", "rope, frequencies*")),
    "drag of the rope that grows with the diameter": (
        broken_rope.drag_that_grows_with_the_diameter,
        ("rope, diameter*",),
    ),
    "drag of the rope that drives": (broken_rope.drag_that_drives, ("rope, drag in*",)),
    "drag of the rope that nobody ordered": (broken_rope.drag_that_nobody_ordered, ("rope, superposition",)),
    "a winch held over each step of the rope": (broken_rope.stages_at_the_start, ("rope, order in time",)),
    "waves that do not push a rope": (broken_rope.water_that_pushes_nothing, ("sea, string and rope*",)),
    "three times the heave": (broken_rope.three_times_the_heave, ("rope, irregular*",)),
    "added mass that slides along": (
        broken.added_mass_that_slides_along,
        ("string in water, sheave*", "manufactured solution, at sea*"),
    ),
    "T in place of Tt": (broken.tension_for_what_sliding_leaves, ("manufactured solution, at sea*",)),
    "the lateral part of the drag along the cable omitted": (
        broken.tangential_term_omitted,
        ("manufactured solution, at sea*",),
    ),
    "buoyancy that accelerates": (broken.buoyancy_that_accelerates, ("string in water, tension",)),
    "a fifth less weight in water": (
        another_scenario(broken.a_fifth_less_weight_of_the_cable),
        ("string in water, statics", "string in water, law*", "string in water, out and in"),
    ),
    "more added mass": (
        another_scenario(broken.more_added_mass),
        ("string in water, frequencies*", "string in water, water that does nothing"),
    ),
    "less displaced by the ROV": (another_scenario(broken.less_displaced_by_the_rov), ("string in water, moving*",)),
    "drag by the square of the diameter": (
        another_scenario(broken.drag_by_the_square_of_the_diameter),
        ("string in water, diameter*",),
    ),
    "twice the heave, in water": (another_scenario(broken.twice_the_heave), ("string in water, drag in still*",)),
    "drag linearised once": (broken.drag_linearised_once, ("string in water, shaken in a*",)),
    "twice the drag": (another_scenario(broken.twice_the_drag), ("string in water, shaken*",)),
    "a force nobody ordered, in water": (UNORDERED, ("string in water, mirror*", "string in water, superposition")),
    "a ROV that depends on the grid": (another_scenario(broken.a_rov_that_depends_on_the_grid), ("refinement",)),
}
"""What is broken, and the cases that must notice, by pattern."""


def noticed(patterns: tuple[str, ...]) -> list[Case]:
    return [case for name, case in CASES.items() if any(fnmatch(name, pattern) for pattern in patterns)]


def is_slow(case: Case) -> bool:
    """The quick manufactured solutions in space without a sea stay among the default tests."""
    return not case.quick or fnmatch(case.name, "manufactured solution,*at sea*") or "term by term" in case.name


AMONG_THE_DEFAULT = 2
"""Cases of each broken model that the default tests judge; the slow ones judge all others."""


def pairs() -> Iterator[Any]:
    """Every broken model with every case that must notice it."""
    for what, (breaking, patterns) in BREAKS.items():
        for number, case in enumerate(sorted(noticed(patterns), key=is_slow)):
            later = is_slow(case) or number >= AMONG_THE_DEFAULT
            yield pytest.param(breaking, case, id=f"{what} - {case.name}", marks=[pytest.mark.slow] if later else [])


@pytest.fixture(autouse=True)
def nothing_is_remembered() -> Iterator[None]:
    """What the engine keeps of winches and signals is of the right model before, and of a wrong one after."""
    broken.forget()
    yield
    broken.forget()


@pytest.mark.parametrize(("breaking", "case"), list(pairs()))
def test_it_is_noticed(breaking: Break, case: Case, monkeypatch: pytest.MonkeyPatch) -> None:
    breaking(monkeypatch)
    result = case.judge()
    if result.skipped:
        pytest.skip(result.skipped)
    assert worst_ratio(result.checks) > MARGIN
    assert all(check.quantity != UNFINISHED for check in result.checks), "a case that breaks down has compared nothing"


TERMS: dict[str, tuple[Break, set[str]]] = {
    "nothing": (broken.nothing, set(TERMS_OFF)),
    "the winch's speed": (broken.wrong_sign_of_the_winch_speed, {"winch stopped"}),
    "the winch's acceleration": (broken.dropped_acceleration, {"winch stopped", "winch at a steady speed"}),
    "the vessel's motion": (another_scenario(broken.twice_the_vessels_motion), {"vessel still"}),
    "the cable's damping": (another_scenario(broken.twice("cable.damping")), {"cable undamped"}),
    "the ROV's damping": (another_scenario(broken.twice("payload.damping")), {"ROV undamped"}),
    "the cable's weight": (another_scenario(broken.a_fifth_less_weight_of_the_cable), {"cable without weight"}),
}
"""What is wrong, and the rows of the manufactured solution, term by term, that do not notice."""


@pytest.mark.parametrize(("breaking", "unmoved"), TERMS.values(), ids=TERMS)
def test_terms_off_one_at_a_time_tell_which_is_wrong(
    breaking: Break, unmoved: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    breaking(monkeypatch)
    checks = list(terms_off())
    assert {check.quantity.partition(": ")[2] for check in checks if check.holds} == unmoved
    assert all(check.holds or check.error > MARGIN * check.tolerance for check in checks)


def test_every_case_can_fail() -> None:
    assert {case.name for _, patterns in BREAKS.values() for case in noticed(patterns)} == set(CASES)


def test_every_pattern_means_a_case() -> None:
    lost = [p for _, patterns in BREAKS.values() for p in patterns if not noticed((p,))]
    assert lost == []

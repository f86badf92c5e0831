"""What 'paper-robustness' found, in words and tables."""

from __future__ import annotations

from math import degrees

import numpy as np
from words import item, millimetres, paragraph, rows_of

from umbilical.scenario import Scenario
from umbilical.stability.judgement import margins_at, usual_lengths
from umbilical.studies.members import Draws
from umbilical.studies.results import StudyResult
from umbilical.studies.statistics import against, at, beyond, interval_text, percentage, ratios

TOLD = ("tip_peak", "tip_rms", "mid_rms", "effort_rms")
PD, STIFF, PROPOSED = "PD", "PD, stiff", "proposed"
FAULT, BOX = "proposed + fault control", "proposed + fault control + projection"
_PAIRS = ((PROPOSED, PD), (PROPOSED, STIFF), (FAULT, PROPOSED), (BOX, FAULT))


def headline(result: StudyResult) -> str:
    """The answer, first."""
    paper, stiff = (against(result, "tip_peak", PROPOSED, other) for other in (PD, STIFF))
    effort = against(result, "effort_rms", PROPOSED, STIFF)
    lost = np.count_nonzero(result.ended(STIFF, "DIVERGED"))
    pd, mine, its = (at(result, "tip_peak", arm, 0.5).value for arm in (PD, STIFF, PROPOSED))
    return paragraph(
        f"**The proposed law keeps the ROV {1.0 / paper.ratio.value:.0f} times nearer than the paper's PD, and",
        f"{stiff.ratio.value:.2f} times as far away as a PD with stiffer gains.**",
        f"On {paper.members} draws with a fault each, the median of the largest displacement is {pd:.3g} m with the",
        f"paper's PD, {millimetres(mine)} with the stiff one and {millimetres(its)} with the proposed law, which is",
        f"the nearer of these two in {percentage(stiff.better)} of the draws. The thrust asked for is the same",
        f"(ratio {interval_text(effort.ratio)}). So most of what looks like the merit of the law is the weakness of",
        "the gains it is compared with. What it has over the stiff PD: no draw is lost, of which the stiff PD lost",
        f"{lost}, there is more room for lag, and less noise gets into the thrust; its gain margin is smaller (below).",
        "The stiff PD measures what the proposed law measures, through the same observer; its gains are ours.",
    )


def table(result: StudyResult) -> str:
    """Endings, medians, 95 % quantiles and the limit of every arm."""
    limit = result.study.limits["tip_peak"]
    rows = [["arm", "did not complete", f"`tip_peak` > {limit:g} m", *(f"`{name}`" for name in TOLD)]]
    for arm in result.arms:
        cells = [f"{at(result, m, arm, 0.5).value:.3g} ({at(result, m, arm, 0.95).value:.3g})" for m in TOLD]
        lost = np.count_nonzero(~result.ended(arm, "COMPLETED"))
        rows.append([arm, str(lost), percentage(beyond(result, "tip_peak", arm, limit)), *cells])
    return rows_of(rows)


def versus(result: StudyResult) -> str:
    """Arms against each other, on the same draws."""
    rows = [["arm", "against", *(f"`{name}`" for name in TOLD)]]
    for arm, other in _PAIRS:
        cells = [against(result, name, arm, other) for name in TOLD]
        rows.append([arm, other, *(f"{interval_text(c.ratio, 3)}; {100 * c.better.value:.3g} %" for c in cells)])
    return rows_of(rows)


def loops(result: StudyResult, noisy: StudyResult) -> str:
    """Margins of the loops before anything is drawn, and what noise does to those that see the same."""
    rows = [["arm", "thrust up to", "phase", "lag", "`tip_peak`, with noise", "`effort_rms`, with noise"]]
    scenarios = dict(zip(result.arms, Draws(result.study).undrawn(), strict=True))
    for arm in (PD, STIFF, PROPOSED):
        medians = [at(noisy, metric, arm, 0.5) for metric in ("tip_peak", "effort_rms")] if arm in noisy.arms else []
        rows.append([arm, *margins(scenarios[arm]), *(interval_text(median, 3) for median in medians or [])])
        rows[-1] += ["-"] * (len(rows[0]) - len(rows[-1]))
    return rows_of(rows)


def margins(scenario: Scenario) -> list[str]:
    """Smallest gain, phase and delay margin over the lengths of a run, or how many poles are unstable."""
    judged = [margins_at(scenario, length) for length in usual_lengths(scenario)]
    if unstable := max(one.stability.unstable for one in judged):
        return [f"unstable ({unstable} poles)", "-", "-"]
    sound = [one.margins for one in judged if one.margins is not None]
    gain, phase, lag = (min(getattr(one, name).size for one in sound) for name in ("gain_high", "phase", "delay"))
    return [f"{gain:.3g} times", f"{degrees(phase):.3g}°", f"{1e3 * lag:.3g} ms"]


def faults(result: StudyResult) -> str:
    """Whether fault control helps, and where."""
    return "\n".join([_typical(result), _weak(result), _box(result), _endings(result)])


def _typical(result: StudyResult) -> str:
    without, with_it = (result.values("tip_peak", arm) for arm in (PROPOSED, FAULT))
    peak, rms = (against(result, metric, FAULT, PROPOSED).ratio.value for metric in ("tip_peak", "tip_rms"))
    tenth, ratio = _worst_tenth(without), ratios(result, "tip_peak", FAULT, PROPOSED)
    q95 = [millimetres(at(result, "tip_peak", arm, 0.95).value) for arm in (PROPOSED, FAULT)]
    return item(
        "**Fault control makes the typical draw worse and cuts the tail.**",
        f"With it the ROV moves {peak:.2f} times as far (median of the paired ratios), {rms:.2f} times in rms:",
        "its `kappa` starts at half of what the thrusters ask for, and the disturbance observer already takes up",
        "what a failed motor does not deliver. In the tenth of the draws in which the law without it does worst,",
        "it is better in",
        f"{100 * (ratio[tenth] < 1.0).mean():.3g} %, with a median ratio of {np.median(ratio[tenth]):.2f};",
        f"the 95 % quantile falls from {q95[0]} to {q95[1]},",
        f"the largest from {millimetres(without.max())} to {millimetres(with_it.max())}.",
    )


def _weak(result: StudyResult) -> str:
    hard = np.isin(result["fault.kind"].values, ("dead", "stuck"))
    strength, nominal = _thrust(result)
    tenth = _worst_tenth(result.values("tip_peak", PROPOSED))
    wins = ratios(result, "tip_peak", FAULT, PROPOSED) < 1.0
    return item(
        f"**That tenth is one of dead and stuck motors**: {100 * hard[tenth].mean():.3g} % of it, against",
        f"{100 * hard.mean():.3g} % of all draws. Its thrusters are not all weak: the coefficients of both add up to",
        f"{np.median(strength[tenth]):.3g} N s2/rad2 in its median and to {strength[tenth].max():.3g} at most,",
        f"where the nominal ones make {nominal:.3g}. Over all draws fault control is better in",
        f"{100 * wins[hard].mean():.3g} % of those with a dead or stuck motor, and in",
        f"{100 * wins[~hard].mean():.3g} % of those with a partial fault or wear.",
    )


def _box(result: StudyResult) -> str:
    apart = max(np.abs(ratios(result, metric, BOX, FAULT) - 1.0).max() for metric in TOLD)
    return item(
        f"**The projection changes next to nothing here**: none of these metrics by more than {apart:.1g} of itself.",
        "`kappa_0` starts on the lower side of its box, so the box is touched; what it holds back does not matter.",
        "It is a guard for longer runs and larger motion.",
    )


def _endings(result: StudyResult) -> str:
    """Which arms lost runs; those that lost none are told of together."""
    strength, nominal = _thrust(result)
    lost = {arm: np.flatnonzero(~result.ended(arm, "COMPLETED")) for arm in result.arms}
    told_of = [
        f"**{arm} lost {places.size} of {strength.size} runs**, with thrust coefficients that add up to "
        f"{' and '.join(f'{strength[k]:.3g}' for k in places)} N s2/rad2 instead of {nominal:.3g}."
        for arm, places in lost.items()
        if places.size
    ]
    if not (lost[PROPOSED].size or lost[FAULT].size):
        told_of += [
            "**The proposed law never diverged**, with or without fault control: the paper's claim that the loop may",
            "diverge without it is not seen on any of these draws.",
        ]
    return item(*told_of)


def _worst_tenth(values: np.ndarray) -> np.ndarray:
    return np.argsort(-values)[: values.size // 10]


def _thrust(result: StudyResult) -> tuple[np.ndarray, float]:
    """Sum of the thrust coefficients of every member, and of the scenario, N s2/rad2."""
    nominal = [motor.thrust_coefficient for motor in result.study.scenario.motors]
    factors = [result[f"motors.{k}.thrust_coefficient"].values for k in range(1, len(nominal) + 1)]
    return np.sum([f * n for f, n in zip(factors, nominal, strict=True)], axis=0), sum(nominal)

"""C6 to C9: faults, what the motors go through, and the disturbance observers."""

from __future__ import annotations

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.experiments import ARMS, CASES, FAULTS, OBSERVERS, Runs, cell
from umbilical.papers.rao2022.ledger import (
    FOLLOWS,
    UNMAPPED,
    Evidence,
    Finding,
    Kind,
    Number,
    completed,
    count_kind,
    decide,
    percent,
    relative_error,
    short,
)
from umbilical.papers.rao2022.regions import diverged, reversal, runaways, without_repeats

WORKS = 0.01
"""Share of the uncontrolled peak below which we say that a loop works."""
JUMP = 0.1
"""Share of the healthy peak from which on we call an excess over the healthy run a jump."""
FALLEN = 0.5
"""Share of the largest excess below which the response has fallen."""
SETTLED = 0.1
"""Share of the largest excess below which its swing says that the response has settled."""
PROMPT = 1.0
"""s after a fault within which we call what happens at once."""
LATER = 15.0
"""s at the end of a run over which it is looked whether the response has fallen and settled: more than a period of
the slowest load."""


def c6(evidence: Evidence) -> Finding:
    """No fault: known factors are better, and both work."""
    runs, free = evidence.runs, evidence.runs["free"].metrics["tip_peak"]
    without, with_control = (runs[cell("none", arm)].metrics for arm in ARMS)
    ratio, ratio_rms = (without[m] / with_control[m] for m in ("tip_peak", "tip_rms"))
    both = max(without["tip_peak"], with_control["tip_peak"]) / free
    numbers = [
        Number("peak_ratio", ratio, "1", "peak without over peak with fault control"),
        Number("rms_ratio", ratio_rms, "1", "the same of root mean squares"),
        Number("worst_left", both, "1", "larger peak of the two over that without control"),
    ]
    found = reversal(evidence.gain)
    numbers += found.numbers
    holds = max(ratio, ratio_rms) < 1.0 and both < WORKS
    return Finding(
        "C6",
        "With healthy motors the loop without fault control (factors known) is better than the one with it; both work.",
        f"Peak and root mean square at l; ratio below 1, and both below {percent(WORKS)} of the peak without control.",
        tuple(numbers),
        decide(holds and not found.when, holds),
        f"Known factors leave {percent(ratio)} of the peak that fault control leaves ({short(without['tip_peak'])} and "
        f"{short(with_control['tip_peak'])} m); without control it is {short(free)} m.",
        found.words,
        found.when,
    )


def c7a(evidence: Evidence) -> Finding:
    """A fault may make the loop without fault control diverge."""
    runs = evidence.runs
    peaks = {case: runs[cell(case, "without")].metrics["tip_peak_after_fault"] for case in FAULTS}
    blind = runs["blind, dead, without"].metrics
    seen = max(_absorbed(runs[cell(case, "without")]) for case in FAULTS)
    numbers = [Number(f"{case}_peak", p, "m", f"peak after the fault, {case}") for case, p in peaks.items()]
    numbers += [
        Number("D_error", seen, "1", "largest relative error of D after the fault", Kind.ERROR),
        Number("blind_dead_end", abs(blind["tip_end"]), "m", "ROV at the end, dead, no disturbance observer"),
    ]
    lost = [case for case in FAULTS if not completed([runs[cell(case, "without")]])]
    found = runaways(evidence.edges, "without")
    numbers += found.numbers
    region = UNMAPPED
    if evidence.maps:
        counted = {name: diverged(evidence.maps[name], "without") for name in ("map-time", "map-factors")}
        lost += [name for name, (count, _) in counted.items() if count]
        count, cells = (sum(column) for column in zip(*counted.values(), strict=True))
        numbers.append(Number("diverged", count, "1", "runs of the maps that diverged after a fault", Kind.COUNT))
        numbers.append(Number("cells", cells, "1", "runs of the maps with a fault", Kind.EXACT))
        region = f"{count} of {cells} runs over effectiveness, instant, stuck value and belief diverge."
    return Finding(
        "C7a",
        "After a fault the loop without fault control may diverge.",
        "Whether any run with a fault of one motor diverges: three cases, and every cell of two maps.",
        tuple(numbers),
        decide(bool(lost)),
        f"{'Lost: ' + ', '.join(lost) if lost else 'None does'}; the peaks after the fault are {_list(peaks)} m. The "
        "disturbance observer is driven by the commanded thrust, so what the motor fails to deliver looks like a load "
        f"and is followed (error {percent(seen)}). Without the observer the ROV drifts: "
        f"{short(abs(blind['tip_end']))} m at the end, dead.",
        f"{region} {found.words}",
    )


def _absorbed(run: Run) -> float:
    """Relative error of the estimate of D from the fault on."""
    after = slice(run.scenario.faults[0].start, None)
    return relative_error(run["disturbance"].sel(time=after), run["disturbance_estimate"].sel(time=after))


def _list(values: dict[str, float]) -> str:
    return ", ".join(f"{short(value)} ({name})" for name, value in values.items())


def c7b(evidence: Evidence) -> Finding:
    """With fault control the response jumps at the fault and stays bounded."""
    runs = evidence.runs
    excess = {case: _excess(runs, case) for case in FAULTS}
    soon, size = ({case: found[k] for case, found in excess.items()} for k in ("soon", "size"))
    peaks = {case: _peak(runs, case, "with") for case in FAULTS}
    ratios = {case: peaks[case] / _peak(runs, case, "without") for case in FAULTS}
    jumps, stays = min(soon.values()) > JUMP, completed(runs[cell(case, "with")] for case in FAULTS)
    lost, region = _lost_with_control(evidence) if evidence.maps else ([], UNMAPPED)
    return Finding(
        "C7b",
        "With fault control the boundary response jumps at the fault and stays bounded.",
        "Excess over the healthy run with the same control, as a share of the healthy peak: a jump from "
        f"{percent(JUMP)} on within {PROMPT:g} s; bounded: the runs come to their end.",
        (
            *(Number(f"{c}_soon", v, "1", f"excess {PROMPT:g} s after the fault, {c}") for c, v in soon.items()),
            *(Number(f"{c}_size", v, "1", f"largest excess, {c}") for c, v in size.items()),
            *(Number(f"{c}_peak", v, "m", f"peak after the fault, with fault control, {c}") for c, v in peaks.items()),
            *(Number(f"{c}_ratio", v, "1", f"of that without fault control, {c}") for c, v in ratios.items()),
            *lost,
        ),
        decide(jumps and stays, jumps or stays),
        f"The excess is {_shares(soon)} of the healthy peak {PROMPT:g} s after the fault, and {_shares(size)} at its "
        f"largest. The peaks after the fault are {_list(peaks)} m: {_shares(ratios)} of those without fault control.",
        region,
        "no jump is asked for" if stays else "staying bounded is not asked for",
    )


def _peak(runs: Runs, case: str, arm: str) -> float:
    return runs[cell(case, arm)].metrics["tip_peak_after_fault"]


def _lost_with_control(evidence: Evidence) -> tuple[list[Number], str]:
    """How many runs of each map diverged with fault control, and that in words."""
    names = ("time", "factors", "rates")
    maps = {name: without_repeats(evidence.maps[f"map-{name}"]) for name in names}
    counts = {(n, o): diverged(maps[n].sel(observer=[o]), "with") for n in names for o in OBSERVERS}
    numbers = [
        Number(f"diverged_{n}_{o}", count, "1", f"diverged, of {size} of map-{n}, observer {o}", count_kind(size))
        for (n, o), (count, size) in counts.items()
    ]
    each = (f"map-{n} {counts[n, 'on'][0]} and {counts[n, 'off'][0]} of {counts[n, 'on'][1]}" for n in names)
    words = "Diverged with fault control, of the distinct runs of each map, with the disturbance observer and without: "
    return numbers, f"{words}{'; '.join(each)}."


def c7c(evidence: Evidence) -> Finding:
    """With fault control the response falls again and settles."""
    excess = {case: _excess(evidence.runs, case) for case in FAULTS}
    left, swing = ({case: found[k] for case, found in excess.items()} for k in ("left", "swing"))
    back = [left[case] < FALLEN and swing[case] < SETTLED for case in FAULTS]
    return Finding(
        "C7c",
        "After its jump the response with fault control falls and settles.",
        f"The same excess over the last {LATER:g} s, as a share of its largest: fallen below {percent(FALLEN)}, "
        f"settled where it swings by less than {percent(SETTLED)}.",
        (
            *(Number(f"{c}_left", v, "1", f"excess left at the end, of its largest, {c}") for c, v in left.items()),
            *(Number(f"{c}_swing", v, "1", f"its swing at the end, {c}") for c, v in swing.items()),
        ),
        decide(all(back), any(back)),
        f"Of the largest excess, {_shares(left)} is left at the end; it swings by {_shares(swing)} of it.",
        "Looked at in the three fault cases. With beta = 0.01 m/s nothing pulls the ROV back to the middle.",
        "it is asked of " + " and ".join(case for case, yes in zip(FAULTS, back, strict=True) if yes),
    )


def _excess(runs: Runs, case: str) -> dict[str, float]:
    """|y_fault - y_healthy| at the ROV over the healthy peak soon after the fault and at its largest.

    Of its largest, what is left at the end, and the swing of the difference there.
    """
    healthy, faulty = (runs[cell(c, "with")]["tip_displacement"] for c in ("none", case))
    start = runs[cell(case, "with")].scenario.faults[0].start
    difference = (faulty - healthy) / float(abs(healthy).max())
    excess, end = abs(difference), float(difference["time"][-1])
    largest, late = float(excess.max()), difference.sel(time=slice(end - LATER, end))
    return {
        "soon": float(excess.sel(time=slice(start, start + PROMPT)).max()),
        "size": largest,
        "left": float(abs(late).max()) / largest,
        "swing": float(late.max() - late.min()) / largest,
    }


def _shares(values: dict[str, float]) -> str:
    return ", ".join(f"{percent(value)} ({name})" for name, value in values.items())


def c8(evidence: Evidence) -> Finding:
    """Motor speeds and voltages stay bounded."""
    runs = [evidence.runs[cell(case, arm)] for case in CASES for arm in ARMS]
    speed = max(run.metrics["motor_speed_peak"] for run in runs)
    volts = max(run.metrics["motor_voltage_peak"] for run in runs)
    rms = max(run.metrics["motor_voltage_rms"] for run in runs)
    growth = max(_growth(run) for run in runs)
    return Finding(
        "C8",
        "Motor speeds and voltages stay bounded in all four cases.",
        "Peaks and root mean squares; bounded: every run comes to its end, and the voltage of its last fifth does not "
        "exceed what came before.",
        (
            Number("speed_peak", speed, "rad/s", "largest motor speed"),
            Number("voltage_peak", volts, "V", "largest motor voltage"),
            Number("voltage_rms", rms, "V", "largest root mean square of the voltages"),
            Number("growth", growth, "1", "voltage peak of the last fifth over that before"),
        ),
        decide(completed(runs) and growth < 1.0),
        f"No speed exceeds {short(speed)} rad/s and no voltage {short(volts)} V, in {len(runs)} runs (four fault "
        "cases, "
        "both arms).",
        f"Looked at in the paper's cases; the voltage of the last fifth of a run peaks at "
        f"{percent(growth)} of what came before, or less.",
    )


def _growth(run: Run) -> float:
    """Voltage peak of the last fifth of a run over that before."""
    size = abs(run["motor_voltage"]).max("motor")
    end = float(size["time"][-1])
    return float(size.sel(time=slice(0.8 * end, None)).max() / size.sel(time=slice(0.0, 0.8 * end)).max())


def c9(evidence: Evidence) -> Finding:
    """The disturbance observers follow."""
    run = evidence.runs[cell("none", "without")]
    error = relative_error(run["disturbance"], run["disturbance_estimate"])
    motors = [
        relative_error(run["motor_disturbance"].sel(motor=k), run["motor_disturbance_estimate"].sel(motor=k))
        for k in run["motor"].values
    ]
    control = run.scenario.control
    assert control.motor_loop is not None
    assert control.disturbance_observer is not None
    gain, slow = control.motor_loop.observer_gain, control.disturbance_observer.gain
    fastest = max(term.frequency for m in run.scenario.motors for term in m.voltage_disturbance if term.kind == "sine")
    limit, limit_D = (FOLLOWS * of / float(np.sqrt(1.0 - FOLLOWS**2)) for of in (gain, slow))
    lag = fastest / float(np.hypot(fastest, gain))
    return Finding(
        "C9",
        "The disturbance observers follow D and the motors' voltage disturbances.",
        f"Root mean square of the error over that of the signal; below {FOLLOWS:g}.",
        (
            Number("D_error", error, "1", "relative error of D", Kind.ERROR),
            *(
                Number(f"d2_error_{k}", e, "1", f"the same of d2, motor {k}", Kind.SAMPLED)
                for k, e in enumerate(motors, 1)
            ),
            Number("d2_lag", lag, "1", f"error of a lag 1/g_o at {fastest:g} rad/s", Kind.EXACT),
            Number("d2_limit", limit, "rad/s", "frequency up to which the error of d2 stays below it", Kind.EXACT),
            Number("D_limit", limit_D, "rad/s", "the same of D", Kind.EXACT),
        ),
        decide(max(error, *motors) < FOLLOWS, min(error, *motors) < FOLLOWS),
        f"The errors are {percent(error)} for D, and {', '.join(map(percent, motors))} for the motors.",
        f"Each observer is a first-order lag: what moves faster than its gain is missed. For motor 1, sin {fastest:g}t "
        f"against g_o = {gain:g} 1/s, the lag alone makes {percent(lag)}. D is followed because most of it is steady: "
        f"what moves faster than {short(limit_D)} rad/s is not given to a tenth (k_s = {slow:g} 1/s).",
        f"a motor's disturbance is slower than {short(limit)} rad/s",
    )


def c11(evidence: Evidence) -> Finding:
    """With fault control the vibration is suppressed with and without a fault, against no control."""
    runs, free = evidence.runs, evidence.runs["free"]
    worst = {case: _worst_left(runs[cell(case, "with")], free) for case in CASES}
    long = runs["none, with, endless"].metrics["tip_peak"] / runs["free, long"].metrics["tip_peak"]
    blind = {case: runs[f"blind, {case}, with"] for case in ("none", "dead", "stuck")}
    alone = {case: _worst_left(run, free) for case, run in blind.items() if completed([run])}
    lost = [case for case in blind if case not in alone]
    tried = len(blind) + 1
    lost += ["none, 400 s"] if not completed([runs["blind, none, with, long"]]) else []
    kept = {case: completed([runs[cell(case, "with")]]) and left < 1.0 for case, left in worst.items()}
    return Finding(
        "C11",
        "With fault control the vibration is suppressed with a fault and without one.",
        "Largest ratio to no control over l/4, l/2, 3l/4 and l, of peaks and of root mean squares; below 1, and the "
        "run comes to its end.",
        (
            *(Number(f"{c}_worst", v, "1", f"worst ratio with fault control, {c}") for c, v in worst.items()),
            Number("long_left", long, "1", "peak of the ROV in 4000 s over that without control in 400 s"),
            *(Number(f"blind_{c}_worst", v, "1", f"the same without the observer, {c}") for c, v in alone.items()),
            Number("blind_lost", len(lost), "1", f"of {tried} runs without the observer: diverge", Kind.COUNT),
        ),
        decide(all(kept.values()), any(kept.values())),
        f"Of what there is without control, {_shares(worst)} is left at most.",
        f"Over 4000 s {percent(long)} of the peak of 400 s without control. Without the disturbance observer "
        f"{_shares(alone)}; {len(lost)} of {tried} runs diverge ({'; '.join(lost) or 'none'}).",
        "it is asked of " + " and ".join(case for case, yes in kept.items() if yes),
    )


def _worst_left(run: Run, free: Run) -> float:
    """Largest ratio of peaks and root mean squares to those of another run, over the four places."""
    names = [f"{at}_{kind}" for at in ("quarter", "mid", "three_quarter", "tip") for kind in ("peak", "rms")]
    return max(run.metrics[name] / free.metrics[name] for name in names)

"""C6 to C9: faults, what the motors go through, and the disturbance observers."""

from __future__ import annotations

import numpy as np

from umbilical.reproduce.experiments import ARMS, CASES, FAULTS, OBSERVERS, Runs, cell
from umbilical.reproduce.ledger import (
    UNMAPPED,
    Evidence,
    Finding,
    Kind,
    Number,
    completed,
    decide,
    percent,
    relative_error,
    short,
)
from umbilical.reproduce.regions import diverged, reversal, runaways
from umbilical.run import Run

WORKS = 0.01
"""Share of the uncontrolled peak below which we say that a loop works."""
JUMP = 0.1
"""Share of the healthy peak from which on we call an excess over the healthy run a jump."""
SETTLED = 0.5
"""Share of the largest excess below which the response has fallen."""
PROMPT = 1.0
"""s after a fault within which we call what happens at once."""
LATER = 5.0
"""s at the end of a run over which it is looked whether the response has fallen."""
FOLLOWS = 0.25
"""A relative error below which we say that an estimate follows."""


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
    region, when = UNMAPPED, ""
    if evidence.maps:
        found = reversal(evidence.maps["gain"])
        numbers += found.numbers
        region, when = found.words, found.when
    holds = max(ratio, ratio_rms) < 1.0 and both < WORKS
    return Finding(
        "C6",
        "With healthy motors the loop without fault control (factors known) is better than the one with it; both work.",
        f"Peak and root mean square at l; ratio below 1, and both below {percent(WORKS)} of the peak without control.",
        tuple(numbers),
        decide(holds and not when, holds),
        f"Known factors leave {percent(ratio)} of the peak that fault control leaves ({short(without['tip_peak'])} and "
        f"{short(with_control['tip_peak'])} m); without control it is {short(free)} m.",
        region,
        when,
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
    region = UNMAPPED
    if evidence.maps:
        counted = {name: diverged(evidence.maps[name], "without") for name in ("map-time", "map-factors")}
        lost += [name for name, (count, _) in counted.items() if count]
        cells = sum(size for _, size in counted.values())
        count = sum(count for count, _ in counted.values())
        numbers.append(Number("diverged", count, "1", "runs of the maps that diverged after a fault", Kind.COUNT))
        numbers.append(Number("cells", cells, "1", "runs of the maps with a fault"))
        found = runaways(evidence.edges, "without")
        numbers += found.numbers
        region = f"{count} of {cells} runs over effectiveness, instant, stuck value and belief diverge. {found.words}"
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
        region,
    )


def _absorbed(run: Run) -> float:
    """Relative error of the estimate of D from the fault on."""
    after = slice(run.scenario.faults[0].start, None)
    return relative_error(run["disturbance"].sel(time=after), run["disturbance_estimate"].sel(time=after))


def _list(values: dict[str, float]) -> str:
    return ", ".join(f"{short(value)} ({name})" for name, value in values.items())


def c7b(evidence: Evidence) -> Finding:
    """With fault control the response jumps, falls and settles."""
    runs = evidence.runs
    found = {case: _excess(runs, case) for case in FAULTS}
    soon, size, left = ({case: excess[k] for case, excess in found.items()} for k in ("soon", "size", "left"))
    rises, falls = min(size.values()) > JUMP, max(left.values()) < SETTLED
    stays = completed(runs[cell(case, "with")] for case in FAULTS)
    numbers = [Number(f"{c}_soon", v, "1", f"excess {PROMPT:g} s after the fault, {c}") for c, v in soon.items()]
    numbers += [Number(f"{c}_size", v, "1", f"largest excess, {c}") for c, v in size.items()]
    numbers += [
        Number(f"{c}_left", v, "1", f"share of the largest excess left at the end, {c}") for c, v in left.items()
    ]
    region = UNMAPPED
    if evidence.maps:
        counts = {f"{n}_{o}": _lost(evidence, n, o) for n in ("time", "factors", "rates") for o in OBSERVERS}
        numbers += [Number(f"diverged_{n}", c, "1", f"diverged, of {s}", Kind.COUNT) for n, (c, s) in counts.items()]
        region = (
            "Diverged with fault control, of the runs of each map, with the observer and without it: "
            + "; ".join(
                f"map-{n} {counts[f'{n}_on'][0]} and {counts[f'{n}_off'][0]} of {counts[f'{n}_on'][1]}"
                for n in ("time", "factors", "rates")
            )
            + "."
        )
    return Finding(
        "C7b",
        "With fault control the boundary response jumps at the fault, falls and settles.",
        "Excess over the healthy run with the same control, as a share of the healthy peak: a jump from "
        f"{percent(JUMP)} "
        f"on; fallen when less than {percent(SETTLED)} of the largest is left in the last {LATER:g} s.",
        tuple(numbers),
        decide(rises and falls and stays, stays and (rises or falls)),
        f"The excess is {_shares(soon)} of the healthy peak {PROMPT:g} s after the fault, and {_shares(size)} at its "
        f"largest; of that, {_shares(left)} is left at the end. With beta = 0.01 m/s nothing pulls the ROV back.",
        region,
        "falling back is not asked for" if rises else "a jump is not asked for",
    )


def _lost(evidence: Evidence, name: str, observer: str) -> tuple[int, int]:
    """Diverged runs of a map with fault control; where the factors believed mean nothing, one column counts."""
    data = evidence.maps[f"map-{name}"].sel(observer=[observer])
    return diverged(data.isel(believed_ratio=[0]) if name == "factors" else data, "with")


def _excess(runs: Runs, case: str) -> dict[str, float]:
    """|y_fault - y_healthy| at the ROV over the healthy peak: soon after the fault, its largest, the share left."""
    healthy, faulty = (runs[cell(c, "with")]["tip_displacement"] for c in ("none", case))
    start = runs[cell(case, "with")].scenario.faults[0].start
    excess = abs(faulty - healthy) / float(abs(healthy).max())
    end, largest = float(excess["time"][-1]), float(excess.max())
    return {
        "soon": float(excess.sel(time=slice(start, start + PROMPT)).max()),
        "size": largest,
        "left": float(excess.sel(time=slice(end - LATER, end)).max()) / largest,
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
    counts = {n: diverged(evidence.maps[n], "with") for n in ("map-rates",) if n in evidence.maps}
    region = UNMAPPED
    if counts:
        lost, cells = counts["map-rates"]
        region = f"Where the loop itself runs away they do too: {lost} of {cells} cells of the map of adaptation rates."
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
        region,
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
    loop = run.scenario.control.motor_loop
    assert loop is not None
    fastest = 20.0
    lag = fastest / float(np.hypot(fastest, loop.observer_gain))
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
            Number("d2_lag", lag, "1", f"error of a lag 1/g_o at {fastest:g} rad/s"),
        ),
        decide(max(error, *motors) < FOLLOWS, min(error, *motors) < FOLLOWS),
        f"The errors are {percent(error)} for D, and {', '.join(map(percent, motors))} for the motors.",
        f"Each observer is a first-order lag: what moves faster than its gain is missed. For motor 1, sin 20t against "
        f"g_o = {loop.observer_gain:g} 1/s, the lag alone makes {percent(lag)}.",
    )

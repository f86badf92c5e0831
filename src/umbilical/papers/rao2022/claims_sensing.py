"""C10: high-gain observers against differentiation when the sensors err."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.differentiation import EPS, RIVALS, Errors, crossing, errors, observer, rival
from umbilical.papers.rao2022.ledger import Evidence, Finding, Kind, Number, decide, percent, short
from umbilical.scenario.control import HighGainObserver

SAMPLED = "proposed, no jump, sampled"
NOISE = {"x2": np.geomspace(1e-7, 1e-2, 11), "z2": np.geomspace(1e-9, 1e-4, 11)}
"""Standard deviations of white noise per sample: of y(l,t), m, and of y_x(l,t), rad."""
SIGNALS = {"x2": ("tip_displacement", "tip_velocity"), "z2": ("tip_slope", "tip_slope_rate")}
UNITS = {"x2": "m", "z2": "rad"}
CLEARLY = 0.99
"""Ratio of errors below which one estimate beats another; nearer to 1 they are equal."""


class Contest(NamedTuple):
    """One signal: size of its rate, errors of the observer and its rivals at every eps and at that of the preset."""

    size: float
    ours: list[Errors]
    others: dict[str, list[Errors]]
    here: Errors
    rivals: dict[str, Errors]


def contest(run: Run, name: str) -> Contest:
    """The observer and its rivals on the samples of a run, whose output is stored every period."""
    record, period = run.scenario.control.velocity_observer, run.scenario.control.period
    assert isinstance(record, HighGainObserver)
    samples, rate = (run[channel].values for channel in SIGNALS[name])
    scale = float(np.sqrt(np.mean(rate**2)))
    at = [*EPS, record.time_constant]
    ours = [errors(observer(eps, period), samples, rate) for eps in at]
    others = {r: [errors(rival(r, eps, period), samples, rate) for eps in at] for r in RIVALS}
    here = {r: found[-1] for r, found in others.items()}
    return Contest(scale, ours[:-1], {r: found[:-1] for r, found in others.items()}, ours[-1], here)


def share(found: Contest, name: str, against: str) -> float:
    """Share of the cells over noise and eps in which the observer clearly errs less than a rival."""
    return float(np.mean(_wins(found, name, against)))


def _wins(found: Contest, name: str, against: str) -> np.ndarray:
    """In which cells it does, shape (eps, noise)."""
    pairs = zip(found.ours, found.others[against], strict=True)
    return np.array([one.at(NOISE[name]) < CLEARLY * other.at(NOISE[name]) for one, other in pairs])


def _worst_crossing(found: Contest) -> float:
    """Noise from which on it errs less than the plain difference at every eps."""
    return max(crossing(one, other) for one, other in zip(found.ours, found.others["difference"], strict=True))


def c10(evidence: Evidence) -> Finding:
    """When the sensors err, the observers beat differentiation."""
    run = evidence.runs[SAMPLED]
    found = {name: contest(run, name) for name in SIGNALS}
    shares = {(n, r): share(found[n], n, r) for n in SIGNALS for r in RIVALS}
    plain = {n: crossing(found[n].here, found[n].rivals["difference"]) for n in SIGNALS}
    drowned = {n: found[n].size / found[n].here.noise for n in SIGNALS}
    x2 = found["x2"]
    twin = x2.here.noise / x2.rivals["two poles"].noise
    worst = {n: _worst_crossing(found[n]) for n in SIGNALS}
    alike = max((eps for eps, wins in zip(EPS, _wins(x2, "x2", "two poles"), strict=True) if wins.any()), default=0.0)
    quieter = {r: x2.rivals[r].noise / x2.here.noise for r in RIVALS[:2]}
    return Finding(
        "C10",
        "When the sensors err, high-gain observers give the rates better than differentiation.",
        "Root mean square error of the rate from the same samples with white noise; the observer against the backward "
        "difference, alone, behind one pole that lags as much and behind the observer's own two poles, over "
        f"{EPS.size} eps from {short(EPS[0])} to {short(EPS[-1])} s and {NOISE['x2'].size} levels of noise; better: "
        f"an error below {percent(CLEARLY)} of the other's.",
        (
            *(
                Number(
                    f"{n}_share_{r.replace(' ', '_')}", s, "1", f"cells where the observer wins, {n}, {r}", Kind.SHARE
                )
                for (n, r), s in shares.items()
            ),
            Number("quieter_difference", quieter["difference"], "1", "noise, difference over observer", Kind.SOLVED),
            Number("quieter_one_pole", quieter["one pole"], "1", "noise, one pole over observer", Kind.SOLVED),
            Number("twin", twin, "1", "noise, observer over two poles", Kind.SOLVED),
            *(
                Number(f"{n}_from", at, UNITS[n], f"noise from which on it beats the plain difference, {n}", Kind.FRONT)
                for n, at in plain.items()
            ),
            *(
                Number(f"{n}_from_worst", at, UNITS[n], f"the same at the worst eps, {n}", Kind.FRONT)
                for n, at in worst.items()
            ),
            Number("twin_eps", alike, "s", "largest eps at which the observer beats the two poles, x2", Kind.SOLVED),
            *(
                Number(f"{n}_drowned", at, UNITS[n], f"noise that makes an error as large as {n}", Kind.FRONT)
                for n, at in drowned.items()
            ),
        ),
        decide(min(shares.values()) == 1.0, any(shares[n, "difference"] > 0.0 for n in SIGNALS)),
        f"It errs less than the plain difference in {_each(shares, 'difference')} of the cells, than the one behind "
        f"one pole in {_each(shares, 'one pole')}, than the one behind the same two poles in "
        f"{_each(shares, 'two poles')}. At the preset's eps it passes on 1/{short(quieter['difference'])} of the noise "
        f"of the difference, 1/{short(quieter['one pole'])} of that behind one pole and {short(twin)} of that behind "
        f"two: the observer is a difference behind two poles, and only at an eps of {short(alike)} s or less do they "
        "differ, where the held sample lowers the observer's gain by (h/eps)^2/12.",
        "Exact samples are differentiated better by the difference, because the observer lags; it wins from a noise "
        f"of {short(plain['x2'])} m in y(l,t) and {short(plain['z2'])} rad in y_x(l,t) on (at the worst eps "
        f"{short(worst['x2'])} m and {short(worst['z2'])} rad). Its error is as large as the rate itself from "
        f"{short(drowned['x2'])} m and {short(drowned['z2'])} rad on. The load has no jump here; estimates are "
        "compared, not loops.",
        f"the difference is not filtered, and the noise exceeds {short(worst['x2'])} m in y(l,t) and "
        f"{short(worst['z2'])} rad in y_x(l,t)",
    )


def _each(shares: dict[tuple[str, str], float], against: str) -> str:
    return " and ".join(f"{percent(shares[n, against])} ({n})" for n in SIGNALS)

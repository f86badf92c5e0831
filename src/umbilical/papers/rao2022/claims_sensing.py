"""C10: high-gain observers against differentiation when the sensors err."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.differentiation import EPS, RIVALS, Errors, crossing, errors, observer, rival
from umbilical.papers.rao2022.ledger import BOUNDS, Evidence, Judged
from umbilical.scenario.control import HighGainObserver

SAMPLED = "proposed, no jump, sampled"
NOISE = {"x2": np.geomspace(1e-7, 1e-2, 11), "z2": np.geomspace(1e-9, 1e-4, 11)}
"""Standard deviations of white noise per sample: of y(l,t), m, and of y_x(l,t), rad."""
SIGNALS = {"x2": ("tip_displacement", "tip_velocity"), "z2": ("tip_slope", "tip_slope_rate")}


class Contest(NamedTuple):
    """One signal: root mean square of its rate, and errors of the observer and of each rival at every eps, last at that
    of the preset."""

    size: float
    ours: list[Errors]
    others: dict[str, list[Errors]]

    def wins(self, name: str, against: str) -> np.ndarray:
        """Where the observer clearly errs less than a rival, shape (eps, noise)."""
        pairs = zip(self.ours[:-1], self.others[against][:-1], strict=True)
        return np.array([one.at(NOISE[name]) < BOUNDS["clearly"] * other.at(NOISE[name]) for one, other in pairs])

    def crossings(self) -> list[float]:
        """Noise from which on it errs less than the plain difference, at every eps."""
        return [crossing(one, other) for one, other in zip(self.ours, self.others["difference"], strict=True)]

    def quieter(self, against: str) -> float:
        """Noise that a rival passes on, over that of the observer, at the eps of the preset."""
        return self.others[against][-1].noise / self.ours[-1].noise


def contest(run: Run, name: str) -> Contest:
    """The observer and its rivals on the samples of a run, whose output is stored every period."""
    record, period = run.scenario.control.velocity_observer, run.scenario.control.period
    assert isinstance(record, HighGainObserver)
    samples, rate = (run[channel].values for channel in SIGNALS[name])
    at = [*EPS, record.time_constant]
    ours = [errors(observer(eps, period), samples, rate) for eps in at]
    others = {r: [errors(rival(r, eps, period), samples, rate) for eps in at] for r in RIVALS}
    return Contest(float(np.sqrt(np.mean(rate**2))), ours, others)


def c10(evidence: Evidence) -> Judged:
    """When the sensors err, the observers beat differentiation."""
    found = {name: contest(evidence.runs[SAMPLED], name) for name in SIGNALS}
    shares = {r: {n: float(np.mean(found[n].wins(n, r))) for n in SIGNALS} for r in RIVALS}
    x2, start = found["x2"], {n: found[n].crossings() for n in SIGNALS}
    alike = [eps for eps, wins in zip(EPS, x2.wins("x2", "two poles"), strict=True) if wins.any()]
    worst = {n: max(start[n][:-1]) for n in SIGNALS}
    drowned = {n: found[n].size / found[n].ours[-1].noise for n in SIGNALS}
    values = {
        "share": {f"{n}/{r}": shares[r][n] for n in SIGNALS for r in RIVALS},
        **{name.replace(" ", "_"): share for name, share in shares.items()},
        "quieter_difference": x2.quieter("difference"),
        "quieter_one_pole": x2.quieter("one pole"),
        "twin": 1.0 / x2.quieter("two poles"),
        "from": {n: start[n][-1] for n in SIGNALS},
        "worst": worst,
        "drowned": drowned,
        "twin_eps": max(alike, default=0.0),
        **{f"{n}_from": start[n][-1] for n in SIGNALS},
        **{f"{n}_from_worst": worst[n] for n in SIGNALS},
        **{f"{n}_drowned": drowned[n] for n in SIGNALS},
        "tried": EPS.size,
        "first": EPS[0],
        "last": EPS[-1],
        "levels": NOISE["x2"].size,
    }
    everywhere = min(share for of in shares.values() for share in of.values()) == 1.0
    return Judged(values, everywhere, max(shares["difference"].values()) > 0.0)

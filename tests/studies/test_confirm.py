"""`confirm`: what seeds of a sea say of a limit."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.faces import confirmation
from umbilical.screening import load_operation
from umbilical.screening.criteria import parse_criterion
from umbilical.screening.on_the_rope import on_the_rope
from umbilical.studies import confirm as module

SLACK = parse_criterion("slack=1e-2/3h")
HOURS = 3.0 * 3600.0


def shares_of_a_gaussian_sea(rms: float, runs: int, seed: int = 1) -> np.ndarray:
    """Largest values of a narrow-banded Gaussian process of 8 s in blocks of ten minutes, shape (runs, 18)."""
    below = np.random.default_rng(seed).uniform(size=(runs, 18))
    return rms * np.sqrt(-2.0 * np.log(-np.log(below) / (600.0 / 8.0)))


def found_at(rms: float, runs: int = 10) -> module.Confirmation:
    shares = np.minimum(shares_of_a_gaussian_sea(rms, runs), 1.0)
    passed = int((shares.max(axis=1) >= 1.0).sum())
    reached = module._reached(shares, passed, SLACK, HOURS)
    case = on_the_rope(load_operation("work-class"), depth=3000.0, period=8.0, heading=2.36, height=2.0, duration=600.0)
    done = np.ones(runs, dtype=bool)
    return module.Confirmation(case, (SLACK,), 2.0, np.arange(runs), done, shares[None], (reached,))


def test_the_share_of_a_gaussian_sea_is_that_of_its_closed_form() -> None:
    """P = 1 - exp(-nu T exp(-1/(2 rms^2))) is 1 % at this rms; eight times ten runs find it, mostly within 95 %."""
    rms = 1.0 / np.sqrt(2.0 * np.log(HOURS / 8.0 / -np.log1p(-0.01)))
    found = [module._reached(shares_of_a_gaussian_sea(rms, 10, seed), 0, SLACK, HOURS) for seed in range(8)]
    assert abs(np.mean([each.share.value for each in found]) - 1.0) < 0.02
    assert sum(each.share.low <= 1.0 <= each.share.high for each in found) >= 6
    assert np.mean([each.share.high - each.share.low for each in found]) < 0.15


@pytest.mark.parametrize(
    ("rms", "decision", "words"),
    [(0.17, "HOLDS", "is CONFIRMED"), (0.206, "UNRESOLVED", "NOT YET CONFIRMED"), (0.26, "DOES_NOT_HOLD", "NOT CONF")],
)
def test_the_verdict_follows_from_the_interval(rms: float, decision: str, words: str) -> None:
    verdict = confirmation.FACE.conclusion(found_at(rms))
    assert (verdict.decision, words in verdict.headline) == (decision, True)


def test_slack_in_every_block_is_a_verdict_too() -> None:
    found = found_at(5.0)
    assert found.reached[0].too_many
    assert confirmation.FACE.conclusion(found).decision == "DOES_NOT_HOLD"
    assert "1 of" not in confirmation.FACE.text(found)


def test_a_smooth_peak_between_samples_is_found() -> None:
    t = np.arange(0.0, 600.0, 0.5)
    assert module._peaks(np.sin(2.0 * np.pi * t / 7.3), 3) == pytest.approx([1.0] * 3, abs=2e-3)


@pytest.mark.slow
def test_a_rough_sea_on_the_rope_passes_what_a_calm_one_keeps() -> None:
    criteria = [
        parse_criterion(text)
        for text in ("slack=1e-2/10min", "top_tension:300e3=0.01/10min", "body_heave:3=0.01/10min")
    ]
    how = {"depth": 1500.0, "period": 8.0, "heading": np.radians(135.0), "duration": 600.0}
    operation = load_operation("work-class")
    calm, rough = (
        module.confirm(on_the_rope(operation, height=h, **how), criteria, h, settled=200.0, seeds=3) for h in (0.5, 6.0)
    )
    assert confirmation.FACE.conclusion(calm).decision == "HOLDS"
    assert calm.confirmed_height > 0.5
    assert [each.exceeded for each in rough.reached] == [3, 0, 3]
    assert confirmation.FACE.conclusion(rough).decision == "DOES_NOT_HOLD"

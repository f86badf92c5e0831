"""Run the studies that come along, draw them, and write what they found into docs/studies.md.

`.venv/bin/python tools/make_studies [FOLDER]` runs them in FOLDER (out/studies if left out), or takes the results that
are there; it may be stopped and started again. About ten minutes on two cores.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from robust import FAULT, PROPOSED, STIFF, faults, headline, loops, margins, table, versus
from words import between, millimetres, paragraph, rows_of

from umbilical.plots import as_figure, plot_study, plot_tuning, save_figure
from umbilical.plots.tuning import label_of
from umbilical.studies import tune
from umbilical.studies.engines import default_jobs, threads
from umbilical.studies.load import load_study
from umbilical.studies.results import StudyResult, open_study
from umbilical.studies.study import Study
from umbilical.studies.sweep import sweep

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "studies.md"
IMAGES = ROOT / "docs" / "img"
NOISE = {"sensors.tip_displacement.noise": 1e-3, "sensors.tip_slope.noise": 1e-5}
"""A millimetre, and a hundredth of a milliradian: assumed, of a good positioning system and inclinometer."""
NOISY_MEMBERS = 64
SHOWN = 5
"""Points of the front that the page shows."""
PAPERS = {"control.law.slope_gain": 0.01, "control.disturbance_observer.gain": 5.0}
"""Gains of the preset 'paper', to compare the tuned ones with."""


def main() -> None:
    """Studies, pictures, page."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out" / "studies"
    robust, mapped = (found(load_study(name), folder) for name in ("paper-robustness", "fault-map"))
    noisy, gains = found(with_noise(robust.study), folder), load_study("gain-tuning")
    tuned = tune.tune(gains, place(gains, folder), resume=True)
    save_figure(plot_study(robust, "tip_peak"), IMAGES / "paper-robustness.png", force=True)
    save_figure(plot_study(mapped, "tip_peak_after_fault"), IMAGES / "fault-map.png", force=True)
    save_figure(as_figure(plot_tuning(tuned)), IMAGES / "gain-tuning.png", force=True)
    blocks = {
        "headline": headline(robust),
        "found": table(robust),
        "versus": versus(robust),
        "loops": loops(robust, noisy),
        "faults": faults(robust),
        "map": map_in_words(mapped),
        "tuned": front(tuned),
    }
    text = PAGE.read_text(encoding="utf-8")
    for name, content in blocks.items():
        text = between(text, name, content)
    PAGE.write_text(text, encoding="utf-8")


def found(study: Study, folder: Path) -> StudyResult:
    """The result that is there, if it is of this very study, else a new one."""
    stored = place(study, folder) / "study.nc"
    return open_study(stored) if stored.exists() else sweep(study, stored.parent, resume=True)


def place(study: Study, folder: Path) -> Path:
    """Each version of a study has a folder of its own."""
    return folder / f"{study.name}-{study.hash[:12]}"


def with_noise(study: Study) -> Study:
    """The laws that see the same, with noise on what they see, on fewer draws."""
    arms = [arm.model_dump() for arm in study.arms if arm.name in (STIFF, PROPOSED)]
    noisy = [{**arm, "changes": {**arm["changes"], **NOISE}} for arm in arms]
    return study.replace({"name": "noise", "members": NOISY_MEMBERS, "arms": noisy})


def map_in_words(result: StudyResult) -> str:
    """For each motor where fault control is ahead, and how far the ROV moves at worst."""
    sentences, motors = [], result["fault.motor"].values
    for motor in np.unique(motors):
        without, with_it = (result.values("tip_peak_after_fault", arm)[motors == motor] for arm in (PROPOSED, FAULT))
        ahead, most = np.count_nonzero(with_it < without), [millimetres(v.max()) for v in (with_it, without)]
        sentences += [
            f"Of the {without.size} faults of motor {motor} fault control is ahead in {ahead}; at worst the ROV moves",
            f"{most[0]} with it and {most[1]} without.",
        ]
    return paragraph(*sentences)


def front(searched: tune.Tuned) -> str:
    """Some of the front, the two gains of the paper on the same draws, and what the linearised loop says of each."""
    names = [label_of(objective) for objective in tune.tuning_of(searched.study).objectives]
    rows = [["", *(f"`{key}`" for key in PAPERS), *names, "thrust up to", "phase", "lag"]]
    papers = tune.TriedGains(PAPERS, tune.judge_gains(searched.study, PAPERS, {}, threads(default_jobs())))
    shown = np.unique(np.linspace(0, len(searched.front) - 1, SHOWN).round().astype(int))
    told_of = [(f"`{searched.files[k]}`", searched.front[k]) for k in shown]
    for label, trial in (*told_of, ("the two of the paper", papers)):
        numbers = [*(trial.gains[key] for key in PAPERS), *trial.verdict.values]
        tuned = searched.study.scenario.replace({**searched.study.changes, **trial.gains})
        rows.append([label, *(f"{number:.3g}" for number in numbers), *margins(tuned)])
    broken = ", ".join(f"{name} {count}" for name, count in searched.broken.items())
    head = f"{len(searched.trials)} trials by optuna; conditions broken: {broken}."
    return f"{head} Of the {len(searched.front)} points of the front {len(shown)} are shown:\n\n{rows_of(rows)}"


if __name__ == "__main__":
    main()

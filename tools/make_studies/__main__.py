"""Run the studies that come along, draw them, and write what they found into docs/studies.md.

`.venv/bin/python tools/make_studies [FOLDER]` runs them in FOLDER (out/studies if left out), or takes the results that
are there; it may be stopped and started again. About five minutes on two cores.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from umbilical.analysis.paired import Estimate, compare, exceedance, quantile
from umbilical.plots import plot_study, save_figure
from umbilical.studies.load import load_study
from umbilical.studies.results import StudyResult, open_study
from umbilical.studies.sweep import sweep

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "studies.md"
STUDIES = {"paper-robustness": "tip_peak", "fault-map": "tip_peak_after_fault"}
"""Studies, and the metric that is drawn."""
TOLD = ("tip_peak", "tip_rms", "mid_rms", "effort_rms")


def main() -> None:
    """Studies, pictures, page."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out" / "studies"
    text = PAGE.read_text(encoding="utf-8")
    for name, metric in STUDIES.items():
        result = found(name, folder / name)
        save_figure(plot_study(result, metric), ROOT / "docs" / "img" / f"{name}.png", force=True)
        if name == "paper-robustness":
            text = between(text, "found", table(result))
            text = between(text, "versus", against(result))
    PAGE.write_text(text, encoding="utf-8")


def found(name: str, folder: Path) -> StudyResult:
    """The result that is there, if it is of this very study, else a new one."""
    study, stored = load_study(name), folder / "study.nc"
    if stored.exists() and (result := open_study(stored)).study == study:
        return result
    return sweep(study, folder, resume=True)


def table(result: StudyResult) -> str:
    """Endings, medians, 95 % quantiles and the limit of every arm."""
    limit = result.study.limits["tip_peak"]
    rows = [["arm", "diverged", f"`tip_peak` > {limit:g} m", *(f"`{name}`" for name in TOLD)]]
    rows += [["---"] * len(rows[0])]
    for k, arm in enumerate(result.arms):
        lost = int((result["status"].values[:, k] != 0).sum())
        values = [result.values(name, arm) for name in TOLD]
        cells = [f"{quantile(v, 0.5).value:.3g} ({quantile(v, 0.95).value:.3g})" for v in values]
        rows.append([arm, str(lost), percent(exceedance(values[0], limit)), *cells])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def against(result: StudyResult) -> str:
    """Each arm against the one before, on the same draws."""
    rows = [["arm", "against", *(f"`{name}`" for name in TOLD)], ["---"] * (2 + len(TOLD))]
    for other, arm in zip(result.arms[:-1], result.arms[1:], strict=True):
        cells = [compare(result.values(name, arm), result.values(name, other)) for name in TOLD]
        told = (
            f"{c.ratio.value:.3g} ({c.ratio.low:.3g} to {c.ratio.high:.3g}); {100 * c.better.value:.3g} %"
            for c in cells
        )
        rows.append([arm, other, *told])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def percent(share: Estimate) -> str:
    """A share with its interval."""
    return f"{100 * share.value:.3g} % ({100 * share.low:.3g} to {100 * share.high:.3g})"


def between(text: str, name: str, content: str) -> str:
    """The page with new content between the marks of a name."""
    marks = rf"(<!-- {name}: written by tools/make_studies -->\n).*?(<!-- {name}: end -->)"
    return re.sub(marks, lambda m: f"{m[1]}{content}\n{m[2]}", text, flags=re.DOTALL)


if __name__ == "__main__":
    main()

"""The paper, reproduced: runs, maps, figures and verdicts, and the files they are written to."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from umbilical import files, simulate
from umbilical.formats import to_netcdf
from umbilical.papers.rao2022.claims import judge_claims
from umbilical.papers.rao2022.experiments import EXPERIMENTS, Runs, cell
from umbilical.papers.rao2022.figures import PICTURES, Picture, needed
from umbilical.papers.rao2022.figures.style import RESOLUTION
from umbilical.papers.rao2022.ledger import Evidence, Finding
from umbilical.papers.rao2022.maps import MAPS, SCANS, compute_maps
from umbilical.papers.rao2022.progress import Progress, parts
from umbilical.papers.rao2022.proofs import proofs_of
from umbilical.papers.rao2022.regions import edges
from umbilical.papers.rao2022.tables import to_csv
from umbilical.plots.figure import render
from umbilical.result import ResultFaces
from umbilical.studies import engines
from umbilical.studies.engines import in_order

if TYPE_CHECKING:
    import xarray

REPORT = "report.html"
KINDS = ("png", "pdf", "nc", "csv")
"""Files of every figure."""


class Shown(NamedTuple):
    """One figure: what it is, its dataset, its files' contents by ending, and as SVG for the report."""

    picture: Picture
    data: xarray.Dataset
    contents: Mapping[str, bytes]
    svg: bytes


@dataclass(frozen=True, eq=False)
class Reproduction(ResultFaces):
    """Everything that was found; ``findings`` are empty where only some figures were asked for."""

    shown_by: ClassVar[str] = "umbilical.papers.rao2022.summary"
    runs: Runs
    scans: Mapping[str, xarray.Dataset]
    shown: tuple[Shown, ...]
    findings: tuple[Finding, ...]

    def __repr__(self) -> str:
        return f"<Reproduction {len(self.findings)} claims, {len(self.shown)} figures>"

    def plot(self, name: str = "") -> Any:
        """Draw the figure of this name, the first if none is given.

        Raises:
            KeyError: it was not made.
        """
        shown = {one.picture.name: one for one in self.shown}
        one = shown[name or next(iter(shown))]
        return one.picture.draw(one.data)

    @property
    def mapped(self) -> bool:
        """Whether the maps were made."""
        return any(name in self.scans for name in MAPS)


def choose(names: Sequence[str], *, maps: bool) -> tuple[Picture, ...]:
    """The figures of these names, all if there are none, without those of maps if these are left out.

    Raises:
        KeyError: there is no such figure.
    """
    chosen = [PICTURES[name] for name in dict.fromkeys(names)] or list(PICTURES.values())
    return tuple(picture for picture in chosen if maps or picture.name not in MAPS)


def reproduce(
    names: Sequence[str] = (), *, maps: bool = True, processes: int = 1, progress: Progress | None = None
) -> Reproduction:
    """Run the paper's experiments and judge its claims.

    Args:
        names: figures; all of them, and the ledger, if empty.
        maps: whether to run the thousands of runs behind the maps.
        processes: how many draw the figures; with more than one, a script needs its ``if __name__ == "__main__"``.
        progress: called with the share done, 0 to 1.

    Raises:
        KeyError: there is no such figure.
    """
    pictures = choose(names, maps=maps)
    wanted = {picture.name for picture in pictures if picture.scanned}
    scans = [name for name in SCANS if name in wanted]
    shares = [8.0, 3.0 + 12.0 * sum(name in MAPS for name in scans) if scans else 0.0, 0.0 if names else 2.0, 10.0]
    running, scanning, edging, drawing = parts(progress, shares)
    runs = run_experiments(needed(pictures) if names else tuple(EXPERIMENTS), running)
    found = compute_maps(scans, scanning)
    findings = () if names else judge_claims(evidence(runs, found, edging))
    return Reproduction(runs, found, show_pictures(pictures, runs, found, processes, drawing), findings)


def evidence(runs: Runs, scans: Mapping[str, xarray.Dataset], progress: Progress | None = None) -> Evidence:
    """What claims are judged by, from runs and scans, with the edges of stability looked for."""
    gain, maps = scans["gain"], {name: scans[name] for name in MAPS if name in scans}
    return Evidence(runs, gain, edges(gain, progress), maps, proofs_of(runs[cell("none", "without")].scenario))


def run_experiments(names: Sequence[str], progress: Progress | None = None) -> Runs:
    """Runs of some experiments, by name; the longest begin first, so that no core waits for one in the end."""
    scenarios = {name: EXPERIMENTS[name].scenario() for name in names}
    longest_first = sorted(names, key=lambda name: -scenarios[name].duration)
    found = dict(zip(longest_first, in_order(simulate, [scenarios[n] for n in longest_first], progress), strict=True))
    return {name: found[name] for name in names}


def show_pictures(
    pictures: Sequence[Picture],
    runs: Runs,
    scans: Mapping[str, xarray.Dataset],
    processes: int = 1,
    progress: Progress | None = None,
) -> tuple[Shown, ...]:
    """Figures with their data; drawing takes as long as running, so several processes share it."""
    data = [picture.data(runs, scans) for picture in pictures]
    with engines.processes(processes) if processes > 1 else engines.threads(1) as pool:
        drawn = in_order(draw, list(zip((picture.name for picture in pictures), data, strict=True)), progress, pool)
    return tuple(Shown(picture, one, *files) for picture, one, files in zip(pictures, data, drawn, strict=True))


def draw(named: tuple[str, xarray.Dataset]) -> tuple[dict[str, bytes], bytes]:
    """The files by ending of the figure of a name and its data, and the figure as SVG for the report."""
    name, data = named
    figure = PICTURES[name].draw(data)
    figure.draw_without_rendering()
    figure.set_layout_engine(None)  # laid out once; the three renderings then only draw
    contents = {kind: render(figure, kind, dpi=RESOLUTION) for kind in ("png", "pdf")}
    contents |= {"nc": to_netcdf(data), "csv": to_csv(data)}
    return contents, render(figure, "svg", dpi=RESOLUTION // 2)


def targets(pictures: Sequence[Picture], folder: Path, *, report: bool) -> list[Path]:
    """Every file that will be written."""
    found = [folder / f"{picture.name}.{kind}" for picture in pictures for kind in KINDS]
    return [*found, folder / REPORT] if report else found


def write_files(
    found: Reproduction, folder: Path, report: Callable[[Reproduction], str], *, force: bool = False
) -> dict[str, Any]:
    """Write figures, data and, if there are findings, the report; paths by figure and kind.

    Raises:
        OutputError: a file exists and ``force`` is false, or the folder cannot be written to.
    """
    contents = {(one.picture.name, kind): content for one in found.shown for kind, content in one.contents.items()}
    written: dict[str, Any] = {"figures": {one.picture.name: {} for one in found.shown}}
    for (name, kind), content in contents.items():
        written["figures"][name][kind] = str(files.write(folder / f"{name}.{kind}", content, force=force))
    if found.findings:
        written["report"] = str(files.write(folder / REPORT, report(found).encode(), force=force))
    return written

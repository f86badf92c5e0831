"""``umbilical snap``."""

from __future__ import annotations

from typing import Annotated

from typer import Option

from umbilical.cli.loading import load_scenario
from umbilical.cli.options import Changes, Force, Jobs, Json, Plot, source
from umbilical.cli.output import conclude, report
from umbilical.cli.targets import draw_files


def snap_command(
    scenario: Annotated[str, source('A preset or a .toml file with model = "rope" and a sea.', "scenario")],
    changes: Changes = None,
    seeds: Annotated[int, Option("--seeds", min=1, max=10000, help="How many seeds of the sea.")] = 20,
    risk: Annotated[float | None, Option("--risk", min=0.0, max=1.0, help="Accepted probability of slack.")] = None,
    jobs: Jobs = None,
    plot: Plot = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Estimate how likely a rope in a sea goes slack, and how hard it snaps, from seeds of the sea.

    Slack with its interval, the largest snap, a Gumbel distribution of the largest tensions, and beside it the rule
    of thumb v sqrt(K M), which knows no waves along the cable: an impact can be twice as hard. With --risk the exit
    code is 7 unless the whole interval is within it.

    \b
    examples
      umbilical snap work-class-3000m --seeds 20 --plot snaps.png
      umbilical snap work-class-3000m --set winch.length=1500 --risk 0.05  # 20 seeds are too few: exit code 7
    """
    from umbilical.cli.confirm import cost
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.studies.engines import default_jobs
    from umbilical.studies.snap import check_seeds, snap

    loaded, workers = load_scenario(scenario, changes), min(jobs or default_jobs(), seeds)
    check_seeds(loaded, seeds)
    report(f"{seeds} seeds of {loaded.duration:g} s, {cost(loaded, seeds, workers)}")
    announce_compilation(loaded)
    with bar("seeds of the sea") as advance:
        found = snap(loaded, seeds, workers=workers, progress=advance)
    files = draw_files(found.plot, plot if found.completed.any() else None, force=force)
    return conclude(found, risk, files=files, as_json=as_json)

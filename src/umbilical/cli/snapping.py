"""``umbilical snap``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from umbilical.cli.conclusion import Conclusion, conclude
from umbilical.cli.options import Changes, Json
from umbilical.cli.running import load_changed

if TYPE_CHECKING:
    from umbilical.studies.snap import SnapStudy


def snap(
    scenario: Annotated[str, Argument(help='A preset or a .toml file with model = "rope" and a sea.')],
    changes: Changes = None,
    seeds: Annotated[int, Option("--seeds", min=1, max=10000, help="How many seeds of the sea.")] = 20,
    risk: Annotated[float | None, Option("--risk", min=0.0, max=1.0, help="Accepted probability of slack.")] = None,
    workers: Annotated[int, Option("--workers", min=1, max=256, help="Threads.")] = 1,
    as_json: Json = False,
) -> int:
    """Estimate how likely a rope in a sea goes slack, and how hard it snaps, from seeds of the sea.

    Slack with its interval, the largest snap, a Gumbel distribution of the largest tensions, and beside it the rule
    of thumb v sqrt(K M), which knows no waves along the cable: an impact can be twice as hard. With --risk the exit
    code is 7 unless the whole interval is within it.

    \b
    examples
      umbilical snap work-class-3000m --seeds 20
      umbilical snap work-class-3000m --set winch.length=1500 --risk 0.05
    """
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.studies.snap import snap as study

    loaded = load_changed(scenario, changes or [])
    announce_compilation(loaded)
    with bar("seeds of the sea") as advance:
        found = study(loaded, seeds, workers=workers, progress=advance)
    return conclude(
        _verdict(found, risk),
        text=lambda: "\n".join(_report(found)),
        document=lambda: {**found.to_dict(), "accepted_risk": risk},
        as_json=as_json,
    )


def _verdict(found: SnapStudy, risk: float | None) -> Conclusion:
    """Whether slack is as unlikely as was asked, if it was."""
    if not found.completed.all():
        return Conclusion("UNRESOLVED", f"UNRESOLVED, not every seed completed: {found.summary()}")
    if risk is None:
        return Conclusion("NOT_ASKED", found.summary())
    if found.slack.high <= risk:
        return Conclusion("HOLDS", f"{found.summary()}; within the accepted {risk:g}")
    if found.slack.low > risk:
        return Conclusion("DOES_NOT_HOLD", f"{found.summary()}; ABOVE the accepted {risk:g}")
    return Conclusion("UNRESOLVED", f"UNRESOLVED, more seeds are needed for {risk:g}: {found.summary()}")


def _report(found: SnapStudy) -> list[str]:
    lines = [
        f"  snaps in all runs: {int(found.snaps.sum())}",
        f"  largest tension: {found.largest_tension.max():.4g} N; static at the vessel {found.static_tension:.4g} N",
        f"  rule of thumb, static + v sqrt(K M): {found.rule_of_thumb:.4g} N at v = {found.impact_speed.max():.3g} m/s",
    ]
    if (fit := found.extreme) is not None:
        e = fit.exceeded
        lines.append(
            f"  Gumbel of the largest tensions: location {fit.location:.4g} N, scale {fit.scale:.4g} N; one run in a "
            f"hundred exceeds {e.value:.4g} N ({e.low:.4g} to {e.high:.4g})"
        )
    lines += [f"  assumed: {', '.join(found.scenario.assumed) or 'nothing'}"]
    return lines

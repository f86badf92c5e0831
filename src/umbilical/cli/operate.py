"""``umbilical operate`` and ``umbilical lower``: which sea is workable."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, BadParameter, Option

from umbilical.cli.conclusion import conclude
from umbilical.cli.options import Changes, Force, Jobs, Json, Plot
from umbilical.cli.targets import PICTURES, check_target, draw_files
from umbilical.faces.conclusion import Conclusion
from umbilical.faces.text import text_table

if TYPE_CHECKING:
    import numpy as np

    from umbilical.screening import Lowering, Operability, Operation

Source = Annotated[str, Argument(help="An operation that comes along (work-class), or a .toml file.")]
RANGE = "FROM:TO:COUNT, or values with commas"
Criterion = Annotated[
    list[str] | None,
    Option("--criterion", metavar="NAME=P/TIME", help="slack, top_tension:N or body_heave:M; may be repeated."),
]
Height = Annotated[
    float | None, Option("--height", metavar="HS", help="Is this Hs workable everywhere? If not, exit 7.")
]
Confirm = Annotated[
    int | None,
    Option(
        "--confirm",
        metavar="SEEDS",
        min=1,
        max=10000,
        help="Hold --height, or the lowest limit, against the rope in the time domain, with so many seeds of the sea "
        "(10 is usual).",
    ),
]


def operate(
    operation: Source,
    depth: Annotated[str, Option("--depth", metavar="M", help=f"Cable paid out: {RANGE}.")] = "100:3000:30",
    period: Annotated[str, Option("--period", metavar="S", help=f"Peak period Tp: {RANGE}.")] = "5:15:11",
    heading: Annotated[
        str, Option("--heading", metavar="DEG", help=f"Direction the waves go to, 180 is head sea: {RANGE}.")
    ] = "120:180:5",
    criterion: Criterion = None,
    height: Height = None,
    confirm: Confirm = None,
    jobs: Jobs = None,
    seas: Annotated[
        Path | None,
        Option("--seas", metavar="FILE", help="Scatter table or hindcast (.csv, .nc) in place of --period."),
    ] = None,
    needed: Annotated[float, Option("--needed", metavar="H", help="With a hindcast: hours the operation takes.")] = 3.0,
    changes: Changes = None,
    out: Annotated[Path | None, Option("--out", metavar="FILE", help="Store the limits: .nc.")] = None,
    plot: Plot = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Find the largest significant wave height in which an operation keeps its criteria.

    \b
    examples
      umbilical operate work-class --plot map.png
      umbilical operate work-class --depth 3000 --period 8 --heading 135 --height 2.5
      umbilical operate work-class --criterion slack=1e-2/3h --criterion top_tension:250e3=1e-2/3h
      umbilical operate work-class --set compensation.lag=0.05 --set compensation.bandwidth=6
      umbilical operate work-class --depth 3000 --seas hindcast.csv --needed 6 --plot windows.png
      umbilical operate work-class --depth 3000 --period 8 --heading 135 --height 2.3 --confirm 10

    Heave of the vessel, elastic cable and body are linear, the body's drag is linearised for each sea; time is
    integrated with --confirm only. The exit code is 7 when --height is not workable somewhere, or the rope does not
    confirm it.
    """
    import numpy as np

    from umbilical.screening import operate as limits
    from umbilical.screening.criteria import USUAL, read_criteria

    check_target(plot, PICTURES, force=force)
    check_target(out, ("nc",), force=force)
    criteria = read_criteria(criterion or USUAL)
    axes = {
        "depth": values(depth, "--depth", 1.0, 12000.0),
        "period": values(period, "--period", 2.0, 30.0),
        "heading": np.radians(values(heading, "--heading", -360.0, 360.0)),
    }
    from umbilical.cli.progress import bar

    loaded = _load(operation, changes)
    if seas:
        if height is not None:
            raise BadParameter("--seas has heights of its own", param_hint="'--height'")
        if confirm is not None:
            raise BadParameter("one sea is confirmed: --period, --heading and --depth", param_hint="'--confirm'")
        files_of = {"out": out, "plot": plot, "as_json": as_json, "force": force}
        return _windows(loaded, seas, criteria, axes, _within(needed, "--needed", 0.01, 1e4), files_of)
    with bar("looking for the limits") as advance:
        found = limits(loaded, criteria, **axes, progress=advance)
    files = _store(found, out, plot, force)
    if confirm is not None and (height is None or found.holds(height)):
        return _confirmed(found, height, confirm, jobs, files, as_json)
    return conclude(
        _workable(found, height),
        text=lambda: "\n".join(_report(found)),
        document=lambda: {**found.to_dict(), "height": height},
        files=files,
        as_json=as_json,
    )


def _confirmed(
    found: Operability, height: float | None, seeds: int, jobs: int | None, files: dict[str, str], as_json: bool
) -> int:
    """Hold the height that was asked for, or the lowest limit, against the rope; the verdict is that of its runs."""
    from umbilical.cli.confirm import confirm
    from umbilical.faces import confirmation

    runs = confirm(found, height or float(found.limit[found.worst]), seeds, jobs)
    verdict = confirmation.conclusion(runs)
    return conclude(
        Conclusion(verdict.decision, f"{verdict.headline}; screening: {found.summary()}"),
        text=lambda: "\n".join([confirmation.text(runs), "", "the frequency domain:", *_report(found)]),
        document=lambda: {**found.to_dict(), "height": height, "confirmation": confirmation.document(runs)},
        files=files,
        as_json=as_json,
    )


def _windows(
    operation: Operation, path: Path, criteria: Any, axes: dict[str, Any], needed: float, options: dict[str, Any]
) -> int:
    """Hold the seas of a file against the limits."""
    from umbilical.cli.progress import bar
    from umbilical.screening import read_seas, weather

    seas = read_seas(path, operation.sea.peakedness)
    with bar("looking for the limits") as advance:
        found = weather(
            operation, criteria, seas, depth=axes["depth"], heading=axes["heading"], needed=3600.0 * needed,
            progress=advance,
        )  # fmt: skip
    return conclude(
        Conclusion("NOT_ASKED", found.summary()),
        text=lambda: "\n".join(_report(found.found)),
        document=found.to_dict,
        files=_store(found, options["out"], options["plot"], options["force"]),
        as_json=options["as_json"],
    )


def lower(
    operation: Source,
    height: Annotated[float, Option("--height", metavar="HS", help="Significant wave height, m.")] = 2.0,
    period: Annotated[float, Option("--period", metavar="S", help="Peak period Tp, s.")] = 8.0,
    heading: Annotated[float, Option("--heading", metavar="DEG", help="Direction the waves go to.")] = 135.0,
    depth: Annotated[str, Option("--depth", metavar="M", help=f"Depths of the descent: {RANGE}.")] = "100:3000:30",
    speed: Annotated[str, Option("--speed", metavar="M/S", help=f"Winch speeds: {RANGE}.")] = "0.2:2:10",
    risk: Annotated[
        float | None, Option("--risk", metavar="P", help="Largest acceptable probability of slack; above it, exit 7.")
    ] = None,
    changes: Changes = None,
    plot: Plot = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Find the winch speed that lowers the body through the resonance depths with the least risk of slack.

    \b
    examples
      umbilical lower work-class --height 1.5 --period 8
      umbilical lower work-class --height 2 --risk 0.01 --plot lowering.png
    """
    import numpy as np

    from umbilical.cli.progress import bar
    from umbilical.screening import lower as descend
    from umbilical.sea import Spectrum

    check_target(plot, PICTURES, force=force)
    loaded = _load(operation, changes)
    depths = np.sort(values(depth, "--depth", 1.0, 12000.0))
    if depths.size < 2:
        raise BadParameter("a descent needs two depths or more, e.g. 100:3000:30", param_hint="'--depth'")
    speeds = values(speed, "--speed", 1e-3, 20.0)
    sea = Spectrum(
        _within(height, "--height", 0.01, 20.0), _within(period, "--period", 2.0, 30.0), loaded.sea.peakedness
    )
    with bar("computing the descents") as advance:
        found = descend(loaded, sea, heading=np.radians(heading), depth=depths, speed=speeds, progress=advance)
    return conclude(
        _acceptable(found, risk),
        text=lambda: "\n".join(_descents(found)),
        document=lambda: {**found.to_dict(), "accepted_risk": risk},
        files=_store(found, None, plot, force),
        as_json=as_json,
    )


def values(text: str, option: str, low: float, high: float) -> np.ndarray:
    """Numbers of ``FROM:TO:COUNT`` or of a list with commas, all within bounds.

    >>> values("100:300:3", "--depth", 1.0, 1e4).tolist()
    [100.0, 200.0, 300.0]
    """
    import numpy as np

    try:
        if ":" in text:
            start, stop, count = text.split(":")
            if not 2 <= int(count) <= 1000:
                raise BadParameter(f"{text}: 2 to 1000 values", param_hint=f"'{option}'")
            with np.errstate(invalid="ignore"):
                found = np.linspace(float(start), float(stop), int(count))
        else:
            found = np.array([float(part) for part in text.split(",")])
    except ValueError as error:
        raise BadParameter(f"{text}: {RANGE}, e.g. {low:g}:{high:g}:10", param_hint=f"'{option}'") from error
    for number in found:
        _within(float(number), option, low, high)
    return np.unique(found)


def _within(number: float, option: str, low: float, high: float) -> float:
    if not low <= number <= high:
        raise BadParameter(f"{number:g}: from {low:g} to {high:g}", param_hint=f"'{option}'")
    return number


def _load(operation: str, changes: list[str] | None) -> Operation:
    from umbilical.scenario.document import assignment
    from umbilical.screening import load_operation

    return load_operation(operation, dict(map(assignment, changes or [])))


def _workable(found: Operability, height: float | None) -> Conclusion:
    """Whether a sea is workable everywhere, if that was asked; else the lowest limit."""
    if height is None:
        return Conclusion("NOT_ASKED", found.summary())
    holds = found.holds(height)
    where = f"over all {found.limit.size} depths, periods and headings" if found.limit.size > 1 else "there"
    headline = f"Hs {height:g} m is {'workable' if holds else 'NOT workable'} {where}; {found.summary()}"
    return Conclusion("HOLDS" if holds else "DOES_NOT_HOLD", headline)


def _acceptable(found: Lowering, risk: float | None) -> Conclusion:
    """Whether the best speed keeps the accepted risk, if one was given."""
    if risk is None:
        return Conclusion("NOT_ASKED", found.summary())
    holds = bool(found.risk[found.best] <= risk)
    headline = f"{found.summary()}; {'within' if holds else 'ABOVE'} the accepted {risk:g}"
    return Conclusion("HOLDS" if holds else "DOES_NOT_HOLD", headline)


def _report(found: Operability) -> list[str]:
    """A table of the worst heading, thinned to a screen, and what the limits do not know."""
    import numpy as np

    rows, columns = _thinned(found.depth.size), _thinned(found.period.size)
    worst, steepest = found.limit.min(axis=2), found.steepest
    head = ("limiting Hs [m] at", *(f"Tp {found.period[j]:.3g} s" for j in columns), "T1")
    body = [
        (
            f"{found.depth[i]:.4g} m",
            *(f"{'>' if steepest[i, j] else ''}{worst[i, j]:.2f}" for j in columns),
            f"{found.axial_period[i]:.2f} s",
        )
        for i in rows
    ]
    headings = ", ".join(f"{angle:.0f}" for angle in np.degrees(found.heading))
    shown, all_ = f"{len(rows)} x {len(columns)}", f"{found.depth.size} depths x {found.period.size} periods"
    return [
        text_table([head, *body], right=list(range(1, len(head)))),
        f"  worst of the headings {headings} deg; T1: longest axial period of cable and body",
        *("  >: no limit below the steepest sea of the period, a seventh of its wavelength",) * bool(steepest.any()),
        *(f"  shown: {shown} of {all_}; --json and --out have all",) * (worst.size > len(rows) * len(columns)),
        *(f"  note: {notice}" for notice in found.notices()),
        f"  assumed: {', '.join(found.operation.assumed) or 'nothing'}",
    ]


def _descents(found: Lowering) -> list[str]:
    rows = [("speed", "probability of slack", "duration", "least mean tension")]
    for place in _thinned(found.speed.size):
        rows.append((
            f"{found.speed[place]:.3g} m/s", f"{found.risk[place]:.2g}",
            f"{(found.depth[-1] - found.depth[0]) / found.speed[place] / 60.0:.3g} min",
            f"{found.mean_tension[place].min():.4g} N",
        ))  # fmt: skip
    waiting = f"  where to wait: {found.waiting_depth:.4g} m, outside the resonance"
    notes = (f"  note: {notice}" for notice in found.notices())
    return [
        text_table(rows, right=[1, 2, 3]),
        waiting,
        *notes,
        f"  assumed: {', '.join(found.operation.assumed) or 'nothing'}",
    ]


def _thinned(count: int, most: int = 11) -> list[int]:
    import numpy as np

    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int)).tolist()


def _store(found: Any, out: Path | None, plot: Path | None, force: bool) -> dict[str, str]:
    files = {}
    if out:
        from umbilical.files import write
        from umbilical.formats import to_netcdf

        files["result"] = str(write(out, to_netcdf(found.to_dataset()), force=force))
    return files | draw_files(found.plot, plot, force=force)

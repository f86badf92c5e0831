"""``umbilical operate`` and ``umbilical lower``: which sea is workable."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import BadParameter, Option

from umbilical.cli.loading import load_changed_operation
from umbilical.cli.options import Changes, Force, Jobs, Json, Plot, free, source, within
from umbilical.cli.output import conclude
from umbilical.cli.progress import bar
from umbilical.cli.targets import draw_files

if TYPE_CHECKING:
    import numpy as np

    from umbilical.screening import Operability, Weather

OperationSource = Annotated[str, source("An operation that comes along (work-class), or a .toml file.", "screening")]
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


def operate_command(
    operation: OperationSource,
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
    out: Annotated[
        Path | None, Option("--out", metavar="FILE", help="Store the limits: .nc.", callback=free("nc"))
    ] = None,
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

    from umbilical.screening import operate, read_seas, weather
    from umbilical.screening.criteria import USUAL, read_criteria

    criteria = read_criteria(criterion or USUAL)
    depths, periods = values(depth, "--depth", 1.0, 12000.0), values(period, "--period", 2.0, 30.0)
    headings = np.radians(values(heading, "--heading", -360.0, 360.0))
    loaded = load_changed_operation(operation, changes)
    if seas and height is not None:
        raise BadParameter("--seas has heights of its own", param_hint="'--height'")
    if seas and confirm is not None:
        raise BadParameter("one sea is confirmed: --period, --heading and --depth", param_hint="'--confirm'")
    if seas:
        whole, lasts = read_seas(seas, loaded.sea.peakedness), 3600.0 * within(needed, "--needed", 0.01, 1e4)
        with bar("looking for the limits") as advance:
            windows = weather(loaded, criteria, whole, depth=depths, heading=headings, needed=lasts, progress=advance)
        return conclude(windows, files=_store(windows, out, plot, force), as_json=as_json)
    with bar("looking for the limits") as advance:
        found = operate(loaded, criteria, depth=depths, period=periods, heading=headings, progress=advance)
    files, runs = _store(found, out, plot, force), None
    if confirm is not None and (height is None or found.holds(height)):
        from umbilical.cli.confirm import confirm_on_the_rope

        runs = confirm_on_the_rope(found, height or float(found.limit[found.worst]), confirm, jobs)
    return conclude(found, height, runs, files=files, as_json=as_json)


def lower_command(
    operation: OperationSource,
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

    from umbilical.screening import lower
    from umbilical.sea import Spectrum

    loaded = load_changed_operation(operation, changes)
    depths = values(depth, "--depth", 1.0, 12000.0)
    if depths.size < 2:
        raise BadParameter("a descent needs two depths or more, e.g. 100:3000:30", param_hint="'--depth'")
    speeds = values(speed, "--speed", 1e-3, 20.0)
    sea = Spectrum(within(height, "--height", 0.01, 20.0), within(period, "--period", 2.0, 30.0), loaded.sea.peakedness)
    with bar("computing the descents") as advance:
        found = lower(loaded, sea, heading=np.radians(heading), depth=depths, speed=speeds, progress=advance)
    return conclude(found, risk, files=draw_files(found.plot, plot, force=force), as_json=as_json)


def values(text: str, option: str, low: float, high: float) -> np.ndarray:
    """Numbers of ``FROM:TO:COUNT`` or of a list with commas, all within bounds, rising.

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
    return np.unique([within(float(number), option, low, high) for number in found])


def _store(found: Operability | Weather, out: Path | None, plot: Path | None, force: bool) -> dict[str, str]:
    files = {}
    if out:
        from umbilical.files import write
        from umbilical.formats import to_netcdf

        files["result"] = str(write(out, to_netcdf(found.to_dataset()), force=force))
    return files | draw_files(found.plot, plot, force=force)

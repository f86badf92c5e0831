"""``umbilical bench``."""

from __future__ import annotations

from typing import Annotated

from typer import Option

from umbilical.cli.options import Json
from umbilical.cli.speech import say, say_json, table


def bench(
    repeat: Annotated[int, Option("--repeat", min=1, max=1000, help="Runs per row; the median counts.")] = 15,
    members: Annotated[int, Option("--members", min=0, help="Members of a study that are run; 0 for none.")] = 40,
    cold: Annotated[bool, Option("--cold", help="Also compile everything anew, with an empty cache.")] = False,
    as_json: Json = False,
) -> None:
    """Measure how long the paper's 50 s take here.

    Rows: the compiled loop and its parts, the Python loop, a plain numpy + scipy script of the same system, and
    a study of a thousand such runs.

    \b
    examples
      umbilical bench
      umbilical bench --repeat 51 --cold --json
      umbilical bench --members 10000     # what each costs of 10, 100, 1000 and 10000, and memory: some ten minutes
    """
    from umbilical.bench import measure_all
    from umbilical.cli.progress import announce_compilation, bar

    announce_compilation()
    with bar("measuring") as advance:
        found = measure_all(repeat, members=members, cold=cold, progress=advance)
    if as_json:
        say_json(found.document())
    else:
        rows = [(r.name, f"{r.value:.4g}", r.unit, _times(r.speed), r.note) for r in found.rows]
        say(f"{found.headline}\n\n{table([('', '', '', 'x real time', ''), *rows], right=(1, 3))}")


def _times(speed: float | None) -> str:
    return "" if speed is None else f"{speed:.4g}"

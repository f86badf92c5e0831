"""``python3 do.py bench``: measure how long the paper's 50 s take here.

Rows: the compiled loop and its parts, the same loop in C by hand, the Python loop, a plain numpy + scipy script of the
same system, and a study of a thousand such runs; the rope in a sea with control, and beside MoorDyn. C needs a
compiler, the last one the package moordyn; without them their rows are left out. ``--members 10000`` says what each
costs of 10, 100, 1000 and 10000, and memory: some ten minutes.
"""

from __future__ import annotations

import argparse

from benchmarks import measure_all
from umbilical.cli.output import print_json, print_result
from umbilical.cli.progress import announce_compilation, bar
from umbilical.tables import text_table


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="do.py bench", description=__doc__)
    parser.add_argument("--repeat", type=int, default=15, help="runs per row; the median counts")
    parser.add_argument("--members", type=int, default=40, help="members of a study that are run; 0 for none")
    parser.add_argument("--cold", action="store_true", help="also compile everything anew, with an empty cache")
    parser.add_argument("--json", action="store_true", help="print one JSON object instead of text")
    chosen = parser.parse_args()
    announce_compilation()
    with bar("measuring") as advance:
        found = measure_all(max(chosen.repeat, 1), members=chosen.members, cold=chosen.cold, progress=advance)
    if chosen.json:
        print_json(found.document())
    else:
        rows = [(r.name, f"{r.value:.4g}", r.unit, _times(r.speed), r.note) for r in found.rows]
        print_result(f"{found.headline}\n\n{text_table([('', '', '', 'x real time', ''), *rows], right=(1, 3))}")


def _times(speed: float | None) -> str:
    return "" if speed is None else f"{speed:.4g}"


if __name__ == "__main__":
    main()

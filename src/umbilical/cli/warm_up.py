"""``umbilical warm-up``."""

from __future__ import annotations

from time import perf_counter

from umbilical.cli.output import print_result


def warm_up_command() -> int:
    """Compile all kernels now, so that no later run has to.

    \b
    example
      umbilical warm-up

    They are kept in the folder that `umbilical doctor` names; where they are there already, they are only loaded.
    """
    from umbilical.compile import cache_folder
    from umbilical.engine import warming

    for part in warming.PARTS:
        begun = perf_counter()
        warming.compile_part(part)
        print_result(f"{part}: {perf_counter() - begun:.1f} s")
    print_result(f"kept in {cache_folder()}")
    return 0

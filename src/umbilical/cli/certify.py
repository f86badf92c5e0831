"""``umbilical certify``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from typer import Option

from umbilical.cli.conclusion import conclude_result
from umbilical.cli.options import Changes, Force, Json, Plot, Source
from umbilical.cli.run import load_changed
from umbilical.cli.targets import PICTURES, check_target, draw_files

if TYPE_CHECKING:
    from umbilical.certificate import Certificate
    from umbilical.scenario import Scenario
    from umbilical.studies.audit import Audit


def certify(
    scenario: Source,
    changes: Changes = None,
    audit: Annotated[bool, Option("--audit", help="Simulate the ideal and the real loop, and compare.")] = False,
    plot: Plot = None,
    as_json: Json = False,
    force: Force = False,
) -> int:
    """Prove how fast the ideal loop calms down over the whole run, or say what stands against it.

    \b
    examples
      umbilical certify ringdown --set control.law.slope_gain=5
      umbilical certify haul-in --set control.law.slope_gain=5 --audit --plot haul-in-certificate.png

    The ideal loop has no observers, no sampling and perfect thrusters. The exit code is 7 when nothing is certified,
    and then there is nothing that --audit could simulate against: the second line says what was proved to mend it.
    """
    chosen = load_changed(scenario, changes or [])
    check_target(plot, PICTURES, force=force)
    found, checked = _certify(chosen, audit)
    files = draw_files(lambda: found.plot(audit=checked), plot, force=force)
    return conclude_result(found, checked, files=files, as_json=as_json)


def _certify(scenario: Scenario, audit: bool) -> tuple[Certificate, Audit | None]:
    from umbilical.certificate import certify as prove

    certificate = prove(scenario)
    if not audit or not certificate.holds:
        return certificate, None
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.studies import audit as audits

    announce_compilation(scenario)
    with bar("simulating the ideal and the real loop") as advance:
        checked = audits.audit(scenario, progress=advance)
    return checked.certificate, checked

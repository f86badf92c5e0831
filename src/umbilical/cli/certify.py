"""``umbilical certify``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from typer import Option

from umbilical.cli.loading import load_scenario
from umbilical.cli.options import Changes, Force, Json, Plot, Source
from umbilical.cli.output import conclude
from umbilical.cli.targets import draw_files

if TYPE_CHECKING:
    from umbilical.certificate import Certificate
    from umbilical.scenario import Scenario
    from umbilical.studies.audit import Audit


def certify_command(
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
    found, checked = _certify(load_scenario(scenario, changes), audit)
    files = draw_files(lambda: found.plot(audit=checked), plot, force=force)
    return conclude(found, checked, files=files, as_json=as_json)


def _certify(scenario: Scenario, audit: bool) -> tuple[Certificate, Audit | None]:
    from umbilical.certificate import certify

    certificate = certify(scenario)
    if not audit or not certificate.holds:
        return certificate, None
    from umbilical.cli.progress import announce_compilation, bar
    from umbilical.studies import audit as audits

    announce_compilation(scenario)
    with bar("simulating the ideal and the real loop") as advance:
        checked = audits.audit(scenario, progress=advance)
    return checked.certificate, checked

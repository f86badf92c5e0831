"""A certificate, and its audit against simulations, as a verdict, a text and data."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from math import isnan, log
from typing import TYPE_CHECKING, Any

from umbilical.certificate import largest_bounds, lyapunov_of
from umbilical.faces.conclusion import Conclusion, Face
from umbilical.quantities import CERTIFICATE
from umbilical.tables import attributes, shown_unit, text_table

if TYPE_CHECKING:
    from umbilical.certificate import Certificate, Inequality
    from umbilical.studies.audit import Audit


SCATTER = 1e-3
"""By how much sampling and grid may lift V of an ideal run over its bound before the bound counts as broken."""


def _conclusion(certificate: Certificate, audit: Audit | None = None) -> Conclusion:
    """Whether a rate is proved and, where that was asked, no simulation of the ideal loop refutes it."""
    name = certificate.scenario.name
    if not certificate.holds:
        return Conclusion("DOES_NOT_HOLD", f"{name}: not certified: {'; '.join(_missing(certificate))}")
    halving = log(2.0) / certificate.rate
    proved = f"{name}: certified, V decays at {certificate.rate:.4g} 1/s or faster (halves within {halving:.3g} s)"
    if audit is None:
        return Conclusion("HOLDS", proved)
    if (status := audit.ideal_run.status.name) != "COMPLETED":
        return Conclusion("UNRESOLVED", f"{proved}, but UNRESOLVED: the simulation of the ideal loop ended {status}")
    excess = max(audit.excess, audit.cable_excess)
    if not excess <= 1.0 + SCATTER:
        return Conclusion(
            "DOES_NOT_HOLD", f"{proved}, but REFUTED: in simulation V reaches {excess:.4g} times its bound"
        )
    return Conclusion("HOLDS", f"{proved}; in simulation it stays below its bound")


def _missing(certificate: Certificate) -> list[str]:
    """What fails; if nothing does, what could not be proved."""
    failed = [
        f"{i.name} ({i.equation}) fails by {-i.margin:.3g} {shown_unit(i.unit)}".rstrip() for i in certificate.broken
    ]
    return failed or [f"{n} not proved from {a:.6g} to {b:.6g} s" for n, a, b in certificate.proof.open[:1]]


def _text(certificate: Certificate, audit: Audit | None = None) -> str:
    """What the verdict rests on, as people read it."""
    return "\n".join([*_report(certificate), *(_audit_report(audit) if audit else ())])


def _report(certificate: Certificate) -> Iterator[str]:
    """What to do, the conditions, what follows, and what it does not speak about."""
    for fix in certificate.fixes:
        yield f"  fix: {fix.fix} ({fix.key} = {fix.value}; {fix.bound})"
    if not certificate.holds and not certificate.fixes:
        yield "  no fix was found: none of the slope gains and slower winches that were tried is certified"
    yield text_table([_row(inequality) for inequality in certificate.inequalities], right=[2, 4, 6])
    yield ""
    yield text_table(
        [
            (n, _shown(value, 6), shown_unit(CERTIFICATE[n].unit), CERTIFICATE[n].meaning)
            for n, value in _numbers(certificate)
        ]
    )
    yield f"  {_proof(certificate)}"
    yield from _consequences(certificate)
    yield ""
    yield "  the paper's own conditions, as printed (docs/certificates.md says which signs were restored):"
    yield text_table([_row(inequality) for inequality in certificate.paper], right=[2, 4, 6])
    yield ""
    yield f"  outside the certificate: {'; '.join(certificate.limits) or 'nothing'}"


def _row(inequality: Inequality) -> tuple[str, ...]:
    place = [f"{name} = {value:.4g} {unit}" for name, value, unit in
             (("x", inequality.x, "m"), ("t", inequality.t, "s")) if value is not None]  # fmt: skip
    return (
        inequality.name,
        inequality.equation,
        f"{inequality.left:.4g}",
        "<" if inequality.strict else "<=",
        f"{inequality.right:.4g}",
        inequality.unit,
        f"{inequality.margin:.3g}",
        "" if inequality.holds else "FAILS",
        ", ".join(place),
    )


def _numbers(certificate: Certificate) -> list[tuple[str, float]]:
    """Single numbers of a certificate by name."""
    names = ("rate", "fixed_length_rate", "exact_rate", "spent", "residual")
    start = lyapunov_of(certificate.loop, certificate.weights, certificate.start)
    return [
        *certificate.weights._asdict().items(),
        *((name, getattr(certificate, name)) for name in names),
        ("start", start),
    ]


def _shown(value: float, digits: int = 4) -> str:
    return "none" if isnan(value) else f"{value:.{digits}g}"


def _proof(certificate: Certificate) -> str:
    proof = certificate.proof
    if proof.holds and certificate.rate <= 0.0:
        return "verified by interval arithmetic: these rates, one of which at least is not above 0"
    if proof.holds:
        return f"verified for all x and t by interval arithmetic, in {proof.boxes} boxes of time"
    if not proof.boxes:
        return "nothing to verify: no weights meet K1, K2 and K4 at once, so there is no rate that could be claimed"
    return f"not verified: {len(proof.open)} of {certificate.rates.size} slabs of time stayed open"


def _consequences(certificate: Certificate) -> Iterator[str]:
    """Bounds of V and of the displacement from the scenario's own start."""
    found = largest_bounds(certificate)
    if found:
        yield f"  V stays below {found.lyapunov_largest:.4g} J and ends below {found.lyapunov_end:.4g} J"
        yield (
            f"  |y| stays below {found.tip_largest:.4g} m all along the cable ({found.middle_largest:.4g} m at "
            f"its middle) and ends below {found.tip_end:.4g} m ({found.middle_end:.4g} m)"
        )


def _audit_report(audit: Audit) -> Iterator[str]:
    """What the two simulations made of V."""
    yield ""
    rows = [("V, J", "at the start", "at the end", "its bound there", "largest over its bound", "ended")]
    rows += [
        (name, _shown(v[0]), _shown(v[-1]), limit, _shown(ratio), run.status.name)
        for name, v, limit, ratio, run in (
            ("ideal loop", audit.ideal, _shown(audit.bound[-1]), audit.excess, audit.ideal_run),
            ("  V1 + V2 of it", audit.cable, _shown(audit.cable_bound[-1]), audit.cable_excess, audit.ideal_run),
            ("real loop", audit.real, "-", audit.real_excess, audit.real_run),
        )
    ]
    yield text_table(rows, right=[1, 2, 3, 4])
    yield f"  the ideal loop's V is the integral of its exact rate within {audit.identity:.1e} of its largest value"


def _document(certificate: Certificate, audit: Audit | None = None) -> dict[str, Any]:
    """A certificate as ``--json`` prints it."""
    return {
        "status": "CERTIFIED" if certificate.holds else "NOT_CERTIFIED",
        "scenario": certificate.scenario.name,
        "scenario_hash": certificate.scenario.hash,
        "inequalities": [_inequality(i) for i in certificate.inequalities],
        "paper": [_inequality(i) for i in certificate.paper],
        **dict(_numbers(certificate)),
        "bounds": largest_bounds(certificate) or {},
        **attributes(certificate, "edges rates loads proof fixes limits"),
        "audit": _audit_document(audit) if audit else None,
    }


def _inequality(inequality: Inequality) -> dict[str, Any]:
    return asdict(inequality) | attributes(inequality, "margin holds")


def _audit_document(audit: Audit) -> dict[str, Any]:
    sides = {"ideal": (audit.ideal_run, audit.ideal), "real": (audit.real_run, audit.real)}
    return attributes(audit, "excess cable_excess real_excess identity") | {
        f"{side}_{name}": value
        for side, (run, v) in sides.items()
        for name, value in (("status", run.status.name), ("start", v[0]), ("end", v[-1]))
    }


FACE = Face(_conclusion, _text, _document)

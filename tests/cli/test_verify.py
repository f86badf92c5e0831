"""``umbilical verify``: the table, the files, and what the exit code says."""

from __future__ import annotations

import json

import pytest

from umbilical.verify import control, moving_end
from umbilical.verify.cases import Case, CaseError, Check

FEW = {"Motor": control.MOTORS[:2]}


def _case(find, needs: str = "") -> Case:
    return Case("a case", "a reference", "a source", find, needs=needs)


@pytest.fixture
def few(monkeypatch):
    monkeypatch.setattr("umbilical.verify.verification.FAMILIES", FEW)


def wrong(*_):
    yield Check("speed, rad/s", 51.0, 50.0, 0.02, 1e-6, "asked for")


def diverged(*_):
    raise CaseError("DIVERGED at t = 1 s")


def test_all_hold(umbilical, few):
    done = umbilical("verify", "--quick")
    assert done.code == 0
    assert "motor, steady state: sgn(G)" in done.out
    assert done.out.startswith("6 checks in 2 cases: 6 hold\n")


def test_json_is_one_object_with_every_number(umbilical, few):
    document = umbilical("verify", "--json").document()
    assert document["holds"] is True
    assert (document["verdict"], document["exit_code"]) == ("HOLDS", 0)
    row = document["checks"][0]
    assert {
        "case",
        "reference",
        "source",
        "quantity",
        "ours",
        "expected",
        "error",
        "tolerance",
        "why",
        "verdict",
    } <= set(row)


@pytest.mark.parametrize("find", [wrong, diverged])
def test_one_that_does_not_hold_has_its_exit_code(umbilical, monkeypatch, find):
    monkeypatch.setattr("umbilical.verify.verification.FAMILIES", {"Motor": (*control.MOTORS[:1], _case(find))})
    done = umbilical("verify")
    assert done.code == 7
    assert "FAILS" in done.out
    assert "1 FAIL" in done.out


def test_a_case_that_lacks_a_package_is_skipped_and_says_so(umbilical, monkeypatch):
    skipped = _case(wrong, needs="no_such_package")
    monkeypatch.setattr("umbilical.verify.verification.FAMILIES", {"Motor": control.MOTORS[:1], "Other": (skipped,)})
    done = umbilical("verify")
    assert done.code == 0
    assert "skipped: needs no_such_package" in done.out
    assert "1 case skipped" in done.out.splitlines()[0]


def test_where_nothing_could_be_checked_nothing_is_verified(umbilical, monkeypatch):
    skipped = _case(wrong, needs="no_such_package")
    monkeypatch.setattr("umbilical.verify.verification.FAMILIES", {"Other": (skipped,)})
    done = umbilical("verify")
    assert done.code == 7
    assert done.out.splitlines()[0].startswith("UNRESOLVED, nothing was checked")


def test_quick_leaves_out_what_takes_long(umbilical, monkeypatch):
    slow = Case("slow", "", "", wrong, quick=False)
    monkeypatch.setattr("umbilical.verify.verification.FAMILIES", {"Motor": (*control.MOTORS[:1], slow)})
    assert umbilical("verify", "--quick").code == 0
    assert umbilical("verify").code == 7


def test_files_appear_where_they_were_asked_for(umbilical, few, tmp_path):
    done = umbilical("verify", "--out", str(tmp_path / "new" / "evidence"))
    assert done.code == 0
    tmp_path = tmp_path / "new" / "evidence"
    assert "**motor, step from rest**" in (tmp_path / "verification.md").read_text()
    assert json.loads((tmp_path / "verification.json").read_text())["holds"] is True
    assert (tmp_path / "convergence.svg").read_text().startswith("<?xml")
    again = umbilical("verify", "--out", str(tmp_path))
    assert again.code == 4
    assert "verification.md, verification.json, convergence.svg already" in again.err
    assert umbilical("verify", "--out", str(tmp_path), "--force").code == 0


def test_a_folder_that_cannot_be_made_is_refused_before_the_work(umbilical, monkeypatch, tmp_path):
    monkeypatch.setattr("umbilical.verify.verification.FAMILIES", {"Moving": moving_end.CASES})
    (tmp_path / "file").write_text("")
    done = umbilical("verify", "--out", str(tmp_path / "file" / "evidence"))
    assert done.code == 4
    assert "cannot be made" in done.err

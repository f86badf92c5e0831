"""``umbilical certify``: verdict, exit code, one object, picture."""

from __future__ import annotations

import pytest

GAIN = "control.law.slope_gain"


def test_what_holds(umbilical):
    done = umbilical("certify", "ringdown", "--set", f"{GAIN}=5")
    assert done.code == 0
    assert done.out.startswith("ringdown: certified, V decays at 0.01248 1/s or faster (halves within 55.")
    assert "verified for all x and t by interval arithmetic" in done.out
    assert "outside the certificate: the observers" in done.out


def test_what_does_not_hold_says_which_by_how_much_and_what_would_mend_it(umbilical):
    done = umbilical("certify", "haul-in")
    assert done.code == 7
    assert "not certified: K2 (lam (l + x0)/gam <= beta) fails by 1.8" in done.out
    assert "slope_gain must be at least 1.87" in done.out
    assert "with 0.1% of each bound left free" in done.out
    assert "nothing to verify: no weights meet K1, K2 and K4" in done.out
    assert "nan" not in done.out


def test_one_object(umbilical):
    found = umbilical("certify", "paper", "--set", f"{GAIN}=5", "--json").document()
    assert found["status"] == "CERTIFIED"
    assert {i["name"] for i in found["inequalities"]} == {"wave", "K0", "K1", "K2", "K3", "K4", "K5", "K6"}
    assert all(i["holds"] and i["margin"] >= 0.0 for i in found["inequalities"])
    assert len(found["paper"]) == 7
    assert found["rate"] == pytest.approx(0.00875, rel=0.02)
    assert min(found["rates"]) == found["rate"]
    assert found["proof"]["holds"]
    assert 0.0 < found["bounds"]["middle_largest"] < found["bounds"]["tip_largest"] < 0.1


def test_one_object_of_what_does_not_hold(umbilical):
    done = umbilical("certify", "haul-in", "--json")
    found = done.document()
    assert done.code == 7
    assert found["status"] == "NOT_CERTIFIED"
    assert found["rate"] is None
    assert set(found["rates"]) == {None}
    assert found["proof"] == {"holds": False, "boxes": 0, "open": []}
    assert found["bounds"] == {}
    assert [fix["key"] for fix in found["fixes"]] == [GAIN]


def test_audit_and_picture(umbilical, tmp_path):
    picture = tmp_path / "c.png"
    given = ("certify", "ringdown", "--set", f"{GAIN}=2", "--set", "duration=2", "--audit", "--plot", picture)
    done = umbilical(*given)
    assert done.code == 0
    assert "ideal loop" in done.out
    assert picture.stat().st_size > 10_000
    assert umbilical(*given).code == 4, "it exists already"


def test_another_law_is_refused(umbilical):
    done = umbilical("certify", "paper-pd", "--json")
    assert done.code == 2
    assert done.document()["problems"][0]["key"] == "control.law.kind"

"""`umbilical operate` and `umbilical lower`: verdict, exit code, files, refusals."""

from __future__ import annotations

import pytest
import xarray

ONE = ("operate", "work-class", "--depth", "3000", "--period", "8", "--heading", "135")


@pytest.mark.parametrize(("height", "code", "word"), [("2.5", 0, "is workable"), ("2.7", 7, "is NOT workable")])
def test_the_verdict_stands_in_the_first_line_and_the_exit_code(umbilical, height, code, word):
    done = umbilical(*ONE, "--height", height)
    assert done.code == code
    assert word in done.out.splitlines()[0]
    assert umbilical(*ONE, "--height", height, "--json").document()["exit_code"] == code


def test_limits_are_stored_and_drawn(umbilical, tmp_path):
    done = umbilical("operate", "work-class", "--depth", "500:3000:3", "--period", "6:10:3", "--heading", "135,180",
                     "--out", tmp_path / "map.nc", "--plot", tmp_path / "map.png")  # fmt: skip
    assert done.code == 0
    with xarray.open_dataset(tmp_path / "map.nc") as data:
        assert data["limit"].dims == ("depth", "period", "heading")
        assert data["limit"].attrs["units"] == "m"
    assert (tmp_path / "map.png").stat().st_size > 10_000


def test_lowering_judges_the_accepted_risk(umbilical, tmp_path):
    few = ("lower", "work-class", "--depth", "100:3000:6", "--speed", "0.5:1.5:3", "--height", "1.5")
    assert umbilical(*few, "--risk", "0.5", "--plot", tmp_path / "low.png").code == 0
    assert umbilical(*few, "--risk", "1e-12").code == 7
    assert umbilical(*few, "--json").document()["best_speed"] == 1.0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--depth", "0:100:5"), "from 1 to 12000"),
        (("--depth", "deep"), "FROM:TO:COUNT"),
        (("--period", "8:9:1000000"), "2 to 1000"),
        (("--criterion", "slack"), "slack=P/TIME"),
        (("--set", "payload.mass=-1"), "payload.mass"),
        (("--out", "limits.csv"), "must end with"),
    ],
)
def test_what_cannot_be_asked_is_refused(umbilical, arguments, words):
    done = umbilical("operate", "work-class", *arguments)
    assert done.code in (2, 4)
    assert words in done.err


@pytest.mark.slow
@pytest.mark.parametrize(("height", "code", "word"), [("1.0", 0, "is CONFIRMED"), ("5.5", 7, "is NOT workable")])
def test_a_height_is_held_against_the_rope(umbilical, height, code, word):
    asked = (*ONE, "--criterion", "slack=1e-2/10min", "--height", height, "--confirm", "2")
    done = umbilical(*asked)
    assert done.code == code
    assert word in done.out.splitlines()[0]
    assert ("2 seeds of 800 s, roughly" in done.err) == (code == 0)
    if code == 0:
        document = umbilical(*asked, "--json").document()
        assert (document["verdict"], document["confirmation"]["completed"]) == ("HOLDS", [True, True])


def test_what_the_rope_cannot_confirm_is_refused(umbilical):
    drive = ("--set", "compensation.lag=0.05", "--set", "compensation.bandwidth=6")
    done = umbilical(*ONE, "--height", "1", "--confirm", "2", *drive)
    assert done.code == 2
    assert "compensation" in done.err
    assert umbilical("operate", "work-class", "--seas", "none.csv", "--confirm", "2").code == 2


def test_the_headline_of_the_json_is_the_verdicts(umbilical):
    assert "is NOT workable" in umbilical(*ONE, "--height", "2.7", "--json").document()["headline"]


def test_a_table_says_what_it_leaves_out_and_where_only_the_steepest_sea_ends_it(umbilical):
    whole = umbilical("operate", "work-class", "--depth", "200,400", "--heading", "135").out
    assert "Tp 10 s" in whole
    assert "shown:" not in whole
    part = umbilical("operate", "work-class", "--depth", "100:400:14", "--period", "5:16:12", "--heading", "135").out
    assert "shown: 11 x 11 of 14 depths x 12 periods" in part
    assert ">5.58" in whole
    assert "no limit below the steepest sea" in whole


def test_operations_are_listed_shown_and_copied_like_scenarios(umbilical, tmp_path):
    assert "work-class " in umbilical("presets").out.partition("operations")[2]
    mine = tmp_path / "mine.toml"
    assert "umbilical operate" in umbilical("presets", "--copy", "work-class", mine).out
    assert "payload.wet_weight" in umbilical("show", mine).out
    assert umbilical("show", "work-class", "--json").document()["operation"]["name"] == "work-class"
    refused = umbilical("run", mine)
    assert refused.code == 2
    assert "umbilical operate" in refused.err

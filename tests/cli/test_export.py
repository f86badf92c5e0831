"""``umbilical export --to c`` and ``fmu``: where the files go, and what is refused with which code."""

from __future__ import annotations

import pytest


def test_a_controller_goes_to_a_folder_and_is_not_replaced_unasked(umbilical, tmp_path):
    folder = tmp_path / "deep" / "controller"
    done = umbilical("export", "paper", "--to", "c", "-o", folder, "--prefix", "left_", "--hold", "0.02")
    assert (done.code, done.err) == (0, "")
    assert "umbilical_controller.h" in done.out
    assert "#define LEFT_HOLD 20 " in (folder / "umbilical_controller.h").read_text()
    assert umbilical("export", "paper", "--to", "c", "-o", folder).code == 4
    assert umbilical("export", "paper", "--to", "c", "-o", folder, "--force").code == 0


def test_names_that_are_left_out_follow_the_scenario(umbilical, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert umbilical("export", "crosscheck-pd", "--to", "c").code == 0
    assert (tmp_path / "crosscheck-pd-controller" / "selftest.c").exists()


def test_an_fmu(umbilical, tmp_path):
    pytest.importorskip("fmpy", reason="needs the extra `fmi`")
    done = umbilical("export", "paper", "--to", "fmu", "-o", tmp_path / "p.fmu", "--set", "control.period=0.0005")
    assert done.code == 0, done.err
    assert (tmp_path / "p.fmu").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("paper-none", "--to", "c"), 2, "control.law.kind = none"),
        (("paper", "--to", "c", "--hold", "-1"), 2, "hold = -1 s"),
        (("paper", "--to", "c", "--prefix", "9"), 2, "prefix = '9'"),
        (("paper", "--to", "c", "--set", "cable.damping=-1"), 2, "cable.damping = -1"),
        (("nowhere", "--to", "c"), 2, "no preset or file"),
        (("paper", "--to", "fmu", "--prefix", "a_"), 2, "not with --to fmu"),
        (("paper.nc", "--to", "csv", "--hold", "1"), 2, "not with --to csv"),
        (("paper.nc", "--to", "csv", "--set", "duration=1"), 2, "not with --to csv"),
        (("paper", "--to", "fmu", "-o", "x.zip"), 4, "must end with .fmu"),
    ],
)
def test_refusals(umbilical, tmp_path, monkeypatch, words, code, said):
    monkeypatch.chdir(tmp_path)
    done = umbilical("export", *words)
    assert (done.code, done.out) == (code, "")
    assert said in done.err
    assert list(tmp_path.iterdir()) == []

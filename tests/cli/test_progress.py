"""News about long work: on stderr, and only where somebody reads it."""

from __future__ import annotations

import sys

from umbilical.cli import progress


def test_without_a_terminal_quick_work_is_silent_and_long_work_writes_few_lines(capsys, monkeypatch):
    with progress.bar("working") as advance:
        advance(0.5)
    assert capsys.readouterr() == ("", "")
    instants = iter([0.0, *range(1, 101)])
    monkeypatch.setattr(progress, "perf_counter", lambda: float(next(instants)))
    with progress.bar("working") as advance:
        for share in range(1, 101):
            advance(share / 100.0)
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines() == [f"working: {k}% after {k} s" for k in (11, 22, 44, 88)]


def test_a_bar_on_a_terminal_after_a_while(capsys, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress.bar("quick work") as advance:
        advance(0.5)
    assert capsys.readouterr() == ("", "")
    monkeypatch.setattr(progress, "PATIENCE", -1.0)
    with progress.bar("slow work") as advance:
        advance(0.5)
        advance(1.0)
    out, err = capsys.readouterr()
    assert out == ""
    assert "slow work" in err


def test_the_first_compilation_announces_itself(capsys, monkeypatch):
    for warm, words in [(True, ""), (False, "compiling the kernels once")]:
        monkeypatch.setattr("umbilical.compile.is_warm", lambda warm=warm: warm)
        progress.announce_compilation()
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith(words)
        assert bool(err) == bool(words)

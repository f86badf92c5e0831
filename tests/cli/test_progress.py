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
    assert err.splitlines() == [f"working: {k}% after {k} s" for k in (10, 20, 40, 80)]


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


def test_the_first_compilation_announces_itself_once_and_can_be_silenced(caplog, monkeypatch):
    from umbilical import compile as kernels

    monkeypatch.setattr(kernels.config, "DISABLE_JIT", 0)
    for warm, count in [(True, 0), (False, 1)]:
        monkeypatch.setattr(kernels, "is_warm", lambda *_, warm=warm: warm)
        kernels.announce.cache_clear()
        kernels._said.clear()
        for loop in ("run_steps", "run_held", "run_rope_steps"):
            progress.announce_compilation()
            kernels.announce(loop)
        assert caplog.text.count("compiling the kernels once") == count

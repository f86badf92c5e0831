"""Errors: one text on stderr, the right exit code, no traceback unless asked for."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from umbilical.errors import ControllerError, MissingPartnerError, OutputError


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["run", "papre"], 2, "did you mean 'paper'?"),
        (["run"], 2, "Missing argument"),
        (["run", "paper", "--oot", "x.nc"], 2, "--oot"),
        (["frobnicate"], 2, "frobnicate"),
        (["show", "."], 2, "folder"),
        (["show", "none.nc"], 2, "there is no such file"),
        (["plot", "none.nc", "--kind", "pie"], 2, "pie"),
        (["plot", "none.nc", "--kind", "energ"], 2, "did you mean 'energy'?"),
        (["export", "none.nc"], 2, "--to"),
        (["presets", "papre"], 2, "did you mean 'paper'?"),
        (["presets", "--copy", "paper", "no-folder/a.toml"], 4, "there is no folder"),
    ],
)
def test_bad_input(umbilical, arguments, code, words):
    done = umbilical(*arguments)
    assert (done.code, done.out) == (code, "")
    assert words in done.err
    assert "Traceback" not in done.err


@pytest.mark.parametrize(
    "error", [OutputError("disk full"), ControllerError("it broke"), MissingPartnerError("control")]
)
def test_every_error_of_ours_ends_with_its_exit_code(umbilical, monkeypatch, error):
    monkeypatch.setattr("umbilical.library.load", _raiser(error))
    done = umbilical("run", "paper")
    assert (done.code, done.err) == (error.exit_code, f"umbilical: {error}\n")


def test_an_unexpected_error_is_called_a_bug_of_ours(umbilical, monkeypatch):
    monkeypatch.setattr("umbilical.library.load", _raiser(ZeroDivisionError("oops")))
    done = umbilical("run", "paper", "--json")
    assert done.code == 1
    assert "ZeroDivisionError: oops" in done.err
    assert "a bug of Umbilical" in done.err
    assert "--debug" in done.err
    assert "Traceback" not in done.err
    assert done.document()["status"] == "FAILED"


@pytest.mark.parametrize("arguments", [("--debug", "run", "paper"), ("run", "paper", "--debug")])
def test_debug_shows_the_traceback(umbilical, monkeypatch, arguments):
    monkeypatch.setattr("umbilical.library.load", _raiser(ZeroDivisionError("oops")))
    done = umbilical(*arguments)
    assert done.code == 1
    assert "Traceback" in done.err


def test_an_interruption_outside_a_run(umbilical, monkeypatch):
    monkeypatch.setattr("umbilical.library.load", _raiser(KeyboardInterrupt()))
    done = umbilical("run", "paper")
    assert (done.code, done.err) == (130, "umbilical: interrupted\n")


@pytest.mark.skipif(os.name == "nt", reason="pipes break differently there")
def test_a_reader_that_leaves_is_no_bug():
    script = "import sys; from umbilical.cli import main; raise SystemExit(main(['schema']))"
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-c", script], stdout=writing, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(writing)
    assert (done.returncode, done.stderr) == (4, "")


def test_no_command_simulates_what_the_disk_cannot_hold(umbilical, monkeypatch, tmp_path):
    from umbilical import machine

    monkeypatch.setattr(machine, "room", lambda folder: 1e6)
    done = umbilical("run", "paper", "--out", tmp_path / "a.nc")
    assert done.code == 4
    assert "the result takes 6.7 MB, and the disk has 1 MB left" in done.err


def _raiser(error: BaseException):
    def raising(*_arguments, **_options):
        raise error

    return raising

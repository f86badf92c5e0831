"""What reaches the terminal, and what happens where it cannot be reached or the user has had enough."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from umbilical.cli.terminal import printable
from umbilical.tables import text_table

posix = pytest.mark.skipif(os.name == "nt", reason="streams and signals of POSIX")
EVIL = "\x1b]0;owned\x07\x1b[31m\u202ered\x9b1m\r\udcff"


def call(*words: str, **options) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([sys.executable, "-m", "umbilical", *words], check=False, **options)


def test_everything_a_terminal_obeys_is_escaped_and_nothing_else():
    assert printable("η = 5 µm,\tλ₀\n日本 \u200c\xa0🚢") == "η = 5 µm,\tλ₀\n日本 \u200c\xa0🚢"
    assert printable(EVIL) == r"\x1b]0;owned\x07\x1b[31m\u202ered\x9b1m\r\udcff"


def test_no_command_lets_a_text_of_somebody_else_through(umbilical, tmp_path):
    name = "a\x1b[31mb"
    scenario = tmp_path / f"{name}.toml"
    text = '"a\\u001b[31mb"'
    scenario.write_text(f"extends = 'crosscheck-none'\nname = {text}\ndescription = {text}\nduration = 0.1\n")
    wrong = tmp_path / f"{name}2.toml"
    wrong.write_text(f"extends = 'paper'\n{text} = {text}\n")
    result = tmp_path / f"{name}.nc"
    for words in (
        ("show", scenario),
        ("run", scenario, "--out", result),
        ("run", scenario, "--out", result),
        ("show", result),
        ("compare", result, result),
        ("show", result, "--json"),
        ("show", wrong),
        ("show", tmp_path / f"{name}3.toml"),
        ("run", "paper", "--set", f"{name}={name}"),
        ("plot", result, "--kind", name),
        (name,),
        ("--debug", "show", wrong),
    ):
        done = umbilical(*words)
        assert done.code in (0, 2, 4)
        assert "\x1b" not in done.out + done.err
        assert "x1b[31m" in done.out + done.err or "u001b[31m" in done.out


@posix
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
def test_a_full_or_closed_stream_is_no_bug():
    with Path("/dev/full").open("wb") as full:
        for stream in (full, None):
            options = {"stdout": stream} if stream else {"preexec_fn": lambda: os.close(1)}
            done = call("presets", stderr=subprocess.PIPE, **options)
            assert done.returncode == 4
            assert done.stderr.startswith(b"umbilical: standard output: cannot be written (")
            assert done.stderr.count(b"\n") == 1
        done = call("presets", stdout=subprocess.PIPE, stderr=full)
        assert (done.returncode, done.stdout[:9]) == (0, b"scenarios")
    done = call("show", "papre", "--json", stdout=subprocess.PIPE, preexec_fn=lambda: os.close(2))
    assert (done.returncode, b'"REFUSED"' in done.stdout) == (2, True)


def test_characters_the_terminal_does_not_have_are_escaped():
    environment = os.environ | {"PYTHONIOENCODING": "ascii"}
    done = call("show", "ringdown", "--metric", "η", env=environment, stderr=subprocess.PIPE)
    assert done.returncode == 2
    done = call("show", "η.toml", env=environment, stderr=subprocess.PIPE)
    assert (done.returncode, b"\\u03b7.toml" in done.stderr) == (2, True)


@posix
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interruption_while_modules_are_imported(number):
    script = (
        "import os, signal, sys\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a shell's background job ignores it
        "class Interrupting:\n"
        "    def find_spec(self, name, *_):\n"
        f"        if name == 'typer': os.kill(os.getpid(), {int(number)})\n"
        "sys.meta_path.insert(0, Interrupting())\n"
        "from umbilical.cli import main\n"
        "raise SystemExit(main(['presets']))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (130, "umbilical: interrupted\n")


@posix
def test_a_request_to_terminate_keeps_the_result_as_ctrl_c_does(umbilical, monkeypatch, tmp_path):
    from umbilical import load, simulate

    def terminated(scenario, controller=None):
        return simulate(scenario, progress=lambda share: os.kill(os.getpid(), signal.SIGTERM))

    monkeypatch.setattr("umbilical.cli.progress.simulate_visibly", terminated)
    before = signal.getsignal(signal.SIGTERM)
    done = umbilical("run", "crosscheck-none", "--out", tmp_path / "a.nc")
    assert done.code == 130
    assert "INTERRUPTED" in done.out.splitlines()[0]
    assert load(tmp_path / "a.nc").name == "crosscheck-none"
    assert signal.getsignal(signal.SIGTERM) is before


def test_a_table_is_wrapped_to_the_width_that_is_asked_for(monkeypatch):
    rows = [("key", "1.0", "a meaning " * 20), ("longer key", "2.0", "short")]
    monkeypatch.setenv("COLUMNS", "60")
    lines = text_table(rows).splitlines()
    assert max(map(len, lines)) <= 60
    assert lines[1].startswith(" " * 19 + "meaning")
    monkeypatch.delenv("COLUMNS")
    assert len(text_table(rows).splitlines()) == 2


def test_the_description_of_a_scenario_is_wrapped_too(umbilical, monkeypatch):
    monkeypatch.setenv("COLUMNS", "60")
    description = umbilical("show", "paper").out.split("\n\n")[1]
    assert max(map(len, description.splitlines())) <= 60
    assert description.endswith("assumed.")


def test_a_long_value_does_not_pad_the_table_of_a_scenario(umbilical, tmp_path):
    times = ", ".join(str(float(k)) for k in range(1000))
    path = tmp_path / "long.toml"
    winch = f'[winch]\nlaw = "table"\ntimes = [{times}]\nlengths = [{", ".join(["450.0"] * 1000)}]\n'
    path.write_text(f'extends = "crosscheck-none"\n{winch}')
    done = umbilical("show", path)
    assert done.code == 0
    assert "(1000 entries)" in done.out
    assert max(map(len, done.out.splitlines())) < 300
    assert len(umbilical("show", path, "--json").document()["scenario"]["winch"]["times"]) == 1000

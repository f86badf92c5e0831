"""The page that plays a run: what it holds, how large it is, and that it runs in a browser."""

from __future__ import annotations

import base64
import html
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import umbilical
from tests.support import browser
from umbilical import Run, load, simulate
from umbilical.report import player as page


@pytest.fixture(scope="module")
def run() -> Run:
    return simulate(load("paper-stuck", {"duration": 12.0}))


@pytest.fixture(scope="module")
def free() -> Run:
    return simulate(load("crosscheck-none", {"duration": 4.0}))


def film(text: str) -> dict[str, Any]:
    found = re.search(r'<script id="data" type="application/json">(.*?)</script>', text, flags=re.DOTALL)
    assert found
    return json.loads(found[1])


def floats(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), "<f4")


def test_the_page_holds_the_run(run: Run) -> None:
    (reel,) = film(page.player(run))["runs"]
    shape = np.frombuffer(base64.b64decode(reel["y"]), "<i2").reshape(-1, reel["nodes"]) * reel["step"]
    time = floats(reel["time"])
    tip = run["tip_displacement"].sel(time=time, method="nearest").values
    assert np.allclose(shape[:, -1], tip, atol=2.0 * reel["step"])
    assert time[-1] == pytest.approx(12.0)
    assert np.allclose(
        floats(reel["end"]), 500.0 * (10.0 - run["payout_acceleration"].sel(time=time, method="nearest"))
    )
    assert [panel["title"] for panel in reel["panels"]][-1] == "motor voltage [V]"


def test_faults_are_events(run: Run) -> None:
    assert film(page.player(run))["events"] == [{"time": 10.0, "text": "motor 2: stuck"}]


def test_two_runs_share_a_page(run: Run, free: Run) -> None:
    assert [reel["name"] for reel in film(page.player(run, free))["runs"]] == ["paper-stuck", "crosscheck-none"]


def test_the_same_run_gives_the_same_bytes_and_no_address(run: Run) -> None:
    text = page.player(run)
    assert text == page.player(run)
    assert "http" not in text.replace("http-equiv", "")
    assert len(text) < 1_000_000


def test_a_name_cannot_leave_its_element(free: Run) -> None:
    evil = simulate(free.scenario.replace({"name": "</script><script>lost()//"}))
    assert "<script>lost" not in page.player(evil)


def test_a_long_run_is_thinned_and_says_so(free: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "BUDGET", 10_000)
    text = page.player(free)
    assert "thinned to" in film(text)["thinned"]
    assert len(json.dumps(film(text))) < 12_000


def test_a_run_without_samples_is_refused(free: Run) -> None:
    nothing = Run(free.data.isel(time=slice(0, 1)), free.scenario)
    with pytest.raises(ValueError, match="anything to play"):
        page.player(nothing)


SLACK = {
    "model": "rope", "duration": 6.0, "output.interval": 0.02, "payload.wet_weight": 1000.0,
    "cable.wet_line_density": 0.5, "winch": {"law": "constant", "length": 100.0}, "control.law": {"kind": "none"},
    "rope": {
        "elements": 4,
    },
    "cable.axial_stiffness": 1e6, "cable.water": {"diameter": 0.03},
    "payload.water": {"quadratic_drag": 400.0, "vertical_drag": 600.0},
    "environment.water": {"current": {"depths": [0.0, 110.0], "speeds": [0.5, 0.5], "speeds_across": [0.3, 0.3]}},
    "environment.vessel_heave": [{"kind": "sine", "amplitude": 2.0, "frequency": 1.2}],
    "initial.shape": "equilibrium",
}  # fmt: skip
"""A vessel heaves more than a light body can follow."""


@pytest.fixture(scope="module")
def slack() -> Run:
    return simulate(load("paper", SLACK))


def shorts(text: str, nodes: int) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), "<i2").reshape(-1, nodes)


def test_a_rope_is_seen_from_two_sides_with_its_tension(slack: Run) -> None:
    text = page.player(slack)
    (reel,), nodes = film(text)["runs"], film(text)["runs"][0]["nodes"]
    time, last = floats(reel["time"]), slack["body_position"].values[-1]
    assert film(text)["views"] == 2
    assert time[-1] == pytest.approx(6.0)
    shown = [shorts(reel[key], nodes)[-1, -1] * reel[step] for key, step in
             (("y", "step"), ("across", "step"), ("z", "depth_step"))]  # fmt: skip
    assert shown == pytest.approx(last.tolist(), abs=1e-2)
    pull = shorts(reel["pull"], nodes) * reel["pull_step"]
    assert pull[:, -1] == pytest.approx(
        np.maximum(slack["tension"].sel(time=time, method="nearest")[:, -1], 0.0), abs=1.0
    )
    assert [panel["title"] for panel in reel["panels"]][:2] == ["ROV position [m]", "tension [N]"]
    assert len(text) < 1_000_000


def test_slack_and_snaps_are_events(slack: Run) -> None:
    assert slack.metrics["snaps"] >= 1
    events = film(page.player(slack))["events"]
    assert {event["text"] for event in events} == {"the cable goes slack", "the cable is taut again: snap"}
    for event in events:
        later = float(slack["slack_length"].sel(time=event["time"], method="nearest"))
        assert (later > 0.0) is event["quiet"]


def test_a_rope_and_a_string_share_a_page(slack: Run, free: Run) -> None:
    assert film(page.player(free))["views"] == 1
    assert film(page.player(free, slack))["views"] == 2


def test_signals_of_two_runs_meet_by_what_they_are(slack: Run, run: Run) -> None:
    found = film(page.player(slack, run))
    rope, string = ([panel["title"] for panel in reel["panels"]] for reel in found["runs"])
    assert found["panels"] == [*rope, *(title for title in string if title not in rope)]
    assert (rope[0], set(string) - set(rope)) == (string[0], {"motor voltage [V]"} - set(rope))


def test_two_runs_of_one_name_are_told_apart(run: Run) -> None:
    reels = film(page.player(run, run))["runs"]
    assert [reel["name"] for reel in reels] == ["paper-stuck", "paper-stuck (2)"]
    assert [reel["status"].split(":")[0] for reel in reels] == [reel["name"] for reel in reels]


def test_a_run_shows_itself_in_a_notebook(run: Run, free: Run) -> None:
    shown = umbilical.show(run, free)
    assert repr(shown).startswith("<plays paper-stuck and crosscheck-none: ")
    frame = shown._repr_html_()
    assert frame.startswith('<iframe sandbox="allow-scripts"')
    found = re.search(r'srcdoc="([^"]*)"', frame)
    assert found
    assert html.unescape(found[1]) == page.player(run, free)


@pytest.mark.slow
@pytest.mark.browser
@pytest.mark.skipif(browser.PROGRAM is None, reason="no Chromium on this machine")
class TestInABrowser:
    @pytest.fixture
    def stored(self, run: Run, free: Run, tmp_path: Path) -> Path:
        path = tmp_path / "run.html"
        path.write_text(page.player(run, free), encoding="utf-8")
        return path

    def test_the_console_is_silent_and_nothing_is_wider_than_a_phone(self, stored: Path) -> None:
        assert browser.console(stored) == []
        assert browser.width(stored, 420) <= 420

    def test_time_advances_and_keys_step(self, stored: Path) -> None:
        """1.5 s between two drawn frames play 1.5 s of the run; End and one step back end one frame before the last."""
        press = 'document.dispatchEvent(new KeyboardEvent("keydown", {key: "%s"}));'
        script = (
            "<script>go(0); set(true); last = 0; tick(1000); tick(2500); const played = time[frame].toFixed(1);"
            f"{press % 'End'}{press % 'ArrowLeft'}"
            "document.title = `played ${played} s, ${frames - 1 - frame} before the end`;</script>"
        )
        stored.write_text(stored.read_text(encoding="utf-8").replace("</body>", f"{script}</body>"), encoding="utf-8")
        assert "<title>played 1.5 s, 1 before the end</title>" in browser.dump(stored)

    def test_a_rope_plays_and_says_that_it_is_slack(self, slack: Run, tmp_path: Path) -> None:
        path = tmp_path / "rope.html"
        path.write_text(page.player(slack), encoding="utf-8")
        assert browser.console(path) == []
        assert browser.width(path, 420) <= 420
        time = float(slack["time"].values[int(np.argmax(slack["slack_length"].values))])
        words = (
            "<script>const said = []; CanvasRenderingContext2D.prototype.fillText = word => said.push(word);"
            "set(false);"
            f"go(0); const before = said.includes('slack'); go([...time].findIndex(v => v >= {time}));"
            "const two = said.includes('y and depth');"
            "document.title = `${before} then ${said.includes('slack')}, ${two}`;"
            "</script>"
        )
        path.write_text(path.read_text(encoding="utf-8").replace("</body>", f"{words}</body>"), encoding="utf-8")
        assert "<title>false then true, true</title>" in browser.dump(path)

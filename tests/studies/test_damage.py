"""Files of a study that were damaged or changed are refused with what is wrong, never believed and never a bug."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray

from tests.support.studies import small_study
from umbilical.errors import FileError, OutputError
from umbilical.formats import to_netcdf
from umbilical.studies.journal import Journal, entries, is_whole_line, to_line
from umbilical.studies.results import is_study_file, open_study
from umbilical.studies.rows import NAMES
from umbilical.studies.store import study_fingerprint
from umbilical.studies.sweep import sweep
from umbilical.studies.tune import tune

STUDY = small_study(members=4)


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("whole") / "out"
    sweep(STUDY, folder)
    return folder


@pytest.fixture
def copy(whole, tmp_path) -> Path:
    return Path(shutil.copytree(whole, tmp_path / "copy"))


def by_polynomial(text: bytes) -> int:
    """CRC-32 of ISO 3309, bit by bit."""
    remainder = 0xFFFFFFFF
    for byte in text:
        remainder ^= byte
        for _ in range(8):
            remainder = remainder >> 1 ^ (0xEDB88320 if remainder & 1 else 0)
    return remainder ^ 0xFFFFFFFF


def test_a_line_carries_a_checksum_of_all_of_it():
    """CRC-32, here by its polynomial: any single bit that flips is noticed."""
    line = to_line([1, [0.5, "a"]])
    assert line == b'%08x [1,[0.5,"a"]]\n' % by_polynomial(b'[1,[0.5,"a"]]')
    assert is_whole_line(line)
    for place in range(8 * len(line)):
        flipped = bytearray(line)
        flipped[place // 8] ^= 1 << place % 8
        assert not is_whole_line(bytes(flipped)), place
    assert not any(is_whole_line(line[:length]) for length in range(len(line)))


def test_a_line_damaged_between_others_is_refused_by_its_number(copy, whole):
    text = (copy / "journal.txt").read_bytes()
    lines = text.splitlines(keepends=True)
    spoilt = bytearray(text)
    spoilt[len(lines[0]) + 20] ^= 1
    (copy / "journal.txt").write_bytes(spoilt)
    with pytest.raises(FileError, match="line 2 is damaged"):
        sweep(STUDY, copy, resume=True)
    assert (copy / "journal.txt").read_bytes() == spoilt, "nothing finished is cut off"
    (copy / "journal.txt").write_bytes(b"".join([lines[0], *lines[2:]]))  # as the text says
    sweep(STUDY, copy, resume=True)
    assert (copy / "study.nc").read_bytes() == (whole / "study.nc").read_bytes()


def test_a_damaged_last_line_is_run_again(copy, whole):
    text = (copy / "journal.txt").read_bytes()
    (copy / "journal.txt").write_bytes(text[:-10] + b"\xff" + text[-9:])
    sweep(STUDY, copy, resume=True)
    assert (copy / "study.nc").read_bytes() == (whole / "study.nc").read_bytes()


CELL = ["COMPLETED", "", 1.0, [0.0] * len(NAMES)]
FOREIGN = {
    "a number": 5,
    "a member there is not": [5, [CELL, CELL]],
    "no member": [0, [CELL, CELL]],
    "a share of a member": [1.5, [CELL, CELL]],
    "an arm too few": [1, [CELL]],
    "no status": [1, [CELL, ["FINE", *CELL[1:]]]],
    "a metric too few": [1, [CELL, [*CELL[:3], [0.0]]]],
    "texts for metrics": [1, [CELL, [*CELL[:3], ["a"] * len(NAMES)]]],
    "no reason": [1, [CELL, ["FAILED", None, *CELL[2:]]]],
    "an object": {"a": 1},
}


@pytest.mark.parametrize("entry", FOREIGN)
def test_a_line_that_is_no_row_of_the_study_is_refused(copy, entry):
    written = Journal(copy / "journal.txt")
    written.append(FOREIGN[entry])
    written.close()
    with pytest.raises(FileError, match="no row of this study; begin anew with --force"):
        sweep(STUDY, copy, resume=True)
    sweep(STUDY, copy, force=True)


def test_a_line_that_is_no_json_is_refused(tmp_path):
    from zlib import crc32

    for text in (b"[1,", b"\xff", b"[" * 100_000):
        (tmp_path / "j").write_bytes(b"%08x %s\n" % (crc32(text), text))
        with pytest.raises(FileError, match="line 1 is not what Umbilical writes"):
            list(entries(tmp_path / "j"))


@pytest.mark.parametrize(
    "line", [[[0.5], [1.0], [0.0]], [[0.5, 0.5], [1.0], [0.0, 0.0]], 5, [["a"], [1.0], [0.0, 0.0]]]
)
def test_a_search_refuses_a_line_that_is_no_trial_of_it(tmp_path, line):
    gains = [{"key": "control.law.position_gain", "low": 1.0, "high": 2.0}]
    tuning = {"arm": "PD", "gains": gains, "objectives": [{"metric": "tip_peak"}], "trials": 1}
    study = small_study(members=1, tuning=tuning)
    tune(study, tmp_path / "out")
    (tmp_path / "out" / "journal.txt").write_bytes(to_line(line))
    with pytest.raises(FileError, match="no trial of this study"):
        tune(study, tmp_path / "out", resume=True)


WORDS = {
    "task": "another task",
    "study_hash": "another study",
    "version": "another version",
    "kernels": "other kernels",
    "metrics": "other metrics",
}


@pytest.mark.parametrize("key", WORDS)
def test_parts_that_would_not_fit_are_not_mixed(copy, key):
    """Each key of the fingerprint alone is enough, the kernels too; the file is left as it is."""
    manifest = json.loads((copy / "manifest.json").read_text())
    assert {name: manifest[name] for name in WORDS} == study_fingerprint(STUDY, "sweep")
    (copy / "manifest.json").write_text(json.dumps({**manifest, key: "other"}))
    before = (copy / "journal.txt").read_bytes()
    with pytest.raises(FileError, match=f"begun with {WORDS[key]}"):
        sweep(STUDY, copy, resume=True)
    assert (copy / "journal.txt").read_bytes() == before


def test_the_fingerprint_knows_the_kernels_by_their_sources(monkeypatch):
    from umbilical import compile as compiling

    before = study_fingerprint(STUDY, "sweep")
    assert before["kernels"] == compiling.cache_folder().name
    monkeypatch.setattr(compiling, "cache_folder", lambda: Path("/elsewhere/0123"))
    assert study_fingerprint(STUDY, "sweep") == {**before, "kernels": "0123"}


@pytest.mark.parametrize("text", ["", "{", "[]", "5", '{"task": "sweep"}', "\xff", "[" * 100_000])
def test_a_damaged_manifest_is_named(copy, text):
    (copy / "manifest.json").write_text(text, encoding="latin-1")
    with pytest.raises(FileError, match="is damaged, or no manifest of a study"):
        sweep(STUDY, copy, resume=True)
    with pytest.raises(OutputError, match="and no study"):
        sweep(STUDY, copy, force=True)
    assert (copy / "study.nc").exists()


Change = Callable[[xarray.Dataset], xarray.Dataset]
CHANGED: dict[str, tuple[Change, str]] = {
    "study 5": (lambda d: d.assign_attrs(study=5), "study = 5: must be a text"),
    "study gone": (lambda d: _without(d, "study"), "study: is missing"),
    "study an array": (lambda d: d.assign_attrs(study=np.arange(3.0)), "study = .*: must be a text"),
    "study no TOML": (lambda d: d.assign_attrs(study="[["), "not TOML"),
    "another study": (lambda d: d.assign_attrs(study=small_study(members=5).to_toml()), "member: must run from 1 to 5"),
    "another arm": (lambda d: d.assign_coords(arm=["a", "b"]), "arm: must be those of the study"),
    "kind an array": (lambda d: d.assign_attrs(kind=np.arange(3)), "of a something else, not of a study"),
    "kind gone": (lambda d: _without(d, "kind"), "of a run, not of a study"),
    "no status": (lambda d: d.drop_vars("status"), "status: was taken out"),
    "no reason": (lambda d: d.drop_vars("reason"), "reason: was taken out"),
    "no end": (lambda d: d.drop_vars("end_time"), "end_time: was taken out"),
    "no draw": (lambda d: d.drop_vars("payload.mass"), "payload.mass: was taken out"),
    "no arms": (lambda d: d.drop_vars("arm"), "arm: was taken out"),
    "cut": (lambda d: d.isel(member=slice(0, 2)), "member: has 2 places"),
    "one arm": (lambda d: d.isel(arm=0), "arm: the dimension is gone"),
    "status 9": (lambda d: d.assign(status=d["status"] + 9), "status: must be from 0 to"),
    "status -1": (lambda d: d.assign(status=d["status"] - 1), "status: must be from 0 to"),
    "status a float": (lambda d: d.assign(status=d["status"] * 0.5), "status: holds float64"),
    "a metric of texts": (lambda d: d.assign(tip_peak=d["reason"]), "tip_peak: holds"),
    "a metric of one member": (lambda d: d.assign(tip_peak=d["tip_peak"][0]), "tip_peak: is over"),
}


def _without(data: xarray.Dataset, name: str) -> xarray.Dataset:
    data = data.copy()
    del data.attrs[name]
    return data


@pytest.mark.parametrize("change", CHANGED)
def test_a_changed_result_is_refused_with_what_is_wrong(whole, tmp_path, change):
    alter, wrong = CHANGED[change]
    with xarray.open_dataset(whole / "study.nc", engine="h5netcdf") as data:
        (tmp_path / "a.nc").write_bytes(to_netcdf(alter(data.load())))
    with pytest.raises(FileError, match=wrong):
        open_study(tmp_path / "a.nc")
    assert is_study_file(tmp_path / "a.nc") == (not change.startswith("kind"))


def test_a_result_without_one_of_its_metrics_is_named(whole, tmp_path):
    with xarray.open_dataset(whole / "study.nc", engine="h5netcdf") as data:
        (tmp_path / "a.nc").write_bytes(to_netcdf(data.load().drop_vars("tip_peak")))
    with pytest.raises(FileError, match="tip_peak: was taken out"):
        open_study(tmp_path / "a.nc")

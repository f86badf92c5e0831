"""Files of other programs: what a spreadsheet writes is read, and what is doubtful is refused by line and name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray

from umbilical.columns import ColumnChoice, Columns, Series, factor, read_columns, series_of
from umbilical.errors import FileError, Problem


def columns(text: str | bytes) -> Columns:
    return read_columns(Path("file.csv"), text.encode() if isinstance(text, str) else text)


def series(text: str | bytes, **options: object) -> Series:
    found = series_of(columns(text), ColumnChoice(**options), "here.file")  # type: ignore[arg-type]
    assert isinstance(found, Series), found
    return found


def problem(text: str | bytes, **options: object) -> Problem:
    found = series_of(columns(text), ColumnChoice(**options), "here.file")  # type: ignore[arg-type]
    assert isinstance(found, list)
    return found[0]


def record(times: np.ndarray, values: np.ndarray) -> str:
    return "t [s],y [m]\n" + "".join(f"{t!r},{y!r}\n" for t, y in zip(times.tolist(), values.tolist(), strict=True))


SPREADSHEETS = {
    "decimal commas": b"t [s];y [mm]\n0,0;1000,5\n0,1;2000\n",
    "byte-order mark": "\ufefft [s];y [mm]\n0,0;1000,5\n0,1;2000\n".encode(),
    "UTF-16 and tabulators": "t (s)\ty (mm)\n0,0\t1000,5\n0,1\t2000\n".encode("utf-16"),
    "Western code page": "t [s];Länge [mm]\n0,0;1000,5\n0,1;2000\n".encode("cp1252"),
    "sep line, quotes, empty rows": b'sep=;\r\n"t [s]";"y [mm]"\r\n0,0;"1000,5"\r\n;\r\n0,1;2000\r\n;\r\n',
    "points and commas": b"t [s],y [mm]\n0.0,1000.5\n0.1,2000\n",
    "a line of units": b"t;y\ns;mm\n0,0;1000,5\n0,1;2000\n",
    "our own export": b"# a run\n# s,mm\nt,y\n0,1000.5\n0.1,2000\n",
    "spaces": b"t[s] y[mm]\n0.0   1000.5\n0.1  2e3\n",
    "dates": b"t,y [mm]\n2026-03-01T12:00:00,1000.5\n2026-03-01T12:00:00.1,2000\n",
    "days first": b"t;y [mm]\n01.03.2026 9:00;1000,5\n01.03.2026 09:00:00,1;2000\n",
    "words beside": "t [s];y [mm];Wetter\n0,0;1000,5;mäßig\n0,1;2000;\n".encode("cp1252"),
    "seconds since 1970": b"t [s],y [mm]\n1772366400,1000.5\n1772366400.1,2000\n",
}


@pytest.mark.parametrize("name", SPREADSHEETS)
def test_what_spreadsheets_and_loggers_write_is_read(name: str) -> None:
    found = series(SPREADSHEETS[name])
    assert found.values == pytest.approx([1.0005, 2.0])
    assert found.points == pytest.approx([0.0, 0.1], abs=1e-6)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"0,1\n1,2\n", "names no column"),
        (b"t [s],y [m]\n", "no rows"),
        (b"", "no rows"),
        (b"t [s],y [m]\n0,1\n1,2,3\n", "line 3 has 3 cells"),
        (b"t [s];y [m]\n0,5;1,2\n0,6;1.234\n", "decimal commas"),
        (b"t [s],y [m]\n0,1\n1,two\n", "line 3, y: 'two'"),
        (b"t,y [m]\n11/28/2026 10:00,1\n", "2026-03-01T12:00"),
        (b"t,y [m]\n31.11.2026 10:00,1\n", "2026-03-01T12:00"),
        (b"t [s],y [m],note\n0,1,calm\n1,2\n", "line 3 has 2 cells"),
        (b"a [s],a [m]\n0,1\n1,2\n", "two columns"),
        (b"PK\x03\x04\x00\x00", "can save it as CSV"),
        (b"\x89HDF\r\n\x1a\nbroken", "damaged"),
    ],
)
def test_what_cannot_be_read_is_refused(content: bytes, words: str) -> None:
    with pytest.raises(FileError, match=words):
        columns(content)


EVEN = np.arange(100) * 0.1


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        ("t [s],y\n0,1\n1,2\n", "unit", "y [m]"),
        ("t [s],y [kg]\n0,1\n1,2\n", "unit", "kg"),
        ("t,y [m]\n0,1\n1,2\n", "across_unit", "t [s]"),
        ("t [s],y [m],z [m]\n0,1,1\n1,2,1\n", "value", "y, z"),
        ("t [s],roll [deg],z [m]\n0,1,1\n1,2,1\n", "value", 'value = "z" }'),
        ("t [s],y [m]\n0,1\n2,2\n1,3\n", "name", "line 4: 1 follows a later one"),
        ("t [s],y [m]\n0,1\n1,2\n1,2\n", "name", "line 4: 1 stands twice"),
        ("t [s],y [m]\n0,1\n1,\n2,3\n", "blanks", "line 3"),
        ("t [s],y [m]\n0,1\n1,NaN\n2,3\n", "blanks", "line 3"),
        (record(EVEN, np.where(EVEN == 1.0, 999.0, np.sin(EVEN))), "fill", "999 in y, first in line 12"),
        (record(EVEN, np.where(EVEN == 1.0, -99.0, np.sin(EVEN))), "fill", "-99"),
        (record(np.delete(EVEN, slice(10, 20)), np.zeros(90)), "name", "the first of 1.1 s after line 11"),
    ],
)
def test_what_is_doubtful_is_asked(text: str, key: str, words: str) -> None:
    found = problem(text)
    assert found.key == f"here.file.{key}"
    assert words in str(found)


def test_99_among_its_like_is_a_value() -> None:
    assert series(record(EVEN, np.linspace(90.0, 110.0, 100).round(0))).values.max() == 110.0


def test_declared_marks_are_left_out_where_the_gap_is_short() -> None:
    text = record(EVEN, np.where(EVEN == 1.0, 999.0, np.sin(EVEN)))
    assert series(text, fill=(999.0,)).points.size == 99
    blank = "t [s],y [m]\n" + "".join(f"{t:g},{'' if k == 10 else 1}\n" for k, t in enumerate(EVEN))
    assert series(blank, blanks=True).points.size == 99
    marks = np.where((EVEN > 1.0) & (EVEN < 2.5), 999.0, np.sin(EVEN))
    assert "gaps" in str(problem(record(EVEN, marks), fill=(999.0,)))


def test_a_record_without_a_period_has_no_gaps() -> None:
    assert series(record(np.geomspace(1.0, 100.0, 40), np.zeros(40))).points.size == 40


@pytest.mark.parametrize("noise", [0.02, 0.1])
def test_declared_noise_is_taken_off_and_no_more(noise: float) -> None:
    time = np.arange(0.0, 60.0, 0.1)
    wave = 0.8 * np.sin(0.7 * time) + 0.3 * np.sin(1.3 * time + 1.0)
    measured = wave + noise * np.random.default_rng(4).standard_normal(time.size)
    found = series(record(time, measured), noise=noise).values
    assert np.sqrt(np.mean((found - measured) ** 2)) == pytest.approx(noise, rel=0.01)
    assert np.sqrt(np.mean((found - wave) ** 2)) < 0.6 * noise
    curvature = [np.std(np.diff(values, 2)) / 0.1**2 for values in (wave, found, measured)]
    assert curvature[1] < 2.0 * curvature[0] < curvature[2]


def test_noise_as_large_as_the_motion_is_refused() -> None:
    assert problem(record(EVEN, np.sin(EVEN)), noise=5.0).key == "here.file.noise"
    assert "straight line" in str(problem(record(EVEN[:4], np.sin(EVEN[:4])), noise=0.01))


def test_drift_is_taken_off_without_a_shift_of_phase() -> None:
    time = np.arange(0.0, 1200.0, 0.2)
    wave = np.sin(0.8 * time)
    drifting = record(time, wave + 3.0 + 4.0 * np.sin(2.0 * np.pi * time / 900.0))
    found = series(drifting, drift="highpass(60)").values
    inside = (time > 120.0) & (time < 1080.0)
    assert abs(found - wave)[inside].max() < 0.03
    assert found[0] == found[-1] == 0.0
    assert abs(np.mean(series(record(time, wave + 3.0), drift="mean").values)) < 1e-2
    assert "quarter" in str(problem(record(time, wave), drift="highpass(600)"))


def test_a_start_of_choice() -> None:
    assert series("t [s],y [m]\n0,1\n5,2\n9,3\n", start=5.0).points.tolist() == [-5.0, 0.0, 4.0]


def test_netcdf_with_units_and_dates(tmp_path: Path) -> None:
    data = xarray.Dataset(
        {"sway": ("time", np.array([1.0, 2.0, 4.0]), {"units": "cm"}), "other": ("x", np.zeros(2))},
        {"time": ("time", np.array([10.0, 11.0, 12.0]), {"units": "seconds since 2026-01-01"})},
    )
    data.to_netcdf(tmp_path / "a.nc", engine="h5netcdf")
    found = series_of(read_columns(tmp_path / "a.nc"), ColumnChoice(value="sway"), "k")
    assert isinstance(found, Series)
    assert (found.points.tolist(), found.values.tolist()) == ([0.0, 1.0, 2.0], [0.01, 0.02, 0.04])


def test_units_of_another_kind_have_no_factor() -> None:
    assert factor("Hz", "rad/s") == pytest.approx(2.0 * np.pi)
    assert factor("m", "s") is None

"""Weather windows: shares and persistence, and what files of seas are read and refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from umbilical import load_operation
from umbilical.cli import main
from umbilical.errors import FileError, ScenarioError
from umbilical.screening import Seas, read_seas, weather
from umbilical.screening.criteria import parse_criterion

SLACK = [parse_criterion("slack=1e-2/3h")]
AXES: Any = {"depth": np.array([500.0, 1500.0]), "heading": np.radians([135.0, 180.0])}
HOUR = 3600.0


def hindcast(height: list[float], time: list[float], needed: float = 2.0) -> Any:
    period = np.full(len(height), 8.0)
    seas = Seas(np.array(height), period, np.ones(len(height)) / len(height), np.array(time) * HOUR)
    return weather(load_operation("work-class"), SLACK, seas, **AXES, needed=needed * HOUR)


def test_windows_of_a_hindcast() -> None:
    found = hindcast([1.0, 1.0, 1.0, 5.0, 5.0, 1.0, 5.0, 1.0], list(range(8)))
    assert (found.windows / HOUR).tolist() == [3.0, 1.0, 1.0]
    assert found.share == pytest.approx(5.0 / 8.0)
    assert found.window_share == pytest.approx(1.0 / 6.0)  # one hour of the first six in which two hours can begin
    assert "1 windows of 3, the longest 3 h" in found.summary()


def test_a_gap_ends_a_window() -> None:
    found = hindcast([1.0] * 8, [0.0, 1.0, 2.0, 3.0, 20.0, 21.0, 22.0, 23.0])
    assert (found.windows / HOUR).tolist() == [4.0, 4.0]
    assert hindcast([1.0] * 4, [0.0, 1.0, 2.0, 3.0]).windows.tolist() == [4.0 * HOUR]
    assert hindcast([5.0] * 4, [0.0, 1.0, 2.0, 3.0]).windows.size == 0


def test_the_share_is_that_of_limits_at_each_period() -> None:
    seas = Seas(np.array([1.0, 2.0, 1.0]), np.array([8.0, 16.0, 7.0]), np.array([0.2, 0.3, 0.5]), None)
    found = weather(load_operation("work-class"), SLACK, seas, **AXES)
    worst = found.found.limit.min(axis=(0, 2))
    assert found.limit == pytest.approx(np.interp(seas.period, found.found.period, worst))
    assert found.share == pytest.approx(seas.weight[seas.height <= found.limit].sum())


def test_a_scatter_table_and_a_hindcast_of_spreadsheets(tmp_path: Path) -> None:
    (tmp_path / "scatter.csv").write_text("Hs [m];Tz [s];count\n0,5;5,0;30\n1,5;6,0;60\n2,5;7,0;10\n")
    found = read_seas(tmp_path / "scatter.csv")
    assert found.weight.tolist() == pytest.approx([0.3, 0.6, 0.1])
    assert found.period[0] == pytest.approx(5.0 / 0.777399208, rel=1e-8)
    assert found.time is None
    (tmp_path / "hindcast.csv").write_text("time,hs [m],tp [s]\n2026-01-01T00:00,1,8\n2026-01-01T03:00,2,9\n")
    found = read_seas(tmp_path / "hindcast.csv")
    assert found.time is not None
    assert found.time.tolist() == [0.0, 3.0 * HOUR]
    german = "Datum;Hs [m];Tp [s];Wetter\r\n31.12.2025 21:00;1,0;8,5;Böen\r\n01.01.2026 00:00;2,5;9,0;\r\n"
    (tmp_path / "hindcast.csv").write_bytes(german.encode("cp1252"))
    found = read_seas(tmp_path / "hindcast.csv")
    assert found.time is not None
    assert (found.height.tolist(), found.time.tolist()) == ([1.0, 2.5], [0.0, 3.0 * HOUR])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Hs [m],Tp [s]\n1,8\n2,9\n", "how often"),
        ("Hs [m],count\n1,8\n2,9\n", "period"),
        ("Hs,Tp [s],count\n1,8,1\n2,9,2\n", "unit"),
        ("Hs [m],Tp [s],count\n99,8,1\n2,9,2\n", "missing value"),
        ("Hs [m],Tp [s],count\n1,8,-1\n2,9,2\n", "0 or more"),
        ("time [h],Hs [m],Tp [s]\n1,1,8\n0,2,9\n", "increasing"),
    ],
)
def test_what_is_no_sea_is_refused(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "seas.csv").write_text(text)
    with pytest.raises(ScenarioError, match=words):
        read_seas(tmp_path / "seas.csv")


def test_spectra_of_wavespectra(tmp_path: Path) -> None:
    pytest.importorskip("wavespectra")
    import xarray
    from wavespectra.construct.frequency import jonswap

    rows = [jonswap(freq=np.linspace(0.03, 0.6, 80), fp=0.1, hs=height, gamma=3.3) for height in (1.0, 2.0)]
    time = np.array(["2026-01-01T00", "2026-01-01T03"], dtype="datetime64[ns]")
    spectra = xarray.concat(rows, "time").assign_coords(time=time)
    spectra.rename("efth").to_dataset().to_netcdf(tmp_path / "buoy.nc", engine="h5netcdf")
    found = read_seas(tmp_path / "buoy.nc")
    assert found.height == pytest.approx([1.0, 2.0], rel=0.01)
    assert found.period == pytest.approx([10.0, 10.0], rel=0.03)  # between its frequencies
    (tmp_path / "broken.nc").write_bytes(b"\x89HDF\r\n\x1a\nno")
    with pytest.raises(FileError, match="damaged"):
        read_seas(tmp_path / "broken.nc")


def three_days() -> Any:
    """Directional spectra of one site every three hours: Hs of 1 to 2 m, Tp 10 s."""
    xarray = pytest.importorskip("xarray")
    construct = pytest.importorskip("wavespectra.construct.frequency")
    directions = np.arange(0.0, 360.0, 30.0)
    spread = xarray.DataArray(np.cos(np.radians(directions - 210.0)).clip(0.0) ** 2, {"dir": directions}, ["dir"])
    rows = [
        construct.jonswap(freq=np.linspace(0.04, 0.5, 47), fp=0.1, hs=height, gamma=3.3) * spread / spread.sum() / 30.0
        for height in HEIGHTS
    ]
    time = np.datetime64("2026-01-01", "ns") + np.arange(HEIGHTS.size) * np.timedelta64(3, "h")
    found = xarray.concat(rows, "time").assign_coords(time=time).expand_dims(site=[0])
    found = found.transpose("time", "site", "freq", "dir").rename("efth").to_dataset()
    return found.assign(lon=("site", [4.0]), lat=("site", [60.0]))


HEIGHTS = np.linspace(1.0, 2.0, 24)


def as_ndbc_text(spectra: Any, path: Path) -> None:
    one = spectra["efth"].isel(site=0).sum("dir") * 30.0
    head = "#YY  MM DD hh mm " + " ".join(f"{frequency:7.4f}" for frequency in one.freq.values)
    stamps = [str(t)[:16].replace("-", " ").replace("T", " ").replace(":", " ") for t in one.time.values]
    rows = [f"{t} " + " ".join(f"{value:8.4f}" for value in row) for t, row in zip(stamps, one.values, strict=True)]
    path.write_text("\n".join([head, *rows]) + "\n")


def as_ndbc_netcdf(spectra: Any, path: Path) -> None:
    one = (spectra["efth"].isel(site=0, drop=True).sum("dir") * 30.0).rename("spectral_wave_density")
    one = one.expand_dims(latitude=[60.0], longitude=[4.0]).transpose("time", "freq", "latitude", "longitude")
    one.rename(freq="frequency").to_dataset().to_netcdf(path, engine="scipy")


def as_swan_netcdf(spectra: Any, path: Path) -> None:
    density = spectra["efth"].rename("density").rename(site="points", freq="frequency", dir="direction")
    density = (density * 180.0 / np.pi).assign_coords(direction=np.radians(density["direction"]))
    density.to_dataset().to_netcdf(path, engine="h5netcdf")


WRITERS: dict[str, Any] = {
    "wavespectra.nc": lambda spectra, path: spectra.spec.to_netcdf(path),
    "classic.nc": lambda spectra, path: spectra.to_netcdf(path, engine="scipy"),
    "ww3.nc": lambda spectra, path: spectra.spec.to_ww3(path),
    "swan.spec": lambda spectra, path: spectra.spec.to_swan(path),
    "octopus.oct": lambda spectra, path: spectra.spec.to_octopus(str(path)),
    "spectra.json": lambda spectra, path: spectra.spec.to_json(path),
    "44025.txt": as_ndbc_text, "ndbc.nc": as_ndbc_netcdf, "swan.nc": as_swan_netcdf,
}  # fmt: skip


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if name[-3:] != ".nc" else [pytest.mark.slow]) for name in WRITERS]
)
def test_spectra_of_buoys_and_models(name: str, tmp_path: Path) -> None:
    WRITERS[name](three_days(), tmp_path / name)
    found = read_seas(tmp_path / name)
    assert found.height == pytest.approx(HEIGHTS, rel=0.01)
    assert found.period == pytest.approx(np.full(HEIGHTS.size, 10.0), rel=0.02)
    assert found.time == pytest.approx(3.0 * 3600.0 * np.arange(HEIGHTS.size))


def test_spectra_of_two_sites_say_which_can_be_read(tmp_path: Path) -> None:
    both = three_days().isel(site=[0, 0])
    both.to_netcdf(tmp_path / "two.nc", engine="scipy")
    with pytest.raises(FileError, match="site 2"):
        read_seas(tmp_path / "two.nc")
    (tmp_path / "cut.json").write_text('{"coords": ')
    with pytest.raises(FileError, match="cannot read it as json"):
        read_seas(tmp_path / "cut.json")


def test_the_command_says_and_draws_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = "".join(f"{3 * k};{1 + (k % 9) / 3:.2f};{7 + k % 5}\n".replace(".", ",") for k in range(60))
    (tmp_path / "place.csv").write_text(f"time [h];Hs [m];Tp [s]\n{rows}")
    line = ["operate", "work-class", "--depth", "1500", "--heading", "135", "--seas", str(tmp_path / "place.csv")]
    assert main([*line, "--needed", "6", "--plot", str(tmp_path / "w.png"), "--out", str(tmp_path / "w.nc")]) == 0
    assert "of the sea states are workable" in capsys.readouterr().out.splitlines()[0]
    assert (tmp_path / "w.png").stat().st_size > 1000
    assert main([*line, "--height", "2"]) == 2

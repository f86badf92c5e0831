"""Result files: what goes in comes out, the bytes are reproducible, and bad files are told apart."""

from __future__ import annotations

import gc
import io
import platform
import re
import time
from contextlib import suppress
from datetime import datetime

import numpy as np
import pytest
import xarray

from umbilical.errors import FileError, OutputError
from umbilical.formats import from_netcdf
from umbilical.run import Status
from umbilical.stored_runs import open_run, scenario_text


@pytest.fixture
def stored(run, tmp_path):
    return run.save(tmp_path / "small.nc")


def test_what_was_saved_is_opened(run, stored):
    again = open_run(stored)
    assert again.data.identical(run.data)
    assert list(again.data.variables) == list(run.data.variables)
    assert again.scenario == run.scenario
    assert again.metrics == run.metrics
    assert again.notices == run.notices
    assert again.status is Status.COMPLETED
    assert again.timing == {}


@pytest.mark.parametrize("motors", [0, 1])
def test_no_dimension_is_dropped_on_the_way(make_run, tmp_path, motors):
    run = make_run(motors=motors)
    assert open_run(run.save(tmp_path / "a.nc")).data.identical(run.data)


def test_not_a_number_and_infinity_survive(make_run, tmp_path):
    run = make_run(
        status=Status.DIVERGED, time=np.linspace(0.0, 0.9, 21), metrics={"tip_peak": np.inf, "tip_rms": np.nan}
    )
    assert open_run(run.save(tmp_path / "a.nc")).data.identical(run.data)


def test_xarray_alone_reads_it(run, stored):
    with xarray.open_dataset(stored, engine="h5netcdf") as data:
        assert data.identical(run.data)


def test_the_same_run_gives_the_same_bytes_at_another_time(make_run, tmp_path):
    first = make_run(timing={"simulate_s": 0.5}).save(tmp_path / "a.nc").read_bytes()
    time.sleep(1.1)  # formats that store the clock store whole seconds
    second = make_run(timing={"simulate_s": 0.7}).save(tmp_path / "b.nc").read_bytes()
    assert first == second


def test_opened_and_saved_again_gives_the_same_bytes(stored, tmp_path):
    assert open_run(stored).save(tmp_path / "again.nc").read_bytes() == stored.read_bytes()


def test_one_changed_number_changes_the_bytes(make_run, tmp_path):
    files = [make_run(end_time=end).save(tmp_path / f"{end}.nc").read_bytes() for end in (1.0, 0.95)]
    assert files[0] != files[1]


def test_neither_host_nor_path_nor_date_is_inside(stored, tmp_path):
    content = stored.read_bytes()
    for secret in (platform.node(), str(tmp_path), datetime.now().strftime("%Y-%m-%d")):
        assert secret.encode() not in content


def test_a_scenario_longer_than_an_hdf5_attribute_may_be_is_stored(run, tmp_path):
    run.data.attrs["scenario"] += "# a long table\n" * 20_000
    stored = run.save(tmp_path / "long.nc")
    assert len(scenario_text(stored)) > 200_000


def test_the_scenario_can_be_read_alone(run, stored):
    assert scenario_text(stored) == run.scenario.to_toml()


def test_never_overwrites_unasked(run, make_run, stored):
    before = stored.read_bytes()
    with pytest.raises(OutputError, match="exists already"):
        make_run(status=Status.DIVERGED, time=np.linspace(0.0, 0.475, 21), end_time=0.5).save(stored)
    assert stored.read_bytes() == before
    make_run(status=Status.DIVERGED, time=np.linspace(0.0, 0.475, 21), end_time=0.5).save(stored, force=True)
    assert open_run(stored).end_time == 0.5


def test_truncated_anywhere_it_is_refused_with_its_name(stored, tmp_path):
    content, cut = stored.read_bytes(), tmp_path / "cut.nc"
    rng = np.random.default_rng(3)
    lengths = {0, 1, 7, 8, 9, 48, 96, 512, *rng.integers(0, len(content), 60), *range(len(content) - 9, len(content))}
    for length in sorted(lengths):
        cut.write_bytes(content[:length])
        with pytest.raises(FileError, match=r"cut\.nc: .*(cut short|not a NetCDF4 file)"):
            open_run(cut)


def _netcdf(data: xarray.Dataset) -> bytes:
    return bytes(data.to_netcdf(None, engine="h5netcdf"))


def _altered(run, **attributes) -> bytes:
    return _netcdf(run.data.assign_attrs(attributes))


def test_damaged_attributes_leave_no_half_open_file_behind(stored):
    """What h5netcdf could not open complains on stderr when it is forgotten; pytest makes an error of that."""
    content, generator = stored.read_bytes(), np.random.default_rng(1)
    for _ in range(100):
        spoilt = bytearray(content)
        for place in generator.integers(0, len(content), 4):
            spoilt[place] = generator.integers(0, 256)
        with suppress(FileError):
            from_netcdf(bytes(spoilt), "spoilt.nc")
    gc.collect()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda run: b"", "not a NetCDF4 file .it is empty."),
        (lambda run: b"time,tip\n0,1\n" * 100, "not a NetCDF4 file"),
        (lambda run: "name = 'x'".encode("utf-16"), "not a NetCDF4 file"),
        (lambda run: b"\x89HDF\r\n\x1a\n" + b"\xff" * 5000, "damaged or cut short"),
        (lambda run: _netcdf(xarray.Dataset({"a": 1})), "not a result written by Umbilical"),
        (lambda run: _altered(run, result_schema=999), "result layout 999"),
        (lambda run: _altered(run, scenario="nonsense"), "the scenario inside: this is not TOML"),
        (lambda run: _altered(run, scenario="name = 'x'"), r"the scenario inside: \d+ problems(.|\n)*refuses it"),
    ],
)
def test_other_files_are_told_apart(run, tmp_path, make, message):
    path = tmp_path / "other.nc"
    path.write_bytes(make(run))
    with pytest.raises(FileError, match=rf"other\.nc: .*{message}"):
        open_run(path)


def test_missing_and_folder(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        open_run(tmp_path / "missing.nc")
    (tmp_path / "folder").mkdir()
    with pytest.raises(FileError, match=r"folder: (this is a folder|cannot be read)"):
        open_run(tmp_path / "folder")


def test_csv_holds_every_time_series_exactly(run, tmp_path):
    lines = run.export(tmp_path / "a.csv", "csv").read_text().splitlines()
    assert lines[0] == f"# Umbilical run of small, scenario {run.scenario.hash}"
    assert lines[1] == "# s,m,rad/s,rad/s,,,"
    assert lines[2] == "time,tip_displacement,motor_speed_1,motor_speed_2,kappa_0,kappa_1,kappa_2"
    table = np.loadtxt(io.StringIO("\n".join(lines[3:])), delimiter=",")
    parts = (run["time"], run["tip_displacement"], run["motor_speed"], run["kappa"])
    assert np.array_equal(table, np.column_stack([part.values for part in parts]))


def test_mat_holds_every_array_exactly(run, tmp_path):
    from scipy.io import loadmat

    content = loadmat(run.export(tmp_path / "a.mat", "mat"), simplify_cells=True)
    for name, array in run.data.variables.items():
        assert np.array_equal(content[name], array.values), name
    assert content["units"]["metric_tip_peak"] == "m"
    assert content["scenario"] == run.scenario.to_toml()


@pytest.mark.parametrize("to", ["csv", "mat"])
def test_exports_have_no_clock_and_never_overwrite_unasked(run, tmp_path, to):
    first = run.export(tmp_path / "a", to).read_bytes()
    time.sleep(1.1)
    with pytest.raises(OutputError, match="exists already"):
        run.export(tmp_path / "a", to)
    assert run.export(tmp_path / "a", to, force=True).read_bytes() == first


def test_an_unknown_format_is_refused(run, tmp_path):
    with pytest.raises(OutputError, match="no format 'xlsx'; there are csv, mat"):
        run.export(tmp_path / "a.xlsx", "xlsx")


ATTRIBUTES = ("title", "convention", "scenario", "scenario_hash", "seed", "status", "reason", "end_time", "notices")


@pytest.mark.parametrize("name", [*ATTRIBUTES, "contents", "result_schema", "version_numpy"])
@pytest.mark.parametrize("value", [None, 5.5, "[" * 5000, np.array([1, 2])], ids=["none", "5.5", "[", "array"])
def test_a_changed_attribute_is_named(run, tmp_path, name, value):
    path = tmp_path / "changed.nc"
    attributes = {key: item for key, item in run.data.attrs.items() if key != name or value is not None}
    data = run.data.copy()
    data.attrs = attributes if value is None else attributes | {name: value}
    path.write_bytes(_netcdf(data))
    free = name in ("title", "convention", "scenario_hash", "reason", "version_numpy")
    if free and isinstance(value, str):
        assert open_run(path).data.attrs[name] == value
    else:
        with pytest.raises(FileError, match=re.escape(f"{path}: ")):
            open_run(path)


@pytest.mark.parametrize("name", ["displacement", "tip_displacement", "metric_tip_peak", "time", "sigma", "motor"])
def test_what_was_taken_out_is_named(run, tmp_path, name):
    path = tmp_path / "less.nc"
    path.write_bytes(_netcdf(run.data.drop_vars(name)))
    with pytest.raises(FileError, match=rf"less\.nc: (.|\n)*{name}: was taken out"):
        open_run(path)


def _scaled(data, name, factor):
    return data.assign({name: data[name].copy(data=data[name].values * factor)})


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda data: data.isel(motor=[0]), "motor: has 1 places, and had 2"),
        (lambda data: data.isel(sigma=slice(3)), "sigma: has 3 places, and had 9"),
        (lambda data: data.isel(time=4), "time: the dimension is gone"),
        (lambda data: data.isel(time=[4, 3]), "time: must be finite and increase"),
        (lambda data: data.assign(displacement=data["displacement"].T), r"displacement: is over \(sigma, time\)"),
        (lambda data: data.assign(kappa=data["kappa"].astype(str)), "kappa: holds"),
        (lambda data: data.assign_coords(sigma=data["sigma"] * np.nan), "sigma: must be finite and increase"),
        (lambda data: data.assign_coords(time=2.0 * data["time"]), "time: goes on to 2 s, and end_time is 1 s"),
        (lambda data: data.assign_attrs(end_time=0.5), "end_time = 0.5: COMPLETED, and the scenario inside lasts 1 s"),
        (lambda data: data.assign_attrs(end_time=2.0, status="DIVERGED"), "end_time = 2: DIVERGED, and the scenario"),
        (lambda data: _scaled(data, "tip_displacement", 2.0), "tip_displacement: reaches 1.9.*, and tip_peak is 1.25"),
        (lambda data: _scaled(data, "tip_displacement", np.nan), "tip_displacement: reaches nan, and tip_peak"),
        (lambda data: _scaled(data, "displacement", 1e300), "displacement: reaches .*300, which no completed run does"),
        (lambda data: _scaled(data, "kappa", np.inf), "kappa: reaches inf, which"),
        (lambda data: _scaled(data, "metric_effort_rms", np.nan), "metric_effort_rms: reaches nan, which"),
        (lambda data: data.assign(tip_displacement=data["tip_displacement"].assign_attrs(units=5)), "units must be"),
    ],
)
def test_arrays_that_are_not_those_of_a_run_are_named(run, tmp_path, change, words):
    path = tmp_path / "other.nc"
    path.write_bytes(_netcdf(change(run.data)))
    with pytest.raises(FileError, match=rf"other\.nc: (.|\n)*{words}"):
        open_run(path)


def test_a_scenario_that_is_not_the_one_that_was_simulated_is_told(run, tmp_path):
    path = tmp_path / "other.nc"
    path.write_bytes(_netcdf(run.data.assign_attrs(scenario_hash="0" * 64)))
    assert f"is {run.scenario.hash[:12]} and the run was of 000000000000" in open_run(path).notices[-1]


def test_metrics_of_a_part_are_marked_as_those_of_the_whole_run(run, tmp_path):
    path = tmp_path / "part.nc"
    path.write_bytes(_netcdf(run.data.isel(time=slice(0, 5))))
    part = open_run(path)
    note = "5 of 21 samples are left; the metrics are those of the whole run"
    assert part.notices == (*run.notices, note)
    assert note in part.summary()
    assert note in part._repr_html_()
    assert open_run(part.save(tmp_path / "again.nc")).notices == part.notices


def test_a_unit_that_is_read_as_a_date_elsewhere_stays_a_number(run, tmp_path):
    path = tmp_path / "dated.nc"
    run.data["time"].attrs["units"] = "seconds since 2000-01-01"
    path.write_bytes(_netcdf(run.data))
    assert open_run(path)["time"].dtype == float


def test_arrays_larger_than_the_machine_are_refused_before_they_are_made(tmp_path):
    import h5netcdf

    path = tmp_path / "bomb.nc"
    with h5netcdf.File(path, "w") as file:
        file.attrs["result_schema"] = 2
        file.dimensions = {"time": 10**7, "sigma": 10**7}
        file.create_variable("displacement", ("time", "sigma"), "f8", chunks=(1000, 1000))
    assert path.stat().st_size < 100_000
    with pytest.raises(FileError, match="its arrays take 800000 GB"):
        open_run(path)


def test_a_diverged_run_does_not_go_on_to_its_end(make_run, tmp_path):
    make_run(status=Status.DIVERGED).save(path := tmp_path / "said.nc")
    with pytest.raises(FileError, match="a diverged run has none"):
        open_run(path)

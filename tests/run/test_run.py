"""What a run holds and says of itself."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from umbilical.coordinates import SECOND_DIMENSION
from umbilical.quantities import CHANNELS, METRICS
from umbilical.run import Status


def test_every_array_carries_its_words(run):
    for name in ("displacement", "tip_displacement", "motor_speed", "kappa"):
        word = CHANNELS[name]
        assert run[name].attrs == {"units": word.unit, "long_name": word.meaning, "symbol": word.symbol}
    assert run["metric_tip_peak"].attrs["units"] == METRICS["tip_peak"].unit
    assert all("units" in run.data[name].attrs for name in run.data.variables)


def test_dimensions_and_coordinates(run):
    assert run["displacement"].dims == ("time", "sigma")
    assert run["motor_speed"].dims == ("time", "motor")
    assert run["kappa"].dims == ("time", "kappa_index")
    assert run["tip_displacement"].dims == ("time",)
    assert run["motor"].values.tolist() == [1, 2]
    assert run["kappa_index"].values.tolist() == [0, 1, 2]
    assert run["sigma"].values.tolist() == np.linspace(0, 1, 9).tolist()


def test_the_table_of_dimensions_names_known_channels():
    assert set(SECOND_DIMENSION) <= set(CHANNELS)


@pytest.mark.parametrize("motors", [0, 1, 7])
def test_no_dimension_is_ever_dropped(make_run, motors):
    assert make_run(motors=motors)["motor_speed"].shape == (21, motors)


def test_nodes_may_be_unevenly_spaced(make_run):
    nodes = np.linspace(0, 1, 9) ** 2
    assert make_run(sigma=nodes)["sigma"].values.tolist() == nodes.tolist()


def test_a_channel_without_words_or_of_another_length_is_refused(make_run):
    with pytest.raises(KeyError, match="depth"):
        make_run(metrics={"depth": 1.0})
    with pytest.raises(ValueError, match="time"):
        make_run(time=np.zeros(20))


def test_ending_and_metrics(make_run):
    run = make_run(status=Status.DIVERGED, reason="slope above 1 at sigma = 0.5", end_time=0.25)
    assert (run.status, run.end_time) == (Status.DIVERGED, 0.25)
    assert run.reason == "slope above 1 at sigma = 0.5"
    assert run.metrics == {"tip_peak": 1.25, "effort_rms": 0.1 + 0.2}
    assert run.notices == ("first, with a line\nbreak", "second: \u03b2 = 5 m/s")


def test_exit_codes():
    codes = {status.name: status.exit_code for status in Status}
    assert codes == {"COMPLETED": 0, "DIVERGED": 3, "FAILED": 5, "INTERRUPTED": 130}


def test_the_summary_is_aligned_and_has_every_metric_with_its_unit(make_run):
    lines = make_run(notices=("mind the gap",), reason="time is up").summary().splitlines()
    assert lines[0] == "small: COMPLETED at t = 1 s, time is up"
    assert lines[1].split()[:3] == ["tip_peak", "1.25", "m"]
    assert lines[2].split()[:3] == ["effort_rms", "0.3", "N"]
    assert lines[1].index("largest") == lines[2].index("root mean square")
    assert lines[3] == "  note: mind the gap"


def test_the_summary_shows_no_unit_of_a_pure_number(make_run):
    line = make_run(metrics={"slope_peak": 0.5}).summary().splitlines()[1]
    assert line.split()[:3] == ["slope_peak", "0.5", "largest"]


def test_a_run_shows_itself_in_one_line_and_as_a_table(make_run):
    run = make_run(reason="slope > 1")
    assert repr(run) == "<Run small: COMPLETED at t = 1 s, slope > 1 (time 21, sigma 9, motor 2, kappa_index 3)>"
    page = run._repr_html_()
    assert "slope &gt; 1" in page
    assert page.count("<tr>") == 2


def test_its_attributes_say_where_it_comes_from(run):
    attributes = run.data.attrs
    assert attributes["scenario"] == run.scenario.to_toml()
    assert attributes["scenario_hash"] == run.scenario.hash
    assert attributes["seed"] == 7
    assert attributes["version_numpy"] == np.__version__
    assert "paying out is positive" in attributes["convention"]


def test_a_run_in_words_does_not_load_what_its_arrays_need():
    script = (
        "import sys, umbilical; run = umbilical.simulate(umbilical.load('paper', {'duration': 0.01}))\n"
        "run.summary(); run.metrics; run.notices\n"
        "slow = {'xarray', 'pandas', 'scipy.integrate', 'scipy.optimize', 'scipy.interpolate'}\n"
        "loaded = slow & set(sys.modules)\n"
        "run['time']; print(loaded, 'xarray' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["set()", "True"]

"""Pictures: words and units from the data, nothing drawn that is not there, nothing global touched."""

from __future__ import annotations

import subprocess
import sys
from typing import get_args

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from umbilical import Run, load, plots, simulate
from umbilical.cli.plot import Kind
from umbilical.errors import OutputError
from umbilical.plots.channels import ESTIMATES
from umbilical.plots.figure import at_sigma, draw_channel

SINGLE = {
    "tip": plots.plot_tip,
    "positions": plots.plot_positions,
    "cable": plots.plot_cable,
    "energy": plots.plot_energy,
    "motors": plots.plot_motors,
    "observers": plots.plot_observers,
}


@pytest.fixture(scope="module")
def run() -> Run:
    """Motors, adaptation, a motor that dies at 1 s and recovers at 1.5 s."""
    return simulate(load("paper-dead-adaptive", {"duration": 2.0, "faults.1.start": 1.0, "faults.1.end": 1.5}))


@pytest.fixture(scope="module")
def free() -> Run:
    """No motors, no observers."""
    return simulate(load("crosscheck-none", {"duration": 1.0}))


@pytest.mark.parametrize("name", SINGLE)
def test_a_picture_goes_on_the_axes_given(run, name):
    axes = Figure().add_subplot()
    assert SINGLE[name](run, ax=axes) is axes
    assert axes.has_data()
    assert axes.get_title(loc="left")
    assert axes.get_xlabel() == "time [s]"


@pytest.mark.parametrize("name", plots.PLOTS)
def test_every_picture_makes_its_own_page(run, name):
    drawn = plots.PLOTS[name](run)
    figure = plots.as_figure(drawn)
    panels = [axes for axes in figure.axes if axes.get_title(loc="left")]
    assert isinstance(drawn, Axes | Figure)
    assert panels
    assert all(axes.has_data() for axes in panels)


def test_the_command_line_offers_every_picture():
    assert set(get_args(Kind)) == {*plots.PLOTS, *plots.ROPE_PLOTS, *plots.STUDY_PLOTS}


@pytest.mark.parametrize(
    ("draw", "channel"),
    [(plots.plot_tip, "tip_displacement"), (plots.plot_energy, "energy"), (plots.plot_motors, "motor_speed")],
)
def test_labels_come_from_the_data(run, draw, channel):
    words = run[channel].attrs
    axes = draw(run)
    assert axes.get_ylabel() == f"${words['symbol']}$ [{words['units']}]"


def test_the_curve_is_the_channel(run):
    line = plots.plot_tip(run).lines[0]
    np.testing.assert_array_equal(line.get_xdata(), run["time"].values)
    np.testing.assert_array_equal(line.get_ydata(), run["tip_displacement"].values)


def test_the_map_covers_the_cable_and_hangs_down(run):
    axes = plots.plot_cable(run)
    bottom, top = axes.get_ylim()
    assert (bottom, top) == (pytest.approx(float(run["length"].max())), 0.0)
    (picture,) = axes.images
    largest = float(np.abs(run["displacement"]).max())
    assert picture.get_clim() == (-largest, largest)
    shown = np.asarray(picture.get_array())
    assert np.nanmax(np.abs(shown)) == pytest.approx(largest, rel=0.02)
    end = float(run["length"][-1]) / bottom * shown.shape[0]
    assert np.isfinite(shown[: int(end) - 1, -1]).all()
    assert np.isnan(shown[int(end) + 1 :, -1].astype(float)).all()


@pytest.mark.parametrize("sigma", [0.0, 0.1, 0.25, 0.5, 0.999, 1.0])
def test_places_are_read_between_nodes(run, sigma):
    wanted = [np.interp(sigma, run["sigma"].values, row) for row in run["displacement"].values]
    np.testing.assert_allclose(at_sigma(run, sigma).values, wanted, rtol=1e-12, atol=1e-15)


def marks(axes: Axes, style: str) -> set[float]:
    """Instants at which lines of a style stand upright."""
    return {float(np.asarray(line.get_xdata())[0]) for line in axes.lines if line.get_linestyle() == style}


def test_faults_are_marked_and_named(run):
    axes = plots.plot_tip(run)
    named = {text.get_text(): text.xy[0] for text in axes.texts if isinstance(text, Annotation)}
    assert named == {"motor 2: dead": 1.0, "motor 2: healthy": 1.5}
    assert marks(axes, "--") == {1.0, 1.5}


def test_other_jumps_are_marked_and_named():
    pulse = [{"kind": "pulse", "value": 1.0, "start": 0.25, "end": 0.75}]
    axes = plots.plot_tip(simulate(load("crosscheck-none", {"duration": 1.0, "environment.payload_force": pulse})))
    named = {text.xy[0]: text.get_text() for text in axes.texts if isinstance(text, Annotation)}
    assert named == {0.25: "force on the ROV", 0.75: "force on the ROV"}
    assert marks(axes, ":") == {0.25, 0.75}


def test_the_winch_has_a_panel_where_it_moves(run, free):
    axes = plots.plot_winch(run)
    beside = next(other for other in axes.figure.axes if other is not axes)
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), run["length"].values)
    np.testing.assert_array_equal(beside.lines[0].get_ydata(), run["payout_speed"].values)
    panels = {axes.get_title(loc="left") for axes in plots.plot_overview(run).axes}
    assert "winch" in panels
    assert "winch" not in {axes.get_title(loc="left") for axes in plots.plot_overview(free).axes}


def test_no_motor_hides_another(run):
    lines = {line.get_label(): line.get_linewidth() for line in plots.plot_motors(run, "motor_voltage").lines}
    assert lines["motor 1"] > lines["motor 2"]


def test_a_voltage_limit_is_drawn_where_it_is_near_and_named_where_not(run):
    motors = len(run.scenario.motors)
    for limit, drawn in ((1.0, {1.0, -1.0}), (300.0, set())):
        limited = simulate(run.scenario.replace({f"motors.{k + 1}.voltage_limit": limit for k in range(motors)}))
        axes = plots.plot_motors(limited, "motor_voltage")
        levels = {float(np.asarray(line.get_ydata())[0]) for line in axes.lines if line.get_linestyle() == "-."}
        assert levels == drawn
        assert any("limit" in text.get_text() for text in axes.texts) != bool(drawn)


def test_what_falls_between_stored_samples_is_told(run):
    sparse = simulate(run.scenario.replace({"output.interval": 1.0}))
    assert any("between samples" in text.get_text() for text in plots.plot_motors(sparse, "motor_voltage").texts)
    dense = simulate(run.scenario.replace({"output.interval": run.scenario.control.period}))
    assert not any("between samples" in text.get_text() for text in plots.plot_motors(dense, "motor_voltage").texts)


def test_chatter_is_a_band_from_the_lowest_to_the_highest_value(run):
    axes, flat = Figure().add_subplot(), run["tip_displacement"].copy(data=np.zeros(run["time"].size))
    fast = flat.copy(data=np.where(np.arange(flat.size) % 2, 3.0, -2.0))
    repeated = fast.isel(time=np.arange(2000) % fast.size).assign_coords(time=np.arange(2000.0))
    draw_channel(axes, flat)
    draw_channel(axes, repeated, "fast")
    (band,) = axes.collections
    heights = np.asarray(band.get_paths()[0].vertices)[:, 1]
    assert (len(axes.lines), heights.min(), heights.max()) == (1, -2.0, 3.0)


def test_of_a_fast_disturbance_so_much_is_shown_that_its_estimate_can_be_told_from_it():
    fast = [{"kind": "sine", "amplitude": 1.0, "frequency": 100.0}]
    whole = simulate(load("paper", {"duration": 5.0, "motors.1.voltage_disturbance": fast, "output.interval": 0.005}))
    shown = {k: plots.plot_observers(whole, "motor_disturbance", motor=k).get_xlim()[1] for k in (1, 2)}
    assert shown[1] < 1.0
    assert shown[2] == 5.0


def test_no_panel_for_what_a_run_does_not_have(run, free):
    few, many = (len(plots.plot_overview(which).axes) for which in (free, run))
    assert few < many
    with pytest.raises(ValueError, match="no motor_speed"):
        plots.plot_motors(free)
    with pytest.raises(ValueError, match="nothing was estimated"):
        plots.PLOTS["observers"](free)
    with pytest.raises(ValueError, match="estimated: nothing"):
        plots.plot_observers(free)
    with pytest.raises(ValueError, match="there is no motor 3"):
        plots.plot_observers(run, "motor_disturbance", motor=3)


def test_an_observer_is_drawn_on_its_truth(run):
    axes = plots.plot_observers(run, "disturbance")
    drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
    np.testing.assert_array_equal(drawn["truth"], run["disturbance"].values)
    np.testing.assert_array_equal(drawn["estimate"], run[ESTIMATES["disturbance"]].values)


@pytest.mark.parametrize("name", SINGLE)
def test_a_run_without_samples_is_refused_in_words(run, name):
    empty = Run(run.data.isel(time=slice(0, 0)), run.scenario)
    with pytest.raises(ValueError, match=r"ended before there was anything to draw|estimated"):
        SINGLE[name](empty)
    with pytest.raises(ValueError, match="ended before there was anything to draw"):
        plots.plot_overview(empty)


@pytest.mark.parametrize("kind", ["png", "pdf", "svg"])
def test_equal_runs_give_equal_files(run, tmp_path, kind):
    files = [plots.save_figure(plots.as_figure(plots.plot_tip(run)), tmp_path / f"{k}.{kind}") for k in (1, 2)]
    assert files[0].read_bytes() == files[1].read_bytes()


def test_a_file_is_not_replaced_unasked_and_needs_a_known_ending(run, tmp_path):
    figure = plots.as_figure(plots.plot_tip(run))
    plots.save_figure(figure, tmp_path / "a.png")
    with pytest.raises(OutputError, match="exists already"):
        plots.save_figure(figure, tmp_path / "a.png")
    with pytest.raises(OutputError, match=r"must end with .png"):
        plots.save_figure(figure, tmp_path / "a.bmp")


def test_pyplot_is_never_touched(run, tmp_path):
    stored = run.save(tmp_path / "run.nc")
    script = (
        "import sys; from umbilical import open_run, plots; run = open_run(sys.argv[1])\n"
        "for draw in plots.PLOTS.values(): draw(run)\n"
        "raise SystemExit('matplotlib.pyplot' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", script, stored], check=False).returncode == 0


def test_runs_are_overlaid_with_their_names(run, free):
    axes = plots.plot_tip([run, free])
    names = [run.scenario.name, free.scenario.name]
    assert [line.get_label() for line in axes.lines[:2]] == names
    assert np.array_equal(axes.lines[1].get_ydata(), free["tip_displacement"].values)
    with pytest.raises(ValueError, match="no run"):
        plots.plot_tip([])


@pytest.mark.parametrize("name", ["tip", "overview"])
def test_a_notebook_shows_the_picture(run, name):
    assert plots.PLOTS[name](run)._repr_png_().startswith(b"\x89PNG")

"""Figures: what is drawn is what is stored, with units; equal data give equal bytes."""

from __future__ import annotations

import io
from itertools import product

import numpy as np
import pytest
import xarray

from tests.support.maps import made_up_maps
from umbilical.papers.rao2022.experiments import EXPERIMENTS, Runs
from umbilical.papers.rao2022.figures import PICTURES, Picture
from umbilical.papers.rao2022.figures.maps import _borders
from umbilical.papers.rao2022.figures.style import COLUMN_WIDTH
from umbilical.papers.rao2022.lyapunov import lyapunov
from umbilical.papers.rao2022.maps import MAPS
from umbilical.papers.rao2022.reproduction import KINDS, choose, show_pictures
from umbilical.papers.rao2022.tables import to_csv
from umbilical.plots.figure import render

FROM_RUNS = [picture for picture in PICTURES.values() if not picture.scanned]


def test_all_figures_of_the_paper_are_there() -> None:
    assert [f"fig{k}" for k in range(3, 10)] == [name for name in PICTURES if name.startswith("fig")]
    assert {"spacetime", "energy", "lyapunov", "kappa", "map-time", "map-factors", "map-rates"} <= PICTURES.keys()


def test_every_figure_asks_for_runs_that_exist() -> None:
    for picture in PICTURES.values():
        assert set(picture.experiments) <= EXPERIMENTS.keys()
        assert not picture.faulty or picture.faulty in EXPERIMENTS


@pytest.mark.parametrize("picture", PICTURES.values(), ids=lambda picture: picture.name)
def test_a_figure_is_drawn_from_its_stored_data_alone(runs: Runs, picture: Picture) -> None:
    """From the NetCDF file, the same bytes; as wide as a column; every axis with a label or a neighbour's."""
    data = picture.data(runs, made_up_maps())
    from umbilical.formats import to_netcdf

    stored = xarray.load_dataset(io.BytesIO(to_netcdf(data)), engine="h5netcdf")
    figure = picture.draw(data)
    assert figure.get_size_inches()[0] == pytest.approx(COLUMN_WIDTH)
    assert render(figure, "png") == render(picture.draw(stored), "png")
    assert all(axes.get_ylabel() or axes.get_title("left") for axes in figure.axes)
    assert all("units" in array.attrs for array in data.data_vars.values())


def test_faults_are_marked_where_there_are_some(runs: Runs) -> None:
    panels = PICTURES["fig6"].draw(PICTURES["fig6"].data(runs, {})).axes
    marked = {axes.get_title("left"): "fault" in axes.get_legend_handles_labels()[1] for axes in panels}
    assert marked == {
        "(a1) motor 2 dead": True,
        "(a2) motor 2 stuck": True,
        "(a3) motor 2 partial": True,
        "(b) no fault": False,
    }


def test_every_line_is_named_once_above_the_figure(runs: Runs) -> None:
    """Marks of a fault, too, which stand only in some of the panels."""
    picture = PICTURES["lyapunov"]
    (names,) = picture.draw(picture.data(runs, {})).legends
    assert [text.get_text() for text in names.get_texts()] == ["$V$", "$V_1$", "$|V_2|$", "$V_3$", "fault"]


def test_a_map_says_which_row_and_arm_a_panel_is_and_marks_what_diverged(runs: Runs) -> None:
    """No colour for a diverged cell, which could be taken for a value, but a mark for each."""
    data = PICTURES["map-rates"].data(runs, made_up_maps())
    panels = PICTURES["map-rates"].draw(data).axes[:6]
    assert panels[0].get_title("left") == "disturbance observer on\n(a) known factors"
    assert panels[5].get_title("left") == r"(f) $\kappa$ in a box"
    for ax, (observer, arm) in zip(panels, product(data["observer"].values, data["arm"].values), strict=True):
        lost = int(np.isnan(data["peak"].sel(observer=observer, arm=arm)).sum())
        assert [len(np.asarray(one.get_xdata())) for one in ax.lines if one.get_marker() == "x"] == [lost]
        cells = ax.collections[0]
        assert (cells.to_rgba(np.ma.asarray(cells.get_array()))[..., 3] == 0.0).sum() == lost


def test_cells_of_a_map_lie_around_their_values() -> None:
    """On a logarithmic axis as on a linear one."""
    for scale, values in (("linear", [1.0, 2.0, 3.0]), ("log", [1.0, 4.0, 16.0])):
        borders = _borders(xarray.DataArray(values, attrs={"scale": scale}))
        middles = np.sqrt(borders[1:] * borders[:-1]) if scale == "log" else (borders[1:] + borders[:-1]) / 2.0
        assert middles == pytest.approx(values)


def test_the_same_run_gives_the_same_files(runs: Runs) -> None:
    picture = PICTURES["fig9"]
    first, second = show_pictures([picture, picture], runs, {})
    assert first.contents == second.contents
    assert first.svg == second.svg
    assert set(first.contents) == set(KINDS)
    assert b"CreationDate" not in first.contents["pdf"]
    assert b"FontFile2" in first.contents["pdf"]
    assert b"<dc:date>" not in first.svg


def test_another_run_gives_another_figure(runs: Runs) -> None:
    picture = PICTURES["fig9"]
    other = {**runs, picture.experiments[0]: runs["dead, without"]}
    assert (
        show_pictures([picture], runs, {})[0].contents["png"] != show_pictures([picture], other, {})[0].contents["png"]
    )


@pytest.mark.parametrize("name", ["fig3", "fig7"])
def test_a_table_over_time_holds_every_number(runs: Runs, name: str) -> None:
    data = PICTURES[name].data(runs, {})
    title, units, names, *rows = to_csv(data).decode().splitlines()
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert title.startswith(f"# Fig. {name[-1]}")
    assert units.startswith("# s,")
    assert len(names.split(",")) == len(units.split(","))
    (array,) = data.data_vars.values()
    assert table.shape == (data.sizes["time"], 1 + array.size // data.sizes["time"])
    assert np.sort(table[:, 1:].ravel()) == pytest.approx(np.sort(array.values.ravel()), rel=1e-15)
    if name == "fig3":
        column = names.split(",").index("displacement pd l/2")
        assert (table[:, column] == array.sel(controller="pd", place="l/2").values).all()


def test_a_table_of_cells_names_each(runs: Runs) -> None:
    data = PICTURES["map-time"].data(runs, made_up_maps())
    _, units, names, *rows = to_csv(data).decode().splitlines()
    assert (units, names) == ("# ,,1,s,m", "observer,arm,effectiveness,fault_start,peak")
    assert len(rows) == data["peak"].size
    observer, arm, effectiveness, start, peak = rows[-1].split(",")
    found = data["peak"].sel(observer=observer, arm=arm, effectiveness=float(effectiveness), fault_start=float(start))
    assert peak == ("" if np.isnan(float(found)) else repr(float(found)))


def test_maps_are_left_out_on_request() -> None:
    """Not the scan of the gain, on which verdicts rest; and a figure named twice is made once."""
    assert PICTURES.keys() - {picture.name for picture in choose([], maps=False)} == set(MAPS)
    assert choose(["fig3", "gain", "map-time", "fig3"], maps=False) == (PICTURES["fig3"], PICTURES["gain"])
    with pytest.raises(KeyError):
        choose(["fig33"], maps=True)


def test_v_is_energy_and_more(runs: Runs) -> None:
    """V1 is the cable's part of the energy, by another quadrature; V is positive where the energy is not zero."""
    run = runs["none, without"]
    parts = lyapunov(run)
    cable = run["energy"].values - 0.5 * run.scenario.payload.mass * run["tip_velocity"].values ** 2
    assert parts["V_1"] == pytest.approx(cable, rel=0.05, abs=0.02 * cable.max())
    assert parts["V"][1:].min() > 0.0
    assert np.abs(parts["V_2"]).max() < parts["V_1"].max()
    assert parts["V"] == pytest.approx(parts["V_1"] + parts["V_2"] + parts["V_3"])


def test_v_jumps_when_the_disturbance_does(runs: Runs) -> None:
    run = runs["dead, without"]
    parts = lyapunov(run)
    before, after = (int(np.searchsorted(run["time"].values, t)) for t in (9.9, 10.06))
    assert parts["V_3"][after] > 10.0 * parts["V_3"][before]


def test_v_needs_the_boundary_law(runs: Runs) -> None:
    with pytest.raises(ValueError, match="boundary law"):
        lyapunov(runs["pd"])

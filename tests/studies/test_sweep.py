"""A sweep: rows for whatever happens, the same bits whoever works, results that explain themselves."""

from __future__ import annotations

import os
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
import pytest
import xarray

from tests.support.studies import small_study
from umbilical import load
from umbilical.engine.simulate import measure, measuring, simulate
from umbilical.errors import FileError, OutputError
from umbilical.formats import to_netcdf
from umbilical.stored_runs import open_run
from umbilical.studies import engines, rows
from umbilical.studies.cluster import connect, dask
from umbilical.studies.load import load_study
from umbilical.studies.members import Draws
from umbilical.studies.results import assemble_study, open_study
from umbilical.studies.rows import STATUSES
from umbilical.studies.statistics import reasons
from umbilical.studies.sweep import disk_needed, sweep, worst

TARGETS = ("thrust", "voltage")
ENGINES = {
    "two threads": lambda: engines.threads(2),
    "many threads": lambda: engines.threads(7),
    "processes": lambda: engines.processes(2),
    "dask": lambda: dask("local", 3),
    "an executor of Python's own": lambda: ThreadPoolExecutor(2),
}


@pytest.fixture(scope="module")
def study():
    return small_study()


@pytest.fixture(scope="module")
def reference(study):
    return to_netcdf(sweep(study, engine=engines.threads(1)).data)


@pytest.mark.parametrize("name", ENGINES)
def test_the_result_does_not_depend_on_who_works(study, reference, name):
    with ENGINES[name]() as engine:
        assert to_netcdf(sweep(study, engine=engine).data) == reference


def test_nor_on_the_order(study, reference):
    draws = Draws(study)
    backwards = [rows.run_member(draws, draws.member(number)) for number in range(len(draws), 0, -1)]
    assert to_netcdf(assemble_study(study, backwards).data) == reference


def test_another_seed_is_another_result(reference):
    assert to_netcdf(sweep(small_study(seed=1)).data) != reference


@pytest.mark.slow
def test_a_killed_dask_worker_costs_nothing(reference):
    """Three workers, one of which is killed while members are under way."""
    slow = small_study(scenario__duration=4.0, members=24)
    expected = to_netcdf(sweep(slow).data)
    with connect("local", 3) as client:
        client.wait_for_workers(3)
        victim = next(iter(client.run(os.getpid).values()))
        draws, killed = Draws(slow), []

        def kill():
            time.sleep(0.3)
            os.kill(victim, 9)
            killed.append(victim)

        killer = threading.Thread(target=kill)
        killer.start()
        members = (draws.member(n) for n in range(1, len(draws) + 1))
        pool = engines.Pool(3, lambda: client.get_executor(pure=False, retries=10))
        found = list(engines.in_any_order(pool, partial(rows.run_member, draws), members))
        killer.join()
    assert killed
    assert sorted(row.number for row in found) == list(range(1, 25))
    assert to_netcdf(assemble_study(slow, found).data) == expected


def test_no_scheduler_is_said_plainly():
    with pytest.raises(FileError, match="there is no Dask scheduler"):
        dask("not-an-address", 1).__enter__()


def test_a_member_alone_is_its_row(study, reference):
    result = sweep(study)
    for member, arm in ((3, "PD"), (7, "proposed")):
        run = simulate(result.scenario(member, arm))
        row = result.data.sel(member=member, arm=arm)
        for name in result.metrics:
            assert float(row[name]) == run.metrics[name], name


def test_what_goes_wrong_is_a_row_with_its_reason(monkeypatch):
    """Some members cannot be, some are torn away, some meet a bug of ours; the others do not notice."""
    mass = {"kind": "choice", "values": [-1.0, 500.0, 400.0, 450.0]}
    force = {"kind": "choice", "values": [100.0, 50.0, 1e7, 0.0]}
    study = small_study(
        design="grid",
        campaigns=[],
        scenario__duration=1.0,
        factors=[
            {"key": "payload.mass", "distribution": mass},
            {"key": "environment.payload_force.1.value", "distribution": force},
        ],
        arms=[{"name": "free", "changes": {"control.law.kind": "none"}}],
    )

    def unlucky(scenario, *others):
        if scenario.payload.mass == 450.0:
            raise RuntimeError("out of luck")
        return (yield from measuring(scenario, *others))

    monkeypatch.setattr(rows, "measuring", unlucky)
    result = sweep(study, engine=engines.threads(2))
    status = result["status"].values[:, 0].reshape(4, 4)
    reasons = result["reason"].values[:, 0].reshape(4, 4)
    assert status.tolist() == [[2] * 4, [0, 0, 1, 0], [0, 0, 1, 0], [3] * 4]
    assert "payload.mass" in reasons[0, 0] or "mass" in reasons[0, 0]
    assert "slope reached" in reasons[1, 2]
    assert reasons[3, 0] == "RuntimeError: out of luck"
    assert np.isnan(result["tip_peak"].values.reshape(4, 4)[0]).all()
    assert (result["end_time"].values.reshape(4, 4)[1:3, 2] < 1.0).all()


@pytest.mark.slow
def test_a_python_controller_runs_in_processes_and_threads_alike(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "soft.py").write_text(
        "from umbilical import Command\n"
        "class Spring:\n"
        "    def __init__(self, scenario): self.period = scenario.control.period\n"
        "    def start(self, measurement): return None\n"
        "    def update(self, t, measurement, state):\n"
        "        return Command(thrust=-100 * measurement.tip_displacement), state\n"
    )
    study = small_study(members=3, arms=[{"name": "mine", "controller": "soft:Spring"}])
    workers = (engines.threads(2), engines.processes(2))
    found = [to_netcdf(sweep(study, engine=engine, trust=True).data) for engine in workers]
    assert found[0] == found[1]


def test_xarray_alone_reads_the_result(tmp_path, study):
    sweep(study, tmp_path / "out")
    data = xarray.open_dataset(tmp_path / "out" / "study.nc", engine="h5netcdf")
    assert data["tip_peak"].dims == ("member", "arm")
    assert data["tip_peak"].attrs["units"] == "m"
    assert data["payload.mass"].dims == ("member",)
    assert list(data["arm"].values) == ["PD", "proposed"]
    assert open_study(tmp_path / "out" / "study.nc").study == study
    with pytest.raises(FileError, match="result of a study, not of a run"):
        open_run(tmp_path / "out" / "study.nc")


def test_complete_runs_are_kept_on_request_and_their_size_is_told(tmp_path):
    all_of_them = small_study(members=3, trajectories={"keep": "all"}, changes={"grid.elements": 32})
    sweep(all_of_them, tmp_path / "all")
    stored = sorted((tmp_path / "all" / "runs").iterdir())
    assert len(stored) == 6
    assert sum(file.stat().st_size for file in stored) == pytest.approx(disk_needed(Draws(all_of_them)), rel=0.05)
    worst_two = small_study(members=5, trajectories={"keep": "worst", "count": 2})
    result = sweep(worst_two, tmp_path / "worst")
    names = {
        f"member-{n:06d}-arm-{k}.nc" for k, a in enumerate(result.arms, 1) for n in worst(result, "tip_peak", a, 2)
    }
    assert {file.name for file in (tmp_path / "worst" / "runs").iterdir()} == names
    run = open_run(tmp_path / "worst" / "runs" / sorted(names)[0])
    member = int(sorted(names)[0].split("-")[1])
    assert run.metrics["tip_peak"] == float(result.data["tip_peak"].sel(member=member)[0])


def test_room_is_needed_only_for_what_is_not_there_yet(tmp_path, monkeypatch):
    study, said = small_study(members=3, trajectories={"keep": "all"}), []
    sweep(study, tmp_path / "out", report=said.append)
    assert "MB will be stored" in said[0]
    room = disk_needed(Draws(study)) // 10
    monkeypatch.setattr("shutil.disk_usage", lambda _: type("Disk", (), {"free": room}))
    sweep(study, tmp_path / "out", resume=True)
    with pytest.raises(OutputError, match="are free"):
        sweep(study, tmp_path / "other")


def broken(scenario, *others):
    """Heavy members meet a bug of ours."""
    if scenario.payload.mass > 500.0:
        raise RuntimeError("out of luck")
    return (yield from measuring(scenario, *others))


def test_the_worst_are_kept_of_those_that_have_a_run(tmp_path, monkeypatch):
    monkeypatch.setattr(rows, "measuring", broken)
    result = sweep(small_study(trajectories={"keep": "worst", "count": 2}), tmp_path / "out")
    for number, arm in enumerate(result.arms, start=1):
        names = {file.name for file in (tmp_path / "out" / "runs").glob(f"*-arm-{number}.nc")}
        assert names == {f"member-{member:06d}-arm-{number}.nc" for member in worst(result, "tip_peak", arm, 2)}
        assert not result.ended(arm, "FAILED")[[int(name[7:13]) - 1 for name in names]].any()
        assert result.ended(arm, "FAILED").any()


def test_the_worst_are_run_by_the_engine_that_was_chosen_after_the_result_is_stored(tmp_path):
    asked = {}

    class Asked(ThreadPoolExecutor):
        def submit(self, function, member):
            study = function.args[0].study
            asked[study.trajectories.keep, len(study.arms), (tmp_path / "out" / "study.nc").exists()] = True
            return super().submit(function, member)

    sweep(small_study(trajectories={"keep": "worst", "count": 2}), tmp_path / "out", engine=Asked(1))
    assert list(asked) == [("worst", 2, False), ("all", 1, True)]


@pytest.mark.parametrize("keep", ["none", "worst"])
def test_a_study_of_which_nothing_can_be_is_a_result(tmp_path, keep):
    damping = {"key": "control.law.damping_gain", "distribution": {"kind": "choice", "values": [1e8, 2e8]}}
    study = small_study(members=3, campaigns=[], factors=[damping], arms=[{"name": "one"}], trajectories={"keep": keep})
    result = sweep(study, tmp_path / "out")
    assert result.metrics == ()
    assert np.isnan(result.values("tip_peak", "one")).all()
    assert [(reason.count, reason.status) for reason in reasons(result, "one")] == [(3, "REFUSED")]


WITH_KINDS = {
    "control.allocation.leak": ({"kind": "choice", "values": [1e-3]}, ("", "leak of the adaptive law")),
    "control.allocation.rates.2": ({"kind": "choice", "values": [90.0]}, ("rad2/(m s2)", "adaptation rates")),
    "faults.1.start": ({"kind": "choice", "values": [0.1]}, ("s", "instant the fault begins")),
    "motors.1.torque_disturbance.1.amplitude": ({"kind": "choice", "values": [0.5]}, ("N m", "value in the unit")),
    "winch.end_length": ({"kind": "choice", "values": [490.0]}, ("m", "cable length when the winch has stopped")),
    "environment.payload_force.2.phase": ({"kind": "choice", "values": [0.5]}, ("rad", "phase")),
    "control.law.slope_gain": ({"kind": "choice", "values": [0.5]}, ("m/s", "weight of the boundary slope")),
    "control.allocation.method": ({"kind": "choice", "values": ["adaptive"]}, ("", "control.allocation.method")),
}


@pytest.mark.parametrize("key", WITH_KINDS)
def test_whatever_is_drawn_has_words_and_none_of_them_kills_the_result(key):
    distribution, (unit, meaning) = WITH_KINDS[key]
    study = load_study("fault-map").replace(
        {
            "scenario": load("paper-dead-adaptive", {"duration": 0.2, "grid.elements": 8}).to_dict(),
            "campaigns": [],
            "factors": [{"key": key, "distribution": distribution}],
            "arms": [{"name": "one"}],
        }
    )
    column = sweep(study).data[key]
    assert column.attrs["units"] == unit
    assert column.attrs["long_name"].startswith(meaning)


def test_the_unit_of_a_stuck_value_is_that_of_what_is_stuck():
    units = [sweep(small_study(members=1, campaigns__1__target=t))["fault.value"].attrs["units"] for t in TARGETS]
    assert units == ["rad2/s2", "V"]


def test_what_was_not_measured_is_no_number():
    """Refused and failed members have no value, a diverged one is worse than any number."""
    result = sweep(small_study(members=4))
    result.data["status"][:, 0] = [STATUSES.index(status) for status in ("COMPLETED", "DIVERGED", "REFUSED", "FAILED")]
    values = result.values("tip_peak", "PD")
    assert values[0] == float(result["tip_peak"][0, 0])
    assert values[1] == np.inf
    assert np.isnan(values[2:]).all()
    assert worst(result, "tip_peak", "PD", 4) == [2, 1]
    assert result.lost == ()
    result.data["status"][0, 0] = STATUSES.index("FAILED")
    assert result.lost == ("PD",)


def test_the_power_balance_is_left_out_of_rows_only(study):
    result, run = sweep(study), simulate(Draws(study).scenario(Draws(study).member(1), 0))
    assert set(run.metrics) - set(result.metrics) <= {"energy_balance_residual", "grid_loss"}


@pytest.mark.slow
def test_the_grid_of_the_preset_is_fine_enough():
    """What the comment in paper-robustness.toml says of half the grid, on a few of its draws."""
    draws = Draws(load_study("paper-robustness"))
    proposed = next(arm for arm in draws.study.arms if arm.name == "proposed")
    for number in (83, 415, 830):
        coarse = draws.scenario(draws.member(number), draws.study.arms.index(proposed))
        half, whole = (measure(s).metrics for s in (coarse, coarse.replace({"grid.elements": 64})))
        assert coarse.grid.elements == 32
        for name, change in (("tip_peak", 1e-3), ("mid_peak", 3e-2), ("tip_rms", 1e-3), ("mid_rms", 1e-3)):
            assert half[name] == pytest.approx(whole[name], rel=change), name

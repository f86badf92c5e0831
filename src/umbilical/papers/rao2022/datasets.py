"""The data behind each figure, from runs: everything the figure shows, and nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical import Run
from umbilical.papers.rao2022.experiments import ARMS, CASES, Runs, cell
from umbilical.papers.rao2022.lyapunov import lyapunov
from umbilical.plots.cable import PLACES
from umbilical.plots.figure import at_sigma

if TYPE_CHECKING:
    import xarray

CONTROLLERS = {"none": "free", "pd": "pd", "proposed": cell("none", "without")}
"""The three controllers of Figs. 3 and 4, by the experiments that show them."""


def positions(runs: Runs) -> xarray.Dataset:
    """Fig. 3: y at four places under three controllers."""
    import xarray

    places = [
        _along(
            [_with(at_sigma(runs[name], share), runs[name]["displacement"]) for share in PLACES.values()],
            "place",
            list(PLACES),
        )
        for name in CONTROLLERS.values()
    ]
    return xarray.Dataset({"displacement": _along(places, "controller", list(CONTROLLERS))})


def midpoint(runs: Runs) -> xarray.Dataset:
    """Fig. 4: |y(l/2,t)| under three controllers."""
    import xarray

    words = {"units": "m", "symbol": "|y(l/2,t)|", "long_name": "size of the displacement at the midpoint"}
    sizes = [abs(at_sigma(runs[name], 0.5)).assign_attrs(words) for name in CONTROLLERS.values()]
    return xarray.Dataset({"magnitude": _along(sizes, "controller", list(CONTROLLERS))})


def states(runs: Runs) -> xarray.Dataset:
    """Fig. 5: x2 and z2 with their estimates."""
    return _channels(runs[cell("none", "without")], "tip_velocity", "tip_slope_rate")


def boundary(runs: Runs) -> xarray.Dataset:
    """Fig. 6: y(l,t) in every case with and without fault control."""
    data = _cases(runs, "tip_displacement", CASES)
    data["tip_displacement"].attrs["symbol"] = "y(l,t)"
    return data


def speeds(runs: Runs) -> xarray.Dataset:
    """Fig. 7: motor speeds, stuck motor and no fault."""
    return _cases(runs, "motor_speed", ("none", "stuck"))


def voltages(runs: Runs) -> xarray.Dataset:
    """Fig. 8: motor voltages, stuck motor and no fault."""
    return _cases(runs, "motor_voltage", ("none", "stuck"))


def disturbances(runs: Runs) -> xarray.Dataset:
    """Fig. 9: the disturbances with their estimates."""
    return _channels(runs[cell("none", "without")], "disturbance", "motor_disturbance")


def spacetime(runs: Runs) -> xarray.Dataset:
    """y(x,t) under three controllers, thinned to what a figure of this size shows."""
    import xarray

    thin = slice(None, None, 4)
    shares = np.linspace(0.0, 1.0, 51)
    maps = []
    for name in CONTROLLERS.values():
        y = runs[name]["displacement"].isel(time=thin)
        nodes = runs[name]["sigma"].values
        values = np.array([np.interp(shares, nodes, row) for row in y.values])
        words = runs[name]["sigma"].attrs
        maps.append(
            xarray.DataArray(
                values, {"time": y["time"], "sigma": ("sigma", shares, words)}, ("time", "sigma"), attrs=y.attrs
            )
        )
    length = runs["free"]["length"].isel(time=thin)
    return xarray.Dataset({"displacement": _along(maps, "controller", list(CONTROLLERS)), "length": length})


def balance(runs: Runs) -> xarray.Dataset:
    """Energy and the work of everything that acts, for three controllers."""
    import xarray

    channels = [str(name) for name in runs["pd"].data.data_vars if str(name).startswith("work_")]
    names = [name.removeprefix("work_").replace("_", " ") for name in channels]
    works = [_along([runs[n][channel] for channel in channels], "source", names) for n in CONTROLLERS.values()]
    words = {"units": "J", "symbol": "", "long_name": "work since the start"}
    residual = [runs[n].metrics["energy_balance_residual"] for n in CONTROLLERS.values()]
    who = list(CONTROLLERS)
    return xarray.Dataset(
        {
            "energy": _along([runs[n]["energy"] for n in CONTROLLERS.values()], "controller", who),
            "work": _along(works, "controller", who).assign_attrs(words),
            "residual": (
                "controller",
                residual,
                {"units": "1", "long_name": "what the balance leaves open", "symbol": ""},
            ),
        }
    )


def lyapunov_parts(runs: Runs) -> xarray.Dataset:
    """V(t) and its parts without a fault and with a dead motor, known factors."""
    import xarray

    cases = {"no fault": cell("none", "without"), "motor 2 dead": cell("dead", "without")}
    found = {case: lyapunov(runs[name]) for case, name in cases.items()}
    parts = list(found["no fault"])
    values = np.array([[found[case][part] for part in parts] for case in cases])
    time = runs[cell("none", "without")]["time"]
    words = {"units": "J", "symbol": "V", "long_name": "Lyapunov function of the proof, gamma = 1"}
    return xarray.Dataset(
        {"lyapunov": (("case", "part", "time"), values, words)}, {"case": list(cases), "part": parts, "time": time}
    )


def kappa(runs: Runs) -> xarray.Dataset:
    """kappa_0 and the sum of the offsets, with the values that would deliver what is commanded."""
    import xarray

    cases = ("dead", "stuck")
    chosen = [runs[cell(case, "with")] for case in cases]
    found = {name: _along([_weights(run)[name] for run in chosen], "case", list(cases)) for name in _weights(chosen[0])}
    return xarray.Dataset(found)


def absorption(runs: Runs) -> xarray.Dataset:
    """D and its estimate beside the load itself, known factors, after a fault."""
    import xarray

    names = ("payload_force", "disturbance", "disturbance_estimate")
    cases = ("dead", "stuck")
    return xarray.Dataset(
        {name: _along([runs[cell(case, "without")][name] for case in cases], "case", list(cases)) for name in names}
    )


ADAPTATION = {
    "without": "blind, dead, without",
    "with": "blind, dead, with",
    "fast": "blind, dead, fast",
    "boxed": "blind, dead, boxed",
}
"""Arms of the figure on the adaptive law, by the experiments that show them."""


def adaptation(runs: Runs) -> xarray.Dataset:
    """The ROV and kappa_0 without the disturbance observer, motor 2 dead."""
    import xarray

    chosen = [runs[name] for name in ADAPTATION.values()]
    size = {"units": "m", "symbol": "|y(l,t)|", "long_name": "size of the ROV's displacement"}
    tips = [abs(run["tip_displacement"]).assign_attrs(size) for run in chosen]
    weights = [_weights(run)["kappa_0"] for run in chosen]
    arms = list(ADAPTATION)
    return xarray.Dataset({"tip_size": _along(tips, "arm", arms), "kappa_0": _along(weights, "arm", arms)})


def _weights(run: Run) -> Mapping[str, xarray.DataArray]:
    """kappa_0 and the sum of the others, each with its ideal value (after (30)); constant where nothing adapts."""
    scenario = run.scenario
    factors = np.array([abs(m.thrust_coefficient) for m in scenario.motors])
    signed = np.array([m.thrust_coefficient for m in scenario.motors])
    stuck = np.array(
        [
            next((f.value for f in scenario.faults if f.motor == k and f.kind == "stuck"), 0.0)
            for k in run["motor"].values
        ]
    )
    working = run["effectiveness"].values @ factors
    lost = (run["effectiveness"].values == 0.0) @ (signed * stuck)
    weights = run["kappa"].values
    if scenario.control.allocation.method == "known":
        weights = np.zeros_like(weights)
        weights[:, 0] = 1.0 / factors.sum()
    first = {"units": "rad2/(N s2)", "symbol": r"\kappa_0", "long_name": "gain of the allocation"}
    rest = {"units": "rad2/s2", "symbol": r"\Sigma\kappa_j", "long_name": "sum of the offsets of the allocation"}
    like = run["tip_displacement"]
    return {
        "kappa_0": like.copy(data=weights[:, 0]).assign_attrs(first),
        "kappa_0_ideal": like.copy(data=1.0 / working).assign_attrs(first),
        "kappa_sum": like.copy(data=weights[:, 1:].sum(axis=1)).assign_attrs(rest),
        "kappa_sum_ideal": like.copy(data=-lost / working).assign_attrs(rest),
    }


def _cases(runs: Runs, channel: str, cases: Sequence[str]) -> xarray.Dataset:
    import xarray

    arms = [_along([runs[cell(case, arm)][channel] for arm in ARMS], "arm", list(ARMS)) for case in cases]
    return xarray.Dataset({channel: _along(arms, "case", list(cases))})


def _channels(run: Run, *names: str) -> xarray.Dataset:
    import xarray

    return xarray.Dataset({name: run[name] for base in names for name in (base, f"{base}_estimate")})


def _along(arrays: Sequence[xarray.DataArray], dim: str, names: Sequence[str]) -> xarray.DataArray:
    """Arrays side by side under names; where one ended early its rest is not a number."""
    import xarray

    joined = xarray.concat(list(arrays), dim=dim, join="outer", coords="minimal", compat="override")
    return joined.assign_coords({dim: list(names)}).assign_attrs(arrays[0].attrs)


def _with(array: xarray.DataArray, source: xarray.DataArray) -> xarray.DataArray:
    return array.assign_attrs(source.attrs)


def about_fault(run: Run) -> dict[str, Any]:
    """When and which motor fails, for the marks in figures."""
    fault = run.scenario.faults[0]
    return {"fault_time": fault.start, "fault_motor": fault.motor}

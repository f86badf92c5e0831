"""Figs. 7 and 8: speeds and voltages of the motors, one stuck, and without a fault."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import product

import xarray

from umbilical.papers.rao2022.experiments import ARMS, Runs, cell
from umbilical.papers.rao2022.figures.picture import Picture, by_case
from umbilical.papers.rao2022.figures.style import NO_FAULT, Panel, case_title, faults_first, lines_of, over_time

CASES = (NO_FAULT, "stuck")


def _data(runs: Runs, channel: str) -> xarray.Dataset:
    return by_case(runs, channel, CASES)


def _panels(data: xarray.Dataset, channel: str) -> Iterator[Panel]:
    for case, motor in product(faults_first(data), data["motor"].values):
        lines = lines_of(data, channel, "arm", case=case, motor=motor)
        yield Panel(f"{case_title(case, data)}: motor {motor}", lines, marked=case != NO_FAULT)


def _picture(name: str, title: str, channel: str, claims: str, caption: str) -> Picture:
    draw = over_time(partial(_panels, channel=channel), 0.95)
    experiments = tuple(cell(case, arm) for case, arm in product(CASES, ARMS))
    return Picture(
        name, title, caption, claims, draw, experiments, partial(_data, channel=channel), cell("stuck", "with")
    )


PICTURES = (
    _picture(
        "fig7",
        "Fig. 7",
        "motor_speed",
        "C8 T2a T2b T3",
        "Motor speeds (a) with motor 2 stuck from 10 s on and (b) without a fault. The fault acts on the thrust: the "
        "motor still turns.",
    ),
    _picture(
        "fig8",
        "Fig. 8",
        "motor_voltage",
        "C8 T2a",
        "Motor voltages (a) with motor 2 stuck from 10 s on and (b) without a fault.",
    ),
)

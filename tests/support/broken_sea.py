"""Deliberately wrong seas and vessels: each breaks one thing on its way into the screening."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

from umbilical.plant import exogenous, regular, seaway, stretching
from umbilical.relations import axial
from umbilical.screening import operate, response
from umbilical.sea import components, rao, spectrum, vessel
from umbilical.verify import sea


def two_sided_spectrum(patch: pytest.MonkeyPatch) -> None:
    """Half of the energy at negative frequencies, which nobody adds."""
    right = spectrum.Spectrum.density
    patch.setattr(spectrum.Spectrum, "density", lambda self, omega: right(self, omega) / 2.0)


def energy_for_amplitude(patch: pytest.MonkeyPatch) -> None:
    """Amplitudes that are the energy of their bin."""

    def wrong(sea_state: spectrum.Spectrum, count: int, **options: Any) -> components.Components:
        waves = components.discretise(sea_state, count, **options)
        return waves._replace(amplitude=waves.amplitude**2 / 2.0)

    patch.setattr(sea, "discretise", wrong)


def degrees_for_radians(patch: pytest.MonkeyPatch) -> None:
    """Headings in degrees where radians are meant."""
    right = vessel.BoxVessel.motions
    patch.setattr(vessel.BoxVessel, "motions", lambda self, omega, heading: right(self, omega, np.degrees(heading)))


def lead_for_lag(patch: pytest.MonkeyPatch) -> None:
    """Motions ahead of the wave by what they should be behind it."""
    right = vessel.BoxVessel.motions

    def wrong(self: vessel.BoxVessel, omega: np.ndarray, heading: float) -> vessel.Motions:
        return vessel.Motions(*(np.conj(part) for part in right(self, omega, heading)))

    patch.setattr(vessel.BoxVessel, "motions", wrong)


def table_read_with_lead_for_lag(patch: pytest.MonkeyPatch) -> None:
    """A table of RAOs whose phases are read the other way round."""
    right = rao.rows_of
    patch.setattr(rao, "rows_of", lambda ship, name: np.conj(right(ship, name)))
    patch.setattr(rao, "_of_table", rao._of_table.__wrapped__)


def table_read_in_degrees(patch: pytest.MonkeyPatch) -> None:
    """A table of RAOs whose phases are taken for degrees."""
    right = rao.rows_of

    def wrong(ship: Any, name: str) -> np.ndarray:
        rows = right(ship, name)
        return abs(rows) * np.exp(1j * np.radians(np.angle(rows)))

    patch.setattr(rao, "rows_of", wrong)
    patch.setattr(rao, "_of_table", rao._of_table.__wrapped__)


def added_mass_forgotten(patch: pytest.MonkeyPatch) -> None:
    """The body moves without the water around it."""
    for room in (response, _module(operate)):
        right = room.bar_of
        patch.setattr(
            room, "bar_of", lambda operation, length, right=right: right(operation, length)._replace(mass=9e3)
        )


def half_the_body(patch: pytest.MonkeyPatch) -> None:
    """Half of the mass at the end of the bar."""
    right = axial.heave_transfer
    for room in (response, _module(operate), sea):
        patch.setattr(
            room, "heave_transfer", lambda bar, damping, omega: right(bar._replace(mass=bar.mass / 2.0), damping, omega)
        )


def stretch_forgotten(patch: pytest.MonkeyPatch) -> None:
    """The string's tension follows heave as if the cable did not stretch."""
    patch.setattr(exogenous, "stretching", lambda *_: None)


def stretch_that_leads(patch: pytest.MonkeyPatch) -> None:
    """The bar's answer ahead of the heave by what it should be behind it."""
    right = stretching.heave_transfer

    def wrong(bar: Any, damping: np.ndarray, omega: np.ndarray) -> axial.HeaveTransfer:
        return axial.HeaveTransfer(*(np.conj(part) for part in right(bar, damping, omega)))

    patch.setattr(stretching, "heave_transfer", wrong)
    patch.setattr(stretching, "_stretching", stretching._stretching.__wrapped__)


def drive_that_leads(patch: pytest.MonkeyPatch) -> None:
    """A winch that knows the heave before it comes."""
    right = response.residual_heave

    def wrong(drive: Any, omega: np.ndarray) -> np.ndarray:
        return right(drive and drive.model_copy(update={"lag": -drive.lag}), omega)

    for room in (response, sea):
        patch.setattr(room, "residual_heave", wrong)


def waves_that_repeat_themselves(patch: pytest.MonkeyPatch) -> None:
    """A table of waves that begins again after 51.2 s."""
    right = regular.waves
    patch.setattr(regular, "waves", lambda term, t, order=0: right(term, np.mod(t, 51.2), order))


def squared_amplitude(patch: pytest.MonkeyPatch) -> None:
    """Waves as high as the square of what they are, in m2."""
    right = seaway.discretise

    def wrong(sea_state: spectrum.Spectrum, count: int, **options: Any) -> components.Components:
        waves = right(sea_state, count, **options)
        return waves._replace(amplitude=waves.amplitude**2)

    patch.setattr(seaway, "discretise", wrong)


def vessel_that_follows_the_water(patch: pytest.MonkeyPatch) -> None:
    """A table that is not looked into."""
    nothing, all_of_it = np.zeros_like, np.ones_like

    def wrong(self: rao.RaoVessel, omega: np.ndarray, heading: float) -> vessel.Motions:
        moved, still = all_of_it(omega) + 0j, nothing(omega) + 0j
        return vessel.Motions(still, moved, moved, still, still, still)

    patch.setattr(rao.RaoVessel, "motions", wrong)


def headings_of_half_a_turn(patch: pytest.MonkeyPatch) -> None:
    """Headings outside 0 to 180 degrees are taken for the nearest within."""
    right = vessel.BoxVessel.motions
    patch.setattr(
        vessel.BoxVessel, "motions", lambda self, omega, heading: right(self, omega, float(np.clip(heading, 0.0, 3.1)))
    )


def every_phase_a_lag(patch: pytest.MonkeyPatch) -> None:
    """A table of RAOs whose phases are a lag, whatever it declares, in waves that no check of long waves sees."""
    right = rao.rows_of

    def wrong(ship: Any, name: str) -> np.ndarray:
        lagging = right(ship.model_copy(update={"phase": "lag"}), name)
        return np.where(np.array(ship.frequency) > 0.45, lagging, right(ship, name))

    patch.setattr(rao, "rows_of", wrong)
    patch.setattr(rao, "_of_table", rao._of_table.__wrapped__)


def _module(function: Any) -> Any:
    """The module a function stands in; the package shows the function under the module's own name."""
    return sys.modules[function.__module__]

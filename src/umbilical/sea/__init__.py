"""Waves and vessels: spectra, their components, orbital motion under water, and what a ship makes of them.

All functions work on numpy arrays and know nothing of cables. Frequencies are angular, rad/s; headings are where the
waves go, in rad from the bow's direction: 0 following, pi head sea.
"""

from umbilical.sea.components import Components, discretise
from umbilical.sea.rao import RaoVessel, sheave_of, vessel_of
from umbilical.sea.spectrum import Spectrum
from umbilical.sea.vessel import BoxVessel, Vessel, heave_of_point, motion_of_point
from umbilical.sea.waves import orbital_velocity, wave_number

__all__ = [
    "BoxVessel", "Components", "RaoVessel", "Spectrum", "Vessel", "discretise", "heave_of_point", "motion_of_point",
    "orbital_velocity", "sheave_of", "vessel_of", "wave_number",
]  # fmt: skip

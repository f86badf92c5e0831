"""Frequencies, damped poles, reflection, static deflection and release of the hanging cable, in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.spectra import step_poles
from tests.support.verdicts import assert_holds, each
from umbilical.verify import engine, hanging_string
from umbilical.verify.cases import Case
from umbilical.verify.references.hanging_string import HangingString, damped_poles, frequencies, static_shape

PRINTED = {
    500.0: (0.1536771590334, 0.483646205031, 0.8881725784718, 1.30776502146, 1.731946215684, 2.158067989623),
    400.0: (0.1702, 0.5687, 1.056),
    300.0: (0.1942, 0.7072),
}


@each((*hanging_string.CASES, *hanging_string.DAMPING))
def test_case(case: Case) -> None:
    assert_holds(case)


def test_a_fixed_undamped_cable_decays_by_no_more_than_the_step_takes() -> None:
    """The leading error of the multistep method is ``3/8 w^4 dt^3``, 1/s; the grid takes less from these modes."""
    poles = engine.modes(hanging_string.hung(HangingString()), 12)[0]
    np.testing.assert_allclose(-np.real(poles), 3.0 / 8.0 * np.imag(poles) ** 4 * 1e-9, rtol=0.01, atol=1e-12)


def test_no_mode_of_the_grid_grows() -> None:
    assert np.real(step_poles(hanging_string.hung(HangingString(), grid__elements=24))).max() < 1e-9


@pytest.mark.parametrize("length", PRINTED)
def test_the_reference_has_the_printed_frequencies(length: float) -> None:
    found = frequencies(HangingString(length=length), 6)[: len(PRINTED[length])]
    np.testing.assert_allclose(found, PRINTED[length], rtol=3e-4 if length < 500.0 else 1e-11)


def test_the_undamped_limit_of_the_damped_equation_is_the_undamped_one() -> None:
    string = HangingString(length=400.0)
    found = damped_poles(string, 1e-3, 4)
    np.testing.assert_allclose(np.imag(found), frequencies(string, 4), rtol=1e-9)
    assert ((np.real(found) < 0.0) & (np.real(found) > -1e-3 / string.mass)).all()


def test_an_overdamped_mode_is_none_of_the_damped_ones() -> None:
    """400 N s/m is more than the slowest mode bears: five others are found, the first of them above the second's."""
    string = HangingString(length=400.0)
    found = damped_poles(string, 400.0, 5)
    assert found.shape == (5,)
    assert (np.diff(np.imag(found)) > 0.0).all()
    assert np.imag(found[0]) > frequencies(string, 1)[0]


def test_the_stiffness_at_the_payload_is_the_printed_one() -> None:
    assert 100.0 / static_shape(HangingString(), 100.0, np.ones(1))[0] == pytest.approx(18.2, abs=0.01)

"""The reference element, the layout of its nodes and the limits of the step: exactness and summation by parts."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.plant.elements import DERIVATIVE, INTEGRAL, NODES, WEIGHTS, interpolation_row, upwind_spectrum
from umbilical.plant.layout import (
    integrate,
    node_count,
    positions,
    probe,
    quadrature,
    to_elements,
    to_nodal,
)
from umbilical.plant.multistep import DECAY_LIMIT, EXPLICIT, IMPLICIT, amplification, courant_limit

pytestmark = pytest.mark.nojit


@pytest.mark.parametrize("degree", range(8))
def test_quadrature_is_exact_to_degree_seven(degree: int) -> None:
    exact = (1.0 - (-1.0) ** (degree + 1)) / (degree + 1)
    assert WEIGHTS @ NODES**degree == pytest.approx(exact, abs=1e-15)
    assert quadrature(5) @ positions(5) ** degree == pytest.approx(1.0 / (degree + 1), rel=1e-14)


def test_quadrature_ends_at_degree_seven() -> None:
    assert abs(WEIGHTS @ NODES**8 - 2.0 / 9.0) > 1e-2


@pytest.mark.parametrize("degree", range(5))
def test_derivative_is_exact_to_degree_four(degree: int) -> None:
    exact = degree * NODES ** max(degree - 1, 0)
    np.testing.assert_allclose(DERIVATIVE @ NODES**degree, exact, atol=1e-14)


def test_summation_by_parts() -> None:
    """W D + D^T W = diag(-1, 0, 0, 0, 1): integration by parts holds on the grid."""
    product = WEIGHTS[:, None] * DERIVATIVE
    np.testing.assert_allclose(product + product.T, np.diag([-1.0, 0.0, 0.0, 0.0, 1.0]), atol=1e-14)


@pytest.mark.parametrize("position", [-1.0, -0.3, 0.0, 0.7, 1.0])
def test_interpolation_is_exact_to_degree_four(position: float) -> None:
    for degree in range(5):
        assert interpolation_row(position) @ NODES**degree == pytest.approx(position**degree, abs=1e-14)


@pytest.mark.parametrize("degree", range(5))
def test_integral_is_exact_to_degree_four(degree: int) -> None:
    exact = (NODES ** (degree + 1) - (-1.0) ** (degree + 1)) / (degree + 1)
    np.testing.assert_allclose(INTEGRAL @ NODES**degree, exact, atol=1e-14)


@pytest.mark.parametrize("sigma", [0.0, 0.2, 0.25, 0.5, 0.77, 1.0])
def test_probe_reads_between_nodes(sigma: float) -> None:
    """The displacement sigma^4 from its slope: what the elements before gained, and what is gained within."""
    element, weights = probe(sigma, 5)
    slopes = to_elements(4.0 * positions(5) ** 3)
    assert integrate(slopes)[4 * element] + weights @ slopes[:, element] == pytest.approx(sigma**4, abs=1e-14)


def test_displacement_is_the_exact_integral_of_its_slope() -> None:
    sigma = positions(6)
    np.testing.assert_allclose(integrate(to_elements(5.0 * sigma**4 - 1.0)), sigma**5 - sigma, atol=1e-15)


def test_layout_there_and_back() -> None:
    nodal = np.random.default_rng(0).normal(size=(3, 4 * 6 + 1))
    inside = to_elements(nodal)
    assert inside.shape == (3, 5, 6)
    np.testing.assert_array_equal(to_nodal(inside), nodal)
    assert inside[1, 4, 5] == nodal[1, 24], "the ROV"
    assert inside[1, 2, 3] == nodal[1, 14]
    assert node_count(6) == positions(6).size == 25


def test_an_interface_is_told_as_the_mean_of_its_sides() -> None:
    inside = np.zeros((5, 2))
    inside[4, 0], inside[0, 1] = 1.0, 4.0
    assert to_nodal(inside)[4] == 2.5


@pytest.mark.parametrize("order", [1, 2, 3])
def test_multistep_weights_are_exact_for_polynomials(order: int) -> None:
    """The integral over (0, 1) of a polynomial, from its values at 0, -1, -2; or at 1, 0, -1."""
    for power in range(order):
        past = EXPLICIT[order - 1] @ np.array([0.0, -1.0, -2.0]) ** power
        assert past == pytest.approx(1.0 / (power + 1), abs=1e-15)
    for row, weights in enumerate(IMPLICIT):
        for power in range(row + 2):
            assert weights @ np.array([1.0, 0.0, -1.0]) ** power == pytest.approx(1.0 / (power + 1), abs=1e-15)


def test_no_wave_of_the_grid_grows_at_the_courant_limit_and_some_do_beyond() -> None:
    spectrum = upwind_spectrum()
    assert np.real(spectrum).max() < 1e-12, "the upwind flux feeds nothing"
    assert amplification(courant_limit() * spectrum).max() < 1.0 + 1e-6
    assert amplification(1.02 * courant_limit() * spectrum).max() > 1.0 + 1e-3


def test_a_decay_at_its_limit() -> None:
    assert amplification(np.array([-0.999 * DECAY_LIMIT])) < 1.0 < amplification(np.array([-1.001 * DECAY_LIMIT]))

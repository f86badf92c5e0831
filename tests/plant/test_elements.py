"""The reference element and the layout of its nodes: exactness and summation by parts."""

from __future__ import annotations

import numpy as np
import pytest

from umbilical.plant.elements import DERIVATIVE, NODES, WEIGHTS, highest_frequency, interpolation_row
from umbilical.plant.layout import empty_field, node_count, positions, probe, quadrature, to_field, to_nodal

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


@pytest.mark.parametrize("sigma", [0.0, 0.2, 0.25, 0.5, 0.77, 1.0])
def test_probe_reads_between_nodes(sigma: float) -> None:
    element, weights = probe(sigma, 5)
    values = positions(5)[4 * element : 4 * element + 5] ** 3
    assert weights @ values == pytest.approx(sigma**3, abs=1e-14)


def test_layout_there_and_back() -> None:
    nodal = np.random.default_rng(0).normal(size=(3, 4 * 6 + 1))
    field = to_field(nodal)
    assert field.shape == (3, 4, 7)
    np.testing.assert_array_equal(to_nodal(field), nodal)
    assert field[1, 0, 6] == nodal[1, 24], "the ROV"
    assert field[1, 2, 3] == nodal[1, 14]
    assert not field[:, 1:, 6].any()
    assert empty_field(6).shape == field.shape[1:]
    assert node_count(6) == positions(6).size == 25


@pytest.mark.parametrize("elements", [1, 4, 9])
def test_no_mode_of_a_uniform_cable_is_faster_than_the_bound(elements: int) -> None:
    """Assembled stiffness over mass of a cable fixed at both ends, wave speed 50 m/s, elements of 10 m."""
    size = node_count(elements)
    stiffness, mass = np.zeros((size, size)), quadrature(elements) * 10.0 * elements
    element = DERIVATIVE.T @ (WEIGHTS[:, None] * DERIVATIVE) * 2.0 / 10.0
    for e in range(elements):
        stiffness[4 * e : 4 * e + 5, 4 * e : 4 * e + 5] += element * 50.0**2
    free = np.linalg.eigvals(stiffness / mass[:, None]).real
    assert np.sqrt(free.max()) <= highest_frequency(50.0, 10.0) * (1.0 + 1e-12)
    assert np.sqrt(free.max()) > 0.8 * highest_frequency(50.0, 10.0)

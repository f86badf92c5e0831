"""Designs: how the draws are spread over the unit cube, one row for each member, one column for each variable."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from umbilical.errors import MissingPartnerError

if TYPE_CHECKING:
    from umbilical.studies.study import Method

_LEVELS = 4


def design_size(method: Method, members: int, counts: Sequence[int | None]) -> int:
    """How many members a design has: as many as asked for, or as its rule makes of that.

    A grid has the product of its counts; Saltelli's and Morris's designs come in blocks, rounded up.
    """
    if method == "grid":
        return prod(count or 1 for count in counts)
    block = len(counts) + {"saltelli": 2, "morris": 1}[method] if method in ("saltelli", "morris") else 1
    blocks = -(-members // block)
    return block * (1 << (blocks - 1).bit_length() if method == "saltelli" else blocks)


def points(method: Method, members: int, counts: Sequence[int | None], seed: int) -> np.ndarray:
    """Points of the unit cube, shape (members, variables).

    Args:
        method: ``random`` (rows do not depend on how many there are), ``latin`` (each variable evenly covered),
            ``sobol`` (scrambled; also evenly covered together), ``grid`` (all combinations), ``saltelli`` and
            ``morris`` (for sensitivity indices; need SALib).
        members: how many were asked for, see :func:`design_size`.
        counts: number of values of each variable, None for a continuum.
        seed: of the random part.

    Raises:
        MissingPartnerError: SALib is needed and not installed.

    >>> points("grid", 0, [2, 2], 0).tolist()
    [[0.25, 0.25], [0.25, 0.75], [0.75, 0.25], [0.75, 0.75]]
    """
    found, dimensions = design_size(method, members, counts), len(counts)
    if not dimensions:
        return np.zeros((found, 0))
    if method == "grid":
        sizes = [count or 1 for count in counts]
        return (np.indices(sizes).reshape(dimensions, -1).T + 0.5) / np.array(sizes)
    if method in ("saltelli", "morris"):
        return _by_salib(method, found, dimensions, seed)
    generator = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
    if method == "random":
        return generator.random((found, dimensions))
    return _by_scipy(method, found, dimensions, generator)


def child_seed(seed: int, member: int) -> int:
    """Seed of one member's sensors, whatever the other members are.

    >>> child_seed(1, 7) == child_seed(1, 7) != child_seed(1, 8)
    True
    """
    return int(np.random.SeedSequence(seed, spawn_key=(1, member)).generate_state(1, np.uint64)[0] >> np.uint64(1))


def _by_scipy(method: Method, members: int, dimensions: int, generator: np.random.Generator) -> np.ndarray:
    from scipy.stats import qmc

    if method == "latin":
        return qmc.LatinHypercube(dimensions, rng=generator).random(members)
    # Drawn as the power of two it is balanced for, and cut.
    return qmc.Sobol(dimensions, rng=generator).random_base2(max(members - 1, 1).bit_length())[:members]


def _by_salib(method: Method, members: int, dimensions: int, seed: int) -> np.ndarray:
    salib, problem = partner(), salib_problem(dimensions)
    small = seed % 2**32  # what SALib takes
    if method == "saltelli":
        blocks = members // (dimensions + 2)
        return salib.sample.sobol.sample(problem, blocks, calc_second_order=False, seed=small)
    return salib.sample.morris.sample(problem, members // (dimensions + 1), num_levels=_LEVELS, seed=small)


def salib_problem(dimensions: int) -> dict[str, Any]:
    """The unit cube as SALib wants it."""
    return {"num_vars": dimensions, "names": [str(k) for k in range(dimensions)], "bounds": [[0.0, 1.0]] * dimensions}


def partner() -> Any:
    """SALib.

    Raises:
        MissingPartnerError: it is not installed.
    """
    try:
        import SALib
        import SALib.analyze.morris
        import SALib.analyze.rbd_fast
        import SALib.analyze.sobol
        import SALib.sample.morris
        import SALib.sample.sobol
    except ImportError as error:
        raise MissingPartnerError(
            "sensitivity indices need SALib, which is not installed; get it with `pip install umbilical[sensitivity]`"
        ) from error
    return SALib

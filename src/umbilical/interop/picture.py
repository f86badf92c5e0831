"""A cable as a picture of pixels, by numpy alone."""

from __future__ import annotations

import numpy as np

HEIGHT, WIDTH, MARGIN = 360, 240, 20
_WATER, _CABLE, _ROV, _VESSEL = (236, 243, 248), (30, 60, 90), (200, 60, 40), (90, 90, 90)


def draw_cable(displacement: np.ndarray, widest: float) -> np.ndarray:
    """Draw a cable from the vessel, above, to the ROV.

    Args:
        displacement: m, at equal distances from the vessel to the ROV, shape (nodes,).
        widest: the displacement at the picture's edge, m.

    Returns:
        8-bit colours, shape (360, 240, 3).

    >>> draw_cable(np.linspace(0.0, 0.5, 9), 1.0).shape
    (360, 240, 3)
    """
    picture = np.full((HEIGHT, WIDTH, 3), _WATER, dtype=np.uint8)
    rows = np.arange(MARGIN, HEIGHT - MARGIN)
    depth = np.linspace(0.0, 1.0, rows.size)
    places = np.interp(depth, np.linspace(0.0, 1.0, displacement.size), np.nan_to_num(displacement))
    columns = np.clip(WIDTH / 2 * (1.0 + places / widest), 3, WIDTH - 4).astype(int)
    picture[MARGIN - 6 : MARGIN, WIDTH // 2 - 30 : WIDTH // 2 + 30] = _VESSEL
    for row, here, before in zip(rows, columns, np.append(columns[:1], columns[:-1]), strict=True):
        picture[row, min(here, before) - 1 : max(here, before) + 2] = _CABLE
    picture[rows[-1] : rows[-1] + 7, columns[-1] - 3 : columns[-1] + 4] = _ROV
    return picture

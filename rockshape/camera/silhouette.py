"""The rays that graze a rock: its outline where nothing else cuts it."""

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera

NEARER = 0.1  # of the rock's width: what stands this much nearer beside the outline hides it


def grazing_rays(
    mask: NDArray[np.bool_],
    corner: tuple[int, int],
    camera: Camera,
    grid_m: NDArray[np.float64] | None = None,
) -> NDArray[np.float64]:
    """Directions (n, 3), z = 1, of the rays between the rock's pixels and their neighbours.

    One ray for each side that a pixel of the mask shares with one outside it, through the side's
    middle. Left out are the frame's border, which cuts rocks, and sides beyond which the range
    grid_m (rows, cols, 3) is nearer than the rock by a tenth of its width: another rock stands in
    front there. corner is the row and column of the mask's first pixel.
    """
    inside = np.pad(mask, 1)
    distance = np.full(inside.shape, np.nan)
    if grid_m is not None:
        distance[1:-1, 1:-1] = np.sqrt((grid_m**2).sum(axis=-1))
    known = distance[inside & np.isfinite(distance)]
    slack = np.inf
    if len(known):
        slack = NEARER * float(np.sqrt(mask.sum() / camera.fx / camera.fy) * np.median(known))
    sides = []
    for axis in (0, 1):
        cut = inside.take(range(1, inside.shape[axis]), axis) != inside.take(
            range(inside.shape[axis] - 1), axis
        )
        first = np.argwhere(cut)
        second = first + np.eye(2, dtype=int)[axis]
        swap = ~inside[tuple(first.T)]
        within = np.where(swap[:, None], second, first)
        beyond = np.where(swap[:, None], first, second)
        hidden = distance[tuple(beyond.T)] < distance[tuple(within.T)] - slack
        place = beyond + np.array(corner) - 1
        framed = (place < 0).any(axis=1) | (place >= camera.shape).any(axis=1)
        sides.append(((first + second) / 2)[~(hidden | framed)])
    rows, cols = (np.concatenate(sides) + np.array(corner) - 1).T
    return np.column_stack(
        [(cols - camera.cx) / camera.fx, (rows - camera.cy) / camera.fy, np.ones(len(rows))]
    )

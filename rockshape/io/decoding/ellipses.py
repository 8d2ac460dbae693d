"""Ellipse rasterisation: the pixels whose centres lie inside."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from rockshape.io.decoding.outlined import UnreadableError
from rockshape.io.decoding.polygons import BoxedMask, boxed


def ellipse_mask(
    centre: ArrayLike, radii: Sequence[float], shape: tuple[int, int]
) -> BoxedMask | None:
    """Pixels inside an ellipse along the axes, (x, y) of pixel corners; None for no pixel.

    Raises: UnreadableError for numbers that are not finite or a radius of 0.
    """
    x, y = (float(each) for each in np.asarray(centre, dtype=np.float64))
    if not np.isfinite([x, y, *radii]).all() or min(radii) <= 0:
        raise UnreadableError("of no finite size")
    spans = [
        slice(*(int(each) for each in np.clip([at - radius, at + radius + 1], 0, size)))
        for at, radius, size in zip((y, x), radii[::-1], shape, strict=True)
    ]
    rows, cols = (np.arange(span.start, span.stop) + 0.5 for span in spans)
    inside = ((rows[:, None] - y) / radii[1]) ** 2 + ((cols - x) / radii[0]) ** 2 <= 1
    return boxed(inside, spans[0].start, spans[1].start)

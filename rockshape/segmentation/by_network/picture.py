"""Picture as the network sees it: local contrast and colour, whatever the exposure."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Singles

CHANNELS = 3
_LUMINANCE = np.array([0.299, 0.587, 0.114], dtype=np.float32)
_CELL_PX = 16  # local means are taken on cells as wide as this,
_SPREAD_CELLS = 4.0  # weighted by a bell with this standard deviation
_FLATTEST = 0.015  # standard deviation of brightness below which a place counts as even
_DIMMEST = 0.05  # brightness below which colour fades
_COLOUR = 6.0
_LIMIT = 4.0
_LOOKED_AT = 1e6  # pixels, for a picture's levels


def normalized(picture: Singles) -> Singles:
    """Channels (3, rows, cols) of a picture (rows, cols) or (rows, cols, 3), 1 for white.

    The first is brightness less its local mean in local standard deviations, the others are
    red against green and green against blue, over brightness, less their local means; both are 0
    in a grey picture. Values end at ±4.
    """
    colours = picture if picture.ndim == 3 else None
    grey = picture if colours is None else np.ascontiguousarray(colours @ _LUMINANCE)
    channels = np.zeros((CHANNELS, *grey.shape), dtype=np.float32)
    mean = _local_mean(grey)
    off = grey - mean
    channels[0] = off / np.sqrt(_local_mean(off * off) + np.float32(_FLATTEST**2))
    if colours is not None:
        level = grey + np.float32(_DIMMEST)
        for number in (1, 2):
            ratio = (colours[..., number - 1] - colours[..., number]) / level
            channels[number] = np.float32(_COLOUR) * (ratio - _local_mean(ratio))
    return np.clip(channels, -_LIMIT, _LIMIT, out=channels)


def _local_mean(values: Singles) -> Singles:
    rows, cols = values.shape
    cells = max(1, round(cols / _CELL_PX)), max(1, round(rows / _CELL_PX))
    coarse = cv2.resize(values, cells, interpolation=cv2.INTER_AREA)
    coarse = cv2.GaussianBlur(coarse, (0, 0), _SPREAD_CELLS, borderType=cv2.BORDER_REFLECT)
    return np.asarray(cv2.resize(coarse, (cols, rows), interpolation=cv2.INTER_LINEAR))


def as_fractions(
    picture: NDArray[np.generic], levels: tuple[float, float] | None = None
) -> Singles:
    """Picture of whole numbers or of any range as fractions of its bright end, float32.

    levels are those that stand for black and white, else the picture's own.
    """
    dark, bright = levels_of(picture) if levels is None else levels
    values = np.asarray(picture, dtype=np.float32)
    if bright <= dark:
        return np.zeros_like(values)
    fraction = np.clip((values - np.float32(dark)) / np.float32(bright - dark), 0.0, 1.2)
    return np.asarray(np.nan_to_num(fraction), dtype=np.float32)


def levels_of(picture: NDArray[np.generic]) -> tuple[float, float]:
    """Levels of black and of white: 0 or the 0.1 percentile, whichever is lower, and the 99.9.

    Of large pictures every so many rows and columns are looked at.
    """
    step = max(1, int(np.sqrt(picture.shape[0] * picture.shape[1] / _LOOKED_AT)))
    values = np.asarray(picture[::step, ::step], dtype=np.float32)
    known = values[np.isfinite(values)]
    if known.size == 0:
        return 0.0, 0.0
    dark, bright = (float(value) for value in np.percentile(known, [0.1, 99.9]))
    return min(dark, 0.0), bright

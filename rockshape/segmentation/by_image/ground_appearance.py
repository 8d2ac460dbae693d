"""What the image tells of each pixel: like the ground, unlike it, or ground in a cast shadow."""

from dataclasses import dataclass

import cv2
import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.numerics.arrays import Mask, Singles
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA

BLUR_PX = 1.5
LARGEST_BLOCK_PX, SMALLEST_BLOCK_PX, BLOCKS = 32, 8, 12
UNLIKE_SIGMA = 3.0  # of the ground's texture: unlike the ground
MIN_TEXTURE = 0.01  # of the logarithm of brightness
BARE_SHARE = 0.35  # of a block must be ground to tell its brightness
MUCH_DARKER = 0.5  # in the logarithm: never ground in the sun
DARK = 0.55  # of the ground's brightness: in shadow, cast or its own
RIM_PX = (2, 8)  # from the border of what is unlike the ground: where cast shadows are for sure
MIN_DARK = 50
CAST_LOW, CAST_HIGH = 0.78, 1.35  # of the cast shadows' own brightness
DISC = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (5, 5))


@dataclass(frozen=True, eq=False)
class Lightness:
    """The image beside its ground; all (rows, cols)."""

    light: Singles  # logarithm of brightness, smoothed
    texture: Singles  # standard deviation of the ground's light nearby
    ratio: Singles  # brightness over that of the ground nearby
    unlike: Mask  # not like the ground in the sun
    cast: Mask  # ground in a rock's shadow


def read_lightness(image: Singles) -> Lightness:
    """Compare an image (rows, cols), 0 to 1, with the ground that most of it shows.

    The ground's brightness and texture are the medians of blocks, found again twice without what is
    unlike them. Rocks in the sun and their own shaded sides come at any brightness; ground in a
    cast shadow has but one, that of the sky on level ground: the commonest brightness of what is
    dark along the border of what is unlike the ground.
    """
    light = np.asarray(
        cv2.GaussianBlur(np.log(np.maximum(image, np.float32(1 / 255))), (0, 0), BLUR_PX),
        dtype=np.float32,
    )
    block = int(np.clip(min(image.shape) // BLOCKS, SMALLEST_BLOCK_PX, LARGEST_BLOCK_PX))
    ground, texture = _ground(light, np.zeros(image.shape, dtype=bool), block)
    middle = float(np.median(light[::2, ::2]))
    for _ in range(2):
        odd = (np.abs(light - ground) > UNLIKE_SIGMA * texture) | (light < middle - MUCH_DARKER)
        odd = cv2.dilate(odd.astype(np.uint8), DISC) > 0
        ground, texture = _ground(light, odd, block)
    above = light - ground
    unlike = (np.abs(above) > UNLIKE_SIGMA * texture).astype(np.uint8)
    unlike = cv2.morphologyEx(unlike, cv2.MORPH_CLOSE, DISC)
    unlike = cv2.morphologyEx(unlike, cv2.MORPH_OPEN, DISC)
    ratio = np.exp(above).astype(np.float32)
    return Lightness(
        light=light,
        texture=texture,
        ratio=ratio,
        unlike=unlike > 0,
        cast=_cast_shadows(above, unlike > 0),
    )


def _ground(light: Singles, odd: Mask, block: int) -> tuple[Singles, Singles]:
    """Median and scatter of the light of blocks without what is odd, smooth over the frame."""
    rows, cols = light.shape
    down, across = max(1, rows // block), max(1, cols // block)
    high, wide = min(block, rows), min(block, cols)
    values = np.where(odd, np.nan, light)[: down * high, : across * wide]
    # neighbours are alike, for the light is smoothed: every other row and column tells as much
    values = values.reshape(down, high, across, wide)[:, ::2, :, ::2].transpose(0, 2, 1, 3)
    values = np.sort(values.reshape(down, across, -1), axis=2)  # NaN last
    count = np.isfinite(values).sum(axis=2)
    bare = count > BARE_SHARE * values.shape[2]
    if not bare.any():
        bare = count == count.max()
    middle = _median(values, count)
    scatter = MEDIAN_TO_SIGMA * _median(np.sort(np.abs(values - middle[..., None]), axis=2), count)
    nearest = ndi.distance_transform_edt(~bare, return_distances=False, return_indices=True)
    size = (cols, rows)
    ground, texture = (
        cv2.resize(
            ndi.median_filter(part[tuple(nearest)], 5, mode="nearest").astype(np.float32),
            size,
            interpolation=cv2.INTER_LINEAR,
        )
        for part in (middle, scatter)
    )
    return np.asarray(ground), np.maximum(texture, np.float32(MIN_TEXTURE))


def _median(ordered: NDArray[np.floating], count: NDArray[np.intp]) -> NDArray[np.floating]:
    """Median along the last axis of values in order, of which the first `count` are known."""
    place = np.maximum(count - 1, 0)[..., None] // 2
    found: NDArray[np.floating] = np.take_along_axis(ordered, place, axis=-1)[..., 0]
    return np.asarray(np.nan_to_num(found))


def _cast_shadows(above: Singles, unlike: Mask) -> Mask:
    dark = unlike & (above < np.log(DARK))
    inner = cv2.distanceTransform(unlike.astype(np.uint8), cv2.DIST_L2, 5)
    rim = dark & (inner > RIM_PX[0]) & (inner < RIM_PX[1])
    if rim.sum() < MIN_DARK:
        return np.zeros(unlike.shape, dtype=bool)
    edges = np.arange(-4.0, 0.0, 0.04)
    counts = ndi.gaussian_filter1d(np.histogram(above[rim], bins=edges)[0].astype(float), 2)
    shade = edges[counts.argmax()] + 0.02
    smooth = cv2.GaussianBlur(above, (0, 0), BLUR_PX) - shade
    cast = dark & (smooth > np.log(CAST_LOW)) & (smooth < np.log(CAST_HIGH))
    return np.asarray(cv2.morphologyEx(cast.astype(np.uint8), cv2.MORPH_OPEN, DISC) > 0)

"""What the image tells of each pixel: like the ground, unlike it, or ground in a cast shadow."""

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from rockshape.numerics.arrays import Mask, Singles
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.numerics.strips import by_strips
from rockshape.segmentation.brightness import HALO, blurred_light

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
GROUND, LIT, SHADED, CAST = range(4)  # in the sun; unlike it: rock, its dim side; a cast shadow
DISC = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (5, 5))


@dataclass(frozen=True, eq=False)
class Lightness:
    """The image beside its ground; all (rows, cols)."""

    light: Singles  # logarithm of brightness, smoothed
    texture: Singles  # standard deviation of the ground's light nearby
    kinds: NDArray[np.uint8]  # GROUND, LIT, SHADED or CAST

    @property
    def unlike(self) -> Mask:
        """Pixels not like the ground in the sun."""
        return np.asarray(self.kinds != GROUND)

    @property
    def cast(self) -> Mask:
        """Ground in a rock's shadow."""
        return np.asarray(self.kinds == CAST)


def read_lightness(image: Singles) -> Lightness:
    """Compare an image (rows, cols), 0 to 1, with the ground that most of it shows.

    The ground's brightness and texture are the medians of blocks, found again twice without what is
    unlike them. Rocks in the sun and their own shaded sides come at any brightness; ground in a
    cast shadow has but one, that of the sky on level ground: the commonest brightness of what is
    dark along the border of what is unlike the ground.
    """
    light = blurred_light(image, BLUR_PX)
    block = int(np.clip(min(image.shape) // BLOCKS, SMALLEST_BLOCK_PX, LARGEST_BLOCK_PX))
    blocks = _ground(light, np.zeros(image.shape, dtype=bool), block)
    middle = float(np.median(light[::2, ::2]))
    for _ in range(2):
        blocks = _ground(light, _odd(light, blocks, middle), block)
    above = _above(light, blocks)
    unlike = by_strips(_is_unlike, above, blocks.texture(image.shape))
    for operation in (cv2.MORPH_CLOSE, cv2.MORPH_OPEN):
        unlike = cv2.morphologyEx(unlike, operation, DISC)
    cast = _cast_shadows(above, unlike)
    kinds = by_strips(_kinds, unlike, cast, above)
    del above, unlike, cast  # pictures are large
    return Lightness(light, blocks.texture(image.shape), kinds)


@dataclass(frozen=True, eq=False)
class _Blocks:
    """Median and scatter of the ground's light in blocks of the image."""

    middle: Singles
    scatter: Singles

    def light(self, shape: tuple[int, ...]) -> Singles:
        """The ground's light, smooth over a frame of a shape (rows, cols)."""
        return np.asarray(cv2.resize(self.middle, shape[::-1], interpolation=cv2.INTER_LINEAR))

    def texture(self, shape: tuple[int, ...]) -> Singles:
        """The scatter likewise, and a least one."""
        found = np.asarray(cv2.resize(self.scatter, shape[::-1], interpolation=cv2.INTER_LINEAR))
        return np.maximum(found, np.float32(MIN_TEXTURE), out=found)


def _odd(light: Singles, blocks: _Blocks, middle: float) -> Mask:
    """Pixels (rows, cols) unlike the ground or much darker than the frame, and those beside."""
    odd = by_strips(
        lambda light, ground, texture: (
            (np.abs(light - ground) > UNLIKE_SIGMA * texture) | (light < middle - MUCH_DARKER)
        ).view(np.uint8),
        light,
        blocks.light(light.shape),
        blocks.texture(light.shape),
    )
    return np.asarray(cv2.dilate(odd, DISC, dst=odd).view(np.bool_))


def _above(light: Singles, blocks: _Blocks) -> Singles:
    ground = blocks.light(light.shape)
    return np.asarray(np.subtract(light, ground, out=ground))


def _is_unlike(above: Singles, texture: Singles) -> NDArray[np.uint8]:
    return (np.abs(above) > UNLIKE_SIGMA * texture).view(np.uint8)


def _kinds(unlike: NDArray[np.uint8], cast: NDArray[np.uint8], above: Singles) -> NDArray[np.uint8]:
    rock = np.where(np.exp(above) < DARK, np.uint8(SHADED), np.uint8(LIT))
    return np.where(cast > 0, np.uint8(CAST), np.where(unlike > 0, rock, np.uint8(GROUND)))


def _ground(light: Singles, odd: Mask, block: int) -> _Blocks:
    """Median and scatter of the light of blocks without what is odd."""
    rows, cols = light.shape
    down, across = max(1, rows // block), max(1, cols // block)
    high, wide = min(block, rows), min(block, cols)
    # neighbours are alike, for the light is smoothed: every other row and column tells as much
    size = (down, high, across, wide)
    values = np.where(_thinned(odd, size), np.nan, _thinned(light, size))
    values = values.reshape(down, across, -1)
    values.sort(axis=2)  # NaN last
    count = np.isfinite(values).sum(axis=2)
    bare = count > BARE_SHARE * values.shape[2]
    if not bare.any():
        bare = count == count.max()
    middle = _median(values, count)
    scatter = MEDIAN_TO_SIGMA * _median(np.sort(np.abs(values - middle[..., None]), axis=2), count)
    nearest = ndi.distance_transform_edt(~bare, return_distances=False, return_indices=True)
    filled = (
        ndi.median_filter(part[tuple(nearest)], 5, mode="nearest").astype(np.float32)
        for part in (middle, scatter)
    )
    return _Blocks(*filled)


def _thinned(pixels: NDArray[Any], size: tuple[int, int, int, int]) -> NDArray[Any]:
    """Every other row and column of blocks, (down, across, rows, cols), of size (d, h, a, w)."""
    down, high, across, wide = size
    blocks = pixels[: down * high, : across * wide].reshape(size)
    return blocks[:, ::2, :, ::2].transpose(0, 2, 1, 3)


def _median(ordered: NDArray[np.floating], count: NDArray[np.intp]) -> NDArray[np.floating]:
    """Median along the last axis of values in order, of which the first `count` are known."""
    place = np.maximum(count - 1, 0)[..., None] // 2
    found: NDArray[np.floating] = np.take_along_axis(ordered, place, axis=-1)[..., 0]
    return np.asarray(np.nan_to_num(found))


def _cast_shadows(above: Singles, unlike: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Ground in shadow (rows, cols), 1 where it is, from the brightness above the ground's."""
    edges = np.arange(-4.0, 0.0, 0.04)
    rim = by_strips(_dark_rim, unlike, above, halo=2 * RIM_PX[1])
    if np.count_nonzero(rim) < MIN_DARK:
        return np.zeros_like(unlike)
    counts = ndi.gaussian_filter1d(np.histogram(above[rim], bins=edges)[0].astype(float), 2)
    del rim
    shade = edges[counts.argmax()] + 0.02

    def in_shadow(unlike: NDArray[np.uint8], above: Singles) -> NDArray[np.uint8]:
        smooth = cv2.GaussianBlur(above, (0, 0), BLUR_PX) - shade
        found = (smooth > np.log(CAST_LOW)) & (smooth < np.log(CAST_HIGH))
        return np.asarray(_is_dark(unlike, above) & found, dtype=np.uint8)

    cast = by_strips(in_shadow, unlike, above, halo=HALO)
    return np.asarray(cv2.morphologyEx(cast, cv2.MORPH_OPEN, DISC), dtype=np.uint8)


def _is_dark(unlike: NDArray[np.uint8], above: Singles) -> Mask:
    return np.asarray((unlike > 0) & (above < np.log(DARK)))


def _dark_rim(unlike: NDArray[np.uint8], above: Singles) -> Mask:
    inner = cv2.distanceTransform(unlike, cv2.DIST_L2, 5)
    return _is_dark(unlike, above) & (inner > RIM_PX[0]) & (inner < RIM_PX[1])

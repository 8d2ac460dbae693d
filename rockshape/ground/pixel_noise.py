"""How far the measured range scatters, told by the ground."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from rockshape.ground import Plane  # brings scipy.optimize, a fifth of a second

APART_PX = 12  # pixels this far apart share no matching window, and nearly the same ground
MAX_WINDOW_PX = 11
MIN_PAIRS = 200
GRAZING = 0.1  # rays flatter than this over their depth tell more of the plane than of the range
SCALE = 1.4826  # standard deviation of normal values over their median absolute one


@dataclass(frozen=True)
class RangeNoise:
    """Normal errors of z-depth with standard deviation k z², even over a window of the image.

    The correlation of two pixels falls linearly with their distance and is 0 from the window's side
    on, in rows and in columns, as errors of a stereo matcher do.
    """

    per_square_m: float  # k in 1/m: disparity error over focal length and baseline
    window_px: int

    def depth_sd_m(self, depth_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Standard deviation of each z-depth."""
        return np.asarray(self.per_square_m * depth_m**2)

    def draw_m(
        self, depth_m: NDArray[np.float64], *, rng: np.random.Generator
    ) -> NDArray[np.float64]:
        """One draw of errors for a window of the image, depth_m (rows, cols)."""
        white = rng.standard_normal(depth_m.shape)
        side = (self.window_px, self.window_px)
        even = cv2.boxFilter(white, -1, side, normalize=False, borderType=cv2.BORDER_REFLECT)
        return self.depth_sd_m(depth_m) * even / self.window_px


def estimate_range_noise(
    points_m: NDArray[np.float64], ground: "Plane", rocks: NDArray[np.bool_]
) -> RangeNoise | None:
    """The noise of a range image (rows, cols, 3), from its ground outside the rocks (rows, cols).

    A point's error of depth is its height over the plane divided by the cosine-like n . p/z, and
    q = error/z² has one scale for the whole frame. Half the variance of q's difference between
    pixels 12 apart is k²: the ground's own swells, much longer, cancel. Between neighbours it is
    k²/window. Both variances are taken from median absolute differences, which stones do not move.

    None where fewer than 200 pairs of ground pixels are known.
    """
    depth = points_m[..., 2]
    with np.errstate(invalid="ignore", divide="ignore"):
        slant = points_m @ ground.normal / depth
        error = ground.height_m(points_m) / slant / depth**2
        known = ~rocks & (depth > 0) & (slant < -GRAZING) & np.isfinite(error)
    known &= np.abs(ground.height_m(points_m)) <= 4 * max(ground.sigma_m, 1e-9)
    error = np.where(known, error, np.nan)
    far = np.abs(error[:, APART_PX:] - error[:, :-APART_PX])
    near = np.abs(error[:, 1:] - error[:, :-1])
    far, near = far[np.isfinite(far)], near[np.isfinite(near)]
    if len(far) < MIN_PAIRS or len(near) < MIN_PAIRS:
        return None
    apart, beside = float(np.median(far)), float(np.median(near))
    share = (apart / beside) ** 2 if beside > 0 else 1.0
    window = int(np.clip(2 * round((share - 1) / 2) + 1, 1, MAX_WINDOW_PX))
    return RangeNoise(per_square_m=SCALE * apart / np.sqrt(2), window_px=window)

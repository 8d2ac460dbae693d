"""Logarithm of the image's brightness, in which edges are as strong in the shade as in the sun."""

import cv2
import numpy as np

from rockshape.numerics.arrays import Singles
from rockshape.numerics.strips import by_strips

DARKEST = np.float32(1 / 255)
HALO = 16  # rows beyond a strip that blurring it looks at, and more


def blurred_light(image: Singles, sigma_px: float) -> Singles:
    """Logarithm of the brightness (rows, cols), of 1/255 at least, blurred."""

    def blurred(strip: Singles) -> Singles:
        light = np.log(np.maximum(strip, DARKEST))
        return np.asarray(cv2.GaussianBlur(light, (0, 0), sigma_px), dtype=np.float32)

    return by_strips(blurred, image, halo=HALO)

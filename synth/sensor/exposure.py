"""Exposure: from light to grey levels, with shot and read noise, bits and JPEG."""

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.sensor.development import Development, blurred, toned
from synth.spec.sensor import SensorSpec

Picture = NDArray[np.uint8] | NDArray[np.uint16]

_PLAIN = Development()
_SHIFT = 4  # 12 bits stand in the upper bits of 16, so that white is white to any reader


def take_picture(
    light: NDArray[np.float32],
    sensor: SensorSpec,
    *,
    rng: np.random.Generator,
    development: Development = _PLAIN,
) -> Picture:
    """Levels, (rows, cols) or (rows, cols, 3) in R, G, B, of light where 1 is white.

    A pixel collects Poisson(L e N) electrons of the full well N at exposure e, plus normal read
    noise; level = round((2^bits − 1) electrons/N), clipped. 12 bits are returned times 16, in
    16 bits. JPEG's loss is in the levels: the picture is compressed and opened again. Between
    light and noise stands the lens's blur, between noise and levels the tone curve.
    """
    exposed = sensor.exposure * development.gain * blurred(light, development).astype(np.float64)
    if sensor.full_well_e is not None:
        electrons = rng.poisson(sensor.full_well_e * exposed).astype(np.float64)
        electrons += rng.normal(0.0, sensor.read_noise_e, size=light.shape)
        exposed = electrons / sensor.full_well_e
    white = 2**sensor.bits - 1
    levels = np.rint(toned(exposed, development) * white)
    if sensor.bits > 8:
        return np.asarray(levels * 2**_SHIFT, dtype=np.uint16)
    picture: NDArray[np.uint8] = levels.astype(np.uint8)
    if sensor.jpeg_quality is None:
        return picture
    return _compressed(picture, sensor.jpeg_quality)


def _compressed(picture: NDArray[np.uint8], quality: int) -> NDArray[np.uint8]:
    """Picture compressed as JPEG and opened again."""
    coloured = picture.ndim == 3
    stored = np.ascontiguousarray(picture[..., ::-1]) if coloured else picture
    _, data = cv2.imencode(".jpg", stored, [cv2.IMWRITE_JPEG_QUALITY, quality])
    opened = np.asarray(
        cv2.imdecode(data, cv2.IMREAD_COLOR if coloured else cv2.IMREAD_GRAYSCALE), dtype=np.uint8
    )
    return np.ascontiguousarray(opened[..., ::-1]) if coloured else opened


def eight_bits(picture: Picture) -> NDArray[np.uint8]:
    """Picture's upper eight bits."""
    shift = 0 if picture.dtype == np.uint8 else 8
    return np.asarray(picture >> shift, dtype=np.uint8)

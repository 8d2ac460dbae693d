"""Photograph of a lit bed: light to a picture of 8 bits, with a camera's faults."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.spec.bed import BedPhotoSpec

Bytes = NDArray[np.uint8]

_GREY = np.array([0.299, 0.587, 0.114], dtype=np.float32)
_READ = 0.35  # share of the noise's variance at the mean that is there in the dark


@dataclass(frozen=True)
class Photograph:
    """Settings of one photograph."""

    brightness: float
    contrast: float
    blur_px: float
    sharpening: float
    noise: float
    jpeg_quality: int | None
    grey: bool
    vignetting: float


def draw_photograph(spec: BedPhotoSpec, rng: np.random.Generator) -> Photograph:
    """Settings drawn from a spec's ranges."""
    quality = spec.jpeg_quality
    drawn = (
        int(rng.integers(1, 101))
        if quality is None
        else int(rng.integers(quality[0], quality[1] + 1))
    )
    return Photograph(
        brightness=rng.uniform(*spec.brightness),
        contrast=rng.uniform(*spec.contrast),
        blur_px=rng.uniform(*spec.blur_px),
        sharpening=rng.uniform(*spec.sharpening),
        noise=float(np.exp(rng.uniform(*np.log(np.maximum(spec.noise, 1e-6))))),
        jpeg_quality=None if quality is None else drawn,
        grey=bool(rng.uniform() < spec.grey),
        vignetting=rng.uniform(0.0, 0.15),
    )


def photograph(light: Singles, photo: Photograph, rng: np.random.Generator) -> Bytes:
    """Picture (rows, cols, 3), red, green, blue, of light (rows, cols, 3) that is linear.

    The exposure gives the mean its brightness in the file; the tone curve is sRGB's, with a
    logistic of the given slope at that mean.
    """
    rows, columns = light.shape[:2]
    if photo.blur_px > 0.05:
        light = np.asarray(cv2.GaussianBlur(light, (0, 0), photo.blur_px), dtype=np.float32)
    grey = light @ _GREY
    light = light * _vignette(rows, columns, photo.vignetting)
    target = photo.brightness**2.2
    # Exposed for the middle of the picture's brightness, so that white stones may burn out.
    mean = float(
        np.clip(np.exp(np.log(np.maximum(grey, 1e-4)).mean()) * 0.4 + grey.mean() * 0.6, 1e-4, None)
    )
    tones = np.power(np.maximum(light * np.float32(target / mean), 0.0), np.float32(1.0 / 2.2))
    tones = _curve(tones, photo.brightness, photo.contrast)
    if photo.sharpening > 0.0:
        soft = cv2.GaussianBlur(tones, (0, 0), 1.0)
        tones = tones + np.float32(photo.sharpening) * (tones - soft)
    noise = rng.standard_normal((rows, columns, 3), dtype=np.float32)
    noise[..., 1:] = np.float32(0.8) * noise[..., :1] + np.float32(0.6) * noise[..., 1:]
    scale = _READ + (1.0 - _READ) * np.clip(tones, 0.0, 1.0) / np.float32(photo.brightness)
    tones = tones + np.float32(photo.noise) * np.sqrt(scale) * noise
    if photo.grey:
        tones = np.repeat((tones @ _GREY)[..., None], 3, axis=-1)
    picture = np.rint(255.0 * np.clip(tones, 0.0, 1.0)).astype(np.uint8)
    return picture if photo.jpeg_quality is None else _jpeg(picture, photo.jpeg_quality)


def _curve(tones: Singles, middle: float, slope: float) -> Singles:
    """Tone curve through 0, the middle and 1: a power below and above it."""
    low = np.float32(middle) * (np.maximum(tones, 0.0) / np.float32(middle)) ** np.float32(slope)
    rest = np.float32(1.0 - middle)
    share = np.maximum(tones - np.float32(middle), 0.0) / rest
    high = np.float32(middle) + rest * (
        1.0 - np.exp(-np.float32(slope) * share * (1.0 + 0.35 * share))
    )
    return np.asarray(np.where(tones <= middle, low, high), dtype=np.float32)


def _vignette(rows: int, columns: int, depth: float) -> Singles:
    across = np.linspace(-1.0, 1.0, columns, dtype=np.float32)[None, :]
    down = np.linspace(-1.0, 1.0, rows, dtype=np.float32)[:, None]
    return np.asarray((1.0 - np.float32(depth / 2.0) * (across**2 + down**2))[..., None])


def _jpeg(picture: Bytes, quality: int) -> Bytes:
    _, data = cv2.imencode(".jpg", picture[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
    decoded = cv2.imdecode(data, cv2.IMREAD_COLOR)
    return np.ascontiguousarray(np.asarray(decoded, dtype=np.uint8)[..., ::-1])

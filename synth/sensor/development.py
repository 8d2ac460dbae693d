"""Development of light into levels: blur, exposure, white balance and the tone curve."""

from dataclasses import dataclass

import cv2
import numpy as np

from synth.arrays import Floats, Singles
from synth.sensor.seeds import Use, stream
from synth.spec import SceneSpec, image_of
from synth.spec.image import ToneName


@dataclass(frozen=True)
class Development:
    """Settings of one picture's development."""

    gain: float = 1.0  # times the exposure
    blur_px: float = 0.0
    balance: tuple[float, float, float] = (1.0, 1.0, 1.0)  # gains of red, green and blue
    tone: ToneName = "linear"
    gamma: float = 2.2


def draw_development(spec: SceneSpec, *, scene: int, view: int) -> Development:
    """Development of one view, the same for all pictures taken there."""
    image = image_of(spec)
    rng = stream(Use.DEVELOPMENT, seed=spec.seed, scene=scene, view=view)
    stops, blur_px = rng.uniform(*image.exposure_stops), rng.uniform(*image.blur_px)
    red, blue = np.exp(image.white_balance * rng.standard_normal(2))
    return Development(
        gain=float(2.0**stops),
        blur_px=float(blur_px),
        balance=(float(red), 1.0, float(blue)),
        tone=image.tone,
        gamma=image.gamma,
    )


def blurred(light: Singles, development: Development) -> Singles:
    """Light, (rows, cols) or (rows, cols, 3), under the lens's normal blur."""
    if development.blur_px == 0.0:
        return light
    return np.asarray(cv2.GaussianBlur(light, (0, 0), development.blur_px), dtype=np.float32)


def toned(exposed: Floats, development: Development) -> Floats:
    """Values from 0 to 1 of exposed light, balanced and through the tone curve.

    `srgb` is IEC 61966-2-1's: 12.92 x up to 0.0031308, else 1.055 x^(1/2.4) − 0.055; `gamma`
    x^(1/γ); `filmic` sRGB's of x (2.51 x + 0.03)/(x (2.43 x + 0.59) + 0.14), which rolls off above
    white (Narkowicz 2015, a fit to ACES).
    """
    if exposed.ndim == 3:
        exposed = exposed * np.array(development.balance)
    if development.tone == "filmic":
        lit = np.maximum(exposed, 0.0)
        exposed = lit * (2.51 * lit + 0.03) / (lit * (2.43 * lit + 0.59) + 0.14)
    clipped = np.clip(exposed, 0.0, 1.0)
    if development.tone == "linear":
        return clipped
    if development.tone == "gamma":
        return np.asarray(clipped ** (1.0 / development.gamma))
    return srgb(clipped)


def srgb(linear: Floats) -> Floats:
    """Encoding of linear values from 0 to 1 (IEC 61966-2-1)."""
    power = 1.055 * np.maximum(linear, 1e-9) ** (1.0 / 2.4) - 0.055
    return np.where(linear <= 0.0031308, 12.92 * linear, power)

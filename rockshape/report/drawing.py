"""Rocks of a page as SVG: outlines, ellipses, numbers and a scale bar, in pixels of the image."""

import base64
import math
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse
from rockshape.measurement import Measurement, Rock
from rockshape.observation import Observation

MOST_PX = 1600  # longer side of the picture that is embedded
_STRAY_PX = 0.25  # of the image, by which a drawn outline may leave the measured one
_REDUCED_STRAY_PX = 0.5  # of the picture, where that is more
_NICE = (1, 2, 5)
_NUMBER_SHARE = 0.03  # of the picture's longer side, at most
_BAR_SHARE = 0.3  # of the picture's width, at most


@dataclass(frozen=True)
class DrawnRock:
    """Lines of one rock: its outline as an SVG path, and where its number stands."""

    number: int
    outline: str
    ellipse: Ellipse | None
    x: float
    y: float
    size: float  # of its number


@dataclass(frozen=True)
class ScaleBar:
    """Bar of a round length."""

    length_px: float
    words: str


def drawing(measurement: Measurement, *, prefix: str = "", most_px: int = MOST_PX) -> str:
    """Content of an SVG in pixels of the image: picture, groups `rock-PREFIXNUMBER`, scale bar."""
    import jinja2  # noqa: PLC0415 - for pages and SVG alone

    rows, cols = measurement.instances.shape
    stray_px = _REDUCED_STRAY_PX * max(rows, cols) / most_px
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["short"] = lambda value: f"{value:.1f}"
    template = (files("rockshape.report") / "drawing.svg").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        rows=rows,
        cols=cols,
        prefix=prefix,
        picture=picture_uri(measurement.observation, most_px=most_px),
        drawn=drawn_rocks(measurement, stray_px=max(_STRAY_PX, stray_px)),
        bar=scale_bar(measurement),
    )


def picture_uri(observation: Observation, *, most_px: int = MOST_PX) -> str:
    """Image, in colour where it has 8 bits of it, as a data URI of a JPEG, reduced if large."""
    colour = observation.colour
    if colour is not None and colour.dtype == np.uint8 and colour.shape[2] == 3:
        pixels = np.ascontiguousarray(colour[..., ::-1])
    else:
        pixels = np.clip(np.rint(observation.image * 255), 0, 255).astype(np.uint8)
    scale = min(1.0, most_px / max(pixels.shape))
    if scale < 1:
        pixels = cv2.resize(pixels, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    jpeg = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, 85])[1]
    return f"data:image/jpeg;base64,{base64.b64encode(jpeg.tobytes()).decode()}"


def drawn_rocks(measurement: Measurement, *, stray_px: float = _STRAY_PX) -> Iterator[DrawnRock]:
    """Yield the lines of each rock, small ones last, so that they lie above."""
    most = _NUMBER_SHARE * max(measurement.instances.shape)
    for rock in sorted(measurement, key=lambda each: -each.area_px):
        yield DrawnRock(
            number=rock.number,
            outline=_path(_simplified(rock.outline_px, stray_px)),
            ellipse=rock.ellipse,
            x=round(rock.col, 1),
            y=round(rock.row, 1),
            size=round(min(_number_size(rock), most), 1),
        )


def scale_bar(measurement: Measurement) -> ScaleBar | None:
    """Bar of 1, 2 or 5 times a power of ten of millimetres; None where rocks have other scales."""
    pixels = {rock.sizes.pixel_m for rock in measurement if rock.sizes is not None}
    if len(pixels) != 1 or not math.isfinite(pixel_m := pixels.pop()):
        return None
    most_mm = 1e3 * pixel_m * _BAR_SHARE * measurement.instances.shape[1]
    power = 10.0 ** math.floor(math.log10(most_mm))
    length_mm = max(step * power for step in _NICE if step * power <= most_mm)
    words = f"{length_mm:g} mm" if length_mm < 1000 else f"{length_mm / 1000:g} m"
    return ScaleBar(length_mm / (1e3 * pixel_m), words)


def _simplified(outline_px: NDArray[np.float64], stray_px: float) -> NDArray[np.float64]:
    curve = outline_px.astype(np.float32)[:, None]
    return np.asarray(cv2.approxPolyDP(curve, stray_px, closed=True)[:, 0], dtype=np.float64)


def _path(points: NDArray[np.float64]) -> str:
    """Closed path; a pixel's centre at x is drawn at x + 1/2, since the picture begins at 0."""
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points + 0.5) + "Z"


def _number_size(rock: Rock) -> float:
    """Height of a number that leaves most of its rock in sight."""
    digits = len(str(rock.number))
    return max(4.0, min(0.35 * rock.height_px, 0.8 * rock.width_px / digits))

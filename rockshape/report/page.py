"""The page of `rockshape measure --report`: self-contained HTML."""

import base64
from importlib.resources import files

import cv2
import jinja2
import numpy as np
from numpy.typing import NDArray

from rockshape.measurement import AXES, DESCRIPTORS, Measurement, to_frame
from rockshape.report.overlay import overlay

DIGITS = 4


def render_page(title: str, image: NDArray[np.float32], measurement: Measurement) -> str:
    """HTML that shows the image, (rows, cols) from 0 to 1, with its rocks and their table."""
    picture = cv2.cvtColor(overlay(image, measurement), cv2.COLOR_RGB2BGR)
    jpeg = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 88])[1]
    measures = measurement.measures
    frame = to_frame(measurement)
    described = DESCRIPTORS.values() if measurement.described else ()
    numbers = ["area_px", *AXES, *(measure.column for measure in measures), *described]
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["number"] = lambda value: "" if np.isnan(value) else f"{value:.{DIGITS}g}"
    template = (files("rockshape.report") / "page.html").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        title=title,
        method=measurement.method,
        picture=base64.b64encode(jpeg.tobytes()).decode(),
        ground=measurement.ground,
        measures=measures,
        numbers=numbers,
        rocks=frame.to_dict(orient="records"),
    )

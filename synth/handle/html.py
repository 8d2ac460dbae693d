"""HTML of a view for notebooks: small images and the truth's table."""

import base64
from html import escape
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import ColourImage, DepthImage, Image, LabelImage
from synth.dataset.depth_colours import depth_colours
from synth.sensor.exposure import eight_bits

if TYPE_CHECKING:
    import pandas as pd

_WIDEST_PX = 360
_SHOWN = (
    "id",
    "family",
    "half_axis_a_m",
    "maximum_projection_sphericity",
    "roundness",
    "outline_axis_ratio",
    "outline_roundness",
    "visible_fraction",
    "truncated",
)
_MOST_ROWS = 12


def figure_html(
    image: Image | ColourImage | LabelImage,
    depth_m: DepthImage | None,
    *,
    caption: str,
    table: "pd.DataFrame",
) -> str:
    """HTML of an image, its depth in colours if there is one, and the first rows of a table."""
    shown: NDArray[Any] = image if image.dtype == np.uint8 else eight_bits(image)
    shown = shown if shown.ndim == 2 else np.ascontiguousarray(shown[..., ::-1])
    images = [_tag(shown)]
    if depth_m is not None:
        images.append(_tag(depth_colours(depth_m, np.isfinite(depth_m), paper=255)))
    columns = [name for name in _SHOWN if name in table] or list(table.columns)
    rows = table[columns].head(_MOST_ROWS).to_html(index=False, float_format="{:.3g}".format)
    return f"<p>{escape(caption)}</p><p>{' '.join(images)}</p>{rows}"


def _tag(image: NDArray[Any]) -> str:
    factor = min(1.0, _WIDEST_PX / image.shape[1])
    size = (round(image.shape[1] * factor), round(image.shape[0] * factor))
    _, data = cv2.imencode(".png", cv2.resize(image, size, interpolation=cv2.INTER_AREA))
    text = base64.b64encode(data.tobytes()).decode("ascii")
    return f'<img src="data:image/png;base64,{text}" width="{size[0]}" height="{size[1]}">'

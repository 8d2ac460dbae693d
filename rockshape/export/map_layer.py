"""Map layer: measured outlines in map coordinates with the values of each rock, as GeoJSON.

Source: RFC 7946 for the layout; the member `crs` is that of the GeoJSON of 2008, which GDAL and
QGIS read where coordinates are not degrees of WGS 84.
"""

import json
import math
from typing import Any

import numpy as np

from rockshape.camera.map_frame import MapFrame
from rockshape.errors import InputError
from rockshape.measurement import Measurement, to_frame
from rockshape.observation import Observation

SUFFIXES = (".geojson", ".json")
_WGS_84 = 4326  # RFC 7946's own system
_DIGITS_PX = 3  # of a place, that are kept


def map_layer(measurement: Measurement, *, flags: bool = False) -> bytes:
    """GeoJSON with a polygon a rock; its properties are the columns of the table.

    Raises: InputError for an image whose place on a map is not known.
    """
    frame = map_frame_of(measurement.observation)
    pixel = float(np.sqrt(abs(np.linalg.det(frame.matrix[:, :2]))))
    digits = max(0, _DIGITS_PX - math.floor(math.log10(pixel)))
    rows = to_frame(measurement, flags=flags).to_dict(orient="records")
    features = []
    for rock, row in zip(measurement, rows, strict=True):
        ring = np.round(frame.place(rock.outline_px), digits)
        x, y = (ring - ring[0]).T
        if np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) < 0:  # RFC 7946: counterclockwise
            ring = ring[::-1]
        features.append(
            {
                "type": "Feature",
                "id": rock.number,
                "properties": {str(name): _plain(value) for name, value in row.items()},
                "geometry": {
                    "type": "Polygon",
                    "coordinates": [[*ring.tolist(), ring[0].tolist()]],
                },
            }
        )
    content: dict[str, Any] = {"type": "FeatureCollection"}
    if frame.epsg not in (None, _WGS_84):
        name = f"urn:ogc:def:crs:EPSG::{frame.epsg}"
        content["crs"] = {"type": "name", "properties": {"name": name}}
    return json.dumps({**content, "features": features}).encode()


def map_frame_of(observation: Observation) -> MapFrame:
    """Map frame of an image. Raises: InputError for an image that has none."""
    if observation.map_frame is None:
        raise InputError(
            "--map: expected an image with map coordinates, a GeoTIFF without --camera, found none"
        )
    return observation.map_frame


def _plain(value: Any) -> Any:
    """Value as JSON has it; null where it is missing."""
    plain = value.item() if isinstance(value, np.generic) else value
    return None if isinstance(plain, float) and not math.isfinite(plain) else plain

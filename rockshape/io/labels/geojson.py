"""GeoJSON polygons in pixel coordinates, as QuPath exports them.

Source: RFC 7946, sections 3.1 to 3.3 and 4.
"""

import json
import re
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from rockshape.errors import InputError
from rockshape.io.decoding.json_text import load_json
from rockshape.io.decoding.outlined import Entry, UnreadableError, collect, polygons_mask
from rockshape.io.encoding.pixel_rings import pixel_rings, signed_area
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from rockshape.io.encoding.pixel_rings import Ring
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instance, Instances

EXPECTED = "GeoJSON features in pixel coordinates"
GEOMETRIES = ("Polygon", "MultiPolygon", "GeometryCollection")
_TYPE = re.compile(
    rb'(\xef\xbb\xbf)?\s*[\[{].*"type"\s*:\s*"(FeatureCollection|Feature|(Multi)?Polygon)"',
    re.DOTALL,
)


def is_geojson(head: bytes) -> bool:
    """Whether content is a feature or several, or a polygon."""
    return bool(_TYPE.match(head))


def read_geojson(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of polygons, whose holes are no rock; with the feature's id where it has one.

    Coordinates are x to the right and y down from the image's upper left corner. Other geometry is
    left out, and a note counts it.
    Raises: InputError for no GeoJSON, for one with a coordinate reference system, and where no
        polygon lies in the image.
    """
    features = _features(file, load_json(file, EXPECTED))
    instances = collect(file, info, [_entry(each, info) for each in features], noun="feature")
    if features and not len(instances):
        raise InputError(
            f"{file.path}: expected pixel coordinates, x to the right and y down, "
            f"found no polygon in the image"
        )
    return instances


def _features(file: "InputFile", content: Any) -> list[dict[str, Any]]:
    if isinstance(content, dict) and content.get("crs"):
        raise InputError(
            f"{file.path}: expected pixel coordinates, found a coordinate reference system"
        )
    listed = content.get("features", [content]) if isinstance(content, dict) else content
    if not isinstance(listed, list):
        raise InputError(f"{file.path}: expected {EXPECTED}, found other JSON")
    return [each if isinstance(each, dict) else {} for each in listed]


def _entry(feature: dict[str, Any], info: ImageInfo) -> Entry:
    properties = feature.get("properties")
    told = properties if isinstance(properties, dict) else {}
    geometry = feature.get("geometry") if "geometry" in feature else feature
    return Entry(
        feature.get("id", told.get("id")), lambda: polygons_mask(_polygons(geometry), info.shape)
    )


def _polygons(geometry: object) -> list[Any]:
    """Polygons of a geometry, each a list of rings."""
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    if not isinstance(geometry, dict) or kind not in GEOMETRIES:
        raise UnreadableError(f"of geometry {kind}")
    if kind == "GeometryCollection":
        parts = geometry.get("geometries")
        return [each for part in (parts or []) for each in _polygons(part)]
    coordinates = geometry.get("coordinates")
    polygons = [coordinates] if kind == "Polygon" else coordinates
    if not isinstance(polygons, list) or not all(isinstance(each, list) for each in polygons):
        raise UnreadableError("without coordinates")
    return polygons


def write_geojson(instances: "Instances") -> bytes:
    """Feature a rock, with polygons of pixel corners that hold exactly its pixels."""
    features = [
        {
            "type": "Feature",
            "id": each.id,
            "properties": {"id": each.id},
            "geometry": {"type": "MultiPolygon", "coordinates": _coordinates(each)},
        }
        for each in instances
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}).encode()


def _coordinates(instance: "Instance") -> list[Any]:
    """Polygons, each its outer ring and those of its holes, closed."""
    rows, cols = instance.window
    rings = pixel_rings(instance.mask)
    outer = [ring for ring in rings if signed_area(ring) > 0]
    holes = [ring for ring in rings if signed_area(ring) < 0]
    polygons = [[ring] for ring in outer]
    for hole in holes:
        around = [each for each in polygons if _holds(each[0], hole[0])]
        min(around, key=lambda each: signed_area(each[0])).append(hole)
    corner = cols.start, rows.start
    return [
        [(np.vstack([ring, ring[:1]]) + corner).tolist() for ring in polygon]
        for polygon in polygons
    ]


def _holds(ring: "Ring", corner: "Ring") -> bool:
    """Whether a ring goes round a corner of another or touches it."""
    return cv2.pointPolygonTest(ring.astype(np.float32), corner.astype(float).tolist(), False) >= 0


FORMAT = LabelFormat(
    name="GeoJSON",
    suffixes=(".geojson", ".json"),
    summary="polygons with holes in pixel coordinates, as QuPath exports them; may overlap",
    tested_with="RFC 7946, QuPath export",
    sniff=is_geojson,
    read=read_geojson,
    write=write_geojson,
)

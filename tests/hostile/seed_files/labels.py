"""Label files of the scene's two discs."""

import base64
import io
import zipfile
from collections.abc import Iterator

import numpy as np
import roifile

from tests.hostile.scene import SHAPE, corners, labels
from tests.hostile.seed_files.encoding import File, as_json, npy, npz, pillow, tiff


def files() -> Iterator[File]:
    """Labels of each format."""
    yield from _rasters()
    yield "COCO", ".json", _coco()
    yield from _detections()
    yield "LabelMe", ".json", _labelme()
    yield "YOLO segmentation", ".txt", _yolo()
    yield "GeoJSON", ".geojson", _geojson()
    regions = [roifile.ImagejRoi.frompoints(np.array(each, np.float32)) for each in corners()]
    yield "ImageJ ROI", ".roi", regions[0].tobytes()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, region in enumerate(regions):
            archive.writestr(f"{number}.roi", region.tobytes())
    yield "ImageJ RoiSet", ".zip", stream.getvalue()


def masks() -> dict[str, bytes]:
    """Files of a folder of masks, by name."""
    return {f"rock_{n}.png": pillow(labels() == n, "PNG") for n in (1, 2)}


def _rasters() -> Iterator[File]:
    found = labels()
    for name, suffix in (("PNG", ".png"), ("BMP", ".bmp")):
        yield name, suffix, pillow(found.astype(np.uint8), name)
        yield name, suffix, pillow(found > 0, name)
    yield "PGM", ".pgm", pillow(found.astype(np.uint8), "PPM")
    yield "PGM", ".pgm", pillow(found, "PPM")
    words = " ".join(map(str, found.ravel()))
    yield "PGM", ".pgm", f"P2 {SHAPE[1]} {SHAPE[0]} 2 {words}\n".encode()
    in_colours = np.dstack([found.astype(np.uint8)] * 3)
    yield "WebP", ".webp", pillow(in_colours, "WebP", lossless=True)
    stack = np.stack([found == number for number in (1, 2)]).astype(np.uint8)
    yield "TIFF", ".tif", tiff(found)
    yield "TIFF", ".tif", tiff(stack, photometric="minisblack")
    yield "NPY", ".npy", npy(found)
    yield "NPY", ".npy", npy(stack)
    yield "NPZ", ".npz", npz(labels=found)
    told = {"masks": found, "outlines": found, "filename": "scene.png", "diameter": np.float64(20)}
    yield "Cellpose", ".npy", npy(told)


def _run_lengths(mask: np.ndarray) -> dict[str, object]:
    """Uncompressed run lengths by columns, of zeros first."""
    values = np.concatenate([[False], mask.ravel(order="F"), [False]])
    changes = np.flatnonzero(values[1:] != values[:-1])
    ends = np.concatenate([[0], changes, [] if changes[-1] == mask.size else [mask.size]])
    return {"size": list(SHAPE), "counts": np.diff(ends).astype(int).tolist()}


def _flat(polygon: list[tuple[float, float]]) -> list[float]:
    return [number for corner in polygon for number in corner]


def _coco() -> bytes:
    outlines = [[_flat(corners()[0])], _run_lengths(labels() == 2)]
    own = {"image_id": 1, "category_id": 1, "iscrowd": 0}
    return as_json(
        {
            "images": [{"id": 1, "file_name": "scene.png", "width": 64, "height": 48}],
            "categories": [{"id": 1, "name": "rock"}],
            "annotations": [
                {"id": number, "segmentation": outline, **own}
                for number, outline in enumerate(outlines, start=1)
            ],
        }
    )


def _detections() -> Iterator[File]:
    outlines = [_run_lengths(labels() == number) for number in (1, 2)]
    listed = [{"image_id": 1, "score": 0.9, "segmentation": each} for each in outlines]
    yield "COCO results", ".json", as_json(listed)
    told = {"predicted_iou": 0.98, "stability_score": 0.97, "area": 400, "bbox": [0, 0, 9, 9]}
    yield (
        "Segment Anything",
        ".json",
        as_json([{"segmentation": each, **told} for each in outlines]),
    )


def _labelme() -> bytes:
    png = base64.b64encode(pillow(np.ones((9, 9), bool), "PNG")).decode()
    shapes = [
        {"shape_type": "polygon", "points": corners()[0]},
        {"shape_type": "rectangle", "points": [[30, 5], [40, 15]]},
        {"shape_type": "circle", "points": [[47, 22], [56, 22]]},
        {"shape_type": "mask", "points": [[30, 30], [38, 38]], "mask": png},
    ]
    told = {"label": "rock", "group_id": None}
    size = {"imageHeight": SHAPE[0], "imageWidth": SHAPE[1]}
    return as_json({"version": "5.4.1", "shapes": [each | told for each in shapes], **size})


def _yolo() -> bytes:
    lines = [" ".join(f"{x / 64:.6f} {y / 48:.6f}" for x, y in each) for each in corners()]
    return "".join(f"0 {line}\n" for line in lines).encode()


def _geojson() -> bytes:
    rings = [[*each, each[0]] for each in corners()]
    geometries = [
        {"type": "Polygon", "coordinates": [rings[0]]},
        {"type": "MultiPolygon", "coordinates": [[rings[1]]]},
    ]
    features = [
        {"type": "Feature", "id": number, "geometry": geometry, "properties": {}}
        for number, geometry in enumerate(geometries, start=1)
    ]
    return as_json({"type": "FeatureCollection", "features": features})

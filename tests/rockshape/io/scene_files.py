"""One scene as a file of each format of images and labels, from writers that are not ours.

Where no light writer exists the file is transcribed from the format's specification, which the
registry's record names.
"""

import json
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import roifile
import tifffile
from PIL import Image
from pycocotools import mask as coco_mask

from tests.hostile.seed_files.encoding import pds3
from tests.rockshape.io.test_pds_images import PDS4

SHAPE = (120, 160)
Make = Callable[[Path], Path]


@cache
def rocks() -> dict[int, np.ndarray]:
    """Masks of three rocks by id; each row of one is without a gap."""
    rows, cols = np.mgrid[: SHAPE[0], : SHAPE[1]]
    ellipses = {3: (30, 40, 22, 15, 0.4), 7: (80, 50, 18, 24, 1.1), 200: (60, 120, 30, 21, 2.0)}
    masks = {}
    for number, (row, col, long, short, turn) in ellipses.items():
        along = (cols - col) * np.cos(turn) + (rows - row) * np.sin(turn)
        across = (rows - row) * np.cos(turn) - (cols - col) * np.sin(turn)
        masks[number] = (along / long) ** 2 + (across / short) ** 2 <= 1
    return masks


@cache
def label_image() -> np.ndarray:
    """Rock ids (rows, cols)."""
    return sum(number * mask for number, mask in rocks().items()).astype(np.uint8)


@cache
def picture() -> np.ndarray:
    """Grey levels (rows, cols) of bright rocks with dark bases on sand."""
    rng = np.random.default_rng(11)
    sand = cv2.GaussianBlur(rng.normal(size=SHAPE), (0, 0), 1.5)
    levels = 95 + 12 * sand / sand.std()
    shade = 1 + 0.25 * np.cos(np.arange(SHAPE[1]) / 6)
    levels = np.where(label_image() > 0, 175 * shade.clip(0.8, 1.2), levels)
    return np.rint(cv2.GaussianBlur(levels, (0, 0), 0.8)).clip(0, 255).astype(np.uint8)


def corners(mask: np.ndarray) -> list[list[int]]:
    """Pixel corners round a mask whose rows have no gaps, clockwise; x and y."""
    spans = [(row, np.flatnonzero(mask[row])) for row in np.flatnonzero(mask.any(axis=1))]
    right = [[int(at[-1]) + 1, int(row) + step] for row, at in spans for step in (0, 1)]
    left = [[int(at[0]), int(row) + step] for row, at in reversed(spans) for step in (1, 0)]
    return [*right, *left]


def saved(path: Path, save: Callable[[str], object]) -> Path:
    save(str(path))
    return path


def written(path: Path, content: object) -> Path:
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return path


def run_lengths(mask: np.ndarray) -> dict[str, object]:
    packed = coco_mask.encode(np.asfortranarray(mask.astype(np.uint8)))
    return {"size": list(packed["size"]), "counts": packed["counts"].decode()}


def _pds3(folder: Path) -> Path:
    """After the PDS Standards Reference 3.8, appendix A, IMAGE."""
    path = folder / "frame.img"
    path.write_bytes(pds3(picture(), sample_type="UNSIGNED_INTEGER"))
    return path


def _pds4(folder: Path) -> Path:
    (folder / "frame.dat").write_bytes(picture().tobytes())
    text = PDS4.replace("SignedMSB2", "UnsignedByte")
    text = text.replace("<elements>12<", f"<elements>{SHAPE[0]}<")
    return written(folder / "frame.xml", text.replace("<elements>20<", f"<elements>{SHAPE[1]}<"))


IMAGES: dict[str, Make] = {
    "PNG": lambda f: saved(f / "i.png", lambda at: cv2.imwrite(at, picture())),
    "JPEG": lambda f: saved(
        f / "i.jpg", lambda at: cv2.imwrite(at, picture(), [cv2.IMWRITE_JPEG_QUALITY, 100])
    ),
    "TIFF": lambda f: saved(f / "i.tif", lambda at: tifffile.imwrite(at, picture())),
    "WebP": lambda f: saved(
        f / "i.webp", lambda at: Image.fromarray(picture()).save(at, lossless=True)
    ),
    "BMP": lambda f: saved(f / "i.bmp", lambda at: Image.fromarray(picture()).save(at)),
    "Netpbm": lambda f: saved(f / "i.pgm", lambda at: Image.fromarray(picture()).save(at)),
    "PDS3": _pds3,
    "PDS4": _pds4,
}


def _rois() -> Iterator[roifile.ImagejRoi]:
    for number, mask in rocks().items():
        outline = np.array(corners(mask), dtype=np.float32)
        yield roifile.ImagejRoi.frompoints(outline, name=str(number))


def _masks(folder: Path) -> Path:
    place = folder / "masks"
    place.mkdir()
    for number, mask in rocks().items():
        Image.fromarray(mask).save(place / f"rock_{number}.png")
    return place


def _coco() -> dict[str, object]:
    rows, cols = SHAPE
    return {
        "images": [{"id": 1, "width": cols, "height": rows, "file_name": "i.png"}],
        "annotations": [
            {"id": number, "image_id": 1, "iscrowd": 0, "segmentation": run_lengths(mask)}
            for number, mask in rocks().items()
        ],
    }


def _labelme() -> dict[str, object]:
    """After labelme 5's LabelFile.save."""
    shapes = [
        {"label": "rock", "points": corners(mask), "group_id": None, "shape_type": "polygon"}
        for mask in rocks().values()
    ]
    size = {"imageHeight": SHAPE[0], "imageWidth": SHAPE[1]}
    return {"version": "5.4.1", "flags": {}, "shapes": shapes, "imagePath": "i.png", **size}


def _geojson() -> dict[str, object]:
    """After RFC 7946, as QuPath exports it."""
    features = [
        {
            "type": "Feature",
            "id": number,
            "geometry": {"type": "Polygon", "coordinates": [[*outline, outline[0]]]},
            "properties": {"objectType": "annotation"},
        }
        for number, outline in ((number, corners(mask)) for number, mask in rocks().items())
    ]
    return {"type": "FeatureCollection", "features": features}


def _yolo() -> str:
    """After the Ultralytics data format: class, then corners in fractions of the image's sides."""
    lines = []
    for mask in rocks().values():
        fractions = np.array(corners(mask)) / (SHAPE[1], SHAPE[0])
        lines.append(" ".join(["0", *(f"{value:.9f}" for value in fractions.ravel())]))
    return "\n".join([*lines, ""])


def _detections(**more: object) -> list[dict[str, object]]:
    return [{"segmentation": run_lengths(mask), **more} for mask in rocks().values()]


SAM_KEYS = {"predicted_iou": 0.98, "stability_score": 0.97, "bbox": [0, 0, 1, 1]}
RESULT_KEYS = {"image_id": 1, "category_id": 1, "score": 0.9}
CELLPOSE = {"outlines": np.zeros(SHAPE, np.uint16), "filename": "i.png"}  # cellpose.io's keys
LABELS: dict[str, Make] = {
    "PNG": lambda f: saved(f / "l.png", lambda at: Image.fromarray(label_image()).save(at)),
    "TIFF": lambda f: saved(
        f / "l.tif", lambda at: tifffile.imwrite(at, label_image().astype(np.int32))
    ),
    "Cellpose": lambda f: saved(
        f / "i_seg.npy", lambda at: np.save(at, {**CELLPOSE, "masks": label_image()})
    ),
    "NPY": lambda f: saved(f / "l.npy", lambda at: np.save(at, label_image())),
    "ImageJ RoiSet": lambda f: saved(
        f / "RoiSet.zip", lambda at: roifile.roiwrite(at, list(_rois()), mode="w")
    ),
    "ImageJ ROI": lambda f: saved(f / "one.roi", lambda at: next(_rois()).tofile(at)),
    "NPZ": lambda f: saved(f / "l.npz", lambda at: np.savez(at, labels=label_image())),
    "BMP": lambda f: saved(f / "l.bmp", lambda at: cv2.imwrite(at, label_image())),
    "PGM": lambda f: saved(f / "l.pgm", lambda at: cv2.imwrite(at, label_image())),
    "WebP": lambda f: saved(
        f / "l.webp", lambda at: Image.fromarray(label_image()).save(at, lossless=True)
    ),
    "LabelMe": lambda f: written(f / "l.json", _labelme()),
    "GeoJSON": lambda f: written(f / "l.geojson", _geojson()),
    "Segment Anything": lambda f: written(f / "l.json", _detections(**SAM_KEYS)),
    "COCO results": lambda f: written(f / "l.json", _detections(**RESULT_KEYS)),
    "COCO": lambda f: written(f / "l.json", _coco()),
    "YOLO segmentation": lambda f: written(f / "i.txt", _yolo()),
    "mask folder": _masks,
}

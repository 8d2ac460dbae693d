"""Valid small files of each format, which the corpus and the fuzzers damage.

Formats come from the registry: one that writes makes its own seeds, and one that has none here is
tried on the seeds of all other formats under its own suffixes.
"""

import io
import json
import zipfile
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
import tifffile
from PIL import Image

from rockshape.io.format import Format
from rockshape.io.registry import known_formats
from rockshape.rock.instances import Instances

SHAPE = (48, 64)  # rows, columns of every seed
CAMERA = {"fx": 80.0, "fy": 80.0, "cx": 32.0, "cy": 24.0, "width": 64, "height": 48}


class Seed(NamedTuple):
    """Content of a valid file."""

    kind: str  # of file, as the registry has it
    suffix: str
    data: bytes


def image() -> np.ndarray:
    """Grey picture (rows, cols) of two bright discs, 8 bits."""
    picture = np.full(SHAPE, 60, np.uint8)
    picture[labels() > 0] = 200
    return picture


def labels() -> np.ndarray:
    """Labels (rows, cols) of the discs, 1 and 2."""
    rows, cols = np.indices(SHAPE)
    found = np.zeros(SHAPE, np.uint16)
    found[np.hypot(rows - 24, cols - 18) < 12] = 1
    found[np.hypot(rows - 22, cols - 47) < 9] = 2
    return found


def depth_m() -> np.ndarray:
    """Z-depth (rows, cols) of a plane 2 m away with a dome on each disc."""
    rows, cols = np.indices(SHAPE)
    depth = np.full(SHAPE, 2.0)
    for row, col, radius in ((24, 18, 12.0), (22, 47, 9.0)):
        depth -= np.sqrt(np.clip(radius**2 - (rows - row) ** 2 - (cols - col) ** 2, 0, None)) / 40
    return depth


def points_m() -> np.ndarray:
    """Points (rows, cols, 3) of the depth."""
    rows, cols = np.indices(SHAPE)
    z = depth_m()
    x, y = (cols - CAMERA["cx"]) * z / CAMERA["fx"], (rows - CAMERA["cy"]) * z / CAMERA["fy"]
    return np.stack([x, y, z], axis=-1)


def _pillow(pixels: np.ndarray, name: str, **options: object) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, name, **options)
    return stream.getvalue()


def _tiff(pixels: np.ndarray, **options: object) -> bytes:
    stream = io.BytesIO()
    tifffile.imwrite(stream, pixels, **options)
    return stream.getvalue()


def _npy(values: np.ndarray) -> bytes:
    stream = io.BytesIO()
    np.save(stream, values)
    return stream.getvalue()


def _npz(**arrays: np.ndarray) -> bytes:
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


def _ply() -> bytes:
    points = points_m().reshape(-1, 3).astype("<f4")
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n"
    )
    return head.encode() + points.tobytes()


def _coco() -> bytes:
    polygon = [10, 10, 30, 10, 30, 35, 10, 35]
    counts = [100, 20, 28, 20, SHAPE[0] * SHAPE[1] - 168]
    return json.dumps(
        {
            "images": [{"id": 1, "file_name": "scene.png", "width": 64, "height": 48}],
            "annotations": [
                {"id": 1, "image_id": 1, "segmentation": [polygon], "iscrowd": 0},
                {
                    "id": 2,
                    "image_id": 1,
                    "segmentation": {"counts": counts, "size": list(SHAPE)},
                    "iscrowd": 0,
                },
            ],
        }
    ).encode()


def _zip() -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("1.roi", b"Iout" + bytes(60))
    return stream.getvalue()


def _made() -> Iterator[Seed]:
    grey, colour, found = image(), np.dstack([image()] * 3), labels()
    steps = np.rint(1000 * depth_m()).astype(np.uint16)
    for suffix, name in ((".png", "PNG"), (".jpg", "JPEG"), (".webp", "WebP"), (".bmp", "BMP")):
        yield Seed("image", suffix, _pillow(colour, name))
    yield Seed("image", ".png", _pillow(grey, "PNG"))
    yield Seed("image", ".pgm", _pillow(grey, "PPM"))
    yield Seed("image", ".tif", _tiff(grey))
    yield Seed("image", ".tif", _tiff(colour, compression="zlib", photometric="rgb"))
    yield Seed("image", ".tif", _tiff(grey.astype(np.float32) / 255))
    yield Seed("labels", ".png", _pillow(found.astype(np.uint8), "PNG"))
    yield Seed("labels", ".tif", _tiff(found))
    yield Seed("labels", ".npy", _npy(found))
    yield Seed("labels", ".npz", _npz(labels=found))
    yield Seed("labels", ".json", _coco())
    yield Seed("labels", ".zip", _zip())
    yield Seed("range", ".npy", _npy(points_m()))
    yield Seed("range", ".npy", _npy(depth_m()))
    yield Seed("range", ".npz", _npz(xyz=points_m()))
    yield Seed("range", ".png", _pillow(steps, "PNG"))
    yield Seed("range", ".tif", _tiff(depth_m().astype(np.float32)))
    yield Seed("range", ".ply", _ply())
    yield Seed("camera", ".json", json.dumps({**CAMERA, "depth_scale": 1.0}).encode())


def _written() -> Iterator[Seed]:
    """Seeds of the formats that write."""
    instances = Instances.from_labels(labels().astype(np.int32))
    contents = {"image": image(), "labels": instances}
    for one in known_formats():
        if one.writable and one.readable and one.kind in contents:
            yield Seed(one.kind, one.suffixes[0], one.write(contents[one.kind]))


@cache
def seeds() -> tuple[Seed, ...]:
    """All seeds."""
    return (*_made(), *_written())


def seeds_of(one: Format) -> tuple[Seed, ...]:
    """Seeds of a format; those of all others, under its suffix, where it has none."""
    own = [seed for seed in seeds() if seed.kind == one.kind and seed.suffix in one.suffixes]
    if own:
        return tuple(own)
    return tuple(Seed(one.kind, one.suffixes[0], seed.data) for seed in seeds())


def readable_formats() -> tuple[Format, ...]:
    """Formats of the registry that are read from a file; those of folders have no suffix."""
    return tuple(one for one in known_formats() if one.readable and one.suffixes)

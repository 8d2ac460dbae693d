"""YOLO labels for segmentation: a polygon for each rock that is seen, and data.yaml."""

import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.measure import find_contours

from synth.arrays import Floats

FOLDER = "yolo"
_DIGITS = 6  # of a coordinate: a hundredth of a pixel of 10,000


def write_data_yaml(out: Path, *, training: str, held_out: str) -> None:
    """Write data.yaml, whose folders are relative to its own."""
    text = f"train: images/{training}\nval: images/{held_out}\nnames:\n  0: rock\n"
    (out / FOLDER / "data.yaml").write_text(text, encoding="utf-8", newline="")


def write_yolo_scene(scene: Path, out: Path, split: str) -> None:
    """Copy a scene's pictures to images/SPLIT and write a label file for each to labels/SPLIT.

    A file is named after scene and view; that of a picture without a rock is empty.
    """
    images, labels = (out / FOLDER / name / split for name in ("images", "labels"))
    for folder in (images, labels):
        folder.mkdir(parents=True, exist_ok=True)
    pictures = scene / "rgb" if (scene / "rgb").is_dir() else scene / "gray"
    for path in sorted(pictures.iterdir()):
        stem = f"{scene.name}_{path.stem}"
        shutil.copyfile(path, images / f"{stem}.png")
        table = cv2.imdecode(
            np.frombuffer((scene / "labels" / path.name).read_bytes(), np.uint8),
            cv2.IMREAD_UNCHANGED,
        )
        text = "".join(f"{line}\n" for line in label_lines(np.asarray(table)))
        (labels / f"{stem}.txt").write_text(text, encoding="utf-8", newline="")


def label_lines(labels: NDArray[Any]) -> Iterable[str]:
    """Lines `0 x1 y1 x2 y2 …` of a label image (rows, cols), each rock's outline from 0 to 1."""
    size = np.array(labels.shape[::-1], dtype=np.float64)
    for label in np.unique(labels[labels > 0]):
        outline = mask_polygon(labels == label) / size
        yield "0 " + " ".join(f"{value:.{_DIGITS}f}" for value in outline.ravel())


def mask_polygon(mask: NDArray[np.bool_]) -> Floats:
    """One closed polygon (n, 2), columns and rows, that holds a mask's pixel centres and no other.

    Coordinates count from the frame's corner, so that the first pixel's centre is (0.5, 0.5).
    The line runs midway between pixels inside and outside. A further part, or a hole, is
    joined to what there is by a line there and back, which by the even-odd rule holds nothing.
    """
    rings = [
        ring[:-1, ::-1] - 0.5  # padded by one pixel, whose centre has the coordinate 0
        for ring in find_contours(np.pad(mask, 1).astype(np.float64), 0.5)
    ]
    rings.sort(key=len, reverse=True)
    polygon = rings[0]
    for ring in rings[1:]:
        gaps = np.linalg.norm(polygon[:, None] - ring[None], axis=2)
        place, start = np.unravel_index(np.argmin(gaps), gaps.shape)
        loop = np.roll(ring, -int(start), axis=0)
        polygon = np.concatenate([polygon[: place + 1], loop, loop[:1], polygon[place:]])
    return np.asarray(polygon)

"""Finders on lander frames whose rocks are outlined by hand, with coarse range and without."""

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
from case import Case, Table
from finder_ways import RULE, KnownFrame, ways_table

import rockshape
from rockshape.observation import locate_camera
from validation.records.object_matching import whole_and_wide

MARS = Path(__file__).parents[2] / "examples" / "mars"
PHOTOS = MARS.parent / "photos"
FRAMES = ("i924795", "i925510", "i925814", "i944537", "i944014r")


def scores(*, frames: tuple[str, ...] = FRAMES) -> list[Table]:
    """Score every finder on all frames together; rocks that the frame cuts do not count."""
    with tempfile.TemporaryDirectory() as folder:
        return [ways_table(_frames(frames, Path(folder)), "coarse mesh")]


def _frames(frames: tuple[str, ...], folder: Path) -> Iterator[KnownFrame]:
    """Yield each frame with range, its labels, and which of them count."""
    for frame in frames:
        image, range_file = _at_full_size(frame, folder)
        outlines = MARS / "outlines" / f"{frame}.json"
        seen = locate_camera(rockshape.read(image, range=range_file))
        marked = rockshape.read(image, labels=outlines).instances
        truth = np.zeros(seen.image.shape, dtype=np.int32)
        for number, rock in enumerate(marked, start=1):
            truth[rock.window][rock.mask] = number
        counts = np.zeros(len(marked) + 2, dtype=bool)
        whole = whole_and_wide(truth, RULE.min_width_px)
        counts[: len(whole)] = whole
        truth[_not_judged(outlines, f"{frame}.png", truth.shape) & (truth == 0)] = len(marked) + 1
        yield KnownFrame(seen, truth, counts)


def _at_full_size(frame: str, folder: Path) -> tuple[Path, Path]:
    """Picture and range of a frame; those that are kept at half size are enlarged twice."""
    if (MARS / f"{frame}.png").exists():
        return MARS / f"{frame}.png", MARS / f"{frame}_xyz.npz"
    image, points = folder / f"{frame}.png", folder / f"{frame}.npz"
    half = cv2.imread(str(PHOTOS / f"{frame}_half.png"), cv2.IMREAD_UNCHANGED)
    cv2.imwrite(str(image), cv2.resize(half, None, fx=2, fy=2, interpolation=cv2.INTER_LINEAR))
    xyz = np.load(MARS / f"{frame}_half_xyz.npz")["xyz"]
    np.savez(points, xyz=cv2.resize(xyz, None, fx=2, fy=2, interpolation=cv2.INTER_LINEAR))
    return image, points


def _not_judged(outlines: Path, picture: str, shape: tuple[int, ...]) -> np.ndarray:
    """Pixels of the regions that the reader would not judge."""
    told = json.loads(outlines.read_text("utf-8"))
    images = {one["id"] for one in told["images"] if one["file_name"] == picture}
    mask = np.zeros(shape, dtype=np.uint8)
    for one in told["annotations"]:
        if one["image_id"] in images and one.get("iscrowd") == 1:
            for polygon in one["segmentation"]:
                corners = np.round(np.reshape(polygon, (-1, 2)) - 0.5).astype(np.int32)
                cv2.fillPoly(mask, [corners], 1)
    return mask > 0


FINDER_MARS_CASE = Case(
    name="finder_mars",
    what="finders on five lander frames with rocks outlined by hand",
    run=scores,
    smallest={"frames": ("i944014r",)},
)

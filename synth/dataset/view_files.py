"""Files of one view: its pictures, labels and masks."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from synth.dataset.files import write_png, write_rgb_png
from synth.progress import counted
from synth.render.silhouettes import Cutout
from synth.render.view import Sight
from synth.sensor import Capture


def write_pictures(folder: Path, number: int, capture: Capture, depth: NDArray[np.uint16]) -> None:
    """Write what the sensor captured, with its depth as it is stored."""
    name = f"{number:06d}.png"
    write_png(folder / "gray" / name, capture.picture)
    write_png(folder / "depth" / name, depth)
    if capture.colour is not None:
        write_rgb_png(folder / "rgb" / name, capture.colour)
    for own, picture in capture.pictures.items():
        write_png(folder / own / name, picture)


def write_masks(folder: Path, number: int, view: Sight, jobs: int) -> None:
    """Write the labels, and the masks of each rock by so many threads."""
    stem = f"{number:06d}"
    write_png(folder / "labels" / f"{stem}.png", view.labels)

    def write(instance: int) -> None:
        name = f"{stem}_{instance:06d}.png"
        write_png(folder / "mask" / name, _white(view.silhouettes.cutout(instance)))
        write_png(folder / "mask_visib" / name, _white(view.visible(instance)))

    instances = range(len(view.silhouettes))
    with ThreadPoolExecutor(jobs) as threads:
        for _ in zip(
            counted(instances, "rocks' masks"), threads.map(write, instances), strict=True
        ):
            pass


def _white(cutout: Cutout) -> NDArray[np.uint8]:
    """Picture of the frame, (rows, cols), 255 where the mask is set."""
    frame = np.zeros(cutout.shape, dtype=np.uint8)
    frame[cutout.window] = np.where(cutout.mask, 255, 0)
    return frame

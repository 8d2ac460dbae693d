"""A page of the best and the worst views of a run of the suite `segmentation`.

`python benchmarks/segmentation_cases.py FOLDER PICTURE`: for each kind of range, and for none, the
view in which the robust way found most of its rocks and the one in which it found fewest. True
outlines are blue, those found yellow.
"""

import argparse
import tempfile
from pathlib import Path

import matplotlib as mpl
import msgspec
import numpy as np
import pandas as pd
from matplotlib import pyplot as plt
from numpy.typing import NDArray

from rockshape.io import read_camera, read_image, read_range
from rockshape.observation import Observation
from rockshape.segmentation import FINDERS
from synth.dataset.write import write_common, write_scene
from synth.render import choose_backend
from validation.kinds.segmentation.judge import f1
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.kinds.segmentation.work import draw
from validation.records.truth import read_instances
from validation.suite.suite import load_suite

SERIES = ("robust-exact", "robust-stereo", "robust-sgm", "robust-none")
MIN_ROCKS = 5  # rocks that count in a view
TOP = 200  # rows of sky left out


def chosen(records: pd.DataFrame) -> list[tuple[str, str, int, int, float]]:
    """Series, experiment, scene, view and F1 of the best and the worst view of each series."""
    some = []
    for series in SERIES:
        own = records[(records["series"] == series) & (records["experiment"] != "imp")]
        told = []
        for (experiment, scene, view), rows in own.groupby(["experiment", "scene", "view"]):
            status = rows["status"].to_numpy()
            if np.isin(status, ["matched", "missed"]).sum() >= MIN_ROCKS:
                told.append((series, str(experiment), int(scene), int(view), f1(status)))
        told.sort(key=lambda one: one[-1])
        some += [told[-1], told[0]]
    return some


def picture(series: str, name: str, scene: int, view: int) -> NDArray[np.uint8]:
    """The view with its true and its found outlines."""
    experiment = next(one for one in load_suite("segmentation").experiments if one.name == name)
    assert isinstance(experiment, SegmentationExperiment)
    spec = msgspec.structs.replace(experiment.scene, seed=experiment.seed + scene)
    source = series.rpartition("-")[2]
    with tempfile.TemporaryDirectory() as parent:
        folder = Path(parent) / "data"
        backend = choose_backend(spec.renderer)
        write_scene(spec, 0, backend, folder)
        write_common(spec, backend, folder)
        camera = read_camera(folder / "camera.json")
        data, file = folder / "000000", f"{view:06d}.png"
        image = read_image(data / "gray" / file)
        depth = "depth_true" if source == "exact" else "depth"
        points = read_range(data / depth / file, shape=image.shape, camera=camera)
        labels = read_instances(data / "labels" / file)
    given = Observation(image=image, points_m=None if source == "none" else points, camera=camera)
    return draw(image, labels, FINDERS["both"].segment(given).labels)


def main() -> None:
    """Draw the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("picture", type=Path)
    args = parser.parse_args()
    mpl.use("Agg")
    figure, axes = plt.subplots(len(SERIES), 2, figsize=(12, 18), dpi=90)
    cases = chosen(pd.read_parquet(args.folder / "results.parquet"))
    for axis, (series, name, scene, view, score) in zip(axes.ravel(), cases, strict=True):
        axis.imshow(picture(series, name, scene, view)[TOP:], interpolation="nearest")
        axis.set_title(f"{series}: {name}, scene {scene}, view {view}: F1 {score:.2f}", fontsize=9)
        axis.set_axis_off()
    figure.tight_layout(pad=1.0)
    figure.savefig(args.picture, pil_kwargs={"quality": 70})


if __name__ == "__main__":
    main()

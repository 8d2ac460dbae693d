"""One scene of a segmentation experiment: made, segmented in every way, matched."""

from dataclasses import asdict, dataclass

import cv2
import msgspec
import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.method import find_method
from rockshape.observation import Observation
from rockshape.segmentation import Segmentation
from synth.camera.presets import PRESETS
from validation.arrays import Floats, Labels
from validation.execution.units import Unit, UnitResult
from validation.execution.views import dataset_views
from validation.kinds.segmentation.baselines import BASELINES
from validation.kinds.segmentation.sources import source_of, split_series
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.kinds.segmentation.truth import ViewTruth, range_counts, view_truth
from validation.records.join import RecordKey
from validation.records.object_matching import Rule, judge
from validation.records.pictures import Picture, compress

MAX_BASELINE_M = 0.424
TRUE_COLOUR, FOUND_COLOUR = (64, 180, 255), (255, 209, 56)  # RGB


@dataclass(frozen=True, eq=False)
class Segmented:
    """What one way made of one view."""

    labels: Labels
    outlines: dict[int, Floats]  # sub-pixel, where there are such
    ground_sigmas: float  # the plane's RMS error over the range noise there; NaN without


def run(unit: Unit[SegmentationExperiment]) -> UnitResult:
    """Make a scene, find its rocks in every way and judge what was found.

    A series is a way and the range it was given: `robust-exact`, `paper-stereo`, `otsu-none`.
    """
    experiment, scene = unit.experiment, unit.scene
    spec = msgspec.structs.replace(experiment.scene, seed=experiment.seed + scene)
    views, backend = dataset_views(spec, exact=True)
    records, pictures = [], []
    for view in views:
        truth = view_truth(view, experiment=experiment)
        for series in experiment.series:
            way, _ = split_series(series)
            source, counts = source_of(series), truth.shown
            if source.is_sensed:
                counts = range_counts(
                    truth, view, baseline_m=_baseline_m(experiment), experiment=experiment
                )
            observation = view.observation(source.points_m(view))
            made = _segment(way, observation, truth, experiment)
            place = RecordKey(
                experiment.name, "segmentation", series, scene, spec.seed, view.number, ""
            )
            records.append(
                _rows(place, truth, counts, made, exact_m=view.exact_m, experiment=experiment)
            )
            if scene < experiment.pictured and view.number == 0:
                shown = draw(view.image, truth.labels, made.labels)
                pictures.append(Picture(place, *compress(shown, np.ones_like(truth.labels))))
    return UnitResult(pd.concat(records, ignore_index=True), tuple(pictures), backend)


def _baseline_m(experiment: SegmentationExperiment) -> float:
    return PRESETS[experiment.scene.camera.preset].baseline_m or MAX_BASELINE_M


def _segment(
    way: str, observation: Observation, truth: ViewTruth, experiment: SegmentationExperiment
) -> Segmented:
    if way in BASELINES:
        return Segmented(BASELINES[way].segment(observation), {}, float("nan"))
    made = find_method(way).segment(observation)
    outlines = {one.number: one.outline.points_px for one in made.found if one.outline is not None}
    return Segmented(
        made.labels,
        outlines,
        _ground_sigmas(observation, truth, made=made, experiment=experiment),
    )


def _ground_sigmas(
    observation: Observation,
    truth: ViewTruth,
    *,
    made: Segmentation,
    experiment: SegmentationExperiment,
) -> float:
    """RMS height of the true ground above the fitted one, over the range noise of heights there.

    sigma_h = sigma_Z |n . r|, with sigma_Z = Z^2 sigma_d/(f B) of the camera, be the range exact or
    not.
    """
    camera, ground = observation.camera, made.ground
    if camera is None or ground is None:
        return float("nan")
    height = ground.height_m(truth.ground_m)
    sigma = _sigma_h(truth.ground_m, ground.plane.normal, camera, experiment)
    return float(np.sqrt(np.mean((height / sigma) ** 2)))


def _sigma_h(
    points_m: Floats, normal: Floats, camera: Camera, experiment: SegmentationExperiment
) -> Floats:
    depth = points_m[:, 2]
    per_m = experiment.scene.noise.disparity_px / (camera.fx * _baseline_m(experiment))
    return np.asarray(depth**2 * per_m * np.abs(points_m @ normal) / depth)


def _rows(
    place: RecordKey,
    truth: ViewTruth,
    counts: NDArray[np.bool_],
    made: Segmented,
    *,
    exact_m: Floats,
    experiment: SegmentationExperiment,
) -> pd.DataFrame:
    rule = Rule(experiment.min_iou, experiment.min_width_px)
    rows = judge(truth.labels, counts, made.labels, made.outlines, rule)
    found_m = _depths_m(exact_m, made.labels)
    depth = [truth.depth_m[number] if number > 0 else found_m[-number] for number in rows["place"]]
    rows = rows.assign(depth_m=np.array(depth, dtype=np.float64)).drop(columns="place")
    rows = rows.rename(columns={"found": "rock"})
    rows["eligible"] = rows["status"] != "extra"
    measured = np.isfinite(exact_m[..., 2])
    view = {
        "ground_sigmas": made.ground_sigmas,
        "cover": float((truth.labels[measured] > 0).mean()),
    }
    if rows.empty:  # the view's ground counts even where no rock does
        rows = rows.reindex([0]).assign(status="view", eligible=False)
    return pd.concat([pd.DataFrame(asdict(place) | view, index=rows.index), rows], axis=1)


def _depths_m(exact_m: Floats, labels: Labels) -> Floats:
    """Mean exact z-depth of each label, by its number; NaN without any."""
    count = int(labels.max(initial=0)) + 1
    known = np.isfinite(exact_m[..., 2])
    total = np.bincount(labels[known], exact_m[..., 2][known], minlength=count)
    pixels = np.bincount(labels[known], minlength=count)
    return np.where(pixels > 0, total / np.maximum(pixels, 1), np.nan)


def draw(image: NDArray[np.float32], truth: Labels, found: Labels) -> NDArray[np.uint8]:
    """The image in grey with the true borders in blue and the found ones in yellow over them."""
    grey = np.clip(np.rint(image * 255), 0, 255).astype(np.uint8)
    canvas = np.repeat(grey[..., None], 3, axis=2)
    for labels, colour in ((truth, TRUE_COLOUR), (found, FOUND_COLOUR)):
        single = labels.astype(np.float32)
        box = np.ones((3, 3), dtype=np.uint8)
        canvas[cv2.dilate(single, box) != cv2.erode(single, box)] = colour
    return canvas

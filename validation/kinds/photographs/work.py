"""One picture of a photographs experiment: read or made, searched by every finder, judged."""

from dataclasses import asdict

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape import Instances, Observation, Segmentation
from rockshape.inputs.arrays import observe
from validation.arrays import Labels
from validation.execution.units import Unit, UnitResult
from validation.kinds.photographs.blocks import Blocks
from validation.kinds.photographs.overlay import draw
from validation.kinds.photographs.readings import TRUE, shape_readings
from validation.kinds.photographs.series import known_finders
from validation.kinds.photographs.sources.masked_picture import MaskedPicture
from validation.kinds.photographs.spec import PhotographsExperiment
from validation.records.join import RecordKey
from validation.records.object_matching import (
    Rule,
    equivalent_diameter,
    judge,
    whole_and_wide,
)
from validation.records.pictures import Picture, compress


def run(unit: Unit[PhotographsExperiment]) -> UnitResult:
    """Find the rocks of a picture by every finder and judge them.

    Records have a row for each block of the picture, with its pixels, and one for each object where
    rocks are told apart. A view is a block.
    """
    experiment, number = unit.experiment, unit.scene
    picture = experiment.pictures.picture(experiment.seed, number)
    observation = observe(picture.image)
    counts, readings = _true_rocks(picture, observation, experiment)
    records, pictures = [], []
    for name in experiment.series:
        found = known_finders()[name].segment(observation)
        place = RecordKey(
            experiment.name, "photographs", name, number, experiment.seed, view=0, method=""
        )
        rows = _block_rows(picture, found.labels, experiment.block_px)
        objects = rows.iloc[:0]
        if picture.truth.labels is not None:
            objects = _object_rows(
                picture.truth.labels, counts, found, observation, experiment=experiment
            )
            objects["label"] = objects["instance"] + 1
            objects = objects.join(readings, on="label").drop(columns="label")
            rows = pd.concat([rows, objects], ignore_index=True)
        where = pd.DataFrame(asdict(place), index=rows.index).drop(columns="view")
        records.append(pd.concat([where, rows], axis=1))
        if number < experiment.pictured:
            shown = draw(picture, found.labels, objects)
            pictures.append(Picture(place, *compress(shown, np.ones(shown.shape[:2], np.int32))))
    return UnitResult(pd.concat(records, ignore_index=True), tuple(pictures), "")


def _true_rocks(
    picture: MaskedPicture, observation: Observation, experiment: PhotographsExperiment
) -> tuple[NDArray[np.bool_], pd.DataFrame]:
    """Which labels count, (n + 1,), and readings of these by their number."""
    labels = picture.truth.labels
    if labels is None:
        return np.zeros(1, dtype=bool), pd.DataFrame()
    counts = _counts(labels, picture, experiment)
    numbers = set(np.flatnonzero(counts).tolist())
    readings = shape_readings(observation, Instances.from_labels(labels), numbers)
    return counts, readings.add_prefix(TRUE)


def _counts(
    labels: Labels, picture: MaskedPicture, experiment: PhotographsExperiment
) -> NDArray[np.bool_]:
    """Which labels are judged, large enough, wholly in the frame and visible enough, (n + 1,)."""
    counts = whole_and_wide(labels, experiment.min_width_px)
    counts[np.unique(labels[~picture.truth.judged])] = False
    if picture.visible_fraction is not None:
        for number in np.flatnonzero(counts):
            shown = picture.visible_fraction[number] >= experiment.min_visible_fraction
            counts[number] = bool(shown)
    return counts


def _block_rows(picture: MaskedPicture, found: Labels, side_px: int | None) -> pd.DataFrame:
    """A row for each block with the pixels that truth and found have in common and together."""
    rock, judged = picture.truth.rock, picture.truth.judged
    blocks = Blocks((rock.shape[0], rock.shape[1]), side_px)
    block = blocks.of_pixels()
    both, either = (
        np.bincount(block[mask], minlength=blocks.count)
        for mask in (rock & (found > 0), judged & (rock | (found > 0)))
    )
    return pd.DataFrame(
        {
            "view": np.arange(blocks.count),
            "status": "view",
            "eligible": False,
            "common_px": both.astype(np.float64),
            "union_px": either.astype(np.float64),
        }
    )


def _object_rows(
    truth: Labels,
    counts: NDArray[np.bool_],
    found: Segmentation,
    observation: Observation,
    *,
    experiment: PhotographsExperiment,
) -> pd.DataFrame:
    """Objects of `judge` with their block and the readings of the found ones."""
    rule = Rule(experiment.min_iou, experiment.min_width_px, equivalent_diameter)
    outlines = {one.number: one.outline.points_px for one in found.found if one.outline is not None}
    rows = judge(truth, counts, found.labels, outlines, rule)
    blocks = Blocks((truth.shape[0], truth.shape[1]), experiment.block_px)
    of_true, of_found = blocks.of_labels(truth), blocks.of_labels(found.labels)
    rows["view"] = [of_true[n] if n > 0 else of_found[-n] for n in rows["place"]]
    rows["eligible"] = rows["status"] != "extra"
    numbers = set(rows["found"].dropna().astype(int))
    readings = shape_readings(observation, found.instances, numbers)
    rows = rows.join(readings, on="found").rename(columns={"found": "rock"})
    return rows.drop(columns="place")

"""Realism: statistics of made tiles beside real ones, and a classifier that tells them apart."""

from collections.abc import Callable, Iterable, Iterator, Mapping

import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray
from picture_statistics import STATISTICS, descriptors, patches, statistics
from real_or_made import area_under_curve, train
from real_pictures import PHOTOGRAPHS, Photograph, bed_pictures, plain_pictures, site_pictures

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

MADE: dict[str, Callable[[range], Iterator[Bytes]]] = {
    "plain scenes": plain_pictures,
    "sites": site_pictures,
    "beds": bed_pictures,
}
FIRST_REPORTED = 10_000  # seed: those below 1000 train the classifier and fit the generator


def realism(*, pictures: int = 12, first: int = 0) -> list[Table]:
    """Compare made pictures with real ones: medians and quartiles, and the area under the curve."""
    real = {photo: list(patches(photo.read())) for kind in PHOTOGRAPHS.values() for photo in kind}
    known = {photo: descriptors(found) for photo, found in real.items()}
    columns = (Column("pictures"), Column("patches", "", ".0f"), *map(Column, STATISTICS))
    summaries = [
        _summary(f"real: {kind}", [patch for photo in photos for patch in real[photo]])
        for kind, photos in PHOTOGRAPHS.items()
    ]
    judged = []
    for name, make in MADE.items():
        fitted = _all_patches(make(range(first, first + pictures)))
        reported = _all_patches(make(range(FIRST_REPORTED, FIRST_REPORTED + pictures)))
        summaries.append(_summary(f"made: {name}", reported))
        made = descriptors(fitted), descriptors(reported)
        judged += [_judged(name, kind, known, *made) for kind in PHOTOGRAPHS]
    areas = (
        Column("made"),
        Column("real"),
        Column("AUC, pictures trained on", "", ".3f"),
        Column("AUC, pictures held out", "", ".3f"),
        Column("each of them"),
        Column("AUC, each picture left out in turn", "", ".3f"),
    )
    return [
        Table(columns, summaries, name="statistics"),
        Table(areas, judged, name="classifier"),
    ]


def _all_patches(pictures: Iterable[Bytes]) -> list[Bytes]:
    return [patch for picture in pictures for patch in patches(picture)]


def _summary(name: str, found: list[Bytes]) -> tuple[str | int, ...]:
    """Row of medians, with quartiles, over patches."""
    values = np.array([statistics(patch) for patch in found])
    cells = []
    for column in values.T:
        known = column[np.isfinite(column)]
        if len(known):
            low, middle, high = np.percentile(known, [25, 50, 75])
            cells.append(f"{middle:.3g} ({low:.3g} … {high:.3g})")
        else:
            cells.append("–")
    return (name, len(values), *cells)


def _judged(
    name: str, kind: str, known: Mapping[Photograph, Floats], fitted: Floats, reported: Floats
) -> tuple[str, str, float, float, str, float]:
    """Row of the areas under the curve of classifiers that are trained for this pair."""
    photos = PHOTOGRAPHS[kind]
    trained = [photo for photo in photos if not photo.held_out]
    judge = train(_joined(known, trained), fitted)
    made = judge.scores(reported)
    held = {
        photo.name: area_under_curve(judge.scores(known[photo]), made)
        for photo in photos
        if photo.held_out
    }
    turns = []
    for photo in photos:
        other = train(_joined(known, [one for one in photos if one is not photo]), fitted)
        turns.append(area_under_curve(other.scores(known[photo]), other.scores(reported)))
    return (
        name,
        kind,
        area_under_curve(judge.scores(_joined(known, trained)), made),
        float(np.mean(list(held.values()))),
        ", ".join(f"{one} {area:.2f}" for one, area in held.items()),
        float(np.mean(turns)),
    )


def _joined(known: Mapping[Photograph, Floats], photos: Iterable[Photograph]) -> Floats:
    return np.concatenate([known[photo] for photo in photos])


REALISM_CASE = Case(
    name="realism",
    what="statistics of made and real pictures, and a classifier that tells them apart",
    run=realism,
    smallest={"pictures": 1, "first": 0},
)

"""Robust segmentation: by range, by the image alone, or by both."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from rockshape.ground import Ground, fit_ground
from rockshape.numerics.arrays import Labels
from rockshape.observation import Observation
from rockshape.rock.instances import Instances
from rockshape.rock.visibility import measured_frame
from rockshape.segmentation.by_image.image_branch import find_by_image
from rockshape.segmentation.by_range.height_signal import HeightSignal, relief_of, standing
from rockshape.segmentation.by_range.split import FLATTEST, FLATTEST_ON_WAVES, split
from rockshape.segmentation.edges.edge_snapping import SnappedOutline
from rockshape.segmentation.edges.image_edges import snapped, texture_of
from rockshape.segmentation.flags import flag
from rockshape.segmentation.relabel import in_reading_order, renumber
from rockshape.segmentation.result import Branch, FoundRock, Segmentation, lacks_range


def segment_both(observation: Observation) -> Segmentation:
    """Rocks that stand on the ground in units of its noise, then those that the image alone shows.

    Regions above the ground are cut at valleys and jumps of depth. Outlines are moved to the
    image's edges where these are surer than the range's. Without range, by the image alone.
    """
    ground = ground_among_rocks(observation)
    signal = heights_over(observation, ground)
    by_range = _by_range(observation, ground, signal)
    labels = find_by_image(observation.image, signal, by_range)
    outlines, labels = _at_edges(observation, labels, signal, ground)
    return _result(
        observation,
        labels,
        ground=ground,
        signal=signal,
        outlines=outlines,
        from_range=int(by_range.max(initial=0)),
    )


def segment_by_range(observation: Observation) -> Segmentation:
    """Rocks that stand on the ground in units of its noise, with the range's own outlines.

    Raises: InputError without range.
    """
    if observation.points_m is None:
        raise lacks_range("range")
    ground = ground_among_rocks(observation)
    signal = heights_over(observation, ground)
    labels = _by_range(observation, ground, signal)
    return _result(
        observation,
        labels,
        ground=ground,
        signal=signal,
        outlines={},
        from_range=int(labels.max(initial=0)),
    )


def segment_by_image(observation: Observation) -> Segmentation:
    """Rocks that the image shows, whatever the range; the ground is still the range's."""
    ground = ground_among_rocks(observation)
    nothing = np.zeros(observation.image.shape, dtype=np.int32)
    labels = find_by_image(observation.image, None, nothing)
    outlines, labels = _at_edges(observation, labels, None, None)
    return _result(observation, labels, ground=ground, signal=None, outlines=outlines, from_range=0)


def ground_among_rocks(observation: Observation) -> Ground | None:
    """Ground under rocks; None without range, or where no ground is seen."""
    if observation.points_m is None:
        return None
    return fit_ground(observation.points_m, pixel_rad=pixel_rad(observation))


def heights_over(observation: Observation, ground: Ground | None) -> HeightSignal | None:
    """Heights over the ground in units of their noise; None without range, ground or its noise."""
    if observation.points_m is None or ground is None or ground.noise is None:
        return None
    return relief_of(observation.points_m, ground, ground.noise)


def _result(
    observation: Observation,
    labels: Labels,
    *,
    ground: Ground | None,
    signal: HeightSignal | None,
    outlines: Mapping[int, SnappedOutline],
    from_range: int,
) -> Segmentation:
    """Rocks renumbered in reading order and flagged; labels up to from_range are the range's."""
    rows, cols = observation.image.shape
    whole = slice(0, rows), slice(0, cols)
    frame = whole if signal is None else measured_frame(signal.known)
    numbered = renumber(labels, dropped=np.empty(0, dtype=np.intp))
    flags = flag(observation.image, numbered, signal, frame=frame)
    found = []
    for number, before in enumerate(in_reading_order(labels).tolist(), start=1):
        branch: Branch = "range" if before <= from_range else "image"
        found.append(FoundRock(number, branch, flags[number], outlines.get(before)))
    rocks = Instances.from_labels(numbered)
    items = tuple(
        item if one.outline is None else replace(item, outline_px=one.outline.points_px)
        for item, one in zip(rocks, found, strict=True)
    )
    return Segmentation(Instances(rocks.shape, items), ground, frame, tuple(found))


def _by_range(
    observation: Observation, ground: Ground | None, signal: HeightSignal | None
) -> Labels:
    if ground is None or signal is None:
        return np.zeros(observation.image.shape, dtype=np.int32)
    return find_by_range(signal, ground)


def _at_edges(
    observation: Observation, labels: Labels, signal: HeightSignal | None, ground: Ground | None
) -> tuple[dict[int, SnappedOutline], Labels]:
    """Outlines moved to the image's edges, unless range is finer than any matcher's."""
    if signal is not None and signal.fine:
        return {}, labels
    texture = texture_of(observation.image)
    window_px = 1 if ground is None or ground.noise is None else ground.noise.window_px
    return snapped(observation.image, labels, signal, texture=texture, window_px=window_px)


def find_by_range(signal: HeightSignal, ground: Ground) -> Labels:
    """Labels (rows, cols) from 1 of the rocks that stand on the ground."""
    labels = split(
        signal,
        standing(signal),
        flattest=FLATTEST if ground.swell is None else FLATTEST_ON_WAVES,
    )
    return renumber(labels, dropped=np.empty(0, dtype=np.intp))


def pixel_rad(observation: Observation) -> float:
    """A pixel's angle in the middle of the frame; without a camera, of a field of one radian."""
    if observation.camera is None:
        return 1.0 / max(int(side) for side in observation.image.shape)
    return 1.0 / observation.camera.fx

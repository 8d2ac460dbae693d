"""Robust segmentation: by range, by the image alone, or by both."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from rockshape.ground import Ground, fit_ground
from rockshape.numerics.arrays import Labels
from rockshape.observation import Observation
from rockshape.point_grid.edge_width import edge_width_px
from rockshape.rock.instances import Instances
from rockshape.rock.visibility import measured_frame
from rockshape.segmentation.by_image.image_branch import find_by_image
from rockshape.segmentation.by_network.network_branch import find_by_network
from rockshape.segmentation.by_range.height_signal import HeightSignal, relief_of, standing
from rockshape.segmentation.by_range.split import FLATTEST, FLATTEST_ON_WAVES, split
from rockshape.segmentation.edges.edge_snapping import SnappedOutline
from rockshape.segmentation.edges.image_edges import snapped, texture_of
from rockshape.segmentation.flags import flag
from rockshape.segmentation.placement import largest_first, place_among
from rockshape.segmentation.relabel import in_reading_order, renumber
from rockshape.segmentation.result import Branch, FoundRock, Segmentation, lacks_range

RESOLVED_EDGES = 4.0  # widths of an edge in a rock that soft range shows
SOFT_EDGES_PX = 4.5  # of a matcher's windows 4, of meshes of some hundred triangles 5 to 8


def segment_both(observation: Observation) -> Segmentation:
    """Rocks that stand on the ground in units of its noise, then those that the image alone shows.

    Regions above the ground are cut at valleys and jumps of depth. Outlines are moved to the
    image's edges where these are surer than the range's. Without range, by the image alone. Where
    the range's edges are soft, the network's outlines in the picture come first.
    """
    ground = ground_among_rocks(observation)
    signal = heights_over(observation, ground)
    by_range = _by_range(observation, ground, signal)
    edge_px = edge_width(observation)
    if edge_px > SOFT_EDGES_PX:
        _, by_range = _at_edges(observation, by_range, signal, ground)
        labels, from_range = _by_network_first(observation, by_range, edge_px)
        return _result(
            observation, labels, ground=ground, signal=signal, outlines={}, from_range=from_range
        )
    labels = find_by_image(observation.image, signal, by_range)
    outlines, labels = _at_edges(observation, labels, signal, ground)
    return _result(
        observation,
        labels,
        ground=ground,
        signal=signal,
        outlines=outlines,
        from_range=range(1, int(by_range.max(initial=0)) + 1),
    )


def _by_network_first(
    observation: Observation, by_range: Labels, edge_px: float
) -> tuple[Labels, range]:
    """Labels of the network's rocks and of free ones by soft range, and which are the latter.

    Range whose edges are spread over so many pixels shows no rock that is not some times wider.
    """
    seen = find_by_network(observation)
    resolved = (
        (window, mask)
        for window, mask in largest_first(by_range)
        if min(mask.shape) >= RESOLVED_EDGES * edge_px
    )
    labels = place_among(seen, None, resolved)
    return labels, range(int(seen.max(initial=0)) + 1, int(labels.max(initial=0)) + 1)


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
        from_range=range(1, int(labels.max(initial=0)) + 1),
    )


def segment_by_image(observation: Observation) -> Segmentation:
    """Rocks that the image shows, whatever the range; the ground is still the range's."""
    ground = ground_among_rocks(observation)
    labels = find_by_image(observation.image, None, _no_rocks(observation))
    outlines, labels = _at_edges(observation, labels, None, None)
    return _result(
        observation, labels, ground=ground, signal=None, outlines=outlines, from_range=range(0)
    )


def segment_by_network(observation: Observation) -> Segmentation:
    """Rocks that the network finds in the image, whatever the range; the ground is the range's."""
    ground = ground_among_rocks(observation)
    labels = find_by_network(observation)
    return _result(
        observation, labels, ground=ground, signal=None, outlines={}, from_range=range(0)
    )


def edge_width(observation: Observation) -> float:
    """Width of the range's edges, px; NaN without range or edges."""
    points_m = observation.points_m
    return float("nan") if points_m is None else edge_width_px(points_m)


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
    from_range: range,
) -> Segmentation:
    """Rocks renumbered in reading order and flagged; from_range has the range's labels."""
    rows, cols = observation.image.shape
    whole = slice(0, rows), slice(0, cols)
    frame = whole if signal is None else measured_frame(signal.known)
    numbered = renumber(labels, dropped=np.empty(0, dtype=np.intp))
    flags = flag(observation.image, numbered, signal, frame=frame)
    found = []
    for number, before in enumerate(in_reading_order(labels).tolist(), start=1):
        branch: Branch = "range" if before in from_range else "image"
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
        return _no_rocks(observation)
    return find_by_range(signal, ground)


def _no_rocks(observation: Observation) -> Labels:
    return np.zeros(observation.image.shape, dtype=np.int32)


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

"""From an observation to labels: one call for either variant."""

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.ground import Ground, fit_ground, fit_plane
from rockshape.observation import Observation
from rockshape.rock.visibility import measured_frame
from rockshape.segmentation.by_image.image_branch import find_by_image
from rockshape.segmentation.by_range.height_signal import HeightSignal, relief_of, standing
from rockshape.segmentation.by_range.split import FLATTEST, FLATTEST_ON_WAVES, split
from rockshape.segmentation.edges.edge_snapping import SnappedOutline
from rockshape.segmentation.edges.image_edges import snapped, texture_of
from rockshape.segmentation.flags import flag
from rockshape.segmentation.published import segment_heights
from rockshape.segmentation.relabel import in_reading_order, renumber
from rockshape.segmentation.result import Branch, FoundRock, Segmentation, Variant

Labels = NDArray[np.int32]

NO_RANGE = (
    "measure: expected range to find rocks by (range_m, --range) or rocks outlined already "
    "(labels, --labels), found neither; without range, the method robust finds rocks in the image"
)


def segment(observation: Observation, *, variant: Variant) -> Segmentation:
    """Find the rocks of an observation.

    `paper`: the 3-sigma plane and the tops, sides and bottoms of the heights above it. `robust`:
    the ground that holds among rocks, regions that stand on it in units of the noise, cut at
    valleys and jumps of depth, then what the image alone shows, and all outlines moved to the
    image's edges where they are surer than the range's.
    Raises: InputError for `paper` without range.
    """
    if variant == "paper":
        return _by_paper(observation)
    return _by_range_and_image(observation)


def ground_under(observation: Observation, *, variant: Variant) -> Ground | None:
    """Ground under rocks that others have found; None without range, or where none is seen."""
    if observation.points_m is None:
        return None
    if variant == "paper":
        return _published_ground(observation.points_m)
    return fit_ground(observation.points_m, pixel_rad=pixel_rad(observation))


def _published_ground(points_m: NDArray[np.float64]) -> Ground | None:
    plane = fit_plane(points_m)
    return None if plane is None else Ground(plane)


def _by_paper(observation: Observation) -> Segmentation:
    points_m = observation.points_m
    if points_m is None:
        raise InputError(NO_RANGE)
    ground = _published_ground(points_m)
    if ground is None:
        return _nothing(observation)
    height_m = ground.height_m(points_m)
    labels = segment_heights(height_m, sigma_m=ground.plane.sigma_m)
    found = tuple(FoundRock(number, "range") for number in range(1, int(labels.max()) + 1))
    return Segmentation(labels, ground, measured_frame(np.isfinite(height_m)), found)


def _nothing(observation: Observation) -> Segmentation:
    return Segmentation(
        np.zeros(observation.image.shape, dtype=np.int32), None, _whole(observation), ()
    )


def _whole(observation: Observation) -> tuple[slice, slice]:
    rows, cols = observation.image.shape
    return slice(0, rows), slice(0, cols)


def _by_range_and_image(observation: Observation) -> Segmentation:
    ground = ground_under(observation, variant="robust")
    relief = None if ground is None else heights_over(observation, ground)
    frame = _whole(observation)
    if ground is None or relief is None:
        by_range = np.zeros(observation.image.shape, dtype=np.int32)
    else:
        by_range = find_by_range(relief, ground)
        frame = measured_frame(relief.known)
    labels = find_by_image(observation.image, relief, by_range)
    from_range = int(by_range.max(initial=0))
    outlines, moved = _at_edges(observation, labels, relief)
    numbered = renumber(moved, dropped=np.empty(0, dtype=np.intp))
    found = []
    for number, before in enumerate(in_reading_order(moved).tolist(), start=1):
        branch: Branch = "range" if before <= from_range else "image"
        found.append(FoundRock(number, branch, (), outlines.get(before)))
    flags = flag(observation.image, numbered, relief, frame=frame)
    told = tuple(FoundRock(one.number, one.branch, flags[one.number], one.outline) for one in found)
    return Segmentation(numbered, ground, frame, told)


def _at_edges(
    observation: Observation, labels: Labels, relief: HeightSignal | None
) -> tuple[dict[int, SnappedOutline], Labels]:
    """Outlines moved to the image's edges, unless range is finer than any matcher's."""
    if relief is not None and relief.fine:
        return {}, labels
    texture = texture_of(observation.image)
    return snapped(observation.image, labels, relief, texture=texture)


def heights_over(observation: Observation, ground: Ground) -> HeightSignal | None:
    """Heights over the ground in units of their noise; None without range or noise model."""
    if observation.points_m is None or ground.noise is None:
        return None
    return relief_of(observation.points_m, ground, ground.noise)


def find_by_range(relief: HeightSignal, ground: Ground) -> Labels:
    """Labels (rows, cols) from 1 of the rocks that stand on the ground."""
    labels = split(
        relief,
        standing(relief),
        flattest=FLATTEST if ground.swell is None else FLATTEST_ON_WAVES,
    )
    return renumber(labels, dropped=np.empty(0, dtype=np.intp))


def pixel_rad(observation: Observation) -> float:
    """A pixel's angle in the middle of the frame; without a camera, of a field of one radian."""
    if observation.camera is None:
        return 1.0 / max(int(side) for side in observation.image.shape)
    return 1.0 / observation.camera.fx

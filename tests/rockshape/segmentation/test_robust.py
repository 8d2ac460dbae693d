"""Rocks of closed form on a plane, found by the robust way."""

import numpy as np
import pytest

from rockshape.errors import InputError
from rockshape.ground import NoiseModel, fit_ground
from rockshape.observation import Observation
from rockshape.segmentation import Segmentation
from rockshape.segmentation.by_range.height_signal import relief_of
from rockshape.segmentation.published import segment_published
from rockshape.segmentation.robust import find_by_range, segment_both
from tests import solids

DOWN = np.array([0.0, 0.8, 0.6])  # towards the ground, in the camera frame
LEVEL = np.array([0.0, 0.6, -0.8])  # along the ground, towards the camera
ACROSS = np.array([1.0, 0.0, 0.0])
AXES = np.stack([ACROSS, LEVEL, DOWN])


def scene(*rocks: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Points and true labels of balls: place across and away, and radius, metres."""
    surfaces = [solids.plane_range(solids.CAMERA, normal=-DOWN, offset_m=-1.5)]
    for across, away, radius in rocks:
        foot = 1.5 * DOWN - LEVEL * away
        surfaces.append(
            solids.ellipsoid_range(
                solids.CAMERA,
                centre_m=foot + ACROSS * across - 0.8 * radius * DOWN,
                half_axes_m=np.full(3, radius),
                axes=AXES,
            )
        )
    depth = np.stack([np.nan_to_num(one[..., 2], nan=np.inf) for one in surfaces])
    return solids.nearest(*surfaces), depth.argmin(axis=0).astype(np.int32)


def noisy(points: np.ndarray, rng: np.random.Generator, *, per_m: float = 5e-4) -> np.ndarray:
    inverse = 1 / points[..., 2] + rng.normal(scale=per_m, size=points.shape[:2])
    return points / points[..., 2:] / inverse[..., None]


def found_in(points: np.ndarray) -> Segmentation:
    """Segmentation of points under an even image, which shows nothing."""
    image = np.full(points.shape[:2], 0.5, dtype=np.float32)
    return segment_both(Observation(image=image, points_m=points, camera=solids.CAMERA))


def overlap(one: np.ndarray, two: np.ndarray) -> float:
    return float((one & two).sum() / (one | two).sum())


SIDE_BY_SIDE = ((-0.15, 2.0, 0.15), (0.15, 2.0, 0.15))
ONE_BEHIND = ((0.0, 1.7, 0.15), (0.05, 2.1, 0.2))


@pytest.mark.parametrize("rocks", [SIDE_BY_SIDE, ONE_BEHIND], ids=["touching", "one behind"])
@pytest.mark.parametrize("measured", [False, True], ids=["exact", "noisy"])
def test_two_rocks_are_two(
    rocks: tuple[tuple[float, float, float], ...], measured: bool, rng: np.random.Generator
) -> None:
    points, truth = scene(*rocks)
    labels = found_in(noisy(points, rng) if measured else points).labels
    assert labels.max() == 2
    # half a pixel round a rock of 60 px is 3 %; noise eats the foot, 2.5 deviations high
    least = 0.85 if measured else 0.94
    for number in (1, 2):
        assert max(overlap(truth == number, labels == other) for other in (1, 2)) > least


def test_a_dent_does_not_part_a_rock() -> None:
    points, truth = scene((0.0, 2.0, 0.25))
    y, x = np.mgrid[:240, :320]
    row, col = np.argwhere(truth == 1).mean(axis=0)
    dent = np.exp(-(((x - col) / 6) ** 2 + ((y - row) / 6) ** 2)) * (truth == 1)
    direction = points / np.linalg.norm(points, axis=-1, keepdims=True)
    labels = found_in(points + 0.03 * dent[..., None] * direction).labels
    assert labels.max() == 1
    assert overlap(truth == 1, labels == 1) > 0.94


def test_bare_ground_has_no_rocks(rng: np.random.Generator) -> None:
    points, _ = scene()
    assert found_in(points).labels.max() == 0
    assert found_in(noisy(points, rng)).labels.max() == 0


def test_labels_do_not_depend_on_the_scale_of_the_scene(rng: np.random.Generator) -> None:
    points, _ = scene((-0.3, 2.0, 0.12), (0.2, 1.6, 0.15), (0.5, 2.6, 0.25))
    points = noisy(points, rng)
    whole, tenth = found_in(points).labels, found_in(points / 10).labels
    # thresholds are in units of noise and pixels; only rounding may move a pixel
    assert np.mean(whole != tenth) < 1e-4


def test_a_rock_on_the_border_is_found_and_flagged() -> None:
    points, truth = scene((0.0, 2.0, 0.15))
    cols = np.flatnonzero((truth == 1).any(axis=0))
    cut = points[:, (cols[0] + cols[-1]) // 2 :]
    shifted = np.full_like(points, np.nan)
    shifted[:, : cut.shape[1]] = cut
    ground = fit_ground(points, pixel_rad=1 / solids.CAMERA.fx)
    assert ground is not None
    assert ground.noise is not None
    labels = find_by_range(relief_of(shifted, ground, ground.noise), ground)
    assert labels[:, 0].any()


def test_flags_tell_what_the_view_lacks() -> None:
    found = found_in(scene(*ONE_BEHIND)[0])
    flags = {
        int(
            found.labels[tuple(np.argwhere(found.labels == one.number).mean(axis=0).astype(int))]
        ): one.flags
        for one in found.found
    }
    behind, front = 1, 2  # reading order: the one behind begins higher in the image
    assert "occluded" in flags[behind]
    assert "occluded" not in flags[front]
    assert all(one.branch == "range" for one in found.found)
    assert "truncated" not in flags[front]


def test_a_column_that_goes_on_below_the_ground_is_buried() -> None:
    plane = solids.plane_range(solids.CAMERA, normal=-DOWN, offset_m=-1.5)
    centre = 1.5 * DOWN - 2.0 * LEVEL
    half_ball = solids.ellipsoid_range(
        solids.CAMERA, centre_m=centre, half_axes_m=np.full(3, 0.2), axes=AXES
    )
    on_top, _ = scene((0.0, 2.0, 0.2))
    assert "buried" in found_in(solids.nearest(plane, half_ball)).found[0].flags
    assert "buried" not in found_in(on_top).found[0].flags


def test_the_published_way_is_what_it_was() -> None:
    points, truth = scene((-0.3, 2.0, 0.12), (0.3, 2.0, 0.15))
    image = np.full(points.shape[:2], 0.5, dtype=np.float32)
    found = segment_published(Observation(image=image, points_m=points, camera=solids.CAMERA))
    assert [one.branch for one in found.found] == ["range", "range"]
    assert overlap(truth > 0, found.labels > 0) > 0.9
    with pytest.raises(InputError, match="'published' expected range"):
        segment_published(Observation(image=image))


def test_exact_range_keeps_its_outlines_whatever_the_image_shows() -> None:
    # What stands less than 0.6 of a pixel's size is lost at the foot; nothing else is.
    points, labels = scene((0.0, 2.0, 0.15))
    image = np.full(points.shape[:2], 0.5, dtype=np.float32)
    image[:, : image.shape[1] // 2] = 0.05  # a shadow's edge across the rock
    found = segment_both(Observation(image=image, points_m=points, camera=solids.CAMERA))
    assert all(one.outline is None for one in found.found)
    assert overlap(found.labels == found.labels[labels == 1].max(), labels == 1) > 0.98


@pytest.mark.parametrize(
    ("rough_m", "inverse_depth_per_m", "fine"),
    [(0.0, 0.0, True), (2e-5, 1e-6, True), (2e-3, 1e-6, True), (0.0, 1e-4, False)],
)
def test_fine_range_is_finer_than_a_twentieth_of_a_pixel(
    rough_m: float, inverse_depth_per_m: float, fine: bool
) -> None:
    # At 4 m a pixel of 0.8 mrad is 3.2 mm: a twentieth is 0.16 mm.
    assert NoiseModel(inverse_depth_per_m, 7, rough_m, 8e-4).is_fine(4.0) is fine

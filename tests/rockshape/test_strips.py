"""Rasters computed in strips are those computed at once, and segmentation stays small."""

import tracemalloc

import cv2
import numpy as np
import pytest

from rockshape.numerics import strips
from rockshape.numerics.strips import by_strips
from rockshape.observation import Observation
from rockshape.segmentation.relabel import in_reading_order, label_areas, renumber
from rockshape.segmentation.robust import segment_both


@pytest.mark.parametrize("rows", [1, 7, 512, 513, 1300])
def test_a_filter_with_its_neighbours_is_the_whole_one(rows: int, rng: np.random.Generator) -> None:
    picture = rng.random((rows, 40)).astype(np.float32)

    def slope(part: np.ndarray) -> np.ndarray:
        return cv2.Sobel(part, cv2.CV_32F, 0, 1)

    np.testing.assert_array_equal(by_strips(slope, picture, halo=1), slope(picture))
    sums = by_strips(lambda one, two: (one + two)[..., None], picture, picture)
    np.testing.assert_array_equal(sums, 2 * picture[..., None])


def made_picture(rng: np.random.Generator, shape: tuple[int, int]) -> np.ndarray:
    """Bright and dim discs on sand."""
    sand = cv2.GaussianBlur(rng.normal(size=shape), (0, 0), 1.5)
    picture = (0.4 + 0.04 * sand / sand.std()).astype(np.float32)
    for _ in range(shape[0] * shape[1] // 15_000):
        centre = tuple(int(rng.uniform(0, side)) for side in reversed(shape))
        cv2.circle(picture, centre, int(rng.uniform(12, 40)), float(rng.choice([0.15, 0.75])), -1)
    return cv2.GaussianBlur(picture, (0, 0), 0.8)


def test_rocks_are_the_same_however_high_the_strips(
    rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = Observation(made_picture(rng, (700, 500)))
    whole = segment_both(seen)
    monkeypatch.setattr(strips, "ROWS", 64)
    parts = segment_both(seen)
    assert len(whole.instances) > 5
    np.testing.assert_array_equal(parts.instances.to_labels(), whole.instances.to_labels())
    for one, two in zip(parts.instances, whole.instances, strict=True):
        np.testing.assert_array_equal(one.outline_px, two.outline_px)


def test_numbers_of_a_high_label_image(rng: np.random.Generator) -> None:
    labels = rng.integers(0, 30, (1200, 20)).astype(np.int32)
    numbers, first = np.unique(labels, return_index=True)
    expected = numbers[np.argsort(first)]
    expected = expected[expected > 0]
    assert in_reading_order(labels).tolist() == expected.tolist()
    assert label_areas(labels).tolist() == np.bincount(labels.ravel()).tolist()
    renumbered = renumber(labels, dropped=np.empty(0, dtype=np.intp))
    assert in_reading_order(renumbered).tolist() == list(range(1, 30))


def test_segmentation_by_the_image_needs_few_bytes_a_pixel(rng: np.random.Generator) -> None:
    seen = Observation(made_picture(rng, (3000, 2000)))
    tracemalloc.start()
    try:
        segment_both(seen)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    traced = 75e6  # by 400 proposals at once, whatever the picture's size
    assert peak - traced < 20 * seen.image.size  # single-precision rasters and masks of a byte

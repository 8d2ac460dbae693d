"""The shipped weights on made beds that they never saw: found, and the same in any handling."""

import cv2
import numpy as np
import pytest

from rockshape.observation import Observation
from rockshape.segmentation import FINDERS
from rockshape.segmentation.by_network import network_branch
from rockshape.segmentation.by_network.instances import cut_rocks
from rockshape.segmentation.by_network.picture import as_fractions
from rockshape.segmentation.by_network.scales import joint_answer
from synth import make_bed

BED = make_bed(
    seed=10_400, width_px=320, height_px=320, grains={"median_px": [24, 24], "spread": [0.4, 0.4]}
)


def _found(picture: np.ndarray) -> np.ndarray:
    return cut_rocks(joint_answer(as_fractions(picture)))


def _wide(labels: np.ndarray, width_px: float) -> list[int]:
    """Labels of rocks as wide as a disc of a diameter, away from the frame."""
    area = np.bincount(labels.ravel())
    cut = np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]]))
    return [
        number
        for number in range(1, len(area))
        if 2.0 * np.sqrt(area[number] / np.pi) >= width_px and number not in cut
    ]


def _share_again(one: np.ndarray, two: np.ndarray, width_px: float, least: float) -> float:
    """Share of the rocks of one label image that another has too, at such an overlap."""
    numbers = _wide(one, width_px)
    again = 0
    for number in numbers:
        own = one == number
        partner = int(np.bincount(two[own]).argmax())
        again += (
            partner > 0 and (own & (two == partner)).sum() > least * (own | (two == partner)).sum()
        )
    assert len(numbers) > 10
    return again / len(numbers)


@pytest.fixture(scope="module")
def labels() -> np.ndarray:
    return _found(BED.image)


def test_most_grains_are_found(labels):
    assert _share_again(BED.labels.astype(np.int32), labels, 14.0, 0.5) > 0.7
    assert _share_again(labels, BED.labels.astype(np.int32), 14.0, 0.5) > 0.7


def test_a_crop_of_two_pixels_leaves_the_rocks(labels):
    cropped = _found(np.ascontiguousarray(BED.image[2:, 2:]))
    assert _share_again(cropped, labels[2:, 2:], 12.0, 0.8) > 0.75


def test_half_the_size_has_the_rocks_that_are_still_16_pixels_wide(labels):
    half = _found(cv2.resize(BED.image, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA))
    whole = cv2.resize(half, labels.shape[::-1], interpolation=cv2.INTER_NEAREST)
    assert _share_again(labels, whole, 32.0, 0.5) > 0.75


def test_threads_change_no_label():
    before = cv2.getNumThreads()
    try:
        cv2.setNumThreads(1)
        one = _found(BED.image)
        cv2.setNumThreads(2)
        assert np.array_equal(one, _found(BED.image))
    finally:
        cv2.setNumThreads(before)


def test_a_dark_frame_has_the_same_rocks(labels):
    assert _share_again(labels, _found((BED.image // 5).astype(np.uint8)), 16.0, 0.7) > 0.8


def test_the_finder_takes_colour_and_grey_and_pictures_of_any_size(labels):
    grey = np.asarray(BED.image.mean(axis=-1) / 255.0, dtype=np.float32)
    coloured = FINDERS["network"].segment(Observation(image=grey, colour=BED.image)).labels
    assert (coloured > 0).mean() == pytest.approx((labels > 0).mean(), abs=0.02)
    without = FINDERS["network"].segment(Observation(image=grey)).labels
    assert _share_again(BED.labels.astype(np.int32), without, 16.0, 0.5) > 0.5
    for shape in ((1, 1), (7, 40), (33, 65)):
        tiny = FINDERS["network"].segment(Observation(image=np.zeros(shape, np.float32)))
        assert len(tiny.instances) == 0


def test_what_is_larger_than_a_block_is_answered_as_its_parts_are():
    rng = np.random.default_rng(1)
    picture = cv2.GaussianBlur(rng.uniform(0, 1, (96, 2200)).astype(np.float32), (0, 0), 3)
    whole = joint_answer(picture).rock
    part = joint_answer(picture[:, 700:1500]).rock
    assert np.abs(whole[:, 900:1300] - part[:, 200:600]).mean() < 0.02


def test_a_picture_searched_window_by_window_has_the_rocks_of_one_searched_whole(
    labels, monkeypatch
):
    monkeypatch.setattr(network_branch, "WINDOW_PX", 100)
    monkeypatch.setattr(network_branch, "OVERLAP_PX", 64)
    grey = np.zeros(labels.shape, dtype=np.float32)
    by_parts = FINDERS["network"].segment(Observation(image=grey, colour=BED.image)).labels
    assert by_parts.max() < 1.2 * labels.max()
    assert _share_again(labels, by_parts, 14.0, 0.5) > 0.8

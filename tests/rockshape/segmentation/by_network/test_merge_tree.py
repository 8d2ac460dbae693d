"""Merge tree and choice held to pictures that are told by hand."""

import numpy as np
import pytest

from rockshape.segmentation.by_network.answer import Answer
from rockshape.segmentation.by_network.instances import chosen
from rockshape.segmentation.by_network.likelihood import features_of, terms
from rockshape.segmentation.by_network.merge_tree import MergeTree, merge_tree
from rockshape.segmentation.by_network.regions import regions_of

NAMES = (
    *("rock", "distance", "border", "top", "rock sd", "width sd", "width"),
    *("rim border", "seam border", "joint", "beyond", "seam", "frame"),
    *("area", "ellipse", "rim"),
)


def _answer(labels: np.ndarray, seams: dict[int, float]) -> Answer:
    """Bricks of ten columns; the border at the left side of a brick has the probability given."""
    rows, cols = labels.shape
    border = np.zeros((rows, cols), dtype=np.float32)
    for col, value in seams.items():
        border[:, col - 1 : col + 1] = value
    across = np.abs((np.arange(cols) % 10) - 4.5)
    distance = np.repeat((1.0 - across / 5.0)[None], rows, axis=0).astype(np.float32)
    rock = (labels > 0).astype(np.float32)
    return Answer(rock, border, distance * rock, np.full((rows, cols), 10.0, dtype=np.float32))


@pytest.fixture
def tree() -> MergeTree:
    labels = np.zeros((12, 60), dtype=int)
    labels[1:11, 10:40] = 1  # three bricks and ground round them
    return merge_tree(regions_of(_answer(labels, {20: 0.6, 30: 0.2})))


def test_the_weakest_seam_is_joined_first(tree):
    assert len(tree.children) == 5
    assert sorted(tree.children[3]) == [1, 2]
    assert sorted(tree.children[4]) == [0, 3]


def test_sums_outlines_and_seams_add_up(tree):
    assert tree.pixels.area.tolist() == [100.0, 100.0, 100.0, 200.0, 300.0]
    assert tree.rim[:, 0].tolist() == [40.0, 40.0, 40.0, 60.0, 80.0]
    assert tree.seam[:, 0].tolist() == [0.0, 0.0, 0.0, 10.0, 20.0]
    np.testing.assert_allclose(tree.seam[:, 1], [0.0, 0.0, 0.0, 2.0, 8.0], rtol=1e-6)
    # the ends of both seams, two columns wide, above and below
    np.testing.assert_allclose(tree.rim[4, 1], 4 * 0.6 + 4 * 0.2, rtol=1e-6)


def test_seams_that_are_surely_borders_join_nothing():
    labels = np.zeros((12, 60), dtype=int)
    labels[1:11, 10:30] = 1
    assert len(merge_tree(regions_of(_answer(labels, {20: 0.95}))).children) == 2


def test_joints_and_tops_follow_the_parts(tree):
    np.testing.assert_allclose(tree.joint, [0.0, 0.0, 0.0, 0.2, 0.6], rtol=1e-6)
    np.testing.assert_allclose(sorted(tree.beyond), [0.2, 0.2, 0.6, 0.6, 1.0], rtol=1e-6)
    np.testing.assert_allclose(tree.top, 0.9, rtol=1e-6)
    assert tree.beyond[4] == 1.0


def test_features_of_a_square(tree):
    """The first brick: 10 by 10 pixels of sure rock, told to be 10 px wide, away from the frame."""
    told = dict(zip(NAMES, features_of(tree)[0], strict=True))
    for name in ("rock sd", "width sd", "seam border", "joint", "seam", "frame"):
        assert told[name] == pytest.approx(0.0, abs=1e-6)
    assert told["rock"] == pytest.approx(1.0)
    assert told["distance"] == pytest.approx(np.mean(1.0 - np.abs(np.arange(10) - 4.5) / 5.0))
    assert told["top"] == pytest.approx(0.9)
    assert told["border"] == pytest.approx(0.6 / 10.0)  # one column of ten
    assert told["rim border"] == pytest.approx(12 * 0.6 / 40.0)  # ten rows, and both ends
    assert told["beyond"] == pytest.approx(0.6)
    # least axis of the ellipse with a square's moments: 4 √(s²/12), pixels included
    own_px = 4.0 * np.sqrt(100.0 / 12.0)
    assert told["width"] == pytest.approx(np.log2(10.0 / own_px), abs=1e-6)
    assert told["area"] == pytest.approx(np.log2(100.0) / 8.0)
    assert told["ellipse"] == pytest.approx(100.0 / (4.0 * np.pi * 100.0 / 12.0))
    assert told["rim"] == pytest.approx(40.0 / (8.0 * np.sqrt(100.0 / np.pi)))


def test_spreads_and_the_frame_of_a_region():
    """Half a region is less surely rock and told to be wider; a side of it is the frame's."""
    labels = np.zeros((12, 30), dtype=int)
    labels[1:11, :10] = 1
    answer = _answer(labels, {})
    rock, width_px = answer.rock.copy(), answer.width_px.copy()
    rock[1:6, :10] = 0.5
    width_px[1:6, :10] = 40.0
    uneven = merge_tree(regions_of(Answer(rock, answer.border, answer.distance, width_px)))
    told = dict(zip(NAMES, features_of(uneven)[0], strict=True))
    assert told["rock"] == pytest.approx(0.75)
    assert told["rock sd"] == pytest.approx(0.25)
    assert told["width sd"] == pytest.approx(1.0)  # of log2 10 and log2 40
    assert told["frame"] == pytest.approx(10.0 / 30.0)  # whose pixels are no part of the outline


def test_terms_are_products_of_each_two():
    assert terms(np.array([[2.0, 3.0]])).tolist() == [[1.0, 2.0, 3.0, 4.0, 6.0, 9.0]]


@pytest.mark.parametrize(
    ("gain", "expected"),
    [
        ([0.3, 0.3, 0.3, 0.7, 0.1], [2, 1, 1, 1, 0]),  # two joined, the third for itself
        ([0.3, 0.3, 0.3, 0.5, 0.1], None),  # three for themselves
        ([0.3, 0.3, 0.3, 0.5, 1.0], [1, 1, 1, 1, 1]),  # all one
        ([-0.3, -0.3, 0.3, -0.1, -0.2], [0, 0, 1, 0, 0]),
    ],
)
def test_the_cut_with_the_greatest_sum_is_chosen(tree, gain, expected):
    number = chosen(tree, np.array(gain))
    if expected is None:
        assert len(set(number[:3])) == 3
        assert (number[:3] > 0).all()
    else:
        order = {old: new for new, old in enumerate(dict.fromkeys(n for n in number[::-1] if n), 1)}
        assert [order.get(n, 0) for n in number] == expected


def test_no_rock_at_all():
    nothing = np.zeros((20, 30), dtype=np.float32)
    tree = merge_tree(regions_of(Answer(nothing, nothing, nothing, nothing + 10.0)))
    assert len(tree.children) == 0
    assert features_of(tree).shape == (0, 16)

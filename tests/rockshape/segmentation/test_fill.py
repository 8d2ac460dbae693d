import numpy as np
from skimage.measure import points_in_poly

from rockshape.outline.polygon_fill import inside_of
from rockshape.segmentation.relabel import in_reading_order, renumber


def filled(x: np.ndarray, y: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    window, mask = inside_of(x, y, shape)
    frame = np.zeros(shape, dtype=bool)
    frame[window] = mask
    return frame


def test_a_centre_is_filled_where_it_lies_within(rng: np.random.Generator) -> None:
    rows, cols = np.mgrid[:60, :80]
    centres = np.column_stack([cols.ravel(), rows.ravel()])
    for _ in range(20):
        turn = np.sort(rng.uniform(0, 2 * np.pi, 40))
        radius = rng.uniform(5, 45, 40)  # jagged, and often over the frame's border
        x, y = 40 + radius * np.cos(turn), 30 + radius * np.sin(turn)
        inside = points_in_poly(centres, np.column_stack([x, y])).reshape(60, 80)
        assert np.array_equal(filled(x, y, (60, 80)), inside)


def test_boxes_side_by_side_share_no_pixel_and_leave_none() -> None:
    left = filled(np.array([2.0, 10, 10, 2]), np.array([3.0, 3, 20, 20]), (30, 30))
    right = filled(np.array([10.0, 15, 15, 10]), np.array([3.0, 3, 20, 20]), (30, 30))
    assert not (left & right).any()
    assert (left | right).sum() == 13 * 17


def test_beyond_the_frame_nothing_is_filled() -> None:
    box = np.array([40.0, 50, 50, 40])
    assert not filled(box, np.array([40.0, 40, 50, 50]), (30, 30)).any()
    assert not filled(-box, np.array([4.0, 4, 15, 15]), (30, 30)).any()


def test_numbers_follow_the_first_pixel_of_each() -> None:
    labels = np.array([[0, 7, 7], [3, 3, 7], [9, 0, 3]], dtype=np.int32)
    assert in_reading_order(labels).tolist() == [7, 3, 9]
    assert renumber(labels, dropped=np.array([3])).tolist() == [[0, 1, 1], [0, 0, 1], [2, 0, 0]]
    assert renumber(0 * labels, dropped=np.array([], dtype=int)).max() == 0

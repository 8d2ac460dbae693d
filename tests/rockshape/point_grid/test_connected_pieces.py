"""Connected pieces of drawn images: steps part them, slopes do not."""

import numpy as np

from rockshape.point_grid.connected_pieces import connected_pieces

ROWS, COLS = np.indices((12, 20)).astype(float)
STEP = np.full((12, 20), 0.5)


def test_a_step_parts_two_halves() -> None:
    pieces = connected_pieces((np.where(COLS < 8, 0.0, 1.0), STEP))
    assert len(np.unique(pieces[:, :8])) == len(np.unique(pieces[:, 8:])) == 1
    assert pieces[0, 0] != pieces[0, 8]


def test_a_steep_plane_is_one_piece() -> None:
    assert len(np.unique(connected_pieces((7 * COLS - 3 * ROWS, STEP)))) == 1


def test_a_flat_and_a_steep_face_that_meet_are_one_piece() -> None:
    roof = np.maximum(0.0, 5 * (COLS - 9))
    assert len(np.unique(connected_pieces((roof, STEP)))) == 1


def test_a_row_that_is_off_is_a_piece_of_its_own() -> None:
    image = 0.3 * COLS
    image[5] += 4.0
    pieces = connected_pieces((image, STEP))
    above, row, below = pieces[:5], pieces[5, 1:-1], pieces[6:]
    assert [len(np.unique(part)) for part in (above, row, below)] == [1, 1, 1]
    assert len({above[0, 0], row[0], below[0, 0]}) == 3


def test_a_pixel_that_one_neighbour_alone_holds_is_alone() -> None:
    image = np.full_like(COLS, np.nan)
    image[4:7, 4:7] = 0.0
    image[7, 7] = 0.0
    pieces = connected_pieces((image, STEP))
    assert pieces[7, 7] != pieces[6, 6]
    assert len(np.unique(pieces[4:7, 4:7])) == 1


def test_every_image_must_agree() -> None:
    level, stepped = np.zeros_like(COLS), np.where(ROWS < 6, 0.0, 2.0)
    pieces = connected_pieces((level, STEP), (stepped, STEP))
    assert pieces[0, 0] != pieces[11, 0]


def test_unknown_pixels_join_nothing() -> None:
    image = np.zeros_like(COLS)
    image[:, 10] = np.nan
    pieces = connected_pieces((image, STEP))
    assert pieces[0, 0] != pieces[0, 19]
    assert np.unique(pieces[:, 10]).size == 12

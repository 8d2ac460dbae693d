"""Visibility of a rock: what surely hides a part of its ellipse, and what may."""

import numpy as np
import pytest
from numpy.typing import NDArray

from rockshape import Instances
from rockshape.ellipse.direct import Ellipse
from rockshape.rock.instances import Instance
from rockshape.rock.visibility import visibility

ROWS, COLS = np.mgrid[:80, :120]
FIRST = np.hypot(ROWS - 40, COLS - 45) < 25
SECOND = np.hypot(ROWS - 40, COLS - 80) < 25
CUT = np.where(SECOND, 2, np.where(FIRST, 1, 0))
ELLIPSE = Ellipse(x=45.0, y=40.0, major=25.0, minor=25.0, angle_rad=0.0)  # the first, uncut
COVERED = (FIRST & SECOND).sum() / FIRST.sum()


def points_m(first_m: float, second_m: float) -> NDArray[np.float64]:
    """Range of both rocks, each at one depth; NaN where it is unknown."""
    depth_m = np.where(CUT == 1, first_m, np.where(CUT == 2, second_m, 2.0))
    return np.stack([np.zeros((80, 120)), np.zeros((80, 120)), depth_m], axis=-1)


def seen(points: NDArray[np.float64] | None, ignored: NDArray[np.bool_] | None = None):
    instances = Instances.from_labels(CUT.astype(np.int32))
    return visibility(instances.items[0], ELLIPSE, instances, points, ignored)


@pytest.mark.parametrize(
    ("points", "fraction", "least"),
    [
        (points_m(2.5, 2.0), 1 - COVERED, 1 - COVERED),
        (points_m(2.0, 2.5), 1, 1),
        (points_m(2.0, np.nan), 1, 1 - COVERED),
        (points_m(np.nan, 2.0), 1, 1 - COVERED),
        (None, 1, 1 - COVERED),
    ],
    ids=["farther", "nearer", "neighbour unknown", "itself unknown", "no range"],
)
def test_a_neighbour_hides_unless_it_is_known_to_be_farther(points, fraction, least) -> None:
    found = seen(points)
    assert found.fraction == pytest.approx(fraction, abs=0.01)
    assert found.least == pytest.approx(least, abs=0.01)


def test_ignored_pixels_may_hide_a_part() -> None:
    left = COLS < 30
    found = seen(points_m(2.0, 2.5), left)
    assert found.fraction == pytest.approx(1, abs=0.01)
    assert found.least == pytest.approx(1 - (FIRST & left).sum() / FIRST.sum(), abs=0.01)


def test_a_rocks_own_pixels_are_visible_where_instances_overlap() -> None:
    window = slice(0, 80), slice(0, 120)
    whole = Instances((80, 120), (Instance(1, window, FIRST), Instance(2, window, SECOND)))
    found = visibility(whole.items[0], ELLIPSE, whole, None, None)
    assert found.least == pytest.approx(1, abs=0.01)


def test_without_an_ellipse_nothing_is_known() -> None:
    instances = Instances.from_labels(CUT.astype(np.int32))
    assert np.isnan(visibility(instances.items[0], None, instances, None, None)).all()

"""Hull, Feret diameters and smallest rectangle."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.spatial import ConvexHull

from rockshape.outline.extent import convex_hull, feret_diameters, smallest_rectangle
from rockshape.outline.trace import signed_area
from tests import solids

clouds = arrays(np.float64, st.tuples(st.integers(3, 30), st.just(2)), elements=st.floats(-9, 9))


def widths(points: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Extents of points seen along many bearings."""
    return np.ptp(points @ np.array([np.cos(turns), np.sin(turns)]), axis=0)


@given(points=clouds)
def test_feret_diameters_are_the_extremes_over_all_bearings(points: np.ndarray) -> None:
    least, greatest = feret_diameters(points)
    turns = np.linspace(0, np.pi, 2000)
    seen = widths(points, turns)
    # between two bearings a width changes by at most their distance times the diameter; the hull
    # is found in single precision
    slack = (turns[1] + 1e-6) * seen.max() + 1e-9
    assert least == pytest.approx(seen.min(), abs=slack)
    assert greatest == pytest.approx(seen.max(), abs=slack)
    every = np.linalg.norm(points[:, None] - points, axis=2).max()
    assert greatest == pytest.approx(every, abs=1e-5 * every + 1e-12)


@given(points=clouds)
def test_no_turned_rectangle_is_smaller(points: np.ndarray) -> None:
    long, short = smallest_rectangle(points)
    turns = np.linspace(0, np.pi / 2, 1000)
    areas = widths(points, turns) * widths(points, turns + np.pi / 2)
    scale = np.ptp(points, axis=0).max() ** 2
    assert short <= long
    assert long * short <= areas.min() + 1e-5 * scale + 1e-12
    assert long * short >= areas.min() - 0.01 * scale - 1e-12  # the step between two bearings


def test_the_hull_is_qhulls(rng: np.random.Generator) -> None:
    points = rng.normal(size=(500, 2))
    hull = convex_hull(points)
    theirs = ConvexHull(points)
    assert abs(signed_area(hull)) == pytest.approx(theirs.volume, rel=1e-6)  # single precision
    assert {tuple(p) for p in hull} == {tuple(p) for p in points[theirs.vertices]}


def test_closed_forms() -> None:
    square = solids.regular_polygon(4, np.sqrt(2), points=40)
    assert feret_diameters(square) == pytest.approx((2, 2 * np.sqrt(2)))
    assert smallest_rectangle(square) == pytest.approx((2, 2))
    triangle = solids.regular_polygon(3, 2, points=30)
    assert feret_diameters(triangle) == pytest.approx((3, 2 * np.sqrt(3)))
    assert sorted(smallest_rectangle(triangle)) == pytest.approx([3, 2 * np.sqrt(3)])


def test_degenerate_outlines() -> None:
    assert np.isnan(feret_diameters(np.empty((0, 2)))).all()
    assert np.isnan(smallest_rectangle(np.empty((0, 2)))).all()
    assert feret_diameters(np.ones((4, 2))) == (0, 0)
    assert smallest_rectangle(np.ones((4, 2))) == (0, 0)
    line = np.column_stack([np.arange(5.0), np.zeros(5)])
    assert feret_diameters(line) == pytest.approx((0, 4))
    assert smallest_rectangle(line) == pytest.approx((4, 0))

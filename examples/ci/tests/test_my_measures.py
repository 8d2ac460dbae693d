"""Tests beside the gates: on a mask that is drawn here, and on rendered rocks."""

import numpy as np
import pytest
from my_measures import shape

from validation.testing import assert_consistent, assert_ranks

SCENE = {
    "site": "plain",
    "seed": 7,
    "renderer": "embree",
    "rocks": {"count": 5, "series": "random", "b_over_a": [0.4, 1.0]},
    "camera": {"preset": "imp"},
}


@pytest.fixture(scope="module")
def views(rockshape_view):
    """Return the same five rocks from two places."""
    return [rockshape_view(SCENE, view=number) for number in range(2)]


def test_an_ellipse_has_its_axis_ratio():
    y, x = np.mgrid[-60:61, -60:61]
    assert shape((x / 50) ** 2 + (y / 25) ** 2 <= 1)["axis_ratio"] == pytest.approx(0.5, abs=0.01)


def test_axis_ratios_are_in_the_order_of_the_true_outlines(views):
    for view in views:
        ratios = {rock: shape(view.labels == rock)["axis_ratio"] for rock in view.truth["id"]}
        assert_ranks(ratios, view.truth.set_index("id")["outline_axis_ratio"], at_least=0.8)


def test_circularity_holds_between_views(views):
    assert_consistent(
        [
            {rock: shape(view.labels == rock)["circularity"] for rock in view.truth["id"]}
            for view in views
        ],
        cv_at_most=0.2,  # a slab that lies is long from one place and round from another
    )

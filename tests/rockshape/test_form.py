"""The form of an outline against closed forms."""

import numpy as np
import pytest

from rockshape.outline.edge import trace_edge
from rockshape.outline.form import FORM_SHARE, LEAST_SIGMA_PX, OutlineForm, form_of
from tests import solids


def form(edge: np.ndarray, *, staircase: bool = True) -> OutlineForm:
    found = form_of(edge, staircase=staircase)
    assert found is not None
    return found


def test_the_form_does_not_depend_on_start_and_direction() -> None:
    edge = trace_edge(solids.ellipse(31, 17, turn_rad=0.7, shift=(0.2, 0.3)))
    expected = form(edge)
    for other in (np.roll(edge, 41, axis=0), edge[::-1], np.roll(edge[::-1], 7, axis=0)):
        assert form(other).points == pytest.approx(expected.points, abs=1e-9)
        assert form(other).curvature == pytest.approx(expected.curvature, abs=1e-9)


@pytest.mark.parametrize("radius", [10, 40, 250])
def test_curvature_of_a_circle_is_its_inverse_radius(radius: float) -> None:
    circle = form(solids.circle(radius, points=4000), staircase=False)
    # smoothing shrinks it by sigma^4 / (4 R^3), 0.12^4 / 4 of the radius
    assert circle.curvature * radius == pytest.approx(1, rel=2e-4)
    assert circle.lengths.sum() == pytest.approx(2 * np.pi * radius, rel=2e-4)
    assert circle.scale == FORM_SHARE
    assert np.hypot(*circle.even_points.T) == pytest.approx(radius, rel=6e-4)  # chords


def test_curvature_of_an_ellipse_is_its_own() -> None:
    turns = 2 * np.pi * np.arange(8000) / 8000
    outline = np.column_stack([200 * np.cos(turns), 120 * np.sin(turns)])
    curvature = form(outline, staircase=False).curvature
    assert curvature.max() == pytest.approx(200 / 120**2, rel=0.02)
    assert curvature.min() == pytest.approx(120 / 200**2, rel=0.02)


def test_the_turning_of_any_form_is_one_whole_turn(rng: np.random.Generator) -> None:
    for turn in rng.uniform(0, 7, 5):
        rough = form(trace_edge(solids.ellipse(40, 18, turn_rad=turn, shift=(0.3, 0.1))))
        assert rough.curvature @ rough.lengths == pytest.approx(2 * np.pi, rel=1e-3)


def test_small_rocks_are_smoothed_by_what_pixels_ask_for() -> None:
    small = form(trace_edge(solids.disc(9)))
    assert small.sigma == LEAST_SIGMA_PX
    assert small.scale > FORM_SHARE
    assert form(solids.circle(9, points=200), staircase=False).scale == FORM_SHARE


def test_the_variance_that_pixels_give_the_curvature_is_as_told(rng: np.random.Generator) -> None:
    for radius in (12, 30, 60):
        found = [
            form(trace_edge(solids.disc(radius, shift=(x, y))))
            for x, y in rng.uniform(0, 1, (8, 2))
        ]
        measured = np.mean([one.curvature.var() for one in found])
        assert measured == pytest.approx(found[0].curvature_variance, rel=0.35)


def test_what_has_no_area_has_no_form() -> None:
    line = np.column_stack([np.r_[np.arange(50.0), np.arange(50.0, 0, -1)], np.zeros(100)])
    for outline in (line, np.ones((60, 2)), np.empty((0, 2)), np.ones((1, 2))):
        assert form_of(outline, staircase=False) is None

import itertools

import numpy as np
import pytest

from rockshape.measures.angularity_2d import angularity_2d_deg
from rockshape.outline.trace import trace_outline
from tests import solids


def by_law_of_cosines(outline: np.ndarray) -> float:
    """Equations 6 and 7, triangle by triangle."""
    count = len(outline)
    flattest = []
    for i in range(count):
        angles = []
        for back, forth in itertools.product(range(3, 9), repeat=2):
            h, j = outline[i - back], outline[(i + forth) % count]
            a, b = np.linalg.norm(h - outline[i]), np.linalg.norm(j - outline[i])
            c = np.linalg.norm(h - j)
            angles.append(np.arccos(np.clip((a * a + b * b - c * c) / (2 * a * b), -1, 1)))
        flattest.append(max(angles))
    return float(np.degrees(np.std(flattest, ddof=1)))


def test_equals_the_law_of_cosines_over_all_triangles() -> None:
    outline = trace_outline(solids.ellipse(23, 14, turn_rad=0.3))
    # arccos near 180 degrees turns a rounding of 1e-16 into 1e-8
    assert angularity_2d_deg(outline) == pytest.approx(by_law_of_cosines(outline), abs=1e-5)


def test_a_circle_of_points_scores_nothing() -> None:
    assert angularity_2d_deg(solids.circle(50, points=300)) == pytest.approx(0, abs=1e-5)


def test_a_square_scores_by_its_corners() -> None:
    # 8 points a side apart from a corner see a flat side; those nearer see the corner
    outline = solids.regular_polygon(4, 100, points=400)
    flattest = np.full(400, 180.0)
    for corner in range(0, 400, 100):
        for distance in range(-2, 3):
            flattest[corner + distance] = flattest_across_a_corner(abs(distance))
    # offsets of 3 and more reach past a corner nearer than three points
    assert angularity_2d_deg(outline) == pytest.approx(flattest.std(ddof=1), abs=1e-5)


def flattest_across_a_corner(distance: int) -> float:
    """Largest angle at a point `distance` steps before a right corner, sides of 3 to 8 steps."""
    if distance == 0:
        return 90.0
    # the triangle goes back along the side, and past the corner by the other side's rest
    rests = np.arange(3, 9) - distance
    return 180.0 - float(np.degrees(np.arctan2(rests, distance)).min())


@pytest.mark.parametrize(("radius", "degrees"), [(6, 12.0), (20, 7.2), (50, 3.7), (100, 2.4)])
def test_a_disc_on_pixels_does_not_score_nothing(
    radius: float, degrees: float, rng: np.random.Generator
) -> None:
    scores = [
        angularity_2d_deg(trace_outline(solids.disc(radius, shift=(x, y))))
        for x, y in rng.uniform(-0.5, 0.5, (60, 2))
    ]
    # the centre's place between the pixels moves a score by a fifth at 6 pixels: 3 % in the mean
    assert np.mean(scores) == pytest.approx(degrees, rel=0.1)


def test_start_point_and_direction_do_not_matter() -> None:
    outline = trace_outline(solids.ellipse(30, 12, turn_rad=1.0))
    expected = angularity_2d_deg(outline)
    # summation order moves the last digits only
    assert angularity_2d_deg(np.roll(outline, 37, axis=0)) == pytest.approx(expected, rel=1e-12)
    assert angularity_2d_deg(outline[::-1]) == pytest.approx(expected, rel=1e-9)


def test_fewer_corners_are_sharper() -> None:
    scores = [
        angularity_2d_deg(solids.regular_polygon(sides, 60, points=360))
        for sides in (3, 4, 5, 6, 8)
    ]
    assert scores == sorted(scores, reverse=True)


def test_too_short_an_outline_is_nan() -> None:
    assert np.isnan(angularity_2d_deg(solids.circle(5, points=16)))
    assert np.isfinite(angularity_2d_deg(solids.circle(5, points=17)))

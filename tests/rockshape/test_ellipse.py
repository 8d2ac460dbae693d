import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rockshape.ellipse import Ellipse, fit_ellipse
from rockshape.outline import trace_outline
from tests import solids


def on_ellipse(ellipse: Ellipse, turns: np.ndarray) -> np.ndarray:
    u, v = ellipse.major * np.cos(turns), ellipse.minor * np.sin(turns)
    cosine, sine = np.cos(ellipse.angle_rad), np.sin(ellipse.angle_rad)
    return np.column_stack([ellipse.x + u * cosine - v * sine, ellipse.y + u * sine + v * cosine])


@given(
    x=st.floats(-5000, 5000),
    y=st.floats(-5000, 5000),
    major=st.floats(5, 500),
    ratio=st.floats(0.05, 0.95),
    angle=st.floats(-1.5, 1.5),
)
def test_points_on_an_ellipse_give_it_back(
    x: float, y: float, major: float, ratio: float, angle: float
) -> None:
    truth = Ellipse(x=x, y=y, major=major, minor=ratio * major, angle_rad=angle)
    fit = fit_ellipse(on_ellipse(truth, np.linspace(0, 6, 40)))
    assert fit is not None
    # squares of numbers near 1 at double precision, through one eigenproblem
    assert fit.axis_ratio == pytest.approx(ratio, abs=1e-6)
    assert (fit.x, fit.y) == pytest.approx((x, y), abs=1e-6 * major)
    assert np.sin(fit.angle_rad - angle) == pytest.approx(0, abs=1e-5)


def test_agrees_with_opencv_on_a_noisy_outline(rng: np.random.Generator) -> None:
    truth = Ellipse(x=120.0, y=80.0, major=60.0, minor=25.0, angle_rad=0.7)
    points = on_ellipse(truth, np.linspace(0, 2 * np.pi, 200, endpoint=False))
    points += rng.normal(scale=1.0, size=points.shape)
    (_, _), sides, _ = cv2.fitEllipseDirect(points.astype(np.float32))
    fit = fit_ellipse(points)
    assert fit is not None
    # OpenCV takes single precision and adds its own regularisation
    assert sorted(sides) == pytest.approx([2 * fit.minor, 2 * fit.major], rel=1e-3)


def test_a_rendered_ellipse_is_measured_to_a_pixel() -> None:
    mask = solids.ellipse(80, 48, turn_rad=0.4)
    fit = fit_ellipse(trace_outline(mask))
    assert fit is not None
    # boundary pixel centres lie within one pixel inside the edge
    assert 79 <= fit.major <= 80
    assert 47 <= fit.minor <= 48
    assert fit.angle_rad == pytest.approx(0.4, abs=0.01)


def test_radial_distance_is_measured_along_the_ray() -> None:
    ellipse = Ellipse(x=1.0, y=2.0, major=4.0, minor=2.0, angle_rad=np.pi / 2)
    points = np.array([[1.0, 7.0], [1.0, 3.0], [4.0, 2.0], [1.0, 2.0]])
    assert ellipse.radial_distance(points) == pytest.approx([1.0, -3.0, 1.0, -2.0])


def test_radial_distance_exceeds_the_orthogonal_within_its_bound(
    rng: np.random.Generator,
) -> None:
    ellipse = Ellipse(x=0.0, y=0.0, major=5.0, minor=2.0, angle_rad=0.0)
    dense = on_ellipse(ellipse, np.linspace(0, 2 * np.pi, 20_000))
    points = on_ellipse(ellipse, rng.uniform(0, 2 * np.pi, 50)) * 1.01
    orthogonal = np.linalg.norm(points[:, None] - dense, axis=2).min(axis=1)
    radial = ellipse.radial_distance(points)
    bound = (5.0**2 + 2.0**2) / (2 * 5.0 * 2.0)
    assert np.all(radial >= orthogonal * (1 - 1e-3))  # 1e-3: spacing of the dense ellipse
    assert np.all(radial <= orthogonal * bound * 1.01)  # the bound holds for small distances


@pytest.mark.parametrize(
    "points",
    [
        np.empty((0, 2)),
        np.zeros((9, 2)),
        np.column_stack([np.arange(9.0), 2 * np.arange(9.0)]),
        solids.circle(3, points=5),
    ],
    ids=["none", "one place", "a line", "five points"],
)
def test_no_ellipse_where_none_is_determined(points: np.ndarray) -> None:
    assert fit_ellipse(points) is None

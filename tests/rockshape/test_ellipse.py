import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from skimage.measure import regionprops

from rockshape.ellipse.arc import fit_arc
from rockshape.ellipse.direct import Ellipse, fit_ellipse
from rockshape.ellipse.moments import moment_ellipse
from rockshape.outline.edge import trace_edge
from rockshape.outline.trace import trace_outline
from tests import solids

undetermined = pytest.mark.parametrize(
    "points",
    [
        np.empty((0, 2)),
        np.zeros((9, 2)),
        np.column_stack([np.arange(9.0), 2 * np.arange(9.0)]),
        solids.circle(3, points=5),
    ],
    ids=["none", "one place", "a line", "five points"],
)


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


@undetermined
def test_no_ellipse_where_none_is_determined(points: np.ndarray) -> None:
    assert fit_ellipse(points) is None


@pytest.mark.parametrize("ratio", [1.0, 0.999, 0.6, 0.1, 0.01])
def test_orthogonal_distance_is_brute_forces(ratio: float, rng: np.random.Generator) -> None:
    ellipse = Ellipse(x=3.0, y=4.0, major=50.0, minor=50 * ratio, angle_rad=0.5)
    dense = on_ellipse(ellipse, np.linspace(0, 2 * np.pi, 40_001))
    axes = np.array([[np.cos(0.5), np.sin(0.5)], [-np.sin(0.5), np.cos(0.5)]])
    own = np.array([[0, 0], [10, 0], [49.9, 0], [60, 0], [0, 0.5 * ratio], [0, 70], [-20, 0]])
    points = np.concatenate([rng.uniform(-80, 80, (100, 2)), own @ axes + np.array([3, 4])])
    brute = np.linalg.norm(points[:, None] - dense, axis=2).min(axis=1)
    # half the spacing of the dense ellipse, beside a distance or across it
    spacing = 50 * 2 * np.pi / 40_000
    assert np.abs(ellipse.orthogonal_distance(points)) == pytest.approx(
        brute, abs=spacing / 2, rel=1e-6
    )
    radial = ellipse.radial_distance(points)
    assert np.all(np.sign(ellipse.orthogonal_distance(points)) == np.sign(radial))
    assert ellipse.orthogonal_distance(dense) == pytest.approx(0, abs=1e-6)  # roundings, 50 px


@given(x=st.floats(-900, 900), ratio=st.floats(0.1, 0.95), angle=st.floats(-1.5, 1.5))
def test_an_arc_without_noise_gives_its_ellipse_back(x: float, ratio: float, angle: float) -> None:
    truth = Ellipse(x=x, y=30.0, major=50.0, minor=50 * ratio, angle_rad=angle)
    fit = fit_arc(on_ellipse(truth, np.linspace(0.4, 2.5, 60)))
    assert fit is not None
    # a third of an ellipse magnifies roundings, the flatter the more
    assert fit.axis_ratio == pytest.approx(ratio, abs=1e-4)


def third_of_an_ellipse(start_rad: float, turn_rad: float) -> np.ndarray:
    """Edge points of the pixels of an ellipse 0.60, half-axis 100, in a third of its turn."""
    edge = trace_edge(solids.ellipse(100, 60, turn_rad=turn_rad))
    offset = edge - 104  # the middle of its frame
    cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
    place = np.arctan2((offset @ (-sine, cosine)) / 0.6, offset @ (cosine, sine)) - start_rad
    return np.asarray(edge[place % (2 * np.pi) < 2 * np.pi / 3])


def test_a_third_of_an_ellipse_on_pixels_has_its_axis_ratio(rng: np.random.Generator) -> None:
    ratios = []
    for start, turn in rng.uniform(0, 2 * np.pi, (40, 2)):
        fit = fit_arc(third_of_an_ellipse(start, turn))
        assert fit is not None
        ratios.append(fit.axis_ratio)
    # the benchmark's standard deviation is 0.006; its mean over 40 is known to 0.001
    assert np.mean(ratios) == pytest.approx(0.6, abs=0.004)
    assert np.std(ratios) < 0.012


def test_noise_flattens_an_arcs_direct_fit_and_not_the_other(rng: np.random.Generator) -> None:
    direct, hyper = [], []
    for start, turn in rng.uniform(0, 2 * np.pi, (60, 2)):
        points = third_of_an_ellipse(start, turn)
        points += rng.normal(scale=2.0, size=points.shape)
        fits = fit_ellipse(points), fit_arc(points)
        assert fits[0] is not None
        assert fits[1] is not None
        direct.append(fits[0].axis_ratio)
        hyper.append(fits[1].axis_ratio)
    # the benchmark has 0.566 +- 0.189 and 0.599 +- 0.044
    assert np.mean(hyper) == pytest.approx(0.6, abs=0.02)
    assert np.std(hyper) < 0.5 * np.std(direct)


@undetermined
def test_no_arc_where_none_is_determined(points: np.ndarray) -> None:
    assert fit_arc(points) is None


def test_moments_of_an_outline_are_those_of_its_pixels() -> None:
    mask = solids.ellipse(60, 25, turn_rad=0.7, shift=(0.3, 0.1)) & ~solids.ellipse(
        60, 25, turn_rad=0.7, shift=(70, 50)
    )
    region = regionprops(mask.astype(np.uint8))[0]
    ellipse = moment_ellipse(trace_edge(mask))
    assert ellipse is not None
    # the polygon cuts an eighth of each pixel corner; pixels are summed as squares by both
    assert 2 * ellipse.major == pytest.approx(region.axis_major_length, rel=2e-3)
    assert 2 * ellipse.minor == pytest.approx(region.axis_minor_length, rel=2e-3)
    assert (ellipse.y, ellipse.x) == pytest.approx(region.centroid, abs=0.02)
    # scikit-image turns from the rows' axis
    turn = np.pi / 2 - region.orientation - ellipse.angle_rad
    assert np.sin(turn) == pytest.approx(0, abs=2e-3)


@pytest.mark.parametrize("direction", [1, -1])
def test_moments_of_a_rectangle_have_their_closed_form(direction: int) -> None:
    box = np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [0.0, 2.0]])[::direction]
    box = box + np.array([100, -50])
    ellipse = moment_ellipse(box)
    assert ellipse is not None
    # a side's variance is its square over 12, and the semi-axis twice the root
    assert (ellipse.major, ellipse.minor) == pytest.approx((6 / np.sqrt(3), 2 / np.sqrt(3)))
    assert (ellipse.x, ellipse.y) == pytest.approx((103, -49))
    assert ellipse.angle_rad == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("count", [0, 2, 9])
def test_an_outline_without_area_has_no_moments(count: int) -> None:
    assert moment_ellipse(np.column_stack([np.arange(count), 3.0 * np.arange(count)])) is None

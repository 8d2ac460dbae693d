"""Axis ratio, ellipse error and 2-D sphericity on shapes with closed forms."""

import numpy as np
import pytest

from rockshape.ellipse.direct import Ellipse, fit_ellipse
from rockshape.measures.axis_ratio import axis_ratio
from rockshape.measures.ellipse_error import ellipse_error_px2
from rockshape.measures.sphericity_2d import sphericity_2d
from rockshape.outline.trace import trace_outline
from tests import solids


def fitted(outline: np.ndarray) -> Ellipse:
    ellipse = fit_ellipse(outline)
    assert ellipse is not None
    return ellipse


@pytest.mark.parametrize("sides", [3, 4, 5, 6, 12])
def test_a_regular_polygon_is_as_round_as_a_circle_to_its_ellipse(sides: int) -> None:
    outline = solids.regular_polygon(sides, 100, points=60 * sides)
    # its second moments are a circle's, by symmetry
    assert axis_ratio(fitted(outline)) == pytest.approx(1, abs=1e-9)


def test_ellipse_error_of_a_square_has_its_closed_form() -> None:
    # by symmetry the ellipse is a circle of radius R; a side at distance h from the centre is seen
    # at rho(t) = sqrt(h² + t²), t uniform in -h..h, so the error is mean (rho - R)²
    half, count = 100.0, 4000
    outline = solids.regular_polygon(4, half * np.sqrt(2), points=count)
    circle = fitted(outline)
    radius = circle.major
    mean_square = half**2 * 4 / 3
    mean = half / 2 * (np.sqrt(2) + np.arcsinh(1))
    expected = mean_square - 2 * radius * mean + radius**2
    # the sum over points stands for the integral: half a step, squared, of it
    assert ellipse_error_px2(circle, outline) == pytest.approx(expected, rel=1e-4)
    assert ellipse_error_px2(circle, outline, total=True) == pytest.approx(
        count * ellipse_error_px2(circle, outline)
    )


@pytest.mark.parametrize(("major", "minor"), [(40, 40), (80, 40), (100, 20)])
def test_an_ellipse_on_pixels(major: float, minor: float) -> None:
    outline = trace_outline(solids.ellipse(major, minor, shift=(0.31, -0.17)))
    # boundary pixels lie up to one pixel within the edge: both half-axes are short by about 1/2
    assert axis_ratio(fitted(outline)) == pytest.approx((minor - 0.5) / (major - 0.5), abs=0.01)
    # a deviation uniform over one pixel across the edge has the variance 1/12 at most, and is
    # seen enlarged along the ray
    enlarged = (major**2 + minor**2) / (2 * major * minor)
    assert 0.04 < ellipse_error_px2(fitted(outline), outline) < enlarged**2 / 12
    assert sphericity_2d(outline) == pytest.approx(minor / major, abs=1 / minor)


def test_ellipse_error_grows_with_the_square_of_size() -> None:
    outline = solids.regular_polygon(3, 50, points=300)
    small = ellipse_error_px2(fitted(outline), outline)
    large = ellipse_error_px2(fitted(outline * 7), outline * 7)
    assert large == pytest.approx(49 * small, rel=1e-9)  # rounding only


def test_2d_sphericity_of_a_thin_rock_changes_when_turned() -> None:
    assert sphericity_2d(trace_outline(solids.ellipse(100, 20))) == pytest.approx(0.2, abs=0.01)
    turned = trace_outline(solids.ellipse(100, 20, turn_rad=np.pi / 4))
    assert sphericity_2d(turned) == pytest.approx(1, abs=0.01)


def test_2d_sphericity_counts_whole_pixels() -> None:
    mask = np.zeros((9, 9), dtype=bool)
    mask[2:5, 1:7] = True
    assert sphericity_2d(trace_outline(mask)) == 3 / 6


def test_nothing_has_no_shape() -> None:
    nothing = np.empty((0, 2))
    assert np.isnan(sphericity_2d(nothing))
    assert np.isnan(ellipse_error_px2(Ellipse(0, 0, 2, 1, 0), nothing))

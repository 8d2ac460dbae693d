import numpy as np
import pytest
from scipy.interpolate import LSQBivariateSpline

from rockshape.measures.angularity_3d import angularity_3d_per_m
from rockshape.surface import DEGREE, NET, Patch, fit_surface, view_patch
from tests import solids


def grid(count: int = 60, *, width: float = 0.4, height: float = 0.3) -> tuple[np.ndarray, ...]:
    u, w = np.meshgrid(np.linspace(0, width, count), np.linspace(0, height, count))
    return u.ravel(), w.ravel()


def test_a_cubic_is_reproduced_with_its_second_derivatives() -> None:
    u, w = grid()
    patch = Patch(u_m=u, w_m=w, height_m=2 * u**3 - 3 * u * u * w + w**3 + 5 * u - 1)
    surface = fit_surface(patch)
    assert surface is not None
    # the penalty of 1e-6 is felt in the sixth digit, curvature loses two more
    assert surface.residual_m < 1e-6
    assert surface.second_uu_per_m == pytest.approx(12 * u - 6 * w, abs=1e-3)
    assert surface.second_ww_per_m == pytest.approx(6 * w, abs=1e-3)


def test_agrees_with_scipy_on_a_full_grid(rng: np.random.Generator) -> None:
    u, w = grid()
    height = 0.05 * np.sin(9 * u) * np.cos(7 * w) + rng.normal(scale=1e-3, size=u.shape)
    surface = fit_surface(Patch(u_m=u, w_m=w, height_m=height))
    inner = np.linspace(0, 1, NET - DEGREE + 1)[1:-1]
    scipy = LSQBivariateSpline(u, w, height, 0.4 * inner, 0.3 * inner)
    assert surface is not None
    # the same least squares but for the penalty
    assert surface.second_uu_per_m == pytest.approx(scipy.ev(u, w, dx=2), abs=2e-3)
    assert surface.second_ww_per_m == pytest.approx(scipy.ev(u, w, dy=2), abs=2e-3)


@pytest.mark.parametrize("share", [0.3, 0.5, 0.7])
def test_a_spherical_cap_scores_as_it_must(share: float) -> None:
    # mean of (Q_uu + Q_ww)/2 over a disc of radius r is -1/sqrt(R² - r²), a boundary integral
    radius = 0.5
    rim = share * radius
    u, w = np.meshgrid(np.linspace(-rim, rim, 301), np.linspace(-rim, rim, 301))
    inside = np.hypot(u, w) <= rim
    u, w = u[inside], w[inside]
    surface = fit_surface(Patch(u_m=u, w_m=w, height_m=np.sqrt(radius**2 - u**2 - w**2)))
    assert surface is not None
    expected = 1 / np.sqrt(radius**2 - rim**2)
    # the net of 10 x 10 follows the cap to a few thousandths at its rim
    assert angularity_3d_per_m(surface, signed=True) == pytest.approx(-expected, rel=0.01)
    assert angularity_3d_per_m(surface) == pytest.approx(expected, rel=0.01)


def test_signed_bumps_cancel_and_absolute_ones_do_not() -> None:
    u, w = grid(width=0.3)
    bumps = 0.01 * np.cos(2 * np.pi * u / 0.15) * np.cos(2 * np.pi * w / 0.15)
    surface = fit_surface(Patch(u_m=u, w_m=w, height_m=bumps))
    assert surface is not None
    absolute = angularity_3d_per_m(surface)
    # k² A (2/pi)² for a product of cosines of wave number k
    assert absolute == pytest.approx(0.01 * (2 * np.pi / 0.15) ** 2 * (2 / np.pi) ** 2, rel=0.1)
    # whole waves sum to nothing but for the grid's doubled ends
    assert abs(angularity_3d_per_m(surface, signed=True)) < 0.1 * absolute


def test_a_plane_has_no_angularity_however_it_is_turned() -> None:
    points = solids.plane_range(solids.CAMERA, normal=np.array([0.2, -0.3, -0.9]), offset_m=-2.0)
    surface = fit_surface(view_patch(points[60:180, 60:260].reshape(-1, 3)))
    assert surface is not None
    assert angularity_3d_per_m(surface) < 1e-6  # 1/m; rounding of metres at double precision


def test_half_the_size_is_twice_the_angularity() -> None:
    u, w = grid()
    height = 0.05 * np.sin(9 * u) * np.cos(7 * w)
    large = fit_surface(Patch(u_m=u, w_m=w, height_m=height))
    small = fit_surface(Patch(u_m=u / 2, w_m=w / 2, height_m=height / 2))
    assert large is not None
    assert small is not None
    assert angularity_3d_per_m(small) == pytest.approx(2 * angularity_3d_per_m(large), rel=1e-9)


def test_cells_without_data_do_not_disturb_the_rest() -> None:
    u, w = grid(80, width=0.4, height=0.4)
    round_mask = np.hypot(u - 0.2, w - 0.2) < 0.2
    u, w = u[round_mask], w[round_mask]
    surface = fit_surface(Patch(u_m=u, w_m=w, height_m=0.1 * u * u + 0.2 * w * w))
    assert surface is not None
    # the penalty pulls where a cell holds a sliver of the disc: 1 % at most
    assert surface.second_uu_per_m == pytest.approx(0.2, abs=0.004)
    assert surface.second_ww_per_m == pytest.approx(0.4, abs=0.008)


def test_no_surface_where_none_is_determined() -> None:
    u, w = grid(9)
    assert fit_surface(Patch(u_m=u, w_m=w, height_m=u)) is None
    u, w = grid()
    assert fit_surface(Patch(u_m=u, w_m=0 * w, height_m=u)) is None

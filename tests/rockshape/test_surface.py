import numpy as np
import pytest
from scipy.interpolate import BSpline, LSQBivariateSpline
from scipy.spatial.transform import Rotation

from rockshape.ellipsoid import Ellipsoid
from rockshape.measures.angularity_3d import angularity_3d_per_m
from rockshape.surface import (
    NET,
    Knots,
    Net,
    SurfacePatch,
    body_bends_per_m,
    fit_surface,
    view_patch,
)
from tests import solids


def grid(count: int = 60, *, width: float = 0.4, height: float = 0.3) -> tuple[np.ndarray, ...]:
    u, w = np.meshgrid(np.linspace(0, width, count), np.linspace(0, height, count))
    return u.ravel(), w.ravel()


def test_a_cubic_is_reproduced_with_its_second_derivatives() -> None:
    u, w = grid()
    patch = SurfacePatch(u_m=u, w_m=w, height_m=2 * u**3 - 3 * u * u * w + w**3 + 5 * u - 1)
    surface = fit_surface(patch)
    assert surface is not None
    # the penalty of 1e-6 is felt in the sixth digit, curvature loses two more
    assert surface.residual_m < 1e-6
    assert surface.second_uu_per_m == pytest.approx(12 * u - 6 * w, abs=1e-3)
    assert surface.second_ww_per_m == pytest.approx(6 * w, abs=1e-3)


def test_agrees_with_scipy_on_a_full_grid(rng: np.random.Generator) -> None:
    u, w = grid()
    height = 0.05 * np.sin(9 * u) * np.cos(7 * w) + rng.normal(scale=1e-3, size=u.shape)
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=height))
    inner = np.linspace(0, 1, NET.u.spans + 1)[1:-1]
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
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=np.sqrt(radius**2 - u**2 - w**2)))
    assert surface is not None
    expected = 1 / np.sqrt(radius**2 - rim**2)
    # the net of 10 x 10 follows the cap to a few thousandths at its rim
    assert angularity_3d_per_m(surface, signed=True) == pytest.approx(-expected, rel=0.01)
    assert angularity_3d_per_m(surface) == pytest.approx(expected, rel=0.01)


def test_signed_bumps_cancel_and_absolute_ones_do_not() -> None:
    u, w = grid(width=0.3)
    bumps = 0.01 * np.cos(2 * np.pi * u / 0.15) * np.cos(2 * np.pi * w / 0.15)
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=bumps))
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
    large = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=height))
    small = fit_surface(SurfacePatch(u_m=u / 2, w_m=w / 2, height_m=height / 2))
    assert large is not None
    assert small is not None
    assert angularity_3d_per_m(small) == pytest.approx(2 * angularity_3d_per_m(large), rel=1e-9)


def test_cells_without_data_do_not_disturb_the_rest() -> None:
    u, w = grid(80, width=0.4, height=0.4)
    round_mask = np.hypot(u - 0.2, w - 0.2) < 0.2
    u, w = u[round_mask], w[round_mask]
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=0.1 * u * u + 0.2 * w * w))
    assert surface is not None
    # the penalty pulls where a cell holds a sliver of the disc: 1 % at most
    assert surface.second_uu_per_m == pytest.approx(0.2, abs=0.004)
    assert surface.second_ww_per_m == pytest.approx(0.4, abs=0.008)


def test_no_surface_where_none_is_determined() -> None:
    u, w = grid(9)
    assert fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=u)) is None
    u, w = grid()
    assert fit_surface(SurfacePatch(u_m=u, w_m=0 * w, height_m=u)) is None


@pytest.mark.parametrize("order", [3, 4, 5])
@pytest.mark.parametrize(("along_u", "along_w"), [(10, 10), (7, 12)])
def test_equation_15_to_the_letter_is_dense_least_squares(
    order: int, along_u: int, along_w: int, rng: np.random.Generator
) -> None:
    net = Net(Knots(along_u, order), Knots(along_w, order))
    u, w = grid(40)
    height = 0.05 * np.sin(9 * u) * np.cos(7 * w) + rng.normal(scale=1e-3, size=u.shape)
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=height), net=net, smoothing=0)
    assert surface is not None
    tables = [
        BSpline.design_matrix(place / place.max(), knots.values(), order - 1).toarray()
        for knots, place in ((net.u, u), (net.w, w))
    ]
    dense = (tables[0][:, :, None] * tables[1][:, None, :]).reshape(len(u), -1)
    vertices, *_ = np.linalg.lstsq(dense, height, rcond=None)
    # normal equations square the condition, which is below 1e4 on a full grid
    assert surface.vertices_m.ravel() == pytest.approx(vertices, abs=1e-9)


def test_equation_15_to_the_letter_is_undetermined_on_a_mask() -> None:
    u, w = grid(80, width=0.4, height=0.4)
    round_mask = np.hypot(u - 0.2, w - 0.2) < 0.18
    corner = (u < 0.02) & (w < 0.02)
    chosen = round_mask | corner
    patch = SurfacePatch(u_m=u[chosen], w_m=w[chosen], height_m=u[chosen] ** 2)
    net = Net(Knots(20), Knots(20))
    assert fit_surface(patch, net=net, smoothing=0) is None
    assert fit_surface(patch, net=net, smoothing=0.001) is not None


def test_scipy_has_the_same_surface_where_asked(rng: np.random.Generator) -> None:
    u, w = grid()
    height = 0.05 * np.sin(9 * u) * np.cos(7 * w) + rng.normal(scale=1e-3, size=u.shape)
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=height), smoothing=0)
    inner = np.linspace(0, 1, NET.u.spans + 1)[1:-1]
    scipy = LSQBivariateSpline(u, w, height, 0.4 * inner, 0.3 * inner)
    assert surface is not None
    place = rng.uniform(0, 0.3, (2, 50))
    for along_u, along_w in ((0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2)):
        own = surface.derivative(*place, along_u=along_u, along_w=along_w)
        other = scipy.ev(*place, dx=along_u, dy=along_w)
        assert own == pytest.approx(other, rel=1e-6, abs=1e-7)


def test_a_plane_costs_nothing_however_stiff() -> None:
    u, w = grid(20)
    surface = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=3 * u - 2 * w + 1), smoothing=1.0)
    assert surface is not None
    # the penalty weighs (1 m/0.3 m)^4 times the data's share of a wave, and rounding with it
    assert surface.residual_m < 1e-8


def test_smoothing_flattens_waves_by_their_length() -> None:
    # a wave of number k along u keeps 1/(1 + (k l)^4) of its height, far from the ends
    u, w = grid(120, width=0.6, height=0.6)
    k = 2 * np.pi / 0.1
    net = Net(Knots(40), Knots(12))
    length = 0.8 / k
    surface = fit_surface(
        SurfacePatch(u_m=u, w_m=w, height_m=0.01 * np.sin(k * u)), net=net, smoothing=length
    )
    assert surface is not None
    place = np.linspace(0.2, 0.4, 101)
    kept = surface.derivative(place, np.full(101, 0.3)) @ np.sin(k * place)
    kept /= 0.01 * np.sin(k * place) @ np.sin(k * place)
    assert kept == pytest.approx(1 / (1 + 0.8**4), rel=0.02)


def test_gcv_finds_the_smoothing_that_is_best_against_the_truth(
    rng: np.random.Generator,
) -> None:
    u, w = rng.uniform(0, 0.4, (2, 3000))
    inside = np.hypot(u - 0.2, w - 0.2) < 0.2
    u, w = u[inside], w[inside]
    truth = 0.02 * np.sin(15 * u) * np.cos(13 * w)
    patch = SurfacePatch(u_m=u, w_m=w, height_m=truth + rng.normal(scale=0.003, size=u.shape))
    net = Net(Knots(16), Knots(16))

    def error(smoothing: float | str) -> float:
        surface = fit_surface(patch, net=net, smoothing=smoothing)
        assert surface is not None
        return float(np.sqrt(np.mean((surface.derivative(u, w) - truth) ** 2)))

    least = min(error(length) for length in np.geomspace(0.002, 0.1, 12))
    # 2,300 data tell it to about a fifth; the formula itself is held below
    assert error("gcv") < 1.3 * least
    assert error("slight") > 1.5 * least


def test_gcv_is_least_where_the_dense_formula_is(rng: np.random.Generator) -> None:
    u, w = rng.uniform(0, 0.4, (2, 500))
    height = 0.02 * np.sin(15 * u) * np.cos(13 * w) + rng.normal(scale=0.003, size=500)
    patch = SurfacePatch(u_m=u, w_m=w, height_m=height)
    surface = fit_surface(patch, smoothing="gcv")
    assert surface is not None

    def score(length: float) -> float:
        # the surface is linear in the data: column k of H is its answer to the k-th datum alone
        columns = []
        for datum in np.eye(500):
            alone = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=datum), smoothing=length)
            assert alone is not None
            columns.append(alone.derivative(u, w))
        hat = np.array(columns).T
        misfit = height - hat @ height
        return float(500 * misfit @ misfit / (500 - np.trace(hat)) ** 2)

    here = score(surface.smoothing_m)
    assert here <= score(surface.smoothing_m * 1.1)
    assert here <= score(surface.smoothing_m / 1.1)


def test_weights_count_data_twice(rng: np.random.Generator) -> None:
    u, w = rng.uniform(0, 0.3, (2, 600))
    height = rng.normal(size=600)
    twice = rng.random(600) < 0.3
    weighted = fit_surface(
        SurfacePatch(u_m=u, w_m=w, height_m=height), smoothing=0.02, weights=1.0 + twice
    )
    doubled = fit_surface(
        SurfacePatch(*(np.concatenate([part, part[twice]]) for part in (u, w, height))),
        smoothing=0.02,
    )
    assert weighted is not None
    assert doubled is not None
    assert weighted.vertices_m == pytest.approx(doubled.vertices_m, abs=1e-9)


def test_order_of_the_points_changes_nothing(rng: np.random.Generator) -> None:
    u, w = rng.uniform(0, 0.3, (2, 600))
    height = rng.normal(size=600)
    order = rng.permutation(600)
    first = fit_surface(SurfacePatch(u_m=u, w_m=w, height_m=height))
    second = fit_surface(SurfacePatch(u_m=u[order], w_m=w[order], height_m=height[order]))
    assert first is not None
    assert second is not None
    # sums in another order
    assert second.vertices_m == pytest.approx(first.vertices_m, abs=1e-8)


def test_the_bodys_own_bend_is_that_of_the_surface_over_an_ellipsoid() -> None:
    body = Ellipsoid(
        centre_m=np.array([0.05, -0.1, 2.0]),
        half_axes_m=np.array([0.4, 0.3, 0.25]),
        axes=Rotation.from_rotvec([0.4, -0.3, 0.7]).as_matrix(),
    )
    grid_m = solids.ellipsoid_range(
        solids.CAMERA, centre_m=body.centre_m, half_axes_m=body.half_axes_m, axes=body.axes
    )
    points = grid_m[np.isfinite(grid_m).all(axis=-1)]
    # away from the limb, where curvature runs to infinity
    points = points[np.linalg.norm((points - points.mean(axis=0))[:, :2], axis=1) < 0.2]
    surface = fit_surface(view_patch(points))
    bend = body_bends_per_m(body, points)
    assert surface is not None
    assert (surface.second_uu_per_m + surface.second_ww_per_m) / 2 == pytest.approx(bend, abs=0.3)
    assert angularity_3d_per_m(surface) > 2.5
    # the net follows the cap to some hundredths of its curvature
    assert angularity_3d_per_m(surface, body_per_m=bend) < 0.05
    aside = body_bends_per_m(body, points + np.array([5.0, 0, 0]))
    assert np.isnan(aside).all()
    assert np.isnan(angularity_3d_per_m(surface, body_per_m=aside))

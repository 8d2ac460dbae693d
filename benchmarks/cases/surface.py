"""B-spline surface beside dense least squares and scipy's splines."""

import warnings

import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray
from scipy.interpolate import LSQBivariateSpline, SmoothBivariateSpline, bisplev, bisplrep
from timing import best_of

from rockshape.surface import Knots, Net, SurfacePatch, fit_surface
from rockshape.surface.basis import evaluate

NOISE_M, SIDE_M = 0.001, 0.4
COLUMNS = (
    Column("method"),
    Column("processor", "ms"),
    Column("ratio", "", ".1f"),
    Column("RMS residual", "mm", ".4f"),
)


def beside_scipy(*, points: int = 20_000, net: int = 20, rounds: int = 5) -> list[Table]:
    """Time each method on a bumpy height field with noise.

    scipy's smoothing splines choose their own knots until the residual is the one asked for: ours
    and 2 % more, since they add knots without end at exactly ours.
    """
    rng = np.random.default_rng(10_000)
    u, w = rng.uniform(0, SIDE_M, (2, points))
    waves = 0.02 * np.sin(31 * u) * np.cos(29 * w) + 0.05 * np.hypot(u, w)
    z = waves + rng.normal(scale=NOISE_M, size=points)
    patch, grid = SurfacePatch(u_m=u, w_m=w, height_m=z), Net(Knots(net), Knots(net))
    ours = fit_surface(patch, net=grid, smoothing=0)
    target = ours.residual_m**2 * points * 1.02
    inner = SIDE_M * np.linspace(0, 1, grid.u.spans + 1)[1:-1]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        times = best_of(
            rounds,
            {
                "ours, equation 15, with second derivatives": lambda: fit_surface(
                    patch, net=grid, smoothing=0
                ),
                "ours, smoothing by GCV": lambda: fit_surface(patch, net=grid, smoothing="gcv"),
                "LSQBivariateSpline, our knots": lambda: LSQBivariateSpline(u, w, z, inner, inner),
            },
        )
        times |= best_of(
            1,
            {
                "dense least squares, numpy": lambda: dense(patch, grid),
                "SmoothBivariateSpline": lambda: SmoothBivariateSpline(u, w, z, s=target),
                "bisplrep": lambda: bisplrep(u, w, z, s=target, nxest=60, nyest=60),
            },
        )
        lsq = LSQBivariateSpline(u, w, z, inner, inner)
        smooth = SmoothBivariateSpline(u, w, z, s=target)
        knots = bisplrep(u, w, z, s=target, nxest=60, nyest=60)
    few = slice(0, 2000)  # bisplev takes one place at a time
    at = [bisplev(x, y, knots) for x, y in zip(u[few], w[few], strict=True)]
    residuals_m = (
        ours.residual_m,
        fit_surface(patch, net=grid, smoothing="gcv").residual_m,
        _rms(lsq.ev(u, w) - z),
        _rms(_dense_heights(patch, grid) - z),
        _rms(smooth.ev(u, w) - z),
        _rms(np.array(at) - z[few]),
    )
    floor = next(iter(times.values())).cpu_s
    rows = [
        (name, 1e3 * time.cpu_s, time.cpu_s / floor, 1e3 * residual)
        for (name, time), residual in zip(times.items(), residuals_m, strict=True)
    ]
    return [Table(COLUMNS, rows)]


def design_matrix(patch: SurfacePatch, net: Net) -> NDArray[np.float64]:
    """Return the dense matrix (data, vertices) of equation 15."""
    tables = []
    for knots, place in ((net.u, patch.u_m), (net.w, patch.w_m)):
        basis = evaluate(knots, (place - place.min()) / np.ptp(place))
        table = np.zeros((len(place), knots.count))
        places = basis.span[:, None] + np.arange(knots.order)
        np.put_along_axis(table, places, basis.values.T, axis=1)
        tables.append(table)
    return (tables[0][:, :, None] * tables[1][:, None, :]).reshape(len(patch.u_m), -1)


def dense(patch: SurfacePatch, net: Net) -> NDArray[np.float64]:
    """Return the vertices by numpy's least squares on the whole matrix."""
    return np.asarray(np.linalg.lstsq(design_matrix(patch, net), patch.height_m, rcond=None)[0])


def _dense_heights(patch: SurfacePatch, net: Net) -> NDArray[np.float64]:
    return design_matrix(patch, net) @ dense(patch, net)


def _rms(values: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(values**2)))


SURFACE_CASE = Case(
    name="surface",
    what="B-spline surface over scattered heights, beside dense least squares and scipy",
    run=beside_scipy,
    smallest={"points": 400, "net": 6, "rounds": 1},
    peer="ours by equation 15, in processor time",
)

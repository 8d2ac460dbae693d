"""The B-spline surface beside dense least squares and scipy's splines, in one run.

Run `OMP_NUM_THREADS=1 python benchmarks/surface.py`: it tells processor time, which threads would
count several times. 20,000 points of a bumpy height field with noise, a net of
20 x 20 cubic vertices; medians of warm runs. scipy's SmoothBivariateSpline and bisplrep choose
their own knots until the residual is the one asked for: they are asked for ours.
"""

import argparse
import warnings

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import LSQBivariateSpline, SmoothBivariateSpline, bisplev, bisplrep
from warm import timed

from rockshape.surface import Knots, Net, SurfacePatch, fit_surface
from rockshape.surface.basis import evaluate

NOISE_M = 0.001


def heights_m(u_m: NDArray[np.float64], w_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """A height field with waves of 0.2 m."""
    return np.asarray(0.02 * np.sin(31 * u_m) * np.cos(29 * w_m) + 0.05 * np.hypot(u_m, w_m))


def dense(patch: SurfacePatch, net: Net) -> NDArray[np.float64]:
    """Vertices by numpy's least squares on the whole matrix of data by vertices."""
    tables = []
    for knots, place in ((net.u, patch.u_m), (net.w, patch.w_m)):
        basis = evaluate(knots, (place - place.min()) / np.ptp(place))
        table = np.zeros((len(place), knots.count))
        places = basis.span[:, None] + np.arange(knots.order)
        np.put_along_axis(table, places, basis.values.T, axis=1)
        tables.append(table)
    matrix = (tables[0][:, :, None] * tables[1][:, None, :]).reshape(len(patch.u_m), -1)
    return np.asarray(np.linalg.lstsq(matrix, patch.height_m, rcond=None)[0])


def main() -> None:
    """Print a row for each way."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=20_000)
    parser.add_argument("--net", type=int, default=20)
    parser.add_argument("--seed", type=int, default=10000)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    u, w = rng.uniform(0, 0.4, (2, arguments.points))
    z = heights_m(u, w) + rng.normal(scale=NOISE_M, size=u.shape)
    patch = SurfacePatch(u_m=u, w_m=w, height_m=z)
    net = Net(Knots(arguments.net), Knots(arguments.net))

    def rms(values: object) -> float:
        return float(np.sqrt(np.mean((np.asarray(values) - z) ** 2)))

    ours_s, surface = timed(lambda: fit_surface(patch, net=net, smoothing=0), 9)
    ours = surface.residual_m
    gcv_s, smoothed = timed(lambda: fit_surface(patch, net=net, smoothing="gcv"), 3)
    dense_s, vertices = timed(lambda: dense(patch, net), 1)
    off = np.abs(vertices - surface.vertices_m.ravel()).max()
    inner = 0.4 * np.linspace(0, 1, net.u.spans + 1)[1:-1]
    target = ours**2 * len(u) * 1.02  # a little more, or it adds knots without end
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        lsq_s, lsq = timed(lambda: LSQBivariateSpline(u, w, z, inner, inner), 3)
        smooth_s, smooth = timed(lambda: SmoothBivariateSpline(u, w, z, s=target), 1)
        rep_s, rep = timed(lambda: bisplrep(u, w, z, s=target, nxest=60, nyest=60), 1)
    at = [bisplev(x, y, rep) for x, y in zip(u[:2000], w[:2000], strict=True)]
    rows = [
        ("ours, equation 15, with second derivatives", ours_s, ours),
        ("ours, smoothing by GCV", gcv_s, smoothed.residual_m),
        ("dense least squares (numpy)", dense_s, ours),
        ("LSQBivariateSpline, our knots", lsq_s, rms(lsq.ev(u, w))),
        ("SmoothBivariateSpline", smooth_s, rms(smooth.ev(u, w))),
        ("bisplrep", rep_s, float(np.sqrt(np.mean((np.array(at) - z[:2000]) ** 2)))),
    ]
    print("| way | ms | RMS residual mm | over ours |")
    print("| --- | --- | --- | --- |")
    for name, seconds, residual in rows:
        print(f"| {name} | {1e3 * seconds:.1f} | {1e3 * residual:.4f} | {seconds / ours_s:.1f} |")
    print(f"largest difference of a vertex, ours and dense: {off:.1e} m")


if __name__ == "__main__":
    main()

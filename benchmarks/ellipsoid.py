"""The least-squares ellipsoid beside scipy's Powell at the same minimum, in one run.

Run `OMP_NUM_THREADS=1 python benchmarks/ellipsoid.py`: it tells processor time, which threads would
count several times. Rocks seen from one side with noise, 2,000 points each; warm
medians. `plain` is Powell over the ellipsoid's own distance, as one would write it with scipy;
`lean` is `rockshape.ellipsoid.powell`, whose cost is stripped to 40 µs. Both have one start and a
tolerance of 1e-8: at scipy's default of 1e-4 they stop up to some per cent above the minimum.
"""

import argparse

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation
from warm import timed

from rockshape.ellipsoid import Ellipsoid, fit_ellipsoid
from rockshape.ellipsoid.powell import fit_by_powell
from synth.rocks import quarry
from synth.spec.rocks import RocksSpec

CENTRE_M = np.array([0.3, 0.2, 4.0])
SAME = 1e-6  # relative difference of D_S at which two searches have found the same minimum
COLUMNS = ("Powell ms", "evaluations", "off", "ratio")


def seen_points(count: int, rocks: int, noise_m: float, *, seed: int) -> list[NDArray[np.float64]]:
    """Points on the near sides of made rocks, 4 m in front of the camera, with noise along z."""
    rng = np.random.default_rng([0, seed])
    clouds = []
    for rock in quarry(RocksSpec(count=rocks), rng=rng):
        mesh = rock.mesh
        corners = mesh.vertices_m[mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        share = np.maximum(-normals[:, 2], 0)
        chosen = rng.choice(len(share), count, p=share / share.sum())
        weights = rng.dirichlet(np.ones(3), count)
        points = np.einsum("nk,nkj->nj", weights, corners[chosen]) + CENTRE_M
        points[:, 2] += rng.normal(scale=noise_m, size=count)
        clouds.append(points)
    return clouds


def plain_powell(points: NDArray[np.float64]) -> tuple[float, int]:
    """Powell as one would write it with scipy: D_S / N, and the number of evaluations."""
    centroid = points.mean(axis=0)
    spread, directions = np.linalg.eigh(np.cov(points.T))
    away = centroid / np.linalg.norm(centroid)
    directions = directions * np.sign(np.linalg.det(directions))

    def mean_square(parameters: NDArray[np.float64]) -> float:
        body = Ellipsoid(
            centre_m=parameters[:3],
            half_axes_m=np.exp(parameters[3:6]),
            axes=Rotation.from_rotvec(parameters[6:]).as_matrix().T,
        )
        return float(np.mean(body.radial_distance_m(points) ** 2))

    start = np.concatenate(
        [
            centroid + 0.5 * np.sqrt(spread[2]) * away,
            np.log(np.sqrt(3 * spread)),
            Rotation.from_matrix(directions).as_rotvec(),
        ]
    )
    options = {"xtol": 1e-8, "ftol": 1e-8, "maxiter": 2000, "maxfev": 400_000}
    found = minimize(mean_square, start, method="Powell", options=options)
    return float(found.fun), int(found.nfev)


def compare(points: NDArray[np.float64], number: int) -> tuple[float, float]:
    """Print one rock's row; return how many times longer the two Powells take to the same minimum.

    NaN for a Powell that ended elsewhere.
    """
    ours_s, ours = timed(lambda: fit_ellipsoid(points), 15)
    lean_s, lean = timed(lambda: fit_by_powell(points), 1)
    plain_s, (plain, evaluations) = timed(lambda: plain_powell(points), 1)
    if ours is None or lean is None:
        return float("nan"), float("nan")
    cells, ratios = [], []
    for seconds, distance, count in (
        (lean_s, lean.distance, lean.evaluations),
        (plain_s, plain, evaluations),
    ):
        off = distance / ours.mean_square_m2 - 1
        ratios.append(seconds / ours_s if abs(off) < SAME else float("nan"))
        cells += [f"{1e3 * seconds:.0f}", f"{count}", f"{off:.0e}", f"{ratios[-1]:.0f}"]
    print(f"| {number} | {1e3 * ours_s:.1f} | {' | '.join(cells)} |", flush=True)
    return ratios[0], ratios[1]


def main() -> None:
    """Print a row for each rock and the median ratios."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--rocks", type=int, default=6)
    parser.add_argument("--noise", type=float, default=0.004, help="m")
    parser.add_argument("--seed", type=int, default=10000)
    arguments = parser.parse_args()
    heads = [f"{way} {what}" for way in ("lean", "plain") for what in COLUMNS]
    print("| rock | ours ms | " + " | ".join(heads) + " |")
    print("| --- " * (2 + len(heads)) + "|")
    clouds = seen_points(arguments.points, arguments.rocks, arguments.noise, seed=arguments.seed)
    ratios = np.array([compare(points, number) for number, points in enumerate(clouds)])
    for way, ratio in zip(("lean", "plain"), ratios.T, strict=True):
        print(
            f"{way} Powell over ours: median {np.nanmedian(ratio):.0f}, {np.nanmin(ratio):.0f} to "
            f"{np.nanmax(ratio):.0f}, at another minimum {np.isnan(ratio).sum()}"
        )


if __name__ == "__main__":
    main()

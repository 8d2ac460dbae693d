"""Least-squares ellipsoid beside scipy's Powell search at the same minimum."""

import numpy as np
from case import Case, Column, Table
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation
from timing import best_of

from rockshape.ellipsoid import Ellipsoid, fit_ellipsoid
from rockshape.ellipsoid.powell import fit_by_powell
from synth.rocks import quarry
from synth.spec.rocks import RocksSpec

CENTRE_M = np.array([0.3, 0.2, 4.0])
NOISE_M = 0.004
COLUMNS = (
    Column("rock", "", "d"),
    Column("ours", "ms"),
    *(
        Column(f"{way} {name}", unit, form)
        for way in ("lean", "plain")
        for name, unit, form in (
            ("Powell", "ms", ".0f"),
            ("evaluations", "", "d"),
            ("D_S above ours", "", ".0e"),
            ("ratio", "", ".0f"),
        )
    ),
)


def beside_powell(*, points: int = 2000, rocks: int = 6, rounds: int = 20) -> list[Table]:
    """Time our fit and two Powell searches on each rock's points."""
    rows = []
    for number, cloud in enumerate(visible_points(points, rocks)):
        ours, lean = fit_ellipsoid(cloud), fit_by_powell(cloud)
        plain, evaluations = plain_powell(cloud)
        own = best_of(rounds, {"ours": lambda cloud=cloud: fit_ellipsoid(cloud)})["ours"]
        slow = best_of(
            1,
            {
                "lean": lambda cloud=cloud: fit_by_powell(cloud),
                "plain": lambda cloud=cloud: plain_powell(cloud),
            },
        )
        row: list[float] = [number, 1e3 * own.cpu_s]
        for way, distance, count in (
            ("lean", lean.distance, lean.evaluations),
            ("plain", plain, evaluations),
        ):
            spent = slow[way].cpu_s
            row += [1e3 * spent, count, distance / ours.mean_square_m2 - 1, spent / own.cpu_s]
        rows.append(row)
    return [Table(COLUMNS, rows)]


def visible_points(count: int, rocks: int) -> list[NDArray[np.float64]]:
    """Return points (count, 3) on the near sides of made rocks 4 m away, with noise along z."""
    rng = np.random.default_rng([0, 10_000])
    clouds = []
    for rock in quarry(RocksSpec(count=rocks), rng=rng):
        corners = rock.mesh.vertices_m[rock.mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        share = np.maximum(-normals[:, 2], 0)
        chosen = rng.choice(len(share), count, p=share / share.sum())
        weights = rng.dirichlet(np.ones(3), count)
        points = np.einsum("nk,nkj->nj", weights, corners[chosen]) + CENTRE_M
        points[:, 2] += rng.normal(scale=NOISE_M, size=count)
        clouds.append(points)
    return clouds


def plain_powell(points: NDArray[np.float64]) -> tuple[float, int]:
    """Return D_S / N of Powell's search as one would write it with scipy, and its evaluations.

    The tolerance is 1e-8; at scipy's default of 1e-4 it stops up to some per cent above the
    minimum.
    """
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


ELLIPSOID_CASE = Case(
    name="ellipsoid",
    what="least-squares ellipsoid of a rock seen from one side, beside Powell's search",
    run=beside_powell,
    smallest={"points": 60, "rocks": 1, "rounds": 1},
    peer="our fit, in processor time",
)

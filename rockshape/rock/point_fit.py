"""Constrained ellipsoid of a rock's points, without those that lie off the rock."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.camera.silhouette import grazing_rays
from rockshape.ellipsoid import (
    Ellipsoid,
    HeldEllipsoid,
    Resting,
    fit_held_ellipsoid,
    fit_without_outliers,
)
from rockshape.ellipsoid.outliers import SAME
from rockshape.rock.stray_points import stray_points

if TYPE_CHECKING:
    from rockshape.ground import Ground

PLASTIC = 1.32471795724474602596  # p³ = p + 1
RIM_PX = 2  # from the rock's edge: where pixels see the rock and what is behind it


@dataclass(frozen=True)
class PointCounts:
    """How many of a rock's range points are used, and why others are left out."""

    range_points: int = 0
    flying_points: int = 0  # between rock and background: told so, or outliers within 2 px of edge
    spike_points: int = 0  # other outliers


@dataclass(frozen=True, eq=False)
class PointFit:
    """Constrained ellipsoid of a rock, and which of its pixels' points it is made on."""

    ellipsoid: Ellipsoid | None  # None where it is not determined
    sound: NDArray[np.bool_]  # (rows, cols), the rock's pixels whose point is no outlier
    attached: NDArray[np.bool_]  # (rows, cols), those whose point hangs together with the surface
    known: NDArray[np.bool_]  # (rows, cols), those with a point
    rank: NDArray[np.float64]  # (rows, cols), by which points are sampled

    def counts(self, mask: NDArray[np.bool_]) -> PointCounts:
        """Points used and left out of a rock with a mask (rows, cols)."""
        outliers = self.known & ~self.sound
        if not outliers.any():
            return PointCounts(int(self.known.sum()))
        side = (2 * RIM_PX + 1, 2 * RIM_PX + 1)
        padded = np.pad(mask, RIM_PX).view(np.uint8)
        inner = cv2.erode(padded, np.ones(side, np.uint8))[RIM_PX:-RIM_PX, RIM_PX:-RIM_PX] > 0
        spikes = int((outliers & inner).sum())
        return PointCounts(int(self.sound.sum()), int(outliers.sum()) - spikes, spikes)


def _even_rank(shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Ranks (rows, cols) from 0 to 1 whose lowest share is spread evenly, however many they are.

    The fractional parts of row/p + col/p², p the root of p³ = p + 1.
    Source: Roberts (2018), The unreasonable effectiveness of quasirandom sequences.
    """
    rows, cols = np.ogrid[: shape[0], : shape[1]]
    return np.asarray((rows / PLASTIC + cols / PLASTIC**2) % 1.0)


def fit_points(
    mask: NDArray[np.bool_],
    corner: tuple[int, int],
    grid_m: NDArray[np.float64],
    *,
    camera: Camera | None,
    ground: "Ground | None",
) -> PointFit:
    """Constrained ellipsoid of the points grid_m (rows, cols, 3) under a mask (rows, cols).

    corner is the row and column of the mask's first pixel in the image. Points are sampled by a
    rank that stays with the pixel, whichever others have a point. Outliers are also the
    `stray_points`; where these are more than a thousandth of the points, the fit is repeated
    without them. An axis at its bound or a search that has not converged is no fit.
    """
    known = np.asarray(mask & np.isfinite(grid_m).all(axis=-1))
    rank = _even_rank(mask.shape)
    points_m = grid_m[known]
    plane = None if ground is None else ground.plane
    noise = None if ground is None else ground.noise
    noise_m = None if noise is None else noise.depth_sd_m(points_m[:, 2])

    def rays(sound: NDArray[np.bool_]) -> NDArray[np.float64] | None:
        if camera is None:
            return None
        clean_m = grid_m
        if not sound.all():
            clean_m = grid_m.copy()
            clean_m[known] = np.where(sound[:, None], points_m, np.nan)
        return grazing_rays(mask, corner, camera, clean_m)

    def fit(sound: NDArray[np.bool_], near: Ellipsoid | None) -> HeldEllipsoid | None:
        return fit_held_ellipsoid(
            points_m[sound],
            point_sd_m=0.0 if noise_m is None else noise_m[sound],
            silhouette=rays(sound),
            ground=None if plane is None else Resting(plane.normal, plane.offset_m),
            rank=rank[known][sound],
            near=near,
        )

    found, sound = fit_without_outliers(points_m, fit)
    attached = known
    if found is not None:
        attached = known & ~stray_points(found.ellipsoid, grid_m, known, noise, mask=mask)
        kept = sound & attached[known]
        if (kept != sound).mean() > SAME:
            found = fit(kept, found.ellipsoid)
        sound = kept
    good = found is not None and found.converged and not found.bounded
    return PointFit(
        ellipsoid=found.ellipsoid if found is not None and good else None,
        sound=_on_pixels(known, sound),
        attached=attached,
        known=known,
        rank=rank,
    )


def _on_pixels(known: NDArray[np.bool_], which: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mask (rows, cols) of which (n,) of the pixels known (rows, cols)."""
    mask = known.copy()
    mask[known] = which
    return mask

"""Form of a rock that several views see: the smallest box of all that they see of it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rockshape.fusion.posed_view import PosedView, ViewRock
from rockshape.fusion.smallest_box import smallest_box_m
from rockshape.fusion.voxels import thinned

CELLS = 40.0  # across the rock, whose means are boxed
LEAST_FEET = 0.5  # of the plan about its middle, within which a rock is taken to reach the ground
MAX_GAP_DEG = 180.0  # of azimuth between neighbouring cameras, up to which all sides are seen


def gap_deg(
    cameras_m: NDArray[np.float64], centre_m: NDArray[np.float64], up: NDArray[np.float64]
) -> float:
    """Largest angle about a rock, in plan, between neighbouring cameras (n, 3); 360 for one."""
    away = cameras_m - centre_m
    first = np.cross(up, [1.0, 0.0, 0.0] if abs(up[0]) < 0.7 else [0.0, 1.0, 0.0])
    second = np.cross(up, first)
    azimuth = np.sort(np.rad2deg(np.arctan2(away @ second, away @ first)))
    return float(np.diff(np.append(azimuth, azimuth[0] + 360.0)).max())


def fused_half_axes_m(
    sights: Sequence[tuple[PosedView, ViewRock]],
) -> NDArray[np.float64] | None:
    """Half-axes (3,), a >= b >= c, of the smallest box of a rock's points from several views.

    The points of all views, as means of cells of a fortieth of the rock, and the plumb feet on the
    ground of those in the middle of its plan: a rock that lies there has its underside there. None
    where the points do not span a volume.
    """
    points = np.vstack([view.pose.to_world(rock.points_m) for view, rock in sights])
    feet = np.vstack([view.pose.to_world(rock.feet_m) for view, rock in sights])
    side_m = float(np.ptp(points, axis=0).max()) / CELLS
    if side_m <= 0:
        return None
    cells = thinned(points, side_m)
    foot = thinned(feet, side_m)
    middle = foot.mean(axis=0)
    shrunk = middle + LEAST_FEET * (foot - middle)
    sides = smallest_box_m(np.vstack([cells, shrunk]))
    return None if sides is None else 0.5 * sides

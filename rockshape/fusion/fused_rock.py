"""One rock of several views: its form from all points, its other measures averaged over views."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.fusion.form import MAX_GAP_DEG, fused_half_axes_m, gap_deg
from rockshape.fusion.matching import Sighting
from rockshape.fusion.posed_view import PosedView, ViewRock
from rockshape.measures.sphericity_3d import sphericity_3d

FORM = "sphericity_3d"  # column of the measure that the fused axes tell


@dataclass(frozen=True)
class FusedValue:
    """Value over views, its uncertainty by the jackknife over them, and their spread.

    NaN where no view answers; uncertainty and spread are NaN of fewer than two.
    """

    value: float
    sd: float
    view_sd: float


@dataclass(frozen=True, eq=False)
class FusedRock:
    """One rock as all views have it."""

    number: int
    sights: tuple[Sighting, ...]  # one a view that sees it
    place_m: NDArray[np.float64]  # (3,) in the world, the middle of its points
    gap_deg: float  # largest angle about it, in plan, between neighbouring cameras
    half_axes_m: NDArray[np.float64]  # (3,), a >= b >= c; NaN where nothing determines them
    boxed: bool  # whether they are of the smallest box of all views, rather than means of the views
    values: dict[str, FusedValue]  # by the measures' columns


def fused_rock(
    number: int,
    sights: Sequence[Sighting],
    views: Sequence[PosedView],
    *,
    up: NDArray[np.float64],
) -> FusedRock:
    """Rock of one sight a view, up the ground's normal in the world.

    Where cameras stand round it, no gap between them above 180°, axes and 3-D sphericity are those
    of the smallest box of all points; else they are means of the views' like every other measure.
    Views whose frame cuts the rock are left out of means where another has it whole.
    """
    seen = [(views[each.view], views[each.view].rocks[each.rock]) for each in sights]
    place_m = np.mean(
        [view.pose.to_world(rock.points_m).mean(axis=0) for view, rock in seen], axis=0
    )
    gap = gap_deg(np.array([view.pose.position_m for view, _ in seen]), place_m, up)
    whole = [rock.rock for _, rock in seen if not rock.rock.truncated]
    taken = whole or [rock.rock for _, rock in seen]
    values = {
        column: _mean_over([rock.values[column] for rock in taken]) for column in taken[0].readings
    }
    fitted = [rock.ellipsoid.half_axes_m for rock in taken if rock.ellipsoid is not None]
    half_axes_m = np.mean(fitted, axis=0) if fitted else np.full(3, np.nan)
    sides_m = fused_half_axes_m(seen) if gap <= MAX_GAP_DEG + 1.0 else None
    if sides_m is not None:
        half_axes_m = sides_m
        if FORM in values:
            values[FORM] = _form(seen, sides_m, values[FORM].view_sd)
    return FusedRock(
        number=number,
        sights=tuple(sights),
        place_m=place_m,
        gap_deg=gap,
        half_axes_m=half_axes_m,
        boxed=sides_m is not None,
        values=values,
    )


def _form(
    seen: Sequence[tuple[PosedView, ViewRock]],
    half_axes_m: NDArray[np.float64],
    view_sd: float,
) -> FusedValue:
    """3-D sphericity of the box, its uncertainty by boxes that leave out one view each."""
    without = [fused_half_axes_m([*seen[:i], *seen[i + 1 :]]) for i in range(len(seen))]
    sd = _jackknife([sphericity_3d(sides) for sides in without if sides is not None])
    return FusedValue(sphericity_3d(half_axes_m), sd, view_sd)


def _mean_over(values: Sequence[float]) -> FusedValue:
    """Mean of the views that answer."""
    told = np.array(values, dtype=np.float64)
    told = told[np.isfinite(told)]
    if not len(told):
        return FusedValue(float("nan"), float("nan"), float("nan"))
    several = len(told) > 1
    without = [float(np.delete(told, i).mean()) for i in range(len(told))] if several else []
    view_sd = float(np.std(told, ddof=1)) if several else float("nan")
    return FusedValue(float(told.mean()), _jackknife(without), view_sd)


def _jackknife(without: Sequence[float]) -> float:
    """Standard error of what n samples tell, from its values without each; NaN of fewer than two.

    Source: Efron and Stein (1981), The jackknife estimate of variance, equation 1.4.
    """
    n = len(without)
    return float(np.sqrt(n - 1) * np.std(without)) if n > 1 else float("nan")

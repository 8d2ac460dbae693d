"""Errors of the paper's method: each one was made somewhere, or is easily made."""

from dataclasses import replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import ndimage as ndi

from rockshape.ground import Plane
from rockshape.measures.angularity_2d import angularity_2d_deg
from rockshape.measures.angularity_3d import angularity_3d_per_m
from rockshape.measures.ellipse_error import ellipse_error_px2
from rockshape.observation import Observation
from rockshape.rock.view import RockView
from validation.mutations.mutation import Mutation
from validation.mutations.shared import (
    FORM,
    SHAPES,
    YARD,
    constant,
    lost,
    shuffled,
    stale,
    unsorted,
)

_HEIGHT = Plane.height_m


def _angularity(rock: RockView, *, alpha: int = 2, beta: int = 9) -> float:
    return angularity_2d_deg(rock.outline_px, alpha=alpha, beta=beta)


def _ellipse_error(rock: RockView, *, total: bool = False) -> float:
    if rock.ellipse is None:
        return float("nan")
    return ellipse_error_px2(rock.ellipse, rock.outline_px, total=total)


def _ratio(rock: RockView) -> float:
    return float("nan") if rock.ellipse is None else rock.ellipse.axis_ratio


def _signed(rock: RockView) -> float:
    return float("nan") if rock.surface is None else angularity_3d_per_m(rock.surface, signed=True)


def _depth_as_distance(seen: Observation) -> Observation:
    """Take each z-depth for the length along its ray: Z·(x, y, 1)/|(x, y, 1)|."""
    if seen.points_m is None:
        return seen
    points_m = seen.points_m
    stretch = np.linalg.norm(points_m, axis=-1, keepdims=True) / points_m[..., 2:]
    return replace(seen, points_m=points_m / stretch)


def _below(plane: Plane, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Count heights downwards."""
    return -_HEIGHT(plane, points_m)


def _grown(labels: NDArray[np.int32]) -> NDArray[np.int32]:
    """Give each rock a rim of one pixel."""
    spread = ndi.grey_dilation(labels, size=(3, 3))
    grown: NDArray[np.int32] = np.where(labels > 0, labels, spread).astype(np.int32)
    return grown


def _with_ground(labels: NDArray[np.int32]) -> NDArray[np.int32]:
    """Take two patches of ground for rocks."""
    found = labels.copy()
    for corner in (8, 40):
        patch = found[corner : corner + 20, 8:28]
        patch[patch == 0] = labels.max() + 1 + corner
    return found


def _half_a_pixel(table: pd.DataFrame) -> pd.DataFrame:
    return table.assign(row=table["row"] + 0.5, col=table["col"] + 0.5)


def _swapped(table: pd.DataFrame) -> pd.DataFrame:
    return table.assign(row=table["col"], col=table["row"])


def _millimetres(table: pd.DataFrame) -> pd.DataFrame:
    axes = {name: 1e3 * table[name] for name in ("axis_a_m", "axis_b_m", "axis_c_m")}
    return table.assign(**axes, ellipsoid_error_m2=1e6 * table["ellipsoid_error_m2"])


def _diameters(table: pd.DataFrame) -> pd.DataFrame:
    axes = ["axis_a_m", "axis_b_m", "axis_c_m"]
    return table.assign(**{name: 2.0 * table[name] for name in axes})


PAPER = (
    Mutation(
        "alpha off by one",
        "α = 1: triangles with corners two points away too",
        SHAPES,
        evaluate={"angularity_2d_deg": lambda rock: _angularity(rock, alpha=1)},
    ),
    Mutation(
        "alpha off by one, up",
        "α = 3: no triangles with corners three points away",
        SHAPES,
        evaluate={"angularity_2d_deg": lambda rock: _angularity(rock, alpha=3)},
    ),
    Mutation(
        "beta off by one",
        "β = 10: triangles with corners nine points away too",
        SHAPES,
        evaluate={"angularity_2d_deg": lambda rock: _angularity(rock, beta=10)},
    ),
    Mutation(
        "radians for degrees",
        "2-D angularity in radians",
        SHAPES,
        evaluate={"angularity_2d_deg": lambda rock: float(np.radians(_angularity(rock)))},
    ),
    Mutation(
        "sum for mean",
        "ellipse error summed, as the text says",
        SHAPES,
        evaluate={"ellipse_error_px2": lambda rock: _ellipse_error(rock, total=True)},
    ),
    Mutation(
        "root for square",
        "ellipse error in px",
        SHAPES,
        evaluate={"ellipse_error_px2": lambda rock: float(np.sqrt(_ellipse_error(rock)))},
    ),
    Mutation(
        "geometry's eccentricity",
        "√(1 − b²/a²) for the axis ratio",
        SHAPES,
        evaluate={"axis_ratio": lambda rock: float(np.sqrt(1.0 - _ratio(rock) ** 2))},
    ),
    Mutation(
        "squared axes",
        "b²/a² for the axis ratio: eigenvalues without their root",
        (*SHAPES, *FORM),
        evaluate={"axis_ratio": lambda rock: _ratio(rock) ** 2},
    ),
    Mutation(
        "long over short",
        "the upright box's sides the wrong way round",
        SHAPES,
        evaluate={"sphericity_2d": lambda rock: max(rock.mask.shape) / min(rock.mask.shape)},
    ),
    Mutation(
        "sign kept",
        "3-D angularity as printed: bumps and hollows cancel",
        YARD,
        evaluate={"angularity_3d_per_m": _signed},
    ),
    Mutation(
        "sign lost",
        "heights counted downwards: hollows for hills",
        YARD,
        patch=(Plane, "height_m", _below),
    ),
    Mutation("depth for distance", "z-depth taken along the ray", YARD, observe=_depth_as_distance),
    Mutation("millimetres", "half-axes and error in mm", YARD, table=_millimetres),
    Mutation("axes unsorted", "half-axes in the wrong order", FORM, table=unsorted),
    Mutation("diameters", "diameters for half-axes", YARD, table=_diameters),
    Mutation("half a pixel", "corners for pixel centres", YARD, table=_half_a_pixel),
    Mutation("rows for columns", "row and column swapped", YARD, table=_swapped),
    Mutation("masks one pixel wide", "each mask has a rim of ground", YARD, labels=_grown),
    Mutation("a rock lost", "one rock in each view is not found", (), records=lost),
    Mutation("ground for rocks", "two patches of ground in each view", YARD, labels=_with_ground),
    Mutation("stale truth", "the truth of rocks made anew", (), records=stale),
    *(
        shuffled(column)
        for column in ("angularity_2d_deg", "ellipsoid_error_m2", "sphericity_3d", "axis_ratio")
    ),
    *(constant(column) for column in ("angularity_2d_deg", "ellipse_error_px2", "sphericity_2d")),
)

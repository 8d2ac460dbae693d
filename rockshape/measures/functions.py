"""Measures as functions of one rock: of its mask, its outline or its points.

Measures of the outline take a mask (rows, cols), bool or 0 and another number, whose largest part
is measured, as whole also where it touches the array's edge; or an outline (n, 2) as (x, y) in
pixels, which its last and first point close. `method` picks the reading, `robust` or
`paper`; the latter is one of pixels, so that an outline is drawn on the pixel grid first.

Measures of the solid take points in the camera frame, metres: (n, 3), or (rows, cols, 3) with NaN
off the rock. Their robust reading also uses the rays that graze the rock and what it rests on: it
is NaN, with the reason, for points without grid, camera or ground. The camera of a grid is
calibrated from its points where none is given.

The result is a `Reading`: a float that tells its unit and, where it is NaN, the reason.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.camera.camera import Camera, CameraLike, as_camera
from rockshape.errors import InputError, unknown_name
from rockshape.ground import Ground, Plane
from rockshape.measures import angularity_2d as _angularity_2d
from rockshape.measures import angularity_3d as _angularity_3d
from rockshape.measures import axis_ratio as _axis_ratio
from rockshape.measures import ellipse_error as _ellipse_error
from rockshape.measures import ellipsoid_error as _ellipsoid_error
from rockshape.measures import roughness_2d as _roughness_2d
from rockshape.measures import roughness_3d as _roughness_3d
from rockshape.measures import roundness as _roundness
from rockshape.measures import sphericity_2d as _sphericity_2d
from rockshape.measures import sphericity_3d as _sphericity_3d
from rockshape.measures.measure import Measure
from rockshape.measures.reading import NAN, Reading, Reason
from rockshape.numerics.array_argument import array_argument
from rockshape.outline.polygon_fill import inside_of
from rockshape.rock.instances import Instance, Instances
from rockshape.rock.view import RockView

SURE_RESIDUAL_PX = 0.5  # of a camera calibrated from the grid


def axis_ratio(rock: ArrayLike, *, method: str = "robust") -> Reading:
    """Axis ratio b/a of a mask or outline."""
    measure = _choose(method, robust=_axis_ratio.ROBUST, paper=_axis_ratio.PAPER)
    return measure.read(_flat_view(rock))


def ellipse_error(rock: ArrayLike, *, method: str = "robust") -> Reading:
    """Ellipse fitting error of a mask or outline; `paper` in px²."""
    measure = _choose(method, robust=_ellipse_error.ROBUST, paper=_ellipse_error.PAPER)
    return measure.read(_flat_view(rock))


def sphericity_2d(rock: ArrayLike, *, method: str = "robust") -> Reading:
    """2-D sphericity, the aspect ratio, of a mask or outline."""
    measure = _choose(method, robust=_sphericity_2d.ROBUST, paper=_sphericity_2d.PAPER)
    return measure.read(_flat_view(rock))


def angularity_2d(rock: ArrayLike, *, method: str = "robust") -> Reading:
    """2-D angularity of a mask or outline; `paper` in degrees."""
    measure = _choose(method, robust=_angularity_2d.ROBUST, paper=_angularity_2d.PAPER)
    return measure.read(_flat_view(rock))


def roundness(rock: ArrayLike) -> Reading:
    """Wadell roundness of a mask or outline."""
    return _roundness.ROBUST.read(_flat_view(rock))


def roughness_2d(rock: ArrayLike) -> Reading:
    """2-D roughness of a mask or outline."""
    return _roughness_2d.ROBUST.read(_flat_view(rock))


def ellipsoid_error(
    points_m: ArrayLike,
    *,
    method: str = "robust",
    camera: CameraLike | None = None,
    ground: Ground | Plane | None = None,
) -> Reading:
    """Ellipsoid fitting error of points; `paper` in m²."""
    measure = _choose(method, robust=_ellipsoid_error.ROBUST, paper=_ellipsoid_error.PAPER)
    return _solid(points_m, measure, camera=camera, ground=ground)


def sphericity_3d(
    points_m: ArrayLike,
    *,
    method: str = "robust",
    camera: CameraLike | None = None,
    ground: Ground | Plane | None = None,
) -> Reading:
    """Maximum projection sphericity of points."""
    measure = _choose(method, robust=_sphericity_3d.ROBUST, paper=_sphericity_3d.PAPER)
    return _solid(points_m, measure, camera=camera, ground=ground)


def angularity_3d(
    points_m: ArrayLike,
    *,
    method: str = "robust",
    camera: CameraLike | None = None,
    ground: Ground | Plane | None = None,
) -> Reading:
    """3-D angularity of points; `paper` in 1/m.

    `robust` of range alone: without a picture it has no value where noise hides edges.
    """
    measure = _choose(method, robust=_angularity_3d.ROBUST, paper=_angularity_3d.PAPER)
    return _solid(points_m, measure, camera=camera, ground=ground)


def roughness_3d(
    points_m: ArrayLike,
    *,
    camera: CameraLike | None = None,
    ground: Ground | Plane | None = None,
) -> Reading:
    """3-D roughness of points."""
    return _solid(points_m, _roughness_3d.ROBUST, camera=camera, ground=ground)


def _choose(method: str, *, robust: Measure, paper: Measure) -> Measure:
    readings = {"robust": robust, "paper": paper}
    if not isinstance(method, str) or method not in readings:
        raise unknown_name("method", method, readings)
    return readings[method]


def _flat_view(rock: ArrayLike) -> RockView:
    """View of a mask or outline.

    Raises: InputError for what is neither.
    """
    given = array_argument("rock", rock)
    if given.dtype.kind in "iuf" and given.ndim == 2 and given.shape[1] == 2:
        return _outline_view(given)
    if given.ndim != 2 or given.dtype.kind not in "bui":
        raise InputError(
            "rock: expected a mask (rows, cols), bool or whole numbers, or an outline (n, 2), "
            f"found {given.shape} of {given.dtype}"
        )
    numbers = np.unique(given[given != 0])
    if len(numbers) > 1:
        told = ", ".join(str(number) for number in numbers[:3])
        raise InputError(
            f"rock: expected a mask of one rock, found labels {told}"
            f"{' …' if len(numbers) > 3 else ''}"
        )
    parts = Instances.from_labels((given != 0).astype(np.uint8)).largest_parts()
    part = next(iter(parts), Instance(1, np.s_[0:0, 0:0], np.zeros((0, 0), dtype=bool)))
    return RockView(mask=part.mask, corner=(part.window[0].start, part.window[1].start))


def _outline_view(outline: NDArray[np.generic]) -> RockView:
    points = outline.astype(np.float64)
    if not np.isfinite(points).all():
        raise InputError("rock: expected an outline of finite numbers, found some that are not")
    if len(points) == 0:
        return RockView(mask=np.zeros((0, 0), dtype=bool))
    lowest = np.floor(points.min(axis=0))
    x, y = (points - lowest).T
    shape = int(np.ceil(y.max())) + 1, int(np.ceil(x.max())) + 1
    window, mask = inside_of(x, y, shape)
    corner = (window[0].start + int(lowest[1]), window[1].start + int(lowest[0]))
    return RockView(mask=mask, corner=corner, subpixel_px=points)


def _points_view(points_m: ArrayLike) -> RockView:
    given = array_argument("points_m", points_m)
    if given.dtype.kind not in "iuf":
        raise InputError(f"points_m: expected numbers, found {given.dtype}")
    grid = given.astype(np.float64)
    if grid.ndim not in (2, 3) or grid.shape[-1] != 3:
        raise InputError(f"points_m: expected (n, 3) or (rows, cols, 3), found {grid.shape}")
    grid = grid[None] if grid.ndim == 2 else grid
    return RockView(mask=np.asarray(np.isfinite(grid).all(axis=-1)), grid_m=grid)


def _solid(
    points_m: ArrayLike,
    measure: Measure,
    *,
    camera: CameraLike | None,
    ground: Ground | Plane | None,
) -> Reading:
    """Reading of points; what constrains the ellipsoid is asked for only where it is used."""
    view = _points_view(points_m)
    if not measure.constrained:
        return measure.read(view)
    grid = view.grid_m
    if grid is None or np.ndim(points_m) == 2:
        return Reading(NAN, measure.unit, Reason.NO_GRID)
    seen = _calibrated(grid) if camera is None else as_camera(camera, shape=grid.shape)
    if seen is None:
        return Reading(NAN, measure.unit, Reason.NO_CAMERA)
    if ground is None:
        return Reading(NAN, measure.unit, Reason.NO_GROUND)
    known = Ground(ground) if isinstance(ground, Plane) else ground
    return measure.read(RockView(mask=view.mask, grid_m=grid, camera=seen, ground=known))


def _calibrated(grid_m: NDArray[np.float64]) -> Camera | None:
    """Camera at the origin that saw a grid of points; None where none explains it."""
    from rockshape.camera.calibration import calibrate  # noqa: PLC0415 - brings scipy.optimize

    found = calibrate(grid_m)
    return None if found is None or found.residual_px > SURE_RESIDUAL_PX else found.camera

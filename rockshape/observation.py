"""Observation: an image and, where it was measured, the point seen at each pixel."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.camera.lens import has_square_pixels
from rockshape.camera.map_frame import MapFrame
from rockshape.errors import InputError
from rockshape.rock.instances import Instances
from rockshape.rock.level_ground import LevelGround

if TYPE_CHECKING:
    from rockshape.camera.resection import Resection

GreyImage = NDArray[np.float32]
"""Grey levels (rows, cols) from 0 to 1."""

PointGrid = NDArray[np.float64]
"""Points (rows, cols, 3) in metres, one a pixel; NaN where nothing was measured."""

LabelImage = NDArray[np.int32]
"""Rock ids (rows, cols), 0 the ground."""

Outline = NDArray[np.float64]
"""Closed outline (n, 2) as (x, y) in pixels, clockwise as seen, the first point not repeated.

Pixel centres are at whole numbers, so that a rock of one pixel reaches from -0.5 to 0.5 about it.
"""

SURE_RESIDUAL_PX = 0.5  # a camera at the origin that explains the grid this well is the one
WORST_RESIDUAL_PX = 3.0  # a grid that no camera explains better than this is not one camera's


@dataclass(frozen=True, eq=False, repr=False)
class Observation:
    """One image, its range, and what is known of its camera and its rocks.

    points_m is NaN where nothing was measured. With a camera the points are in its frame; without
    one `locate_camera` finds it. `resection` then tells the camera's pose and residual.
    Raises: InputError where the shapes do not fit each other.
    """

    image: GreyImage  # (rows, cols), grey from 0 to 1
    points_m: PointGrid | None = None  # (rows, cols, 3)
    camera: Camera | None = None
    resection: "Resection | None" = None
    colour: NDArray[np.generic] | None = None  # (rows, cols, channels), as given; None: grey alone
    instances: Instances | None = None  # rocks outlined already; None: they are to be found
    ignored: NDArray[np.bool_] | None = None  # (rows, cols), where no rock is to be found
    left_out: Mapping[str, int] = field(default_factory=dict)  # pixels without range, by reason
    pixel_size_m: float | None = None  # side of a pixel on what is seen, where it is known
    map_frame: MapFrame | None = None  # where on a map the pixels lie, of an orthophoto
    level_ground: LevelGround | None = None  # below the camera, in place of range
    notes: tuple[str, ...] = ()  # what reading has changed or left out, each in a few words

    def __post_init__(self) -> None:
        given: object = self.image
        if not isinstance(given, np.ndarray):
            raise InputError(f"image: expected an array (rows, cols), found {type(given).__name__}")
        shape = self.image.shape
        if self.image.ndim != 2 or self.image.size == 0:
            raise InputError(f"image: expected (rows, cols), found {shape}")
        if self.camera is not None and self.camera.shape != shape:
            raise InputError(
                f"camera: expected {shape} as the image has, found {self.camera.shape}"
            )
        if self.camera is not None and not has_square_pixels(self.camera):
            raise InputError(
                f"camera: expected square pixels, fx and fy equal to 0.5 %, found "
                f"{self.camera.fx:g} and {self.camera.fy:g}; rockshape.read resamples files"
            )
        if self.points_m is not None and self.points_m.shape != (*shape, 3):
            raise InputError(f"points_m: expected {(*shape, 3)}, found {self.points_m.shape}")
        if self.colour is not None and self.colour.shape[:2] != shape:
            raise InputError(f"colour: expected {shape} pixels, found {self.colour.shape}")
        if self.ignored is not None and self.ignored.shape != shape:
            raise InputError(
                f"ignore: expected {shape} as the image has, found {self.ignored.shape}"
            )
        if self.instances is not None and self.instances.shape != shape:
            raise InputError(
                f"labels: expected {shape} as the image has, found {self.instances.shape}"
            )

    def __repr__(self) -> str:
        """Size, and what is known beside the image."""
        rows, cols = self.image.shape
        beside = ("points_m", "camera", "colour", "instances")
        known = [name for name in beside if getattr(self, name) is not None]
        return f"Observation({', '.join([f'image {rows} x {cols}', *known])})"


def locate_camera(observation: Observation) -> Observation:
    """Observation with its camera, found by resection where range is given without one.

    Points that a camera at their origin explains to 0.5 px are left as they are; else the camera is
    resected from the grid and the points are moved to its frame, if it explains them to 3 px.
    Otherwise, and with a camera or without range, the observation is returned as it is.
    """
    points_m = observation.points_m
    if points_m is None or observation.camera is not None:
        return observation
    # brings scipy.optimize, a fifth of a second
    from rockshape.camera.calibration import calibrate  # noqa: PLC0415
    from rockshape.camera.resection import resect  # noqa: PLC0415

    resection = calibrate(points_m)
    if resection is None or resection.residual_px > SURE_RESIDUAL_PX:
        resection = resect(points_m)
    if resection is None or resection.residual_px > WORST_RESIDUAL_PX:
        return observation
    return replace(
        observation,
        resection=resection,
        camera=resection.camera,
        points_m=resection.to_camera(points_m),
    )

"""One posed view: its rocks measured, their points and feet, and the surface about them."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.fusion.pose import CameraPose
from rockshape.measurement import Measurement, Rock
from rockshape.point_grid.flying import flying_pixels

MIN_POINTS = 30  # of a rock in one view, below which it is not told where it lies


@dataclass(frozen=True, eq=False)
class ViewRock:
    """One rock as one view has it, in the camera frame."""

    rock: Rock
    points_m: NDArray[np.float64]  # (n, 3), without flying pixels
    feet_m: NDArray[np.float64]  # (n, 3), where each point's plumb line meets the ground; or none


@dataclass(frozen=True, eq=False)
class PosedView:
    """A view measured, with its pose."""

    name: str
    pose: CameraPose
    measurement: Measurement
    rocks: tuple[ViewRock, ...]  # those with range; in the order of their numbers
    ground_m: NDArray[np.float64]  # (n, 3) in the camera frame, what is not rock
    up: NDArray[np.float64]  # (3,) in the camera frame, the ground's normal

    def posed(self, pose: CameraPose) -> "PosedView":
        """The same view with another pose."""
        return replace(self, pose=pose)


def posed_view(name: str, pose: CameraPose, measurement: Measurement) -> PosedView:
    """View of a measurement and a pose.

    Raises: InputError without range, a camera or ground.
    """
    points_m, camera = measurement.observation.points_m, measurement.observation.camera
    if points_m is None:
        raise InputError(f"{name}: expected range, found none")
    if camera is None:
        raise InputError(f"{name}: expected a camera or range that tells one, found neither")
    if measurement.ground is None:
        raise InputError(f"{name}: expected range of the ground under the rocks, found too little")
    ground = measurement.ground
    clean_m = points_m.copy()
    clean_m[flying_pixels(points_m, pixel_rad=1.0 / camera.fx)] = np.nan
    told = {rock.number: rock for rock in measurement.rocks}
    rocks: list[ViewRock] = []
    bare: NDArray[np.bool_] = np.asarray(np.isfinite(clean_m).all(axis=-1))
    for item in measurement.instances:
        bare[item.window] &= ~item.mask
    for part in measurement.instances.largest_parts():
        seen = clean_m[part.window][part.mask]
        seen = seen[np.isfinite(seen).all(axis=1)]
        if len(seen) >= MIN_POINTS:
            feet = seen - ground.height_m(seen)[:, None] * ground.plane.normal
            rocks.append(ViewRock(told[part.id], seen, feet))
    return PosedView(name, pose, measurement, tuple(rocks), clean_m[bare], ground.plane.normal)

"""Camera model: presets, poses and projection, in OpenCV's frame (x right, y down, z forward)."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.errors import SpecError

Reals = NDArray[np.floating[Any]]

_ROUNDS = 30  # of Newton's method; four or five do for the lenses in use
_SAME = 1e-13  # of x/z: steps below this end the search
_FOUND = 1e-9  # of x/z: a ray that the lens puts farther off than this is none


@dataclass(frozen=True)
class RenderCamera:
    """Pinhole camera, with a lens or without; integer pixel coordinates are pixel centres."""

    fx: float  # pixels
    fy: float  # pixels
    cx: float  # pixels
    cy: float  # pixels
    width: int  # pixels
    height: int  # pixels
    distortion: tuple[float, ...] | None = None  # k1, k2, p1, p2, k3 of OpenCV; None: a pinhole

    def matrix(self) -> Floats:
        """Camera matrix K, (3, 3): pixels from camera coordinates over depth."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def refined(self, factor: int) -> "RenderCamera":
        """Camera with each pixel split into factor × factor, over the same field."""
        return RenderCamera(
            fx=self.fx * factor,
            fy=self.fy * factor,
            cx=(self.cx + 0.5) * factor - 0.5,
            cy=(self.cy + 0.5) * factor - 0.5,
            width=self.width * factor,
            height=self.height * factor,
            distortion=self.distortion,
        )


@dataclass(frozen=True)
class Preset:
    """Camera preset: a flown camera, its stereo baseline and a suitable distance from the rocks."""

    camera: RenderCamera
    distance_m: float
    baseline_m: float | None = None  # from the left eye to the right one; None: one eye alone


def _preset(
    width_px: int, height_px: int, *, pixel_mrad: float, baseline_m: float, distance_m: float
) -> Preset:
    """Preset with square pixels and the principal point in the frame's middle."""
    focal_px = 1000.0 / pixel_mrad
    camera = RenderCamera(
        fx=focal_px,
        fy=focal_px,
        cx=(width_px - 1) / 2.0,
        cy=(height_px - 1) / 2.0,
        width=width_px,
        height=height_px,
    )
    return Preset(camera=camera, distance_m=distance_m, baseline_m=baseline_m)


# Frame, central pixel's angle and baseline: Imager for Mars Pathfinder (Smith et al. 1997),
# Sojourner (Matijevic et al. 1997), Mars Exploration Rovers (Maki et al. 2003, Bell et al. 2003),
# Mars Science Laboratory (Maki et al. 2012), Mars 2020 (Maki et al. 2020). A fisheye is taken as
# the pinhole with its frame and its central pixel, so its field is narrower than the lens's.
PRESETS = {
    "imp": _preset(256, 256, pixel_mrad=0.98, baseline_m=0.150, distance_m=11.0),
    "sojourner": replace(
        _preset(768, 484, pixel_mrad=2.9, baseline_m=0.126, distance_m=2.5),
        camera=RenderCamera(1000.0 / 2.9, 1000.0 / 3.4, 383.5, 241.5, 768, 484),
    ),
    "mer-navcam": _preset(1024, 1024, pixel_mrad=0.82, baseline_m=0.20, distance_m=4.5),
    "mer-hazcam": _preset(1024, 1024, pixel_mrad=2.1, baseline_m=0.10, distance_m=2.5),
    "mer-pancam": _preset(1024, 1024, pixel_mrad=0.28, baseline_m=0.30, distance_m=11.0),
    "msl-navcam": _preset(1024, 1024, pixel_mrad=0.82, baseline_m=0.424, distance_m=4.5),
    "m2020-navcam": _preset(5120, 3840, pixel_mrad=0.33, baseline_m=0.424, distance_m=4.5),
}


@dataclass(frozen=True, eq=False)
class Pose:
    """Camera pose: camera = world_to_camera · world + translation_m."""

    world_to_camera: Floats  # (3, 3) rotation
    translation_m: Floats  # (3,)

    def position_m(self) -> Floats:
        """Camera's centre in the world, (3,)."""
        return np.asarray(-self.world_to_camera.T @ self.translation_m)

    def camera_points_m(self, world_points_m: Floats) -> Floats:
        """World points, (..., 3), in the camera's frame."""
        return np.asarray(world_points_m @ self.world_to_camera.T + self.translation_m)


def right_eye(pose: Pose, baseline_m: float) -> Pose:
    """Pose of a second, parallel camera, a baseline to the right of the first."""
    shift_m = np.array([baseline_m, 0.0, 0.0])
    return Pose(pose.world_to_camera, pose.translation_m - shift_m)


def look_at(position_m: Floats, target_m: Floats, *, roll_rad: float = 0.0) -> Pose:
    """Pose at a position that has the target on its axis, rolled from a level horizon.

    A roll turns the camera clockwise about its axis, so the image turns anticlockwise.
    Straight up or down the horizon is undefined; the image's right is then the world's x.
    """
    forward = target_m - position_m
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    length = np.linalg.norm(right)
    right = right / length if length > 1e-12 else np.array([1.0, 0.0, 0.0])
    world_to_camera = np.stack([right, np.cross(forward, right), forward])
    if roll_rad:
        cosine, sine = np.cos(roll_rad), np.sin(roll_rad)
        roll = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        world_to_camera = roll @ world_to_camera
    return Pose(world_to_camera=world_to_camera, translation_m=-world_to_camera @ position_m)


def project(camera: RenderCamera, points_m: Floats) -> Floats:
    """Projection: pixels (column, row), (..., 2), of camera-frame points (..., 3) ahead of it."""
    across = points_m[..., 0] / points_m[..., 2]
    down = points_m[..., 1] / points_m[..., 2]
    x, y = distorted(camera, across, down)
    return np.stack([camera.fx * x + camera.cx, camera.fy * y + camera.cy], axis=-1)


def distorted(camera: RenderCamera, across: Reals, down: Reals) -> tuple[Reals, Reals]:
    """Lens distortion of rays (x/z, y/z), by the Brown–Conrady model as OpenCV has it."""
    if camera.distortion is None:
        return across, down
    k1, k2, p1, p2, k3 = camera.distortion
    square = across**2 + down**2
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    return (
        across * radial + 2.0 * p1 * across * down + p2 * (square + 2.0 * across**2),
        down * radial + p1 * (square + 2.0 * down**2) + 2.0 * p2 * across * down,
    )


def undistorted(camera: RenderCamera, across: Reals, down: Reals) -> tuple[Reals, Reals]:
    """Inverse lens distortion: the rays (x/z, y/z) that the lens shows there.

    Newton's method from the place itself. Where the lens folds the image, some places have no
    ray, and what is returned is none: see `check_lens`. Both arguments are broadcast together.
    """
    if camera.distortion is None:
        return across, down
    wanted_across, wanted_down = (np.asarray(one) for one in np.broadcast_arrays(across, down))
    x: Reals = wanted_across.astype(np.float64)
    y: Reals = wanted_down.astype(np.float64)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for _ in range(_ROUNDS):
            step_x, step_y = _newton_step(camera.distortion, x, y, wanted_across, wanted_down)
            x, y = np.subtract(x, step_x), np.subtract(y, step_y)
            if (np.hypot(step_x, step_y) < _SAME).all():
                break
    return x, y


def _newton_step(
    lens: tuple[float, ...], x: Reals, y: Reals, wanted_x: Reals, wanted_y: Reals
) -> tuple[Reals, Reals]:
    """Newton step J⁻¹ (distorted(x, y) − wanted), J the lens's Jacobian, which is symmetric."""
    k1, k2, p1, p2, k3 = lens
    square = x**2 + y**2
    radial = 1.0 + square * (k1 + square * (k2 + square * k3))
    slope = 2.0 * (k1 + square * (2.0 * k2 + square * 3.0 * k3))  # of radial, over x and over y
    off_x = x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x**2) - wanted_x
    off_y = y * radial + p1 * (square + 2.0 * y**2) + 2.0 * p2 * x * y - wanted_y
    xx = radial + slope * x**2 + 2.0 * p1 * y + 6.0 * p2 * x
    yy = radial + slope * y**2 + 6.0 * p1 * y + 2.0 * p2 * x
    xy = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y
    size = xx * yy - xy**2
    return (yy * off_x - xy * off_y) / size, (xx * off_y - xy * off_x) / size


def pixel_rays(camera: RenderCamera) -> tuple[Floats, Floats]:
    """Pixel centres over the focal length, (1, cols) and (rows, 1)."""
    columns, rows = np.arange(camera.width)[None, :], np.arange(camera.height)[:, None]
    return (
        np.asarray((columns - camera.cx) / camera.fx, dtype=np.float64),
        np.asarray((rows - camera.cy) / camera.fy, dtype=np.float64),
    )


def border_rays(camera: RenderCamera) -> tuple[Floats, Floats, Floats, Floats]:
    """Rays (x/z, y/z), (n, 2), along the frame's left, top, right and bottom side."""
    columns = np.arange(camera.width + 1) - 0.5
    rows = np.arange(camera.height + 1) - 0.5
    left, right = np.full(len(rows), -0.5), np.full(len(rows), camera.width - 0.5)
    top, bottom = np.full(len(columns), -0.5), np.full(len(columns), camera.height - 0.5)
    sides = [(left, rows), (columns, top), (right, rows), (columns, bottom)]
    one, two, three, four = (
        np.column_stack(
            undistorted(camera, (column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy)
        ).astype(np.float64)
        for column, row in sides
    )
    return one, two, three, four


def check_lens(camera: RenderCamera) -> None:
    """Lens check: each place of the frame has a ray of its own.

    Raises:
        SpecError: the lens folds the image inside the frame.
    """
    if camera.distortion is None:
        return
    for column in (-0.5, camera.width - 0.5):
        for row in (-0.5, camera.height - 0.5):
            wanted = np.array([[(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy]])
            # A grid from the axis to the corner: a fold on the way is one as well.
            places = np.linspace(0.0, 1.0, 65)[:, None] * wanted
            rays = undistorted(camera, *places.T)
            again = np.column_stack(distorted(camera, *rays))
            outward = np.diff(np.hypot(*rays)) > 0.0
            if not (np.abs(again - places).max() < _FOUND and outward.all()):
                raise SpecError(
                    "camera.distortion: expected a lens that shows each point of the frame once, "
                    f"found {list(camera.distortion)}, which folds the image"
                )
